// SPDX-License-Identifier: GPL-3.0-or-later
// Damping constants of a loss, and the rules by which a loss is unknown.
#include <cmath>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/loss.hpp>

namespace salebra {

void Loss::set_damping_constants(const Oscillation& motion) {
  damping_constant = closed_form::damping_constant(work_per_cycle, motion);
  damping_constant_without_slip =
      closed_form::damping_constant(work_per_cycle_without_slip, motion);
  damping_per_work = closed_form::damping_constant(1, motion);
}

void Loss::drop_uncertain() {
  const auto uncertain = [](double error_of_work, double work) {
    return error_of_work > 0 && error_of_work >= std::abs(work);
  };
  if (uncertain(error.total(), work_per_cycle))
    work_per_cycle = damping_constant = relaxation_work = slip_work = unknown;
  if (uncertain(error_without_slip.total(), work_per_cycle_without_slip))
    work_per_cycle_without_slip = damping_constant_without_slip = unknown;
}

void Loss::forget() {
  work_per_cycle = damping_constant = relaxation_work = slip_work = unknown;
  error = {};
}

}  // namespace salebra
