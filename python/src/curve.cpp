// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of force curves, sweeps and fits.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/sweep.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/described.hpp"
#include "interop/direction.hpp"
#include "interop/drawn.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

void bind_force_curve(nb::module_& m) {
  auto curve = described_class<ForceCurve>(
      m, "ForceCurve",
      R"(Force, gap, area and stiffness of a contact over the load, sorted by force. Every contact model returns one.

Columns are views of one table, not copies; quantities that the model does not have are NaN.

Parameters
----------
nominal_area : float
    A0, m².
indentation, mean_gap, separation, force, pressure, contact_area_fraction, normal_stiffness, tangential_stiffness : array_like
    Columns of equal length; one of force and pressure follows from the other.
rms_height : float
    Rms height of the surface, m.
model : str
    Name of the model, such as "measured".
)");
  curve.def(
      "__init__",
      [](ForceCurve* self, double nominal_area, std::optional<Values> indentation,
         std::optional<Values> mean_gap, std::optional<Values> separation,
         std::optional<Values> force, std::optional<Values> pressure,
         std::optional<Values> contact_area_fraction, std::optional<Values> normal_stiffness,
         std::optional<Values> tangential_stiffness, double rms_height, const std::string& model) {
        require_positive(nominal_area, "nominal_area");
        ForceCurve made;
        made.model = model;
        made.nominal_area = nominal_area;
        made.rms_height = rms_height;
        const auto fill = [&](const std::optional<Values>& values, const char* name,
                              double ForceSample::*member) {
          if (!values) return;
          if (made.samples.empty()) made.samples.resize(values->values.size());
          require(values->values.size() == made.samples.size(), name, values->values.size(),
                  "values, unlike the other columns; give columns of one length");
          for (std::size_t i = 0; i < made.samples.size(); ++i)
            made.samples[i].*member = values->values[i];
        };
        fill(indentation, "indentation", &ForceSample::indentation);
        fill(mean_gap, "mean_gap", &ForceSample::mean_gap);
        fill(separation, "separation", &ForceSample::separation);
        fill(force, "force", &ForceSample::force);
        fill(pressure, "pressure", &ForceSample::pressure);
        fill(contact_area_fraction, "contact_area_fraction", &ForceSample::contact_area_fraction);
        fill(normal_stiffness, "normal_stiffness", &ForceSample::normal_stiffness);
        fill(tangential_stiffness, "tangential_stiffness", &ForceSample::tangential_stiffness);
        require_that(force || pressure, "force", "none given; give force or pressure");
        for (auto& sample : made.samples) {
          if (!force) sample.force = sample.pressure * nominal_area;
          if (!pressure) sample.pressure = sample.force / nominal_area;
        }
        std::ranges::stable_sort(made.samples, {}, &ForceSample::force);
        new (self) ForceCurve(std::move(made));
      },
      nb::arg("nominal_area"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("mean_gap") = nb::none(), nb::arg("separation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("pressure") = nb::none(),
      nb::arg("contact_area_fraction") = nb::none(), nb::arg("normal_stiffness") = nb::none(),
      nb::arg("tangential_stiffness") = nb::none(), nb::arg("rms_height") = ForceSample::unknown,
      nb::arg("model") = "measured");
  curve.def("__len__", [](const ForceCurve& self) { return self.samples.size(); });
  result_methods(curve);
}

void bind_sweep(nb::module_& m) {
  m.def(
      "sweep_pressures",
      [](const BoundSurface& surface, const PressedArgument& given, const Values& pressures,
         bool stiffness, bool stick, int concurrent_loads, double tolerance, int max_iterations,
         const Choice<Boundary>& boundary, const Choice<Precision>& precision, double hardness,
         const std::variant<double, std::string>& direction, const ProgressArgument& progress) {
        cite({"polonsky_keer1999", "stanley_kato1997"});
        const Material material = given.body ? Material{} : given.material.material();
        SweepOptions options;
        options.contact = {.tolerance = tolerance,
                           .max_iterations = max_iterations,
                           .boundary = boundary.value("boundary"),
                           .precision = precision.value("precision"),
                           .hardness = hardness};
        options.stiffness = stiffness;
        options.stick = stick;
        const DirectionChoice chosen = direction_of(direction);
        require_that(stick || chosen == DirectionChoice(0.0), "direction",
                     "given without `stick`: (G*/E*)K has no direction; give both");
        const std::vector<double> directions = directions_of(chosen, surface.surface);
        require(directions.size() == 1, "direction", directions.size(),
                "directions chosen; a curve has one");
        options.direction = directions.front();
        options.concurrent_loads = concurrent_loads;
        return interruptible(
            progress,
            [&](Progress told) {
              options.contact.on_progress = std::move(told);
              return given.body
                         ? sweep_pressures(surface.surface, *given.body, pressures.values, options)
                         : sweep_pressures(surface.surface, material, pressures.values, options);
            },
            surface.surface.communicator);
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("pressures"), nb::kw_only(),
      nb::arg("stiffness") = true, nb::arg("stick") = false, nb::arg("concurrent_loads") = 0,
      nb::arg("tolerance") = 1e-10, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("precision") = "mixed",
      nb::arg("hardness") = std::numeric_limits<double>::infinity(), nb::arg("direction") = 0.0,
      nb::arg("progress") = false,
      R"(Force–gap curve of a surface by boundary elements, one independent solve for each pressure, in parallel over loads.

Parameters
----------
surface : Surface
material : Material, Body or float
    A number is E* > 0, Pa; the curve then has no K_t. A body other than a half-space has K_t only with `stick`.
pressures : array_like
    > 0, increasing, Pa.
stiffness : bool
    Compute K by a punch solve on each contact set, and K_t = (G*/E*)K if G* is known.
stick : bool
    With `stiffness`: compute K_t along `direction` by a stick solve on each contact set instead.
concurrent_loads : int
    Loads solved at the same time, each with its own 50 to 60 bytes per cell; 0: as many as there are threads. Surfaces that are
    distributed over processes solve one load after the other.
tolerance, max_iterations, boundary, precision, hardness
    As for :func:`press`. With a hardness this is the curve of first loading; for unloading, sweep the surface that
    :func:`after_first_loading` returns.
direction : float or str
    Of K_t, with `stick`: an angle from the x axis, rad or with a unit such as "30deg", or "across" or "along" the lay of the surface.
progress : bool or callable
    True: a bar of tqdm; a function of a :class:`ProgressReport` that returns False to stop; the finished loads are returned.

Returns
-------
ForceCurve
    With `converged` False for the samples that did not converge.
)");
}

std::optional<PressureWindow> window_of(const std::optional<std::pair<double, double>>& window) {
  if (!window) return {};
  return PressureWindow{window->first, window->second, 0};
}

void bind_fit(nb::module_& m) {
  described_class<PressureWindow>(m, "PressureWindow", "The range of pressures that a fit uses.");
  described_class<ExponentialFit>(
      m, "ExponentialFit",
      "p = reference_pressure·exp(−ū/decay_length). The 95 % limits assume independent noise; the "
      "residuals of a computed curve are misfit of the law instead.",
      nb::dynamic_attr());
  m.def(
      "fit_exponential",
      [](const ForceCurve& curve, const std::optional<std::pair<double, double>>& window,
         const Choice<FitWeights>& weights) {
        const FitWeights chosen = weights.value("weights");
        ExponentialFit fit = fit_exponential(curve, window_of(window), chosen);
        return with_figure(std::move(fit), [curve, chosen](ExponentialFit drawn) {
          if (chosen != FitWeights::spacing) {
            figures::Figure figure = figures::figure_of(curve, drawn);
            figure.caption += " The interval of the decay length has a confidence of 95 %.";
            return figure;
          }
          // The curve has no noise, so that the range of l is that of parts of the window.
          const WindowSensitivity parts = window_sensitivity(curve, drawn.window, chosen);
          constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
          const bool several = parts.windows > 1;
          drawn.decay_length_low = several ? parts.decay_length_min : unknown;
          drawn.decay_length_high = several ? parts.decay_length_max : unknown;
          figures::Figure figure = figures::figure_of(curve, drawn);
          figure.caption +=
              " The range of the decay length is that of fits to parts of the window, not the 95 % "
              "limits of the fit.";
          return figure;
        });
      },
      nb::arg("curve"), nb::arg("window") = nb::none(), nb::arg("weights") = "spacing",
      R"(Weighted least squares of ln p = a − ū/l over a window of a curve, with Student-t 95 % limits for independent noise.

.. math:: \sum_i w_i\,(\ln p_i - a + \bar u_i/l)^2 = \min, \qquad p_0 = e^a

Parameters
----------
curve : ForceCurve
window : (float, float), optional
    Minimum and maximum pressure, Pa; by default the samples with ū between 1 and 2.5 h_rms, where the law fits best.
weights : {"spacing", "equal", "force"}
    Weight of a sample. "spacing", for computed curves: the length of ū that the sample represents, half way to its neighbours; l then
    does not depend on the spacing of the loads. "equal", for equal relative errors: 1. "force", for equal absolute errors, such as those
    of a load cell: p².

Raises
------
InvalidInput
    For fewer than three points in the window, equal gaps, or a pressure that does not fall with ū.

Notes
-----
The interval holds for independent errors of ln p. With a computed curve it measures the misfit of the law instead, and
:func:`test_exponential` shows whether the misfit is systematic.
)");
  described_class<ExponentialTest>(
      m, "ExponentialTest",
      "Test of the exponential law: ln p = a + b ū + c ū², and Student's t-test of c = 0.")
      .def("refuted", &ExponentialTest::refuted, nb::arg("level") = 0.05,
           "Whether the test refutes the law at this significance level.");
  m.def(
      "test_exponential",
      [](const ForceCurve& curve, const std::optional<std::pair<double, double>>& window,
         const Choice<FitWeights>& weights) {
        return test_exponential(curve, window_of(window), weights.value("weights"));
      },
      nb::arg("curve"), nb::arg("window") = nb::none(), nb::arg("weights") = "spacing",
      "Tests the exponential law over the window and with the weights of :func:`fit_exponential`. "
      "Needs at least four points.");
  described_class<WindowSensitivity>(m, "WindowSensitivity",
                                     "How much a fit depends on its window.");
  m.def(
      "window_sensitivity",
      [](const ForceCurve& curve, const std::optional<std::pair<double, double>>& window,
         const Choice<FitWeights>& weights) {
        return window_sensitivity(curve, window_of(window), weights.value("weights"));
      },
      nb::arg("curve"), nb::arg("window") = nb::none(), nb::arg("weights") = "spacing",
      "Minimum and maximum decay length over all runs of samples that cover at least half of the "
      "window, with the weights of :func:`fit_exponential`.");
  auto local = described_class<LocalDecayLength>(m, "LocalDecayLength",
                                                 "l(ū) = −dū/d ln p between consecutive samples.");
  result_methods(local);
  m.def("local_decay_length", &local_decay_length, nb::arg("curve"),
        "l(ū) at the midpoints between consecutive samples.");
}

}  // namespace

void bind_curve(nb::module_& m) {
  bind_force_curve(m);
  bind_sweep(m);
  bind_fit(m);
}

}  // namespace salebra::python
