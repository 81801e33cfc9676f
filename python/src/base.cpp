// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of base: errors, units, grids, moments, threads, and the list of works to cite.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <pthread.h>

#include <algorithm>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/base/units.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/results/quantity.hpp>
#include <tuple>

#include "base/printable.hpp"
#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

bool forked = false;  // true in a process that was forked after the import

/// The quantity of this name in the glossary or, if it has none, in a list of quantities that are
/// only arguments.
Quantity quantity_named(std::string_view name) {
  if (is_quantity(name)) return find_quantity(name);
  for (const Quantity& one :
       {Quantity{"resistivity", Dimension::resistivity, "electrical resistivity of a body"},
        Quantity{"conductivity", Dimension::thermal_conductivity, "thermal conductivity of a body"},
        Quantity{"work_of_adhesion", Dimension::energy_per_area, "work of adhesion"},
        Quantity{"coupling_constant", Dimension::inverse_pressure, "β/(πE*)"}})
    if (one.name == name) return one;
  return find_quantity(name);
}

std::string unit_text(Dimension dimension) {
  return dimension == Dimension::dimensionless ? "" : std::string(si_unit(dimension));
}

/// Units of the described properties, by Python class and name of the property.
auto& property_units() {
  static std::map<std::pair<PyObject*, std::string>, Dimension, std::less<>> units;
  return units;
}

/// The unit of a property of a Python class: as described for this class or one of its bases,
/// otherwise that of the quantity with this name. "" for pure numbers.
std::string unit_of_property(nb::handle type, const std::string& name) {
  for (nb::handle base : type.attr("__mro__"))
    if (const auto found = property_units().find({base.ptr(), name});
        found != property_units().end())
      return unit_text(found->second);
  return unit_text(quantity_named(name).dimension);
}

std::vector<std::string>& keys_cited() {
  static std::vector<std::string> keys;
  return keys;
}

}  // namespace

void remember_unit(nb::handle type, std::string_view property, Dimension dimension) {
  property_units()[{type.ptr(), std::string(property)}] = dimension;
}

void cite(std::initializer_list<const char*> keys) {
  auto& known = keys_cited();
  for (const char* key : keys)
    if (std::ranges::find(known, key) == known.end()) known.emplace_back(key);
}
const std::vector<std::string>& cited() { return keys_cited(); }
void forget_citations() { keys_cited().clear(); }

void bind_base(nb::module_& m) {
  static nb::exception<Error> error(m, "Error");
  const auto child = [&](nb::handle builtin) { return nb::make_tuple(error, builtin); };
  static nb::exception<InvalidInput> invalid(m, "InvalidInput", child(PyExc_ValueError));
  static nb::exception<IoError> io(m, "IoError", child(PyExc_OSError));
  static nb::exception<NotConverged> not_converged(m, "NotConverged", child(PyExc_RuntimeError));
  static nb::exception<Interrupted> interrupted(m, "Interrupted", child(PyExc_RuntimeError));
  for (const char* part : {"field", "value", "constraint", "remedy"}) invalid.attr(part) = "";
  error.attr("__doc__") = "Base class of all exceptions that salebra raises on purpose.";
  invalid.attr("__doc__") =
      "A value or file is unusable; nothing was computed or written. The text is \"field: value "
      "constraint; remedy\". The four parts are attributes, some of them empty: field (the "
      "argument or "
      "file), value (as text), constraint, remedy. Also a ValueError.";
  io.attr("__doc__") =
      "The operating system refused a read or a write (disk full, no permission). Also an OSError.";
  not_converged.attr("__doc__") =
      "A computation ended without reaching its tolerance, and its result cannot show that. Also a "
      "RuntimeError. Solvers do not raise it: they return a result with converged = False.";
  interrupted.attr("__doc__") =
      "A progress function returned False, and there is no partial result. Also a RuntimeError.";
  // Registered before the translators of the single classes. Messages quote names and files;
  // control characters in them are replaced, since they must not reach a terminal.
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    const auto raise = [](const nb::handle& kind, const Error& what) {
      PyErr_SetString(kind.ptr(), printable(what.what()).c_str());
    };
    try {
      std::rethrow_exception(thrown);
    } catch (const InvalidInput& what) {
      nb::object refusal = invalid(printable(what.what()));
      for (const auto& [name, part] :
           {std::pair("field", &what.field()), std::pair("value", &what.value()),
            std::pair("constraint", &what.constraint()), std::pair("remedy", &what.remedy())})
        refusal.attr(name) = printable(*part);
      PyErr_SetObject(invalid.ptr(), refusal.ptr());
    } catch (const IoError& what) {
      raise(io, what);
    } catch (const NotConverged& what) {
      raise(not_converged, what);
    } catch (const Interrupted& what) {
      raise(interrupted, what);
    }
  });

  m.def(
      "version", [] { return std::string(version()); },
      "Version of the library, \"major.minor.patch\".");
  m.def(
      "library_versions", &library_versions,
      "The libraries in use, \"Eigen 3.4.0, FFTW 3.3.10, …\". The last digits of results depend on "
      "them.");
  // A forked process does not have the OpenMP threads of its parent and would wait for them for
  // ever, so it computes on one thread.
  pthread_atfork(nullptr, nullptr, [] {
    forked = true;
    parallel::set_threads(1);
  });
  m.def(
      "set_threads",
      [](int threads) {
        require(!forked || threads == 1, "threads", threads,
                "must be 1 in a forked process; use the start method spawn for more");
        parallel::set_threads(threads);
      },
      nb::arg("threads"),
      "Sets the number of threads of loops and transforms; 0 means all that the process may run "
      "on, at most 64 or four for each processor.\n\n"
      "Results have the same bits for every number of threads.");
  m.def("threads", &parallel::threads, "Number of threads of loops and transforms.");

  m.def(
      "parse_quantity",
      [](const std::string& text, const std::string& name) {
        return parse_quantity(text, quantity_named(name).dimension, name);
      },
      nb::arg("text"), nb::arg("name"),
      R"(Converts a text with a unit to a number in SI units, as the program and study files do.

Parameters
----------
text : str
    "10um", "115 GPa", "20kHz", "90deg"; a bare number is SI.
name : str
    Name of the quantity, such as "contact_modulus", which decides the allowed units.

Examples
--------
>>> salebra.parse_quantity("115 GPa", "contact_modulus")
115000000000.0
)");
  m.def(
      "format_quantity",
      [](double value, const std::string& name, int digits) {
        return format_quantity(value, quantity_named(name).dimension, digits);
      },
      nb::arg("value"), nb::arg("name"), nb::arg("digits") = 4,
      R"(Formats a number with significant digits, an SI prefix and the unit of the quantity `name`.

Examples
--------
>>> salebra.format_quantity(1.234e-6, "mean_gap")
'1.234 µm'
)");
  m.def(
      "quantity",
      [](const std::string& name) {
        const Quantity found = quantity_named(name);
        return std::make_tuple(std::string(si_unit(found.dimension)), std::string(found.long_name));
      },
      nb::arg("name"),
      "SI unit and description of a name that salebra uses in options, results and files: (\"m\", "
      "\"decay length of "
      "force with mean gap\").");

  m.def("_unit_of_property", &unit_of_property, nb::arg("type"), nb::arg("name"),
        nb::sig("def _unit_of_property(type: type, name: str) -> str"),
        "SI unit of a property of a class, empty for pure numbers.");

  m.def("_cited", &cited, "Keys of the works that this session used.");
  m.def("_forget_citations", &forget_citations, "Clears the list of citations.");

  described_class<Report>(
      m, "ProgressReport",
      "Progress of a long computation: `progress` functions receive one and return False to stop.");

  nb::class_<Grid2D> bound(m, "Grid2D",
                           R"(Regular grid of nx × ny cells on a rectangle of lx × ly metres.

Point (ix, iy) lies at x = ix·dx, y = iy·dy; lx = nx·dx is the period of a periodic surface.

Parameters
----------
nx, ny : int
    Cells along x and y.
lx, ly : float
    Size, m.
)");
  bound
      .def(
          "__init__",
          [](Grid2D* self, Index nx, Index ny, double lx, double ly) {
            const Grid2D grid{nx, ny, lx, ly};
            grid.validate();
            new (self) Grid2D(grid);
          },
          nb::arg("nx"), nb::arg("ny"), nb::arg("lx"), nb::arg("ly"))
      .def("__hash__",
           [](const Grid2D& grid) {
             return nb::hash(nb::make_tuple(grid.nx, grid.ny, grid.lx, grid.ly));
           })
      .def("__repr__", [](const Grid2D& grid) {
        return "Grid2D(nx=" + std::to_string(grid.nx) + ", ny=" + std::to_string(grid.ny) +
               ", lx=" + format_quantity(grid.lx, Dimension::length) +
               ", ly=" + format_quantity(grid.ly, Dimension::length) + ")";
      });
  using enum Dimension;
  const auto property = [&bound](auto member, const Kept& line) {
    described_property(bound, member, line);
  };
  property(&Grid2D::nx, {"nx", "cells along x"});
  property(&Grid2D::ny, {"ny", "cells along y"});
  property(&Grid2D::lx, {"lx", "size along x", length});
  property(&Grid2D::ly, {"ly", "size along y", length});
  property(&Grid2D::dx, {"dx", "size of a cell along x", length});
  property(&Grid2D::dy, {"dy", "size of a cell along y", length});
  property(&Grid2D::points, {"points", "nx·ny"});
  property(&Grid2D::area, {"area", "nominal area", length_squared});
  property(&Grid2D::cell_area, {"cell_area", "area of a cell", length_squared});

  described_class<SpectralMoments>(m, "SpectralMoments",
                                   R"(Profile moments of a surface or of a spectrum along both axes.

.. math:: m_0 = \langle h^2\rangle,\quad m_2 = \langle(\partial h/\partial x)^2\rangle,\quad
          m_4 = \langle(\partial^2 h/\partial x^2)^2\rangle
)");
}

}  // namespace salebra::python
