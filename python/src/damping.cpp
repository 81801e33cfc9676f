// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the damping theorem and of the damper.
#include "interop/damping.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/results/assumption_verdicts.hpp>

#include "bindings.hpp"
#include "damping/max_motion.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/drawn.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"
#include "results/describe.hpp"

namespace salebra::python {

JudgedDamping BoundDamping::judged() const {
  judge_all({this, 1});
  return {*this, assumptions};
}

void judge_all(std::span<const BoundDamping> results) {
  std::vector<const BoundDamping*> open;
  // A copy: while the lock is free, another thread may finish the same result and drop its `judge`.
  std::vector<std::function<Assumptions()>> judges;
  for (const BoundDamping& one : results)
    if (one.judge) {
      open.push_back(&one);
      judges.push_back(one.judge);
    }
  if (open.empty()) return;
  std::vector<Assumptions> judged(open.size());
  unlocked([&] {
    const auto judge = [&](Index begin, Index end) {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i) judged[i] = judges[i]();
    };
    if (open.size() == 1)
      judge(0, 1);  // its own loops are parallel
    else
      parallel::for_slabs(Index(open.size()), judge);
  });
  for (std::size_t i = 0; i < open.size(); ++i) {
    open[i]->assumptions = std::move(judged[i]);
    open[i]->judge = nullptr;
  }
}

std::vector<Assumptions> assumptions_of(std::span<const BoundDamping> results) {
  judge_all(results);
  std::vector<Assumptions> assumptions;
  for (const BoundDamping& one : results)
    if (one.assumptions) assumptions.push_back(*one.assumptions);
  return assumptions;
}

bool follow_slip(std::span<const BoundDamping> results) {
  return std::ranges::any_of(results,
                             [](const BoundDamping& one) { return !std::isnan(one.slip_work); });
}

void warn_of_unknown(const Motion& motion, const ContactParameters* parameters, bool force_given) {
  const std::string why = why_loss_unknown(motion, known(parameters), force_given);
  if (!why.empty()) warn_user("the loss is unknown: " + why);
}

namespace {

DampingOptions damping_options(const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
                               double tolerance) {
  return {hold.value("hold"), amplitude.value("amplitude"), tolerance, {}};
}

std::string regime_of(const BoundDamping& one) {
  const std::optional<Assumptions> assumptions = one.judged().assumptions;
  return std::string(name_of(assumptions ? assumptions->regime : Regime::unknown));
}

/// A result whose assumptions are judged when they are first read. Impossible parameters are
/// refused now. curve: the force curve of which the law was made; nullptr if there is none. The
/// caller must hold the interpreter's lock.
BoundDamping to_be_judged(const DampingResult& result, const ContactLaw& law, const Motion& motion,
                          const ContactParameters* parameters, const ForceCurve* curve) {
  const double mean = result.indentation;
  const ContactParameters all = std::visit(
      [&](const auto& one) {
        return at_state(known(parameters), law, curve, mean, mean + one.normal_amplitude);
      },
      motion);
  // Keeps the Python object of the law alive as long as the result.
  return {result, {}, [&law, kept = nb::find(law), motion, mean, all] {
            return with_motion(
                motion, [&](const auto& one) { return assumptions_of(law, mean, one, all); });
          }};
}

void warn_of_held_indentation(std::span<const DampingResult> results) {
  if (const auto warning = detail::warning_of_held_indentation(results)) warn_user(*warning);
}

/// A curve of results without its results: the quantity that differs from case to case, and its
/// values. This is the indentation or force, otherwise a number of the motion, otherwise the number
/// of the case.
BoundDampingCurve over(const std::vector<DampingCase>& cases, bool force) {
  BoundDampingCurve curve{force ? "force" : "indentation", {}, {}};
  const auto changes = [](const std::vector<double>& values) {
    return std::ranges::any_of(values, [&](double one) { return one != values.front(); });
  };
  for (const DampingCase& one : cases) curve.values.push_back(one.point.value);
  if (changes(curve.values) || cases.size() < 2) return curve;
  const auto of_motion = [&]<class Kind>(std::type_identity<Kind>) {
    if (!std::ranges::all_of(
            cases, [](const DampingCase& one) { return std::holds_alternative<Kind>(one.motion); }))
      return false;
    bool found = false;
    salebra::for_each_number<Kind>([&](const NumberOf<Kind>& number, const Quantity& quantity) {
      std::vector<double> values;
      for (const DampingCase& one : cases) values.push_back(number(std::get<Kind>(one.motion)));
      if (found || !changes(values)) return;
      found = true;
      curve.coordinate = quantity.name;
      curve.values = std::move(values);
    });
    return found;
  };
  if (of_motion(std::type_identity<Drag>{}) || of_motion(std::type_identity<EqualFrequency>{}))
    return curve;
  curve.coordinate = "case";
  for (std::size_t i = 0; i < cases.size(); ++i) curve.values[i] = double(i);
  return curve;
}

/// The validity of losses as they are described: where they include slip, slip is no assumption.
std::string validity_of_losses(std::span<const BoundDamping> losses) {
  const std::vector<Assumptions> assumptions = assumptions_of(losses);
  if (assumptions.empty()) return std::string(name_of(Validity::not_checked));
  return std::string(name_of(validity_of(verdicts_of(assumptions, follow_slip(losses)))));
}

void bind_damping_result(nb::module_& m) {
  nb::class_<BoundDamping> bound(
      m, "DampingResult", "Damping of one contact under one motion; unknown numbers are NaN.");
  describe([&](auto member, const auto& line) { described_property(bound, member, line); },
           std::type_identity<DampingResult>{});
  bound.def_prop_ro("regime", &regime_of, "no slip, partial slip, lifts off, sliding or unknown.");
  bound.def_prop_ro(
      "validity", [](const BoundDamping& self) { return validity_of_losses({&self, 1}); },
      "One word for the assumptions of this loss; where it includes slip, slip is no assumption.");
  bound.def_prop_ro(
      "assumptions", [](const BoundDamping& self) { return self.judged().assumptions; },
      "assumptions: no slip, no yielding, no inertia; None if they were not judged.");
  value_methods(
      bound, [](const BoundDamping& self) { return self.judged(); },
      [](BoundDamping* self, JudgedDamping&& value) {
        new (self) BoundDamping{value, std::move(value.assumptions), {}};
      });
}

void bind_damping_curve(nb::module_& m) {
  auto bound = curve_class<BoundDamping, DampingResult>(
      m, "DampingCurve",
      "Losses over one quantity: a sequence of :class:`DampingResult` with an array for each "
      "number.");
  bound
      .def_prop_ro(
          "regime",
          [](const BoundDampingCurve& self) {
            judge_all(self.results);
            std::vector<std::string> regimes;
            for (const BoundDamping& one : self.results) regimes.push_back(regime_of(one));
            return regimes;
          },
          "The regime of each loss: no slip, partial slip, sliding or unknown.")
      .def_prop_ro(
          "validity",
          [](const BoundDampingCurve& self) { return validity_of_losses(self.results); },
          "One word for the assumptions of all losses.");
  value_methods(
      bound,
      [](const BoundDampingCurve& self) {
        judge_all(self.results);
        CurveOf<JudgedDamping> curve{self.coordinate, self.values, {}, {}, self.setting};
        for (const BoundDamping& one : self.results) curve.results.push_back(one.judged());
        return curve;
      },
      [](BoundDampingCurve* self, CurveOf<JudgedDamping>&& curve) {
        new (self) BoundDampingCurve{
            std::move(curve.coordinate), std::move(curve.values), {}, {}, std::move(curve.setting)};
        for (JudgedDamping& one : curve.results)
          self->results.push_back({one, std::move(one.assumptions), {}});
      });
}

void bind_theorem(nb::module_& m) {
  m.def(
      "relaxation_damping",
      [](const ContactLaw& law, const Motion& motion, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
         double tolerance, const ContactParameters* parameters, const ForceCurve* curve) {
        cite({"popov2015"});
        const OperatingPoint point = operating_point_of(indentation, force);
        const DampingOptions options = damping_options(hold, amplitude, tolerance);
        std::string dropped;
        const DampingResult result = unlocked([&] {
          DampingResult found = with_motion(motion, [&](const auto& one) {
            return relaxation_damping(law, point, one, options);
          });
          add_slip(found, law, motion, known(parameters));
          dropped = drop_uncertain(found);
          return found;
        });
        if (!dropped.empty()) warn_user(dropped);
        BoundDamping bound = to_be_judged(result, law, motion, parameters, curve);
        warn_of_unknown(motion, parameters);
        warn_of_held_indentation({&result, 1});
        return bound;
      },
      nb::arg("law"), nb::arg("motion"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "auto", nb::arg("amplitude") = "finite",
      nb::arg("tolerance") = 1e-10, nb::arg("parameters") = nb::none(),
      nb::arg("curve") = nb::none(),
      R"(Energy lost per cycle by an oscillating contact, at any amplitude; with slip if `parameters` have a coefficient of friction.

Without slip it is

.. math:: W = \tfrac12\oint s^2\,dK_t, \qquad s = x_{out} - x_{in}\text{ of each spring}

integrated by parts, which needs only K_t:

.. math::
    W_a = 2u_x^2\sin^2\varphi_0\int_0^\pi K_t(\delta(\theta))\sin2\theta\,d\theta, \qquad
    W_b = 4(v/\omega)^2\int_0^\pi\theta\,[K_t(\delta(\theta)) - K_t(\delta_0-u_z)]\,d\theta

with δ(θ) = δ0 + u_z cosθ. Its limit for small amplitudes is Eq. (12) or (15) of doi:10.1038/srep16189.

Parameters
----------
law : ContactLaw
motion : EqualFrequency, Drag or TwoFrequencies
indentation : float, optional
    Mean indentation, m, on the scale of the law.
force : float, optional
    Normal force, N. Give exactly one of indentation and force.
hold : {"indentation", "force"}
    Which mean over a cycle stays fixed: the indentation, or the force (a dead weight).
amplitude : {"finite", "small"}
    "small": Eq. (12) or (15) with F'' of the law.
tolerance : float
    Relative, of the quadrature of W; 1e-13 … 1e-2.
parameters : ContactParameters, optional
    Friction, hardness, density and the like, for the loss and for its assumptions. With friction the loss includes slip, and a slow motion
    needs its excursion. `damping_constant_without_slip` never includes slip.
curve : ForceCurve, optional
    The curve of which the law was made: gives pressures and size.

The `assumptions` of the result are judged when they are first read, which takes about 10 ms.

Raises
------
InvalidInput
    For an impossible motion, and for a motion that leaves the range of a tabulated law.
)");
  m.def(
      "damping_curve",
      [](const ContactLaw& law, const std::vector<Oscillation>& motions,
         const std::optional<Values>& indentation, const std::optional<Values>& force,
         const Choice<Hold>& hold, const Choice<Amplitude>& amplitude, double tolerance,
         const ContactParameters* parameters, const ForceCurve* curve, bool assumptions,
         const ProgressArgument& progress) {
        cite({"popov2015"});
        require_one(indentation.has_value(), "indentation", force.has_value(), "force");
        const std::vector<double>& positions = force ? force->values : indentation->values;
        const std::size_t count = std::max(positions.size(), motions.size());
        require((positions.size() == count || positions.size() == 1) &&
                    (motions.size() == count || motions.size() == 1),
                "motions", motions.size(),
                "motions for another number of operating points; give one, or as many");
        std::vector<DampingCase> cases;
        cases.reserve(count);
        std::vector<Motion> described;
        for (std::size_t i = 0; i < count; ++i) {
          const double position = positions[positions.size() == 1 ? 0 : i];
          cases.push_back({force ? at_force(position) : at_indentation(position),
                           motions[motions.size() == 1 ? 0 : i]});
          described.push_back(motion_of(cases[i].motion));
        }
        DampingOptions options = damping_options(hold, amplitude, tolerance);
        std::string dropped;
        const std::vector<DampingResult> results = interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          const detail::StopCheck check([&] { return !options.on_progress({"damping"}); });
          std::vector<DampingResult> found = relaxation_damping(law, cases, options);
          for (std::size_t i = 0; i < count; ++i) {
            add_slip(found[i], law, described[i], known(parameters));
            if (const std::string one = drop_uncertain(found[i]); dropped.empty()) dropped = one;
          }
          return found;
        });
        if (!dropped.empty()) warn_user(dropped);
        warn_of_held_indentation(results);
        BoundDampingCurve curve_of = over(cases, force.has_value());
        const bool loads = std::ranges::any_of(
            results, [&](const DampingResult& one) { return one.force != results.front().force; });
        curve_of.setting =
            figures::setting_text(figures::motion_text(described.front(), curve_of.coordinate,
                                                       known(parameters).excursion),
                                  known(parameters).friction_coefficient,
                                  loads ? ContactParameters::unknown : results.front().force) +
            fmt::format("; the mean {} is held.", name_of(results.front().hold));
        for (std::size_t i = 0; i < count; ++i)
          curve_of.results.push_back(
              assumptions ? to_be_judged(results[i], law, described[i], parameters, curve)
                          : BoundDamping{results[i], {}, {}});
        // Gives one warning for all motions together.
        const auto unknown = std::ranges::find_if(described, [&](const Motion& one) {
          return !why_loss_unknown(one, known(parameters)).empty();
        });
        if (unknown != described.end()) warn_of_unknown(*unknown, parameters);
        return curve_of;
      },
      nb::arg("law"), nb::arg("motions"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "auto", nb::arg("amplitude") = "finite",
      nb::arg("tolerance") = 1e-10, nb::arg("parameters") = nb::none(),
      nb::arg("curve") = nb::none(), nb::arg("assumptions") = true, nb::arg("progress") = false,
      R"(:func:`relaxation_damping` of many cases in parallel: several motions, several indentations or forces, or as many of both.

Each result judges its assumptions when they are first read; `assumptions=False` leaves them out.

Returns
-------
DampingCurve
    A sequence of DampingResult in the order of the cases, with an array for each number over the quantity that changes.
)");
  m.def(
      "relaxation_damping_force_controlled",
      [](const ContactLaw& law, double mean_force, double force_amplitude, const Motion& motion,
         const Choice<Amplitude>& amplitude, double tolerance, const ContactParameters* parameters,
         const ForceCurve* curve) {
        cite({"popov2015"});
        const DampingOptions options{.amplitude = amplitude.value("amplitude"),
                                     .tolerance = tolerance};
        warn_of_unknown(motion, parameters, true);
        const DampingResult result = unlocked([&] {
          DampingResult found = with_motion(motion, [&](const auto& one) {
            return relaxation_damping_force_controlled(law, mean_force, force_amplitude, one,
                                                       options);
          });
          if (!std::isnan(known(parameters).friction_coefficient)) found.forget();
          return found;
        });
        // The normal amplitude that corresponds to the force amplitude is the force amplitude
        // divided by K.
        Motion moved = motion;
        std::visit(
            [&](auto& one) { one.normal_amplitude = force_amplitude / result.normal_stiffness; },
            moved);
        return to_be_judged(result, law, moved, parameters, curve);
      },
      nb::arg("law"), nb::arg("mean_force"), nb::arg("force_amplitude"), nb::arg("motion"),
      nb::kw_only(), nb::arg("amplitude") = "finite", nb::arg("tolerance") = 1e-10,
      nb::arg("parameters") = nb::none(), nb::arg("curve") = nb::none(),
      ":func:`relaxation_damping` if the normal force oscillates, F = F0 + F_a cos ωt with 0 <= "
      "F_a <= "
      "F0, N. The normal_amplitude of the motion is not used.");
  m.def("mean_force_of_cycle", &mean_force_of_cycle, nb::arg("law"), nb::arg("mean_indentation"),
        nb::arg("normal_amplitude"), "Mean of F over a cycle δ0 + u_z cosθ, N.");
  m.def("indentation_at_mean_force", &indentation_at_mean_force, nb::arg("law"),
        nb::arg("mean_force"), nb::arg("normal_amplitude"),
        "The mean indentation, m, at which the mean of F over a cycle is mean_force: where a dead "
        "weight "
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
        return oscillator_decay(law, operating_point_of(indentation, force),
                                {normal_amplitude, angular_frequency}, {mass, spring_stiffness},
                                options);
      },
      nb::arg("law"), nb::kw_only(), nb::arg("normal_amplitude"), nb::arg("angular_frequency"),
      nb::arg("mass"), nb::arg("spring_stiffness") = 0.0, nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "auto", nb::arg("tolerance") = 1e-10,
      "Decay of a mass (kg) on a spring (N/m) and on the contact: m ẍ + γ ẋ + (k + K_t,min) x = "
      "0.");

  auto map =
      described_class<DamperMap>(m, "DamperMap", "γ over normal amplitudes × angular frequencies.");
  result_methods(map);
  m.def(
      "damper_map",
      [](const ContactLaw& law, const Values& normal_amplitudes, const Values& angular_frequencies,
         std::optional<double> indentation, std::optional<double> force, const Choice<Hold>& hold,
         double tolerance) {
        const DampingOptions options{.hold = hold.value("hold"), .tolerance = tolerance};
        const OperatingPoint point = operating_point_of(indentation, force);
        return unlocked([&] {
          return damper_map(law, point, normal_amplitudes.values, angular_frequencies.values,
                            options);
        });
      },
      nb::arg("law"), nb::arg("normal_amplitudes"), nb::arg("angular_frequencies"), nb::kw_only(),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(), nb::arg("hold") = "auto",
      nb::arg("tolerance") = 1e-10,
      "The damping constant over amplitudes (m) and angular frequencies (rad/s).");
  m.def(
      "stabilising_amplitude",
      [](const ContactLaw& law, double angular_frequency, double falling_slope,
         double max_amplitude, std::optional<double> indentation, std::optional<double> force,
         const Choice<Hold>& hold, double tolerance) {
        const DampingOptions options{.hold = hold.value("hold"), .tolerance = tolerance};
        return stabilising_amplitude(law, operating_point_of(indentation, force), angular_frequency,
                                     falling_slope, max_amplitude, options);
      },
      nb::arg("law"), nb::kw_only(), nb::arg("angular_frequency"), nb::arg("falling_slope"),
      nb::arg("max_amplitude"), nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      nb::arg("hold") = "auto", nb::arg("tolerance") = 1e-10,
      "Minimum u_z, m, at which γ >= falling_slope (N s/m): an estimate, without slip, of the "
      "amplitude "
      "that prevents stick–slip of a slider whose friction falls with velocity. NaN if "
      "max_amplitude is not enough.");
}

}  // namespace

void bind_damping(nb::module_& m) {
  bind_damping_result(m);
  bind_damping_curve(m);
  bind_theorem(m);
  bind_damper(m);
}

}  // namespace salebra::python
