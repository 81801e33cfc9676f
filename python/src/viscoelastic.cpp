// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of contacts on viscoelastic bodies.
#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>

#include "bindings.hpp"
#include "interop/arrays.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/curves.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/drawn.hpp"
#include "interop/path.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

using Terms = std::vector<std::pair<double, double>>;

std::vector<PronyTerm> terms_of(const Terms& pairs) {
  std::vector<PronyTerm> terms;
  for (const auto& [modulus, time] : pairs) terms.push_back({modulus, time});
  return terms;
}

void bind_series(nb::module_& m) {
  nb::class_<PronySeries> bound(
      m, "PronySeries",
      R"(Shear relaxation modulus of an isotropic material with a constant Poisson's ratio.

.. math:: G(t) = G_\infty + \sum_i G_i\,e^{-t/\tau_i}

Parameters
----------
relaxed_modulus : float
    G∞, Pa.
terms : list of (float, float)
    G_i, Pa, and τ_i, s; one term is the standard linear solid.
)");
  bound
      .def(
          "__init__",
          [](PronySeries* self, double relaxed_modulus, const Terms& terms) {
            PronySeries series{relaxed_modulus, terms_of(terms)};
            series.validate();
            new (self) PronySeries(std::move(series));
          },
          nb::arg("relaxed_modulus"), nb::arg("terms"))
      .def_static(
          "of_body",
          [](const Material& relaxed, const Terms& terms) {
            PronySeries series = PronySeries::of_body(relaxed, terms_of(terms));
            series.validate();
            return series;
          },
          nb::arg("relaxed"), nb::arg("terms"),
          "The series with the G∞ of a Material: one relaxed elastic body against a rigid body.")
      .def_ro("relaxed_modulus", &PronySeries::relaxed_modulus, "G∞, Pa.")
      .def_prop_ro("unrelaxed_modulus", &PronySeries::unrelaxed_modulus, "G(0), Pa.")
      .def_prop_ro(
          "terms",
          [](const PronySeries& self) {
            Terms terms;
            for (const PronyTerm& term : self.terms)
              terms.emplace_back(term.modulus, term.relaxation_time);
            return terms;
          },
          "Pairs of G_i, Pa, and τ_i, s.")
      .def("complex_modulus", &PronySeries::complex_modulus, nb::arg("angular_frequency"),
           "G' + iG'', Pa, at ω, rad/s.");
  value_methods(bound);
}

void bind_indentation(nb::module_& m) {
  described_class<ViscoelasticIndentation>(
      m, "ViscoelasticIndentation",
      "Force of an indenter on a viscoelastic body along a path, and its springs at the end.",
      nb::dynamic_attr());
  m.def(
      "viscoelastic_indentation",
      [](const IndenterLaw& law, const PronySeries& prony, const Values& time,
         const Values& indentation, int springs) {
        cite({"popov_hess2015"});
        ViscoelasticIndentation contact = unlocked([&] {
          return viscoelastic_indentation(law, prony, time.values, indentation.values, springs);
        });
        return with_figure(
            std::move(contact), [time = time.values, indentation = indentation.values](
                                    const ViscoelasticIndentation& drawn) {
              const double highest = *std::ranges::max_element(drawn.force);
              figures::Figure figure = figures::curve_figure("indentation", "force",
                                                             {.x = indentation, .y = drawn.force});
              figure.panels.push_back(
                  figures::curve_figure("time", "force", {.x = time, .y = drawn.force}).panels[0]);
              figure.kind = "viscoelastic_indentation";
              figure.columns = 2;
              figure.panels[0].title = "largest force F = " + figures::value_text(highest, "N");
              figure.caption =
                  "An indenter on a viscoelastic body along a path: its force over (a) the "
                  "indentation and (b) the time.";
              return figure;
            });
      },
      nb::arg("law"), nb::arg("prony"), nb::arg("time"), nb::arg("indentation"), nb::kw_only(),
      nb::arg("springs") = 400,
      R"(Normal force and contact radius of an indenter along δ(t), on a viscoelastic body without previous contact.

δ is linear between the samples; the contact may grow, shrink, open and close again.

Parameters
----------
law : IndenterLaw
    Law of the relaxed body.
prony : PronySeries
time, indentation : array_like
    s and m, from first touch.
springs : int
    Number of springs over the maximum contact radius; the error is of second order.
)");
}

/// The losses over the frequency at which the body follows the path, and its loop of normal force
/// and indentation.
figures::Figure damping_figure(const IndenterLaw& law, const PronySeries& prony,
                               const SampledMotion& path, int springs,
                               const ViscoelasticDamping& loss) {
  constexpr int below = 5;  // frequencies in two decades below that of the path, and as many above
  const double elastic = trajectory_damping(law, path).work_per_cycle;
  const double own = 2 * std::numbers::pi / path.period();
  std::vector<double> frequencies;
  std::vector<ViscoelasticLoss> losses;
  for (int k = -below; k <= below; ++k) {
    const double factor = std::pow(10, 2.0 * k / below);
    SampledMotion scaled = path;
    for (double& time : scaled.time) time /= factor;
    const std::complex<double> modulus = prony.complex_modulus(factor * own);
    frequencies.push_back(factor * own);
    losses.push_back({factor * own, modulus.real(), modulus.imag(), elastic,
                      k == 0 ? loss : viscoelastic_damping(law, prony, scaled, springs)});
  }
  figures::Figure figure = figures::figure_of("angular_frequency", frequencies, losses);
  figure.panels[0].title = "W = " + figures::value_text(loss.work_per_cycle, "J") +
                           ", γ = " + figures::value_text(loss.damping_constant, "N s/m") + " at " +
                           format_quantity(own / (2 * std::numbers::pi), Dimension::frequency, 3);
  figure.panels[0].lines.push_back({.at = own, .vertical = true, .name = "this path"});
  figures::Panel loop =
      figures::curve_figure("indentation", "force", {.x = path.indentation, .y = loss.force})
          .panels[0];
  loop.title = "normal loss " + figures::value_text(loss.normal_material_work, "J");
  loop.caption = "Loop of the normal force, whose area is lost in the material.";
  figure.panels.push_back(std::move(loop));
  figure.columns = 3;
  figure.caption += " Motion: " + motion_text_of(path) +
                    ", F = " + format_quantity(loss.mean_force, Dimension::force, 4) + ".";
  figures::state_validity(figure, std::span<const AssumptionVerdict>());
  return figure;
}

void bind_damping_of_period(nb::module_& m) {
  described_class<ViscoelasticDamping>(m, "ViscoelasticDamping",
                                       "Losses of a sticking viscoelastic contact in a period.",
                                       nb::dynamic_attr());
  m.def(
      "viscoelastic_damping",
      [](const IndenterLaw& law, const PronySeries& prony, const SampledMotion& trajectory,
         int springs) {
        cite({"popov2015", "popov_hess2015"});
        ViscoelasticDamping loss =
            unlocked([&] { return viscoelastic_damping(law, prony, trajectory, springs); });
        return with_figure(std::move(loss), [kept = nb::find(law), prony, trajectory,
                                             springs](const ViscoelasticDamping& drawn) {
          return damping_figure(nb::cast<const IndenterLaw&>(kept), prony, trajectory, springs,
                                drawn);
        });
      },
      nb::arg("law"), nb::arg("prony"), nb::arg("trajectory"), nb::kw_only(),
      nb::arg("springs") = 200,
      R"(Losses of an indenter on a viscoelastic body in the steady state of a periodic motion without slip.

Parameters
----------
law : IndenterLaw
    Law of the relaxed body.
prony : PronySeries
trajectory : SampledMotion
    One period, such as a result of `sample()`.
springs : int
    Number of springs in the ring that opens and closes; the error is of second order.
)");
}

void bind_rough_cycles(nb::module_& m) {
  auto result = described_class<ViscoelasticCycle>(
      m, "ViscoelasticCycle",
      "Loss of a rough contact on a viscoelastic body in its steady state; columns are views.");
  result_methods(result);
  curve_class<ViscoelasticCycle>(m, "ViscoelasticCurve",
                                 "Losses over the frequency: a sequence of "
                                 ":class:`ViscoelasticCycle` with an array for each number.");
  m.def(
      "viscoelastic_sweep",
      [](const BoundSurface& surface, const PressedArgument& material, const PronySeries& prony,
         const std::variant<EqualFrequency, Drag>& motion, const Values& angular_frequencies,
         std::optional<double> pressure, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, int steps, double tolerance,
         const ProgressArgument& progress) {
        cite({"popov2015", "polonsky_keer1999", "stanley_kato1997"});
        ViscoelasticCycleOptions options;
        options.hold = hold.value("hold");
        options.steps = steps;
        options.tolerance = tolerance;
        return interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          CurveOf<ViscoelasticCycle> curve{
              "angular_frequency", angular_frequencies.values,
              viscoelastic_sweep(surface.surface, material.pressed(), prony, oscillation(motion),
                                 operating_point_of(pressure, {}, indentation, force),
                                 angular_frequencies.values, options)};
          curve.setting =
              figures::setting_text(
                  figures::motion_text(motion_of(oscillation(motion)), "angular_frequency"),
                  ContactParameters::unknown, ContactParameters::unknown) +
              ".";
          return curve;
        });
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("prony"), nb::arg("motion"),
      nb::arg("angular_frequencies"), nb::kw_only(), nb::arg("pressure") = nb::none(),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(), nb::arg("hold") = "auto",
      nb::arg("steps") = ViscoelasticCycleOptions().steps,
      nb::arg("tolerance") = ViscoelasticCycleOptions().tolerance, nb::arg("progress") = false,
      R"(Steady cycles of a rough contact on a viscoelastic body without slip, one for each frequency.

Each straight step of the displacements is one elastic contact; Anderson's extrapolation of cycles finds the periodic state. The motion is
along x.

Parameters
----------
surface : Surface
    Continued periodically.
material : Material or Body
    The relaxed response.
prony : PronySeries
    Only the ratios G_i/G∞ and τ_i are used. The series holds for the whole body.
motion : EqualFrequency or Drag
    Its own frequency is replaced.
angular_frequencies : array_like
    ω > 0, rad/s; each search starts from the state before.
pressure, indentation, force : float, optional
    One of them, Pa, m or N: the relaxed body at rest, about which the contact oscillates.
hold : str
    "auto", "indentation" or "force": the mean value that the oscillation keeps.
steps : int
    Straight steps in a cycle, even, >= 16; half as many give `step_error`.
tolerance : float
    Largest distance from the periodic state, over the amplitude.

Returns
-------
list of ViscoelasticCycle

Raises
------
InvalidInput
    For a motion that reaches full contact from the mean plane, and where :func:`press` does.
)");
}

void bind_path(nb::module_& m) {
  auto result = described_class<ViscoelasticPath>(
      m, "ViscoelasticPath", "Contact on a viscoelastic body along a path; columns are views.");
  result_methods(result);
  m.def(
      "viscoelastic_path",
      [](const BoundSurface& surface, const PressedArgument& material, const PronySeries& prony,
         const Values& time, const std::optional<Values>& pressure,
         const std::optional<Values>& indentation, const std::optional<Values>& force, int steps,
         const Choice<Boundary>& boundary, const ProgressArgument& progress) {
        require_that(pressure.has_value() + indentation.has_value() + force.has_value() == 1,
                     "path", "exactly one of `pressure`, `indentation` and `force` must be given");
        const OperatingPoints path =
            pressure      ? OperatingPoints{ControlQuantity::pressure, pressure->values}
            : indentation ? OperatingPoints{ControlQuantity::indentation, indentation->values}
                          : OperatingPoints{ControlQuantity::normal_force, force->values};
        ViscoelasticPathOptions options{.steps = steps,
                                        .contact = {.boundary = boundary.value("boundary")}};
        cite({"polonsky_keer1999", "stanley_kato1997"});
        return interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          return viscoelastic_path(surface.surface, material.pressed(), prony, time.values, path,
                                   options);
        });
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("prony"), nb::arg("time"), nb::kw_only(),
      nb::arg("pressure") = nb::none(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("steps") = ViscoelasticPathOptions().steps,
      nb::arg("boundary") = "periodic", nb::arg("progress") = false,
      R"(Contact of a rough surface on an undisturbed viscoelastic body along a path in time, such as creep under a constant pressure.

The value at the first time is reached at once, with the unrelaxed response; between the times it is straight. Each step is one elastic contact.

Parameters
----------
surface : Surface
material : Material or Body
    The relaxed response.
prony : PronySeries
    Only the ratios G_i/G∞ and τ_i are used. The series holds for the whole body.
time : array_like
    s, increasing.
pressure, indentation, force : float or array_like, optional
    One of them, Pa, m or N: a value at each time, or one > 0 that is held. A load is >= 0, where 0 lifts the surface off; an indentation <= 0 holds it above the undeformed body.
steps : int
    Straight steps between neighbouring times, even, >= 2; half as many give `indentation_error` and `pressure_error`.
boundary : {"periodic", "free"}
    A free boundary needs a half-space.

Returns
-------
ViscoelasticPath
)");
}

}  // namespace

void bind_viscoelastic(nb::module_& m) {
  bind_series(m);
  bind_path(m);
  bind_rough_cycles(m);
  bind_indentation(m);
  bind_damping_of_period(m);
}

}  // namespace salebra::python
