// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of study configurations, runs and results.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/design.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/sensitivity.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/study_solution.hpp>
#include <salebra/study/verification.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/curves.hpp"
#include "interop/described.hpp"
#include "interop/direction.hpp"
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
                                      "All settings that determine the result of a study.")
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
    Names of :func:`contact_models`. "bem" (boundary elements), the reference for the others, always runs.

Raises
------
InvalidInput
    "models: …" for another name.
)")
      .def(
          "with_direction",
          [](const StudyConfiguration& study, const std::variant<double, std::string>& direction) {
            StudyConfiguration turned = study;
            turned.direction = direction_of(direction);
            return turned;
          },
          nb::arg("direction"),
          "The same study with another direction of the tangential motion: an angle from the x "
          "axis, rad "
          "or with a unit such as \"30deg\", or \"across\", \"along\" or \"both\" for the lay of "
          "the "
          "surface.")
      .def(
          "with_surface",
          [](const StudyConfiguration& self, const std::filesystem::path& file,
             std::optional<double> size_x, std::optional<double> size_y,
             const std::string& height_unit, bool transpose, const PixelSize& pixel_size,
             const std::string& lateral_unit, std::optional<double> despike,
             const std::optional<std::vector<double>>& crop, bool fill, const std::string& channel,
             std::optional<double> s_filter, std::optional<double> l_filter) {
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
                                       channel,
                                       {s_filter, l_filter}});
          },
          nb::arg("file"), nb::kw_only(), nb::arg("size_x") = nb::none(),
          nb::arg("size_y") = nb::none(), nb::arg("height_unit") = "", nb::arg("transpose") = false,
          nb::arg("pixel_size") = nb::none(), nb::arg("lateral_unit") = "",
          nb::arg("despike") = nb::none(), nb::arg("crop") = nb::none(), nb::arg("fill") = false,
          nb::arg("channel") = "", nb::arg("s_filter") = nb::none(),
          nb::arg("l_filter") = nb::none(),
          "The same study of the surface in `file`. The filters are those of "
          ":meth:`Surface.filtered`, the other arguments those of :func:`read_surface`; a few "
          "undefined points are filled even without `fill`.");
  m.def(
      "contact_models",
      [] {
        nb::dict titles;
        for (const StudyModel& model : contact_models()) titles[model.name] = model.title;
        return titles;
      },
      nb::sig("def contact_models() -> dict[str, str]"),
      "Names of the contact models of studies, with their titles.");
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
      "Reads a study configuration from a TOML text; errors call it `name`, and relative paths "
      "start at "
      "`folder`.");
}

std::vector<double> pressures_of(const ModelResult& result) {
  return result.curve.column(&ForceSample::pressure);
}

std::vector<double> pressures_of(const Realisation& realisation) {
  return realisation.models.empty() ? std::vector<double>()
                                    : pressures_of(realisation.models.front());
}

/// Means over the surfaces at each pressure, as a curve over the pressure. quantity: name of the
/// quantity of the means.
CurveOf<EnsembleMean> over_pressure(const StudyResult& result, std::vector<EnsembleMean> means,
                                    const std::string& quantity) {
  return {"pressure", result.pressures, std::move(means), quantity};
}

void bind_realisation(nb::module_& m) {
  described_class<DampingPoint>(m, "DampingPoint",
                                "Damping at one pressure of a curve, computed in three ways.");
  described_class<SpotStatistics>(m, "SpotStatistics",
                                  "Contact spots by boundary elements at one pressure.");
  described_class<AdhesionSample>(
      m, "AdhesionSample",
      "An adhesive contact at one mean gap of a cycle, while loading and unloading.");
  described_class<AdhesionOfSurface>(m, "AdhesionOfSurface",
                                     "The adhesive cycle of one surface of a study.");
  curve_class<DampingPoint>(
      m, "DampingPointCurve",
      "Damping over the pressure: a sequence of :class:`DampingPoint` with an "
      "array for each number.");
  curve_class<SpotStatistics>(m, "SpotCurve",
                              "Contact spots over the pressure: a sequence of "
                              ":class:`SpotStatistics` with an array for each number.");
  curve_class<FlowFactors>(
      m, "FlowFactorCurve",
      "Flow factors over the pressure: a sequence of :class:`FlowFactors` with "
      "an array for each number.");
  described_class<SurfacePicture>(
      m, "SurfacePicture", "Heights, first contacts, spectrum and distribution of a surface.");
  auto model = described_class<ModelResult>(m, "ModelResult",
                                            "Results of one contact model for one surface.");
  const auto pressures = [](const auto& self) { return pressures_of(self); };
  curve_property(model, "damping", &ModelResult::damping, pressures);
  nb::class_<Realisation> realisation =
      described_class<Realisation>(m, "Realisation", "Everything computed for one surface.");
  curve_property(realisation, "spots", &Realisation::spots, pressures);
  curve_property(realisation, "flow", &Realisation::flow, pressures);
  realisation
      .def(
          "model",
          [](const Realisation& self, const std::string& name) {
            return self.of(contact_model(name));
          },
          nb::arg("name"), "Results of a model by its name, which must be in `models`.")
      .def_prop_ro(
          "bem", [](const Realisation& self) { return self.of(ContactModel::bem); },
          "Results of boundary elements, the reference for the other models.");
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
  described_class<EnsembleMean>(
      m, "EnsembleMean", "A mean with its 95 % interval; the limits are NaN if there is none.");
  described_class<StatedMean>(m, "StatedMean",
                              "A mean with its 95 % interval and its numerical error.");
  curve_class<EnsembleMean>(
      m, "MeanCurve",
      "Means over one quantity: a sequence of :class:`EnsembleMean` with arrays "
      "of the means and their limits.");
  curve_class<StatedMean>(
      m, "StatedMeanCurve",
      "Means over the pressure: a sequence of :class:`StatedMean` with arrays of "
      "the means, their limits and their errors.");
  auto answer = described_class<StudySolution>(
      m, "StudySolution",
      "Damping at each pressure for the motion as described, and whether the numbers can be used.");
  using S = StudySolution;
  const auto pressures = [](const S& self) { return self.pressures; };
  curve_property(answer, "damping_constant", &S::damping_constant, pressures);
  curve_property(answer, "work_per_cycle", &S::work_per_cycle, pressures);
  curve_property(answer, "damping_constant_without_slip", &S::damping_constant_without_slip,
                 pressures);
  curve_property(answer, "thermal_conductance", &S::thermal_conductance, pressures);
  curve_property(answer, "electrical_conductance", &S::electrical_conductance, pressures);
  result_methods(answer);
  answer.def("__repr__", [](const StudySolution& self) {
    return fmt::format("StudySolution(validity='{}', {} pressures)", name_of(self.validity),
                       self.damping_constant.size());
  });
  described_class<EnsembleWarning>(m, "EnsembleWarning",
                                   "A systematic error that a result may have.");
  auto result = described_class<StudyResult>(
      m, "StudyResult", "Results of all surfaces at one point of the parameter grid.");
  result
      .def_prop_ro(
          "models",
          [](const StudyResult& self) {
            std::vector<std::string> names;
            for (const StudyModel& model : self.models()) names.emplace_back(model.name);
            return names;
          },
          "Names of the models that ran.")
      .def(
          "fitted",
          [](const StudyResult& self, const std::string& quantity, const std::string& model) {
            return self.fitted(quantity, contact_model(model));
          },
          nb::arg("quantity"), nb::arg("model") = "bem",
          "Mean over the surfaces of a number of :class:`ModelResult`, such as \"area_slope\" or "
          "\"law_bend\"; a single surface has no interval.")
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
            return over_pressure(
                self,
                self.curve(number_of<ForceSample>(quantity, "quantity"), contact_model(model)),
                quantity);
          },
          nb::arg("quantity"), nb::arg("model") = "bem",
          "Mean at each pressure of a quantity of the curve, such as \"mean_gap\".")
      .def(
          "damping",
          [](const StudyResult& self, const std::string& quantity, const std::string& model) {
            return over_pressure(self, self.damping(quantity, contact_model(model)), quantity);
          },
          nb::arg("quantity") = "damping_constant", nb::arg("model") = "bem",
          "Mean at each pressure of a quantity of :class:`DampingPoint`, such as "
          "damping_constant_closed_form (Eq. (16)). damping_constant is NaN if its error is not "
          "smaller than it; deviation is the ratio of the means of damping_constant_closed_form "
          "and "
          "damping_constant, minus 1.")
      .def(
          "deviation_range",
          [](const StudyResult& self, const std::string& model) {
            const auto [low, high] = self.deviation_range(contact_model(model));
            return std::pair(low, high);
          },
          nb::arg("model") = "bem",
          "Minimum and maximum deviation of Eq. (16) from the theorem on the curve.")
      .def(
          "solution",
          [](const StudyResult& self) { return unlocked([&] { return solution_of(self); }); },
          "The damping constant of the motion as described (with slip if the coefficient of "
          "friction is "
          "known), its shares, its assumptions and their verdict.")
      .def(
          "surfaces_for",
          [](const StudyResult& self, double precision) { return surfaces_for(self, precision); },
          nb::arg("precision"),
          "Number of surfaces that the mean damping constant without slip needs at each pressure "
          "for a "
          "95 % interval of ±precision, estimated from the scatter of these surfaces; NaN for one "
          "surface.")
      .def("direction", &StudyResult::direction,
           "Direction of the tangential motion, from the x axis, rad; NaN if K_t has no direction.")
      .def("in_directions", &StudyResult::in_directions,
           "This result, followed by the same in further directions of the tangential motion: "
           "across "
           "the lay, then along it.")
      .def("convergence_counts", &StudyResult::convergence_counts,
           "Numbers of surfaces for convergence(): all up to 128, then 32 in each doubling.")
      .def(
          "convergence",
          [](const StudyResult& self) {
            const std::vector<std::size_t> counts = self.convergence_counts();
            return CurveOf<EnsembleMean>{"surfaces",
                                         {counts.begin(), counts.end()},
                                         self.convergence(),
                                         "decay_length_over_rms_height"};
          },
          "Mean l/h_rms over the first convergence_counts() surfaces.")
      .def("interval_method", &StudyResult::interval_method,
           "How the intervals were computed, in one line.")
      .def(
          "write",
          [](const StudyResult& self, const std::filesystem::path& file, bool overwrite) {
            unlocked([&] { write_study(file, self, {}, {overwrite}); });
          },
          nb::arg("file"), nb::kw_only(), nb::arg("overwrite") = false,
          "Writes an HDF5 file. xarray opens each group: "
          "xarray.open_dataset(file, engine=\"h5netcdf\", "
          "group=\"damping\").");
  result_methods(result);
}

/// Calls warn_user() during a run, in which the interpreter's lock is not held.
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
      R"(Runs surface → statistics → contact models → exponential law → damping, for an ensemble or a measured surface.

The bits do not depend on the number of threads, nor on whether the run was stopped and continued.

Parameters
----------
configuration : StudyConfiguration
parts : str or os.PathLike, optional
    Folder that keeps each finished surface. A second call with the same folder and configuration continues the run.
resume : bool
    False: refuse a folder that has surfaces already.
progress : bool or callable

Raises
------
NotConverged
    If fewer than four contacts of a sweep converged.
)");
  define("run_ensembles", &run_ensembles, false,
         R"(Runs the ensembles of all points of a configuration's parameter grid.

Parameters
----------
configuration : StudyConfiguration
parts : str or os.PathLike, optional
    Folder that keeps each finished surface, from which a stopped run continues.
resume : bool
    Accept a folder that has surfaces already.
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
      "Whether the file is the complete result of this study, with all its surfaces, models and "
      "settings; False for any other file, or if there is none.");

  described_class<OutputSensitivity>(m, "OutputSensitivity",
                                     "How one result responds to a parameter, at each pressure.");
  described_class<ParameterSensitivity>(m, "ParameterSensitivity",
                                        "How the results respond to one parameter.");
  described_class<StudySensitivity>(
      m, "StudySensitivity",
      "How the results of a study respond to its parameters and to bands of waves.")
      .def(
          "find",
          [](const StudySensitivity& self, const std::string& parameter,
             const std::string& output) {
            require_that(parameter != "waves", "parameter",
                         "waves are several bands; see `parameters`");
            const OutputSensitivity* found = self.find(parameter, output);
            require(found != nullptr, "parameter", parameter + ", " + output,
                    "have no sensitivity; see `parameters`");
            return CurveOf<EnsembleMean>{"pressure", self.pressures, found->at_pressures, output};
          },
          nb::arg("parameter"), nb::arg("output"), "d ln output/d ln parameter over the pressure.")
      .def("outputs", &StudySensitivity::outputs, "Names of the results, each once.")
      .def(
          "sentence",
          [](const StudySensitivity& self, const std::string& output, std::size_t index) {
            const std::vector<std::string> known = self.outputs();
            require(std::ranges::find(known, output) != known.end(), "output", output,
                    fmt::format("has no sensitivity; known are {}", fmt::join(known, ", ")));
            return self.sentence(output, index);
          },
          nb::arg("output"), nb::arg("index"),
          "Which waves decide a result at the pressure with this index.");
  m.def(
      "study_sensitivity",
      [](const StudyConfiguration& configuration, double step, bool waves,
         const ProgressArgument& progress) {
        cite_study();
        return interruptible(progress, [&](const Progress& told) {
          return study_sensitivity(configuration,
                                   {.step = step, .waves = waves, .on_progress = told});
        });
      },
      nb::arg("configuration"), nb::kw_only(), nb::arg("step") = SensitivityOptions().step,
      nb::arg("waves") = true, nb::arg("progress") = false,
      R"(How the results of a study by boundary elements respond to its parameters, with 95 % intervals.

On half-spaces without plasticity they follow from the law of each surface and the response of its gap to changes of the heights, without
further contacts; only the area needs contacts of the same surfaces with each parameter of their shape multiplied by e^step and e^−step. The
intervals are those over the surfaces. For tangential stiffness and damping they contain 0.04 for the response of K_t/K, which is left out.
Otherwise the whole study is computed with each parameter multiplied by e^step and e^−step.

Parameters
----------
configuration : StudyConfiguration
step : float
    Change of ln θ to each side, 0.001 to 0.2.
waves : bool
    Also the amplitudes of each octave of wavelengths.
progress : bool or callable
)");
  described_class<DesignedParameter>(m, "DesignedParameter", "A parameter of a design.");
  described_class<DesignPoint>(m, "DesignPoint",
                               "What a design gives at one force, on other surfaces.");
  described_class<Design>(
      m, "Design", "Parameters for which a result is closest to a target at all its forces.");
  m.def(
      "design",
      [](const std::filesystem::path& file, const ProgressArgument& progress) {
        cite_study();
        return interruptible(progress, [&](const Progress& told) {
          return design(read_design_problem(file), told);
        });
      },
      nb::arg("file"), nb::kw_only(), nb::arg("progress") = false,
      R"(Finds parameters of a study for which a result has wanted values over a range of forces.

Levenberg and Marquardt's method of GSL on the means over the surfaces, in the logarithms of the parameters between their limits. The design
is judged on surfaces that the search did not use (`met`, `deviation`).

Parameters
----------
file : str or os.PathLike
    TOML file with the study, the target and the limits of the free parameters.
progress : bool or callable
)");

  described_class<Check>(m, "Check",
                         "One number that this installation computes, with the analytical value.");
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
