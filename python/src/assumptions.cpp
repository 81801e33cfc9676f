// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the assumptions behind a damping constant, of the loss with slip, of steady sliding,
// and of joints.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/results/assumption_verdicts.hpp>

#include "bindings.hpp"
#include "damping/joint_loop.hpp"
#include "damping/max_motion.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/damping.hpp"
#include "interop/described.hpp"
#include "interop/drawn.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

std::string verdicts(const Assumptions& assumptions) {
  std::string text;
  for (const AssumptionName& name : assumption_names()) {
    const Verdict verdict = (assumptions.*name.assumption).verdict;
    if (verdict == Verdict::broken || verdict == Verdict::doubtful)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name.name, name_of(verdict));
  }
  return "'" + (text.empty() ? "none broken" : text) + "'";
}

namespace {

/// Warns if the mean force with the oscillation is much larger than without, since the mean
/// indentation is held; for functions that cannot hold the mean force.
void warn_of_held_indentation(const ContactLaw& law, double indentation, double mean_force) {
  DampingResult mean;
  mean.force = law.force(indentation);
  mean.mean_force = mean_force;
  if (const auto warning = detail::warning_of_held_indentation({&mean, 1})) warn_user(*warning);
}

void bind_contact_parameters(nb::module_& m) {
  auto parameters = described_class<ContactParameters>(
      m, "ContactParameters",
      "Parameters of a contact in addition to its law and its motion. NaN: not known.");
  keyword_constructor(parameters, 0);
}

void bind_assumption_classes(nb::module_& m) {
  described_class<Assumption>(m, "Assumption",
                              "One assumption: its value, its limits, and its verdict.");
  described_class<AssumptionVerdict>(m, "AssumptionVerdict",
                                     "An assumption as a sentence, with the remedy if it fails.");
  described_class<MaxMotion>(m, "MaxMotion",
                             "The largest motion for which slip changes the loss by at most 5 %.");
  described_class<Assumptions>(
      m, "Assumptions", "The assumptions of a damping constant without slip, each with a verdict.")
      .def(
          "verdicts",
          [](const Assumptions& self, bool slip_followed) {
            return verdicts_of({&self, 1}, slip_followed);
          },
          nb::arg("slip_followed") = false,
          "The assumptions as sentences, worst first. slip_followed: the loss includes slip, so "
          "that no "
          "slip is no assumption.")
      .def_prop_ro(
          "validity",
          [](const Assumptions& self) {
            return std::string(name_of(validity_of(verdicts_of({&self, 1}, false))));
          },
          "'valid', 'valid with care', 'not valid' or 'not checked', for a loss without slip.")
      .def("__repr__",
           [](const Assumptions& self) { return "Assumptions(" + verdicts(self) + ")"; });
  m.def(
      "assumptions_of",
      [](const ContactLaw& law, const Motion& motion, std::optional<double> indentation,
         std::optional<double> force, const ContactParameters* parameters,
         const ForceCurve* curve) {
        const OperatingPoint point = operating_point_of(indentation, force);
        return unlocked([&] {
          const double mean = indentation_of(law, point);
          const auto judged = [&](const auto& one) {
            return assumptions_of(
                law, mean, one,
                at_state(known(parameters), law, curve, mean, mean + one.normal_amplitude));
          };
          return std::visit(judged, motion);
        });
      },
      nb::arg("law"), nb::arg("motion"), nb::kw_only(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("parameters") = nb::none(),
      nb::arg("curve") = nb::none(),
      R"(The assumptions of relaxation_damping() for this contact and motion, with the limits at which the loss changes by 5 and 20 %.

Parameters
----------
law : ContactLaw
motion : EqualFrequency, Drag or TwoFrequencies
    A Drag may have an unknown velocity, NaN: the largest allowed velocity is found.
indentation : float, optional
    Mean indentation, m, on the scale of the law.
force : float, optional
    Force at the mean indentation, N. Give exactly one of indentation and force.
parameters : ContactParameters, optional
    Friction, hardness, density and the like, as far as known; without friction the largest motions are given for μ = 0.1, 0.3 and 1.
curve : ForceCurve, optional
    The curve of which the law was made: gives pressures and size.
)");
}

void bind_loss_with_slip(nb::module_& m) {
  described_class<ErrorBudget>(m, "ErrorBudget", "Numerical error of a loss by its causes, J.");
  described_class<Loss>(
      m, "Loss", "Energy lost in a cycle of a motion, and the damping constant that follows.");
  m.def(
      "loss_with_slip",
      [](const ContactLaw& law, const std::variant<EqualFrequency, Drag>& motion,
         double mean_indentation, double friction_coefficient, double excursion) {
        return unlocked([&] {
          return loss_with_slip(law, mean_indentation, oscillation(motion), friction_coefficient,
                                excursion);
        });
      },
      nb::arg("law"), nb::arg("motion"), nb::arg("mean_indentation"), nb::kw_only(),
      nb::arg("friction_coefficient"), nb::arg("excursion") = ContactParameters::unknown,
      "The loss of a cycle with slip. Case (b) without an excursion (m) slides without end, and "
      "all "
      "springs slip. With an excursion the loss is the mean over the forward and the backward "
      "motion and "
      "over the phases of the turning points.");
}

void bind_regime_map(nb::module_& m) {
  auto map = described_class<RegimeMap>(
      m, "RegimeMap",
      "Regimes of slip in a slow tangential motion, over its velocity and its excursion.");
  result_methods(map);
  m.def(
      "regime_map",
      [](const ContactLaw& law, double mean_indentation, double normal_amplitude,
         double angular_frequency, const Values& velocities, const Values& excursions,
         double friction_coefficient) {
        return unlocked([&] {
          return regime_map(law, mean_indentation, {normal_amplitude, angular_frequency},
                            velocities.values, excursions.values, friction_coefficient);
        });
      },
      nb::arg("law"), nb::arg("mean_indentation"), nb::arg("normal_amplitude"),
      nb::arg("angular_frequency"), nb::arg("velocities"), nb::arg("excursions"), nb::kw_only(),
      nb::arg("friction_coefficient"),
      "Regime (no slip, partial slip, lifts off, sliding) and loss over the loss without slip, for "
      "slow "
      "motions of "
      "these velocities (m/s) and excursions (m) under a normal oscillation.");
}

/// Friction and losses over velocities about that of the state, which is marked.
figures::Figure sliding_figure(const ContactLaw& law, const OperatingPoint& point,
                               const Drag& motion, double friction_coefficient,
                               const SteadySliding& state) {
  constexpr int count = 61;
  const double other = state.critical_velocity > 0 ? state.critical_velocity : motion.drag_velocity;
  const auto [low, high] = std::minmax(motion.drag_velocity, other);
  const double from = low / 10, ratio = 30 * high / low;
  std::vector<double> velocities;
  for (int k = 0; k < count; ++k) velocities.push_back(from * std::pow(ratio, k / (count - 1.0)));
  const std::vector<SteadySliding> states = steady_sliding(
      law, point, NormalOscillation{motion.normal_amplitude, motion.angular_frequency}, velocities,
      friction_coefficient);
  std::vector<SlidingPoint> points;
  for (std::size_t k = 0; k < states.size(); ++k)
    points.push_back({.normal_amplitude = motion.normal_amplitude,
                      .velocity = velocities[k],
                      .state = states[k]});
  figures::Figure figure = figures::figure_of(points, friction_coefficient);
  const auto mark = [&](std::size_t panel, double value) {
    figure.panels[panel].curves.push_back({.name = "the result",
                                           .x = {motion.drag_velocity},
                                           .y = {value},
                                           .style = figures::Style::points,
                                           .color = 6});
  };
  mark(0, state.friction_coefficient);
  mark(1, state.relaxation_work + state.slip_work);
  figure.caption += figures::setting_text(figures::motion_text(motion, "excursion"),
                                          friction_coefficient, state.mean_force) +
                    ".";
  figures::state_validity(figure, std::span<const AssumptionVerdict>());
  return figure;
}

void bind_steady_sliding(nb::module_& m) {
  described_class<SteadySliding>(m, "SteadySliding",
                                 "A contact that slides steadily while it oscillates in the normal "
                                 "direction; unknown numbers are NaN.",
                                 nb::dynamic_attr());
  m.def(
      "steady_sliding",
      [](const ContactLaw& law, const Drag& motion, double friction_coefficient,
         std::optional<double> indentation, std::optional<double> force) {
        cite({"popov2015"});
        const OperatingPoint point = operating_point_of(indentation, force);
        const SteadySliding sliding =
            unlocked([&] { return steady_sliding(law, point, motion, friction_coefficient); });
        if (hold_of(law, point, motion.normal_amplitude) == Hold::indentation)
          warn_of_held_indentation(law, sliding.indentation, sliding.mean_force);
        return with_figure(sliding, [kept = nb::find(law), point, motion,
                                     friction_coefficient](const SteadySliding& state) {
          return sliding_figure(nb::cast<const ContactLaw&>(kept), point, motion,
                                friction_coefficient, state);
        });
      },
      nb::arg("law"), nb::arg("motion"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      "Mean tangential force of steady sliding at motion.drag_velocity with Coulomb's friction "
      "under a normal oscillation; indentation (m) or force (N), one of the two.");
}

/// The loop with its backbone. The program's figure has the loss over the force too, which is one
/// point here.
figures::Figure joint_figure(const ContactLaw& law, const JointMotion& motion,
                             double friction_coefficient, int steps, const JointLoss& loss) {
  // An even number of steps contains the maximum and the minimum of a harmonic motion.
  const detail::JointLoop loop = detail::joint_loop(law, loss.indentation, motion,
                                                    friction_coefficient, steps + steps % 2, {});
  const double force = std::isnan(loss.mean_force) ? law.force(loss.indentation) : loss.mean_force;
  figures::Figure figure = figures::figure_of(std::vector{loss}, loop.displacement,
                                              loop.tangential_force, force, friction_coefficient);
  figure.panels.erase(figure.panels.begin());
  figure.panels.front().title.erase(0, std::string_view("largest motion, ").size());
  std::string& caption = figure.panels.front().caption;
  caption.replace(0, std::string_view("Loop of the largest motion").size(), "Loop");
  figure.columns = 1;
  figures::state_validity(figure, std::span<const AssumptionVerdict>());
  return figure;
}

void bind_joint(nb::module_& m) {
  described_class<JointLoss>(m, "JointLoss",
                             "Loss and stiffness of a joint under a tangential oscillation; "
                             "unknown numbers are NaN.",
                             nb::dynamic_attr());
  m.def(
      "joint_loss",
      [](const ContactLaw& law, double friction_coefficient,
         std::optional<double> tangential_amplitude, std::optional<double> tangential_force,
         std::optional<double> indentation, std::optional<double> force, double normal_amplitude,
         double phase, const Choice<Hold>& hold, double angular_frequency, int steps) {
        require_one(tangential_amplitude.has_value(), "tangential_amplitude",
                    tangential_force.has_value(), "tangential_force");
        const OperatingPoint point = operating_point_of(indentation, force);
        const TangentialOscillation motion =
            tangential_force ? TangentialOscillation(TangentialForce{*tangential_force})
                             : TangentialOscillation(TangentialAmplitude{*tangential_amplitude});
        const Hold held = hold.value("hold");
        JointLoss loss = unlocked([&] {
          return normal_amplitude == 0
                     ? joint_loss(law, point, motion, friction_coefficient)
                     : joint_loss(law, point, {motion, normal_amplitude, phase, held},
                                  friction_coefficient, steps);
        });
        if (normal_amplitude != 0 && loss.hold == Hold::indentation)
          warn_of_held_indentation(law, loss.indentation, loss.mean_force);
        if (angular_frequency > 0) loss.set_damping_constant(angular_frequency);
        return with_figure(loss, [kept = nb::find(law), motion, normal_amplitude, phase,
                                  friction_coefficient, steps](const JointLoss& drawn) {
          return joint_figure(nb::cast<const ContactLaw&>(kept), {motion, normal_amplitude, phase},
                              friction_coefficient, steps, drawn);
        });
      },
      nb::arg("law"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("tangential_amplitude") = nb::none(), nb::arg("tangential_force") = nb::none(),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      nb::arg("normal_amplitude") = 0.0, nb::arg("phase") = 0.0, nb::arg("hold") = "auto",
      nb::arg("angular_frequency") = 0.0, nb::arg("steps") = 2000,
      R"(Loss and stiffness in partial or gross slip under a tangential oscillation, by displacement (m) or by force (N).

With a constant normal force the result is a quadrature. With a normal_amplitude u_z (m) the indentation oscillates, the tangential motion
has a phase (rad) against it, and the springs of the law are followed step by step, through lift-off too. hold: what the oscillation keeps,
"indentation", "force" (the mean force), or "auto", the force if it is given and the contact lifts off. With an angular_frequency (rad/s) the result has a damping_constant.
)");
}

}  // namespace

void bind_assumptions(nb::module_& m) {
  bind_contact_parameters(m);
  bind_assumption_classes(m);
  bind_loss_with_slip(m);
  bind_regime_map(m);
  bind_steady_sliding(m);
  bind_joint(m);
}

}  // namespace salebra::python
