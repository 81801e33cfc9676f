// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the result reader and of the report.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/report/report.hpp>

#include "bindings.hpp"
#include "interop/arrays.hpp"
#include "interop/path.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

nb::object array_in(const ResultReader& reader, const std::string& dataset) {
  if (reader.holds_labels(dataset))
    return nb::module_::import_("numpy").attr("array")(nb::cast(reader.labels(dataset)), "U");
  nb::list shape;
  for (const Index extent : reader.shape(dataset)) shape.append(extent);
  nb::object values = nb::cast(array_of(reader.numbers(dataset))).attr("reshape")(nb::tuple(shape));
  const bool flags = reader.text_attribute(dataset, "dtype") == "bool";
  return flags ? values.attr("astype")("bool") : values;
}

nb::dict attributes_in(const ResultReader& reader, const std::string& path) {
  nb::dict attributes;
  for (const std::string& name : reader.attributes(path)) {
    if (const auto number = reader.number_attribute(path, name))
      attributes[name.c_str()] = *number;
    else if (const auto text = reader.text_attribute(path, name))
      attributes[name.c_str()] = *text;
  }
  return attributes;
}

void bind_reader(nb::module_& m) {
  nb::class_<ResultReader>(
      m, "ResultReader", nb::dynamic_attr(),
      R"(Reads files of results as arrays with units: those of the program, ``-o FILE.h5``, and of the write functions.

Groups are the stages of a computation (`surface`, `curve`, `fit`, `damping`, …); datasets lie on coordinates of their group. Paths are
like "curve/pressure". Any HDF5 file of real numbers can be read.

Parameters
----------
file : str or os.PathLike

Raises
------
InvalidInput
    "<file>: <what is wrong>; <what to do>" for a file that is absent, of another kind or damaged.

Examples
--------
>>> results = salebra.ResultReader("study.h5")
>>> results["damping/pressure"], results.units("damping/pressure")
)")
      .def(nb::init<const std::filesystem::path&>(), nb::arg("file"))
      .def_prop_ro("file", &ResultReader::file, "Path of the file.")
      .def("groups", &ResultReader::groups, nb::arg("path") = "/",
           "Names of the groups in a group.")
      .def("datasets", &ResultReader::datasets, nb::arg("path") = "/",
           "Names of the datasets in a group, coordinates included.")
      .def("__contains__", &ResultReader::has, nb::arg("path"),
           "Whether there is such a group or dataset.")
      .def("__getitem__", &array_in, nb::arg("dataset"),
           nb::sig("def __getitem__(self, dataset: str) -> numpy.typing.NDArray[typing.Any]"),
           "The values of a dataset as a new array: float64 (whole numbers too), bool for truth "
           "values, str "
           "for names; zero-dimensional for a single number.")
      .def(
          "coordinates", &ResultReader::coordinates, nb::arg("dataset"),
          "Names of the coordinates of a dataset, one for each axis; none for a coordinate itself.")
      .def(
          "units",
          [](const ResultReader& self, const std::string& dataset) {
            self.shape(dataset);  // throws if the file has no such dataset
            return self.text_attribute(dataset, "units").value_or("");
          },
          nb::arg("dataset"),
          "SI unit of a dataset, \"1\" for pure numbers; empty if it has no unit.")
      .def("attributes", &attributes_in, nb::arg("path") = "/",
           nb::sig("def attributes(self, path: str = '/') -> dict[str, float | str]"),
           "Attributes of a group or dataset; those of \"/\" are the provenance: program, version, "
           "command line, configuration.")
      .def(
          "to_xarray",
          [](nb::handle_t<ResultReader> self, const std::string& group) {
            return nb::module_::import_("salebra._results").attr("group_to_xarray")(self, group);
          },
          nb::arg("group") = "/",
          nb::sig("def to_xarray(self, group: str = '/') -> xarray.Dataset"),
          "A group as an xarray.Dataset, with units, descriptions and attributes. Needs xarray.")
      .def("__repr__",
           [](const ResultReader& self) { return "ResultReader('" + self.file().string() + "')"; });
}

// Defines a function that writes a study as a page. page: name of the argument with its file.
void define_report(nb::module_& m, const char* name, const char* page,
                   void (*write)(const std::filesystem::path&, const std::filesystem::path&,
                                 const ReportOptions&),
                   const char* description) {
  m.def(
      name,
      [write](const std::filesystem::path& results, const std::filesystem::path& to,
              const std::string& title, const std::vector<std::filesystem::path>& direct,
              bool overwrite) {
        unlocked([&] { write(results, to, {{overwrite}, title, direct}); });
      },
      nb::arg("results"), nb::arg(page), nb::kw_only(), nb::arg("title") = "",
      nb::arg("direct") = std::vector<std::filesystem::path>{}, nb::arg("overwrite") = false,
      description);
}

void bind_report(nb::module_& m) {
  m.def("can_report", &can_report, "Whether this build has plotly.js, which reports need.");
  define_report(
      m, "write_report", "html", &write_report,
      R"(Writes an HTML page about the results of a study, as the program's command `report` does. The page needs no network.

The page has results and warnings, the surface, force over mean gap with the fit, a comparison of the models, damping
with bands, settings and provenance. Every figure comes with its numbers as a table and as CSV.

Parameters
----------
results : str or os.PathLike
    A file of :meth:`StudyResult.write`, :func:`write_ensembles`, or of the program's `study` or `compare`.
html : str or os.PathLike
    The page; it appears complete or not at all.
title : str
    Heading; empty: the origin of the surface.
direct : list of str or os.PathLike
    Files of the program's `oscillate` for the same surface and motion, drawn with the damping curves.
overwrite : bool
    Replace an existing page.

Raises
------
InvalidInput
    For a file that is absent, damaged or without a study, and for a page that exists.
IoError
    If :func:`can_report` is false, or if the operating system refuses.
)");
  define_report(
      m, "write_report_pdf", "pdf", &write_report_pdf,
      R"(The page of :func:`write_report` as PDF, printed by headless Chromium, which must be installed.

Parameters
----------
results, title, direct, overwrite
    As for :func:`write_report`.
pdf : str or os.PathLike
    The file; it appears complete or not at all.

Raises
------
InvalidInput
    As :func:`write_report`, and where no Chromium or Chrome is installed.
IoError
    As :func:`write_report`, and if Chromium does not print the page within two minutes.
)");
}

}  // namespace

void bind_results(nb::module_& m) {
  bind_reader(m);
  bind_report(m);
}

}  // namespace salebra::python
