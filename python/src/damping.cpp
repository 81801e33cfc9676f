// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the damping theorem and of the damper.
#include "interop/damping.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/premises.hpp>

#include "bindings.hpp"
#include "damping/largest_motion.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

DampingOptions damping_options(const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
                               double tolerance) {
  return {hold.value("hold"), amplitude.value("amplitude"), tolerance, {}};
}

/// An answer whose premises are still to be judged, of a law made of `curve` if there is one. Facts
/// that cannot be are refused now. Called with the interpreter's lock.
BoundDamping to_be_judged(const DampingResult& result, const ContactLaw& law, const Motion& motion,
                          const ContactFacts* facts, const ForceCurve* curve) {
  const double mean = result.indentation;
  const ContactFacts all = std::visit(
      [&](const auto& one) {
        return at_state(known(facts), law, curve, mean, mean + one.normal_amplitude);
      },
      motion);
  // The object keeps the law.
  return {result, {}, [&law, kept = nb::find(law), motion, mean, all] {
            return unlocked([&] {
              return with_motion(
                  motion, [&](const auto& one) { return premises_of(law, mean, one, all); });
            });
          }};
}

void warn_of_held_indentation(Hold hold, std::span<const DampingResult> results) {
  if (const auto doubt = detail::doubt_of_held_indentation(hold, results)) warn_user(*doubt);
}

void bind_damping_result(nb::module_& m) {
  nb::class_<BoundDamping> bound(
      m, "DampingResult", "Relaxation damping of one contact under one motion; NaN is unknown.");
  describe([&](auto member, const auto& line) { described_property(bound, member, line); },
           std::type_identity<DampingResult>{});
  bound.def_prop_ro(
      "premises", [](const BoundDamping& self) { return self.judged().premises; },
      "whether the contact may be taken for one without slip, yielding and inertia; None where "
      "they "
      "were not asked for.");
  value_methods(
      bound, [](const BoundDamping& self) { return self.judged(); },
      [](BoundDamping* self, JudgedDamping&& value) {
        new (self) BoundDamping{value, std::move(value.premises), {}};
      });
}

void bind_theorem(nb::module_& m) {
  m.def(
      "relaxation_damping",
      [](const ContactLaw& law, const Motion& motion, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
         double tolerance, const ContactFacts* facts, const ForceCurve* curve) {
        cite({"popov2015"});
        const Position position = position_of(indentation, force);
        const DampingOptions options = damping_options(hold, amplitude, tolerance);
        const DampingResult result = unlocked([&] {
          return with_motion(motion, [&](const auto& one) {
            return relaxation_damping(law, position, one, options);
          });
        });
        warn_of_held_indentation(options.hold, {&result, 1});
        return to_be_judged(result, law, motion, facts, curve);
      },
      nb::arg("law"), nb::arg("motion"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "indentation",
      nb::arg("amplitude") = "finite", nb::arg("tolerance") = 1e-10, nb::arg("facts") = nb::none(),
      nb::arg("curve") = nb::none(),
      R"(Work lost per cycle by a contact without slip that oscillates, at any amplitude.

.. math:: W = \tfrac12\oint s^2\,dK_t, \qquad s = x_{out} - x_{in}\text{ of each indentation level}

in the by-parts forms that need K_t alone:

.. math::
    W_a = 2u_x^2\sin^2\varphi_0\int_0^\pi K_t(\delta(\theta))\sin2\theta\,d\theta, \qquad
    W_b = 4(v/\omega)^2\int_0^\pi\theta\,[K_t(\delta(\theta)) - K_t(\delta_0-u_z)]\,d\theta

with δ(θ) = δ0 + u_z cosθ. Its limit for small amplitudes is Eq. (12) or (15) of doi:10.1038/srep16189.

Parameters
----------
law : ContactLaw
motion : EqualFrequency, Drag or TwoFrequencies
indentation : float, optional
    Where the contact stands, m, on the law's own scale …
force : float, optional
    … or the force that it carries, N; exactly one of the two.
hold : {"indentation", "force"}
    What stays fixed over a cycle: the mean indentation, or the mean force (a dead weight).
amplitude : {"finite", "small"}
    "small": Eq. (12) or (15) with F'' of the law.
tolerance : float
    Relative, of the quadrature of W; 1e-13 … 1e-2.
facts : ContactFacts, optional
    Friction, hardness, density and the like, by which the premises are judged.
curve : ForceCurve, optional
    The curve that the law is made of; says pressures and size.

The result's `premises` are judged when they are read first, which takes about 10 ms.

Raises
------
InvalidInput
    For values that no motion has, and for a motion that leaves the range of a tabulated law.
)");
  m.def(
      "damping_curve",
      [](const ContactLaw& law, const std::vector<Oscillation>& motions,
         const std::optional<Values>& indentation, const std::optional<Values>& force,
         const Choice<Hold>& hold, const Choice<Amplitude>& amplitude, double tolerance,
         const ContactFacts* facts, const ForceCurve* curve, bool premises,
         const ProgressArgument& progress) {
        cite({"popov2015"});
        require_one(indentation.has_value(), "indentation", force.has_value(), "force");
        const std::vector<double>& places = force ? force->values : indentation->values;
        const std::size_t count = std::max(places.size(), motions.size());
        require((places.size() == count || places.size() == 1) &&
                    (motions.size() == count || motions.size() == 1),
                "motions", motions.size(),
                "motions for another number of positions; give one, or as many");
        std::vector<DampingCase> cases;
        cases.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
          const double place = places[places.size() == 1 ? 0 : i];
          cases.push_back({force ? Position(AtForce{place}) : Position(AtIndentation{place}),
                           motions[motions.size() == 1 ? 0 : i]});
        }
        DampingOptions options = damping_options(hold, amplitude, tolerance);
        const std::vector<DampingResult> results = interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          const detail::StopCheck check([&] { return !options.on_progress({"damping"}); });
          return relaxation_damping(law, cases, options);
        });
        warn_of_held_indentation(options.hold, results);
        std::vector<BoundDamping> answers;
        for (std::size_t i = 0; i < count; ++i)
          answers.push_back(
              premises ? to_be_judged(results[i], law,
                                      std::visit([](const auto& one) -> Motion { return one; },
                                                 cases[i].motion),
                                      facts, curve)
                       : BoundDamping{results[i], {}, {}});
        return answers;
      },
      nb::arg("law"), nb::arg("motions"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "indentation",
      nb::arg("amplitude") = "finite", nb::arg("tolerance") = 1e-10, nb::arg("facts") = nb::none(),
      nb::arg("curve") = nb::none(), nb::arg("premises") = true, nb::arg("progress") = false,
      R"(:func:`relaxation_damping` of many cases, in parallel: a list of motions, of positions, or both of one length.

`premises=False` leaves the premises out. Otherwise each result judges its own when they are read first.

Returns
-------
list of DampingResult
    In the order of the cases.
)");
  m.def(
      "relaxation_damping_force_controlled",
      [](const ContactLaw& law, double mean_force, double force_amplitude, const Motion& motion,
         const Choice<Amplitude>& amplitude, double tolerance, const ContactFacts* facts,
         const ForceCurve* curve) {
        cite({"popov2015"});
        const DampingOptions options{.amplitude = amplitude.value("amplitude"),
                                     .tolerance = tolerance};
        const DampingResult result = unlocked([&] {
          return with_motion(motion, [&](const auto& one) {
            return relaxation_damping_force_controlled(law, mean_force, force_amplitude, one,
                                                       options);
          });
        });
        // The normal oscillation has the amplitude that the stiffness makes of the force's.
        Motion moved = motion;
        std::visit(
            [&](auto& one) { one.normal_amplitude = force_amplitude / result.normal_stiffness; },
            moved);
        return to_be_judged(result, law, moved, facts, curve);
      },
      nb::arg("law"), nb::arg("mean_force"), nb::arg("force_amplitude"), nb::arg("motion"),
      nb::kw_only(), nb::arg("amplitude") = "finite", nb::arg("tolerance") = 1e-10,
      nb::arg("facts") = nb::none(), nb::arg("curve") = nb::none(),
      "Normal motion by force, F = F0 + F_a cos ωt with 0 <= F_a <= F0, N; the motion's "
      "normal_amplitude is not used.");
  m.def("mean_force_of_cycle", &mean_force_of_cycle, nb::arg("law"), nb::arg("mean_indentation"),
        nb::arg("normal_amplitude"), "Mean of F over a cycle δ0 + u_z cosθ, N.");
  m.def("indentation_at_mean_force", &indentation_at_mean_force, nb::arg("law"),
        nb::arg("mean_force"), nb::arg("normal_amplitude"),
        "The mean indentation at which the cycle mean of F is mean_force, m: where a dead weight "
        "settles.");
}

void bind_damper(nb::module_& m) {
  described_class<OscillatorDecay>(
      m, "OscillatorDecay",
      "Decay of a tangential oscillator under fast normal oscillation of its contact.");
  m.def(
      "oscillator_decay",
      [](const ContactLaw& law, double normal_amplitude, double angular_frequency, double mass,
         double spring_stiffness, std::optional<double> indentation, std::optional<double> force,
         const Choice<Hold>& hold, double tolerance) {
        const DampingOptions options{.hold = hold.value("hold"), .tolerance = tolerance};
        return oscillator_decay(law, position_of(indentation, force),
                                {normal_amplitude, angular_frequency}, {mass, spring_stiffness},
                                options);
      },
      nb::arg("law"), nb::kw_only(), nb::arg("normal_amplitude"), nb::arg("angular_frequency"),
      nb::arg("mass"), nb::arg("spring_stiffness") = 0.0, nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "indentation", nb::arg("tolerance") = 1e-10,
      "A mass (kg) on a spring (N/m) and on the contact: m ẍ + γ ẋ + (k + K_t,min) x = 0.");

  auto map =
      described_class<DamperMap>(m, "DamperMap", "γ over normal amplitudes × angular frequencies.");
  result_methods(map, true);
  m.def(
      "damper_map",
      [](const ContactLaw& law, const Values& normal_amplitudes, const Values& angular_frequencies,
         std::optional<double> indentation, std::optional<double> force, const Choice<Hold>& hold,
         double tolerance) {
        const DampingOptions options{.hold = hold.value("hold"), .tolerance = tolerance};
        const Position position = position_of(indentation, force);
        return unlocked([&] {
          return damper_map(law, position, normal_amplitudes.values, angular_frequencies.values,
                            options);
        });
      },
      nb::arg("law"), nb::arg("normal_amplitudes"), nb::arg("angular_frequencies"), nb::kw_only(),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      nb::arg("hold") = "indentation", nb::arg("tolerance") = 1e-10,
      "The damping constant over amplitudes (m) and angular frequencies (rad/s).");
  m.def(
      "stabilising_amplitude",
      [](const ContactLaw& law, double angular_frequency, double falling_slope,
         double largest_amplitude, std::optional<double> indentation, std::optional<double> force,
         const Choice<Hold>& hold, double tolerance) {
        const DampingOptions options{.hold = hold.value("hold"), .tolerance = tolerance};
        return stabilising_amplitude(law, position_of(indentation, force), angular_frequency,
                                     falling_slope, largest_amplitude, options);
      },
      nb::arg("law"), nb::kw_only(), nb::arg("angular_frequency"), nb::arg("falling_slope"),
      nb::arg("largest_amplitude"), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "indentation", nb::arg("tolerance") = 1e-10,
      "The least u_z, m, at which γ >= falling_slope (N s/m): an estimate, without slip, of what "
      "keeps a slider whose friction falls with velocity from stick–slip. "
      "NaN where no amplitude up to largest_amplitude is enough.");
}

}  // namespace

void bind_damping(nb::module_& m) {
  bind_damping_result(m);
  bind_theorem(m);
  bind_damper(m);
}

}  // namespace salebra::python
