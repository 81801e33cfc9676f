// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of study configurations, runs and results.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/study_solution.hpp>
#include <salebra/study/verification.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/path.hpp"
#include "interop/reading.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"
#include "results/describe.hpp"

namespace salebra::python {
namespace {

void cite_study() {
  cite({"popov2015", "polonsky_keer1999", "stanley_kato1997", "greenwood_williamson1966",
        "nayak1971", "mccool1986"});
}

void bind_configuration(nb::module_& m) {
  described_class<StudyConfiguration>(m, "StudyConfiguration",
                                      "Everything that decides the result of a study.")
      .def(
          "with_models",
          [](const StudyConfiguration& self, const std::vector<std::string>& models) {
            StudyConfiguration chosen = self;
            chosen.models = contact_models(models);
            return chosen;
          },
          nb::arg("models"),
          nb::sig("def with_models(self, models: collections.abc.Sequence[str]) -> "
                  "StudyConfiguration"),
          R"(The same study with these contact models on each surface.

Parameters
----------
models : list of str
    Of :func:`contact_models`. "bem" (boundary elements), which the others are measured by, is run in any case.

Raises
------
InvalidInput
    "models: …" for another name.
)")
      .def(
          "with_surface",
          [](const StudyConfiguration& self, const std::filesystem::path& file,
             std::optional<double> size_x, std::optional<double> size_y,
             const std::string& height_unit, bool transpose, const PixelSize& pixel_size,
             const std::string& lateral_unit, std::optional<double> despike,
             const std::optional<std::vector<double>>& crop, bool fill,
             const std::string& channel) {
            return with_surface(self, {file,
                                       size_x,
                                       size_y,
                                       {},
                                       height_unit,
                                       transpose,
                                       pixel_size_of(pixel_size),
                                       lateral_unit,
                                       despike,
                                       rectangle_of(crop),
                                       fill,
                                       channel});
          },
          nb::arg("file"), nb::kw_only(), nb::arg("size_x") = nb::none(),
          nb::arg("size_y") = nb::none(), nb::arg("height_unit") = "", nb::arg("transpose") = false,
          nb::arg("pixel_size") = nb::none(), nb::arg("lateral_unit") = "",
          nb::arg("despike") = nb::none(), nb::arg("crop") = nb::none(), nb::arg("fill") = false,
          nb::arg("channel") = "",
          "`file` in place of the surfaces of the configuration, which keeps everything else. The "
          "others are those of :func:`read_surface`; few undefined points are filled without "
          "`fill`.");
  m.def(
      "contact_models",
      [] {
        nb::dict titles;
        for (const StudyModel& model : contact_models()) titles[model.name] = model.title;
        return titles;
      },
      nb::sig("def contact_models() -> dict[str, str]"),
      "Names of the contact models that a study may run, with their titles.");
  m.def("read_study_configuration", &read_study_configuration, nb::arg("file"),
        "Reads a TOML file of a study; data/README.md explains each key. Raises InvalidInput "
        "\"FILE:LINE: table.key: …\".");
  m.def(
      "parse_study_configuration",
      [](const std::string& text, const std::string& name, const std::filesystem::path& folder) {
        return parse_study_configuration(text, name, folder);
      },
      nb::arg("text"), nb::arg("name") = "configuration",
      nb::arg("folder") = std::filesystem::path("."),
      "The same from a text; `name` stands for the file in errors, relative paths are taken from "
      "`folder`.");
}

void bind_realisation(nb::module_& m) {
  described_class<DampingPoint>(m, "DampingPoint",
                                "Damping at one pressure of a curve, by three routes.");
  described_class<SpotStatistics>(m, "SpotStatistics",
                                  "Contact spots of the boundary elements at one pressure.");
  described_class<AdhesionSample>(m, "AdhesionSample",
                                  "An adhesive contact at a mean gap of a cycle, in and out.");
  described_class<AdhesionOfSurface>(m, "AdhesionOfSurface",
                                     "The adhesive cycle of one surface of a study.");
  described_class<SurfacePicture>(
      m, "SurfacePicture", "Heights, first contacts, spectrum and distribution of a surface.");
  described_class<ModelResult>(m, "ModelResult", "What one contact model says about one surface.");
  nb::class_<Realisation> realisation =
      described_class<Realisation>(m, "Realisation", "Everything computed for one surface.");
  realisation
      .def(
          "model",
          [](const Realisation& self, const std::string& name) {
            return self.of(contact_model(name));
          },
          nb::arg("name"), "What a model says, by its name; one of those that were asked for.")
      .def_prop_ro(
          "bem", [](const Realisation& self) { return self.of(ContactModel::bem); },
          "Boundary elements, which the other models are measured by.");
}

template <Described T>
nb::list columns_of() {
  nb::list columns;
  salebra::for_each_number<T>([&](const auto&, const Quantity& quantity) {
    columns.append(nb::make_tuple(std::string(quantity.name),
                                  std::string(si_unit(quantity.dimension)),
                                  std::string(quantity.long_name)));
  });
  return columns;
}

void bind_result(nb::module_& m) {
  m.def("_curve_columns", &columns_of<ForceSample>,
        nb::sig("def _curve_columns() -> list[typing.Any]"));
  m.def("_damping_columns", &columns_of<DampingPoint>,
        nb::sig("def _damping_columns() -> list[typing.Any]"));
  described_class<EnsembleMean>(m, "EnsembleMean",
                                "A mean with its 95 % interval; NaN limits where there is none.");
  described_class<StatedMean>(m, "StatedMean",
                              "A mean with its 95 % interval and its numerical error.");
  auto answer = described_class<StudySolution>(
      m, "StudySolution",
      "What a study says of the motion that was described, at each pressure, and whether it may be "
      "used.");
  result_methods(answer, true);
  answer.def("__repr__", [](const StudySolution& self) {
    return fmt::format("StudySolution(validity='{}', {} pressures)", name_of(self.validity),
                       self.damping_constant.size());
  });
  described_class<EnsembleWarning>(m, "EnsembleWarning",
                             "Why a result may be off for other reasons than chance.");
  auto result = described_class<StudyResult>(m, "StudyResult",
                                             "The ensemble at one point of the parameter grid.");
  result
      .def_prop_ro(
          "models",
          [](const StudyResult& self) {
            std::vector<std::string> names;
            for (const StudyModel& model : self.models()) names.emplace_back(model.name);
            return names;
          },
          "Names of the models that were asked for.")
      .def(
          "fitted",
          [](const StudyResult& self, const std::string& quantity, const std::string& model) {
            return self.fitted(quantity, contact_model(model));
          },
          nb::arg("quantity"), nb::arg("model") = "bem",
          "Mean over the surfaces of a number of :class:`ModelResult`, such as \"area_slope\" or "
          "\"law_bend\"; one surface has no interval.")
      .def(
          "decay_length",
          [](const StudyResult& self, const std::string& model) {
            return self.decay_length(contact_model(model));
          },
          nb::arg("model") = "bem", "l, m, with its interval.")
      .def(
          "decay_length_over_rms_height",
          [](const StudyResult& self, const std::string& model) {
            return self.decay_length_over_rms_height(contact_model(model));
          },
          nb::arg("model") = "bem")
      .def(
          "curve",
          [](const StudyResult& self, const std::string& quantity, const std::string& model) {
            return self.curve(number_of<ForceSample>(quantity, "quantity"), contact_model(model));
          },
          nb::arg("quantity"), nb::arg("model") = "bem",
          "Mean at each pressure of a quantity of the curve, such as \"mean_gap\".")
      .def(
          "damping",
          [](const StudyResult& self, const std::string& quantity, const std::string& model) {
            return self.damping(quantity, contact_model(model));
          },
          nb::arg("quantity") = "damping_constant", nb::arg("model") = "bem",
          "Mean at each pressure of a quantity of :class:`DampingPoint`, such as "
          "damping_constant_closed_form (Eq. (16)). damping_constant is NaN where its error is not "
          "smaller; "
          "deviation is the ratio of the means of damping_constant_closed_form and "
          "damping_constant, less "
          "1.")
      .def(
          "deviation_range",
          [](const StudyResult& self, const std::string& model) {
            const auto [low, high] = self.deviation_range(contact_model(model));
            return std::pair(low, high);
          },
          nb::arg("model") = "bem",
          "Least and greatest deviation of Eq. (16) from the theorem on the curve.")
      .def(
          "solution",
          [](const StudyResult& self) { return unlocked([&] { return solution_of(self); }); },
          "The damping constant of the contact as described, with slip where the coefficient of "
          "friction is known, its shares, its verdicts and their verdict.")
      .def(
          "surfaces_for",
          [](const StudyResult& self, double precision) { return surfaces_for(self, precision); },
          nb::arg("precision"),
          "How many surfaces the mean of the damping constant without slip would need at each "
          "pressure for a 95 % interval of ±precision, by the scatter of those at hand; NaN of one "
          "surface.")
      .def("convergence_counts", &StudyResult::convergence_counts,
           "Numbers of surfaces of convergence(): all up to 128, then 32 in each doubling.")
      .def("convergence", &StudyResult::convergence,
           "Mean l/h_rms over the first convergence_counts() surfaces.")
      .def("interval_method", &StudyResult::interval_method,
           "How the intervals came about: one line.")
      .def(
          "write",
          [](const StudyResult& self, const std::filesystem::path& file, bool overwrite) {
            unlocked([&] { write_study(file, self, {}, {overwrite}); });
          },
          nb::arg("file"), nb::kw_only(), nb::arg("overwrite") = false,
          "Writes an HDF5 file, each group of which xarray opens as it is: "
          "xarray.open_dataset(file, engine=\"h5netcdf\", "
          "group=\"damping\").");
  result_methods(result, false);
}

/// warn_user() from a run, which has given the interpreter's lock away.
void warn_user_unlocked(const std::string& text) {
  const nb::gil_scoped_acquire locked;
  warn_user(text);
}

void bind_runs(nb::module_& m) {
  const auto define = [&m](const char* name, auto run, bool resumes, const char* description) {
    m.def(
        name,
        [run](const StudyConfiguration& configuration,
              const std::optional<std::filesystem::path>& parts, bool resume,
              const ProgressArgument& progress) {
          cite_study();
          const std::unique_ptr<StudyParts> folder =
              parts ? std::make_unique<StudyParts>(*parts, resume) : nullptr;
          return interruptible(progress, [&](const Progress& told) {
            return run(
                configuration,
                {.on_progress = told, .on_warning = warn_user_unlocked, .parts = folder.get()});
          });
        },
        nb::arg("configuration"), nb::kw_only(), nb::arg("parts") = nb::none(),
        nb::arg("resume") = resumes, nb::arg("progress") = false, description);
  };
  define(
      "run_study", &run_study, true,
      R"(Surface → statistics → contact models → exponential law → damping, for an ensemble or a measured surface.

Same bits for every thread count, and for a run that was stopped and continued.

Parameters
----------
configuration : StudyConfiguration
parts : str or os.PathLike, optional
    Folder in which each finished surface is kept. A second call with the same folder and configuration continues the run.
resume : bool
    False: a folder that holds surfaces already is refused.
progress : bool or callable

Raises
------
NotConverged
    Where fewer than four contacts of a sweep converged.
)");
  define("run_ensembles", &run_ensembles, false,
         R"(The ensembles of every point of a configuration's parameter grid.

Parameters
----------
configuration : StudyConfiguration
parts : str or os.PathLike, optional
    Folder in which each finished surface is kept, so that a run that was stopped can continue.
resume : bool
    A folder that holds surfaces already is accepted.
progress : bool or callable
)");
  m.def(
      "write_ensembles",
      [](const std::filesystem::path& file, const std::vector<const StudyResult*>& results,
         bool overwrite) {
        std::vector<StudyResult> copies;
        for (const StudyResult* result : results) copies.push_back(*result);
        unlocked([&] { write_ensembles(file, copies, {}, {overwrite}); });
      },
      nb::arg("file"), nb::arg("results"), nb::kw_only(), nb::arg("overwrite") = false,
      "Writes the results of :func:`run_ensembles` to one HDF5 file.");
  m.def(
      "is_result_of",
      [](const std::filesystem::path& file, const StudyConfiguration& study) {
        return unlocked([&] { return is_result_of(file, study); });
      },
      nb::arg("file"), nb::arg("study"),
      "Whether the file is the finished result of this study, of all its surfaces, models and "
      "settings; False for any other file, and for none.");

  described_class<Check>(
      m, "Check", "One number that this installation computes, beside what analysis says of it.");
  m.def(
      "verify_installation",
      [](const ProgressArgument& progress) {
        return interruptible(progress,
                             [](const Progress& told) { return verify_installation(told); });
      },
      nb::kw_only(), nb::arg("progress") = false,
      "Runs the solvers on problems with known solutions (Hertz, Westergaard, …). A few seconds.");
}

}  // namespace

void bind_study(nb::module_& m) {
  bind_configuration(m);
  bind_realisation(m);
  bind_result(m);
  bind_runs(m);
}

}  // namespace salebra::python
