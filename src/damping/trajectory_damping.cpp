// SPDX-License-Identifier: GPL-3.0-or-later
// Loss, mean forces and energy balance of a contact law driven along a sampled path.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <utility>

#include "base/special_values.hpp"
#include "base/stop_check.hpp"
#include "max_motion.hpp"
#include "table_error.hpp"

namespace salebra {
namespace {

using detail::unknown;

// Mean over one period of the product of two quantities, both linear in time between the samples.
double mean_product(const SampledMotion& path, const std::vector<double>& a,
                    const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 1; i < path.time.size(); ++i) {
    const double same = a[i - 1] * b[i - 1] + a[i] * b[i];
    const double cross = a[i - 1] * b[i] + a[i] * b[i - 1];
    sum += (path.time[i] - path.time[i - 1]) * (2 * same + cross) / 6;
  }
  return sum / path.period();
}

// One direction of the motion, with the displacement and the force in this direction.
struct Direction {
  const std::vector<double>&displacement, &force;
};

void set_means(TrajectoryDamping& result, const SampledMotion& path,
               std::span<const Direction> directions, bool drifts) {
  double square_velocity = 0, variance = 0, in_phase = 0;
  const std::vector<double> ones(path.time.size(), 1);
  for (const Direction& one : directions) {
    std::vector<double> x = one.displacement;
    for (std::size_t i = 1; i < path.time.size(); ++i) {
      const double step = x[i] - x[i - 1];
      square_velocity += step * step / (path.time[i] - path.time[i - 1]);
    }
    const double mean = mean_product(path, x, ones);
    for (double& value : x) value -= mean;
    variance += mean_product(path, x, x);
    in_phase += mean_product(path, one.force, x);
  }
  square_velocity /= path.period();
  result.power = result.work_per_cycle / path.period();
  result.damping_constant = square_velocity > 0 ? result.power / square_velocity : unknown;
  result.storage_stiffness = result.loss_factor = unknown;
  if (drifts || !(variance > 0)) return;
  result.storage_stiffness = in_phase / variance;
  // A contact that pushes the body on stores no energy to compare the loss with.
  if (result.storage_stiffness > 0)
    result.loss_factor =
        result.work_per_cycle / (2 * std::numbers::pi * result.storage_stiffness * variance);
}

// Returns whether the displacement changes over a period by more than the round-off of a closed
// path.
bool moves_on(const SampledMotion& path) {
  const auto [low, high] = std::ranges::minmax(path.displacement);
  return std::abs(path.drift()) > 1e-9 * (high - low);
}

/// Sets the force and the cumulative loss over the period of the path from `force` and `lost`,
/// which hold values at its samples. The period was followed from the sample `first` on, so the
/// samples before `first` came last.
void set_series(TrajectoryDamping& result, const std::vector<double>& force,
                const std::vector<double>& lost, std::size_t first) {
  result.tangential_force = force;
  result.tangential_force.push_back(force[0]);
  for (std::size_t i = 0; i < lost.size(); ++i) {
    const bool came_first = first > 0 && i >= first;
    result.dissipated.push_back(lost[i] - lost[0] + (came_first ? result.work_per_cycle : 0));
  }
  result.dissipated.push_back(result.work_per_cycle);
}

// The steady state of a path that is valid.
TrajectoryDamping followed(const ContactLaw& law, const SampledMotion& path,
                           const TrajectoryDampingOptions& options) {
  const auto [lowest, highest] = std::ranges::minmax(path.indentation);
  detail::require_possible(law, 0.5 * (lowest + highest), 0.5 * (highest - lowest));
  const auto [low_x, high_x] = std::ranges::minmax(path.displacement);
  const bool stick = std::isinf(options.friction_coefficient);
  const bool drifts = moves_on(path);
  const double drift = drifts ? path.drift() : 0;
  // Number of periods until the state repeats. A spring with a stretch limit follows a closed path
  // periodically from its second period on. On a path with drift it reaches its limit in each
  // period. A spring that starts at its limit never lags behind the periodic state, and joins it
  // when the periodic state reaches the limit.
  const bool slides = drifts && !stick;
  const int periods = stick ? 1 : 2;

  const std::size_t count = path.time.size() - 1;
  const auto bottom = std::ranges::min_element(path.indentation);
  const std::size_t first = static_cast<std::size_t>(bottom - path.indentation.begin()) % count;
  TangentialContact contact(
      law, lowest, highest,
      {.friction_coefficient = options.friction_coefficient,
       .tangential_range = slides ? std::numeric_limits<double>::infinity() : high_x - low_x});

  // Starts at the smallest indentation of the path, where every spring that opens during the path
  // is open. The earlier history then has no effect.
  TrajectoryDamping result;
  if (slides) {
    contact.slide(path.indentation[first], path.displacement[first], drift > 0 ? 1 : -1);
  } else {
    // Springs that never separate or slip are free of stress in the middle of a closed path.
    const double rest = drifts ? path.displacement[first] : 0.5 * (low_x + high_x);
    contact.start(path.indentation[first], rest);
    contact.move_to(path.indentation[first], path.displacement[first]);
  }
  const double origin = path.displacement[first];
  std::vector<double> force(count), lost(count);
  for (int period = 0; period < periods; ++period) {
    const double lost_before = contact.dissipated();
    const double slip_before = contact.dissipated_in_permanent_contact();
    double x = origin;
    for (std::size_t step = 0; step < count; ++step) {
      detail::stop_if_asked();
      constexpr std::size_t interval = 1 << 12;
      if (step % interval == interval - 1 && options.on_progress &&
          !options.on_progress(
              {"trajectory",
               (period + static_cast<double>(step) / static_cast<double>(count)) / periods,
               static_cast<int>(step), 0}))
        throw Interrupted("trajectory: interrupted");
      const std::size_t at = (first + step) % count;
      force[at] = contact.tangential_force();
      // In full stick, drift stretches the springs that never open without limit. Their force due
      // to the drift is left out.
      if (drifts && stick) force[at] -= contact.permanent_stiffness() * (x - origin);
      lost[at] = contact.dissipated() - lost_before;
      const bool wrapped = first + step >= count;
      x = path.displacement[at + 1] + drift * (period + (wrapped ? 1 : 0));
      contact.move_to(path.indentation[at + 1], x);
      result.memory = std::max(result.memory, contact.memory());
    }
    result.work_per_cycle = contact.dissipated() - lost_before;
    result.slip_work = contact.dissipated_in_permanent_contact() - slip_before;
  }
  result.relaxation_work = result.work_per_cycle - result.slip_work;
  set_series(result, force, lost, first);
  const Direction along[]{{path.displacement, result.tangential_force}};
  set_means(result, path, along, drifts);
  return result;
}

}  // namespace

TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& path,
                                     const TrajectoryDampingOptions& options) {
  path.validate();
  TrajectoryDamping result = followed(law, path, options);
  const bool slips = std::isfinite(options.friction_coefficient);
  result.error = detail::error_of_table(
      law, {std::ranges::min(path.indentation), std::ranges::max(path.indentation)},
      slips ? -detail::infinity : std::ranges::min(path.indentation), result.work_per_cycle,
      result.work_per_cycle,
      [&](const ContactLaw& other) { return followed(other, path, options).work_per_cycle; });
  return result;
}

TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& path,
                                     std::span<const double> transverse) {
  require(transverse.size() == path.time.size(), "transverse", transverse.size(),
          "positions do not match the times; give one for each");
  const SampledMotion across{path.time, path.indentation, {transverse.begin(), transverse.end()}};
  TrajectoryDamping result = trajectory_damping(law, path);
  TrajectoryDamping other = trajectory_damping(law, across);
  result.work_per_cycle += other.work_per_cycle;
  result.relaxation_work += other.relaxation_work;
  for (double ErrorBudget::*const part : {&ErrorBudget::intervals, &ErrorBudget::first_touch})
    result.error.*part += other.error.*part;
  for (std::size_t i = 0; i < result.dissipated.size(); ++i)
    result.dissipated[i] += other.dissipated[i];
  result.memory = std::max(result.memory, other.memory);
  result.transverse_force = std::move(other.tangential_force);
  const Direction directions[]{{path.displacement, result.tangential_force},
                               {across.displacement, result.transverse_force}};
  set_means(result, path, directions, moves_on(path) || moves_on(across));
  return result;
}

}  // namespace salebra
