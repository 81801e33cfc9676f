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
      R"(Reads a file of results as arrays with units: what the program's ``-o FILE.h5`` and the write functions made.

Groups are the stages of a computation (`surface`, `curve`, `fit`, `damping`, …); datasets lie on coordinates of their group. Paths are
like "curve/pressure". Any HDF5 file of real numbers can be read.

Parameters
----------
file : str or os.PathLike

Raises
------
InvalidInput
    "<file>: <what is wrong>; <what to do>" for what is not there, is of another kind, or damaged.

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
           "The values of a dataset, an array of its own: float64 (whole numbers too), bool for "
           "flags, str for names; zero-dimensional for a single number.")
      .def("coordinates", &ResultReader::coordinates, nb::arg("dataset"),
           "Names of the coordinates on which a dataset lies, one for each axis; none for a "
           "coordinate.")
      .def(
          "units",
          [](const ResultReader& self, const std::string& dataset) {
            self.shape(dataset);  // it must be there
            return self.text_attribute(dataset, "units").value_or("");
          },
          nb::arg("dataset"),
          "SI unit of a dataset, \"1\" for pure numbers; empty where it has none.")
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

void bind_report(nb::module_& m) {
  m.def("can_report", &can_report,
        "Whether this build carries plotly.js, without which no report can be drawn.");
  m.def(
      "write_report",
      [](const std::filesystem::path& results, const std::filesystem::path& html,
         const std::string& title, const std::vector<std::filesystem::path>& direct,
         bool overwrite) {
        unlocked([&] { write_report(results, html, {{overwrite}, title, direct}); });
      },
      nb::arg("results"), nb::arg("html"), nb::kw_only(), nb::arg("title") = "",
      nb::arg("direct") = std::vector<std::filesystem::path>{}, nb::arg("overwrite") = false,
      R"(Makes one HTML page of the results of a study, as the program's command `report` does; it needs no network.

Conclusion and warnings first, then the surface, force over mean gap with the fit and its residuals, the models side by side, damping
with bands, settings and provenance; every figure with its numbers as a table and as CSV.

Parameters
----------
results : str or os.PathLike
    What :meth:`StudyResult.write`, :func:`write_ensembles` or the program's `study` and `compare` wrote.
html : str or os.PathLike
    The page; it appears complete or not at all.
title : str
    Heading; empty: from where the surface came.
direct : list of str or os.PathLike
    What the program's `oscillate` wrote of the same surface and motion, to be drawn beside the damping curves.
overwrite : bool
    Replace an existing page.

Raises
------
InvalidInput
    For a file that is not there, damaged or contains no study, and for a page that exists.
IoError
    Where :func:`can_report` is false, or the system refuses.
)");
}

}  // namespace

void bind_results(nb::module_& m) {
  bind_reader(m);
  bind_report(m);
}

}  // namespace salebra::python
