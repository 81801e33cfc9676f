// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the loss of a contact law with slip if the coefficient of friction is known.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/closed_form.hpp>
#include <variant>

#include "damping/table_error.hpp"

namespace salebra {

std::string why_loss_unknown(const Motion& motion, const ContactParameters& parameters,
                             bool force_given) {
  if (std::isnan(parameters.friction_coefficient)) return {};
  if (force_given)
    return "slip is not computed for a `force_amplitude`; give the `normal_amplitude`";
  const auto* two = std::get_if<TwoFrequencies>(&motion);
  if (two && common_period(*two).normal_cycles == 0)
    return "slip is not computed for a motion that never repeats; give frequencies with a common "
           "period";
  const auto* drag = std::get_if<Drag>(&motion);
  if (drag && std::isnan(parameters.excursion))
    return "with friction the loss of a slow motion depends on its `excursion`; give it";
  if (drag && parameters.excursion < drag->distance_per_cycle())
    return "the motion reverses within one normal cycle, so it is not slow; give a longer "
           "`excursion`, or a motion of equal frequencies";
  return {};
}

void add_slip(DampingResult& result, const ContactLaw& law, const Motion& motion,
              const ContactParameters& parameters, int steps, const Context& context) {
  const double friction = parameters.friction_coefficient;
  if (std::isnan(friction)) return;
  result.forget();
  if (!why_loss_unknown(motion, parameters).empty()) return;
  const auto take = [&](const auto& loss) {
    result.work_per_cycle = loss.work_per_cycle;
    result.damping_constant = loss.damping_constant;
    result.relaxation_work = loss.relaxation_work;
    result.slip_work = loss.slip_work;
  };
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    const auto loss_of = [&](const ContactLaw& one, double indentation) {
      return loss_with_slip(one, indentation, *drag, friction, parameters.excursion);
    };
    take(loss_of(law, result.indentation));
    result.power = closed_form::power(result.work_per_cycle, *drag);
    result.error = detail::error_of_table(
        law,
        {result.indentation - drag->normal_amplitude, result.indentation + drag->normal_amplitude},
        -std::numeric_limits<double>::infinity(), result.work_per_cycle, result.work_per_cycle,
        [&](const ContactLaw& other) {
          const double indentation =
              result.hold == Hold::force
                  ? indentation_at_mean_force(other, result.mean_force, drag->normal_amplitude)
                  : result.indentation;
          return loss_of(other, indentation).work_per_cycle;
        });
  } else {
    const TrajectoryDamping cycle =
        cycle_of(law, motion, result.indentation, steps, friction, context).loss;
    take(cycle);
    result.power = cycle.power;
    result.storage_stiffness = cycle.storage_stiffness;
    result.loss_factor = cycle.loss_factor;
    result.error = cycle.error;
  }
  // A law without a ratio of moduli is that of a body on which springs are right only as far as K_t/K
  // is the same at all loads.
  if (std::isnan(law.modulus_ratio())) {
    const double exponent = detail::stiffness_ratio_exponent(law, result.indentation);
    result.error.stiffness_ratio =
        std::hypot(result.error.stiffness_ratio, exponent * result.work_per_cycle);
  }
}

std::string drop_uncertain(DampingResult& result) {
  const bool had = !std::isnan(result.work_per_cycle);
  static_cast<Loss&>(result).drop_uncertain();
  if (!had || !std::isnan(result.work_per_cycle)) return {};
  result.power = Loss::unknown;
  return fmt::format(
      "at {} there is no loss, because its error is larger than the loss: the loads of the curve "
      "are too far apart for this motion; give a curve with loads closer to each other, or the "
      "surface",
      format_quantity(result.force, Dimension::force, 3));
}

DampingCycle cycle_of(const ContactLaw& law, const Motion& motion, double indentation, int steps,
                      double friction_coefficient, const Context& context) {
  DampingCycle cycle;
  cycle.path = std::visit([&](const auto& m) { return sample(m, indentation, steps); }, motion);
  TrajectoryDampingOptions options{.on_progress = context.on_progress};
  if (!std::isnan(friction_coefficient)) options.friction_coefficient = friction_coefficient;
  cycle.loss = trajectory_damping(law, cycle.path, options);
  const auto* equal = std::get_if<EqualFrequency>(&motion);
  // Without an angular frequency, power and damping constant are unknown.
  if (equal && !(equal->angular_frequency > 0))
    cycle.loss.power = cycle.loss.damping_constant = Loss::unknown;
  return cycle;
}

}  // namespace salebra
