// SPDX-License-Identifier: GPL-3.0-or-later
// Loading and unloading of adhesive contacts, each solve started from the previous state.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/adhesive_cycle.hpp>

#include "adhesion_reference.hpp"

namespace salebra {
namespace {

// The loading and unloading branches of a cycle meet if their forces differ by less than this
// fraction of the maximum force.
constexpr double meets = 1e-3;
constexpr int bisections = 6;  // after doubling has bracketed the maximum pull: to 2 %

class CycleRun {
 public:
  CycleRun(const Surface& surface, const Body& body, const Adhesion& adhesion,
           const AdhesiveCycleOptions& options)
      : surface_(surface), body_(body), adhesion_(adhesion), options_(options) {
    if (options.contact.start_tension) tension_ = *options.contact.start_tension;
  }

  /// Solves one operating point and appends it to `branch`. Returns false if the run ends here.
  bool press_at(const OperatingPoint& point, bool unloading,
                std::vector<AdhesiveContactState>& branch) {
    AdhesiveContactState state = solve(point);
    const bool converged = state.converged();
    if (converged && !state.detached) follow(state);
    keep(std::move(state), unloading, branch);
    return converged;
  }

  /// Finds the maximum pull that the contact bears. The states appended to `branch` have increasing
  /// pulls.
  void pull_off(double first, AdhesiveCycle& cycle) {
    std::vector<AdhesiveContactState>& branch = cycle.unloading;
    double held = 0, parts = 0, pull = 0;
    for (int halvings = 0; halvings <= bisections;) {
      AdhesiveContactState state = solve(at_pressure(-pull));
      if (!state.converged()) {
        keep(std::move(state), true, branch);
        return;
      }
      if (state.detached) {
        parts = pull;
        if (pull == 0) break;
      } else {
        held = pull;
        follow(state);
        keep(std::move(state), true, branch);
      }
      halvings += parts > 0;
      pull = parts > 0 ? (held + parts) / 2 : std::max(first, 2 * pull);
    }
    cycle.pull_off_pressure = held;
    cycle.pull_off_error = parts - held;
  }

 private:
  AdhesiveContactState solve(const OperatingPoint& point) const {
    AdhesiveContactOptions contact = options_.contact;
    contact.start_tension = tension_.size() > 0 ? &tension_ : nullptr;
    return press_adhesive(surface_, body_, point, adhesion_, contact);
  }
  void follow(const AdhesiveContactState& state) { tension_ = state.tension; }
  void keep(AdhesiveContactState state, bool unloading,
            std::vector<AdhesiveContactState>& branch) const {
    if (state.converged() && options_.on_state) options_.on_state(unloading, state);
    state.contact_pressure = state.gap = state.tension = Field();
    branch.push_back(std::move(state));
  }

  const Surface& surface_;
  const Body body_;
  const Adhesion& adhesion_;
  const AdhesiveCycleOptions& options_;
  Field tension_;
};

/// Work ∫F dδ by the trapezium rule over every stride-th state of a branch and the last one.
double work_along(const std::vector<AdhesiveContactState>& branch, std::size_t stride) {
  double work = 0;
  for (std::size_t k = 0; k + 1 < branch.size();) {
    const std::size_t next = std::min(k + stride, branch.size() - 1);
    work += (branch[k].force + branch[next].force) / 2 *
            (branch[next].indentation - branch[k].indentation);
    k = next;
  }
  return work;
}

/// Error of the work of a cycle by snapping. A surface snaps into or out of contact somewhere
/// between two operating points, while the trapezium rule takes the middle. Each interval between
/// two operating points thus has an error, from the change of the difference of the forces in
/// loading and unloading; returns the sum of the two largest of these errors.
double error_of_snaps(const AdhesiveCycle& cycle) {
  const auto& in = cycle.loading;
  const std::size_t last = in.size() - 1;
  const auto difference = [&](std::size_t k) {
    return in[k].force - cycle.unloading[last - k].force;
  };
  double largest = 0, second = 0;
  for (std::size_t k = 0; k < last; ++k) {
    const double error = std::abs((difference(k + 1) - difference(k)) *
                                  (in[k + 1].indentation - in[k].indentation)) /
                         2;
    second = std::max(second, std::min(largest, error));
    largest = std::max(largest, error);
  }
  return largest + second;
}

/// Error of the work ∫F dδ of a branch if the force is wrong by `force` times the residual.
double error_of_tolerance(const std::vector<AdhesiveContactState>& branch, double force) {
  double error = 0;
  for (std::size_t k = 0; k + 1 < branch.size(); ++k)
    error += force * std::max(branch[k].adhesion_residual, branch[k + 1].adhesion_residual) *
             std::abs(branch[k + 1].indentation - branch[k].indentation);
  return error;
}

/// Finds the largest tension at the positions of the unloading, and how much larger it may be
/// between them. pressure_of_residual: error of the mean pressure, Pa, of a state with residual 1.
void measure_pull_off(AdhesiveCycle& cycle, double pressure_of_residual) {
  const auto& branch = cycle.unloading;
  const auto largest = std::ranges::min_element(branch, {}, &AdhesiveContactState::mean_pressure);
  if (!(largest->mean_pressure < 0)) {
    // Only a tension has a maximum to come off at.
    cycle.pull_off_pressure = cycle.pull_off_error = 0;
    return;
  }
  if (largest == branch.begin() || largest == branch.end() - 1) return;
  const std::ptrdiff_t at = largest - branch.begin(), last = std::ssize(branch) - 1;
  const auto tension = [&](std::ptrdiff_t k) { return -branch[std::size_t(k)].mean_pressure; };
  const auto distance = [&](std::ptrdiff_t k) {  // outward from the closest position
    return branch.front().indentation - branch[std::size_t(k)].indentation;
  };
  const auto slope = [&](std::ptrdiff_t k) {  // from position k to the next
    return k < 0 || k >= last ? 0 : (tension(k + 1) - tension(k)) / (distance(k + 1) - distance(k));
  };
  // A fall that is much steeper than the changes beside it is a snap.
  constexpr double steeper = 3;
  const bool snaps = -slope(at) > steeper * std::max(slope(at - 1), -slope(at + 1));
  // Highest point of the lines from both sides into the step from k to k + 1.
  const auto bound = [&](std::ptrdiff_t k, double rise, double fall) {
    const double step = distance(k + 1) - distance(k);
    const double meet = (tension(k + 1) - tension(k) - fall * step) / (rise - fall);
    return tension(k) + rise * std::clamp(meet, 0.0, step);
  };
  double most = tension(at);
  if (snaps) {
    most += slope(at - 1) * (distance(at + 1) - distance(at));
  } else {
    most = std::max(most, bound(at, slope(at - 1), at + 2 <= last ? slope(at + 1) : slope(at)));
    // Without a position before it, the step before has only the line from outside.
    most = std::max(most, at >= 2 ? bound(at - 1, slope(at - 2), slope(at))
                                  : tension(at) - slope(at) * (distance(at) - distance(at - 1)));
  }
  cycle.pull_off_pressure = tension(at);
  cycle.pull_off_error = most - tension(at) + pressure_of_residual * largest->adhesion_residual;
}

/// Evaluates the closed cycle: its work, its reversible amplitude and their errors.
/// force_of_residual: error of the force, N, of a state with residual 1, whose tension is wrong
/// everywhere by one unit of the tolerance.
void measure(AdhesiveCycle& cycle, double force_of_residual) {
  const auto force = [](const AdhesiveContactState& state) { return std::abs(state.force); };
  double largest = force(std::ranges::max(cycle.loading, {}, force));
  largest = std::max(largest, force(std::ranges::max(cycle.unloading, {}, force)));
  const std::size_t last = cycle.loading.size() - 1;
  const auto distance_to = [&](std::size_t k) {
    return (cycle.loading[last].indentation - cycle.loading[k].indentation) / 2;
  };
  // Deep contacts have loads of many times the maximum pull, so the threshold for a difference of
  // the branches is relative to the pull.
  const double pull = -std::ranges::min(cycle.unloading, {}, &AdhesiveContactState::force).force;
  const double seen = meets * (pull > 0 ? pull : largest);
  for (std::size_t k = last; k-- > 0;)
    if (std::abs(cycle.loading[k].force - cycle.unloading[last - k].force) > seen) {
      cycle.reversible_amplitude = distance_to(k + 1);
      cycle.reversible_amplitude_error = distance_to(k) - distance_to(k + 1);
      break;
    }
  const double open = cycle.loading.front().force - cycle.unloading.back().force;
  if (std::abs(open) > meets * largest) return;
  const auto work = [&](std::size_t stride) {
    return work_along(cycle.loading, stride) + work_along(cycle.unloading, stride);
  };
  cycle.adhesion_work_per_cycle = work(1);
  cycle.adhesion_work_error = std::abs(work(1) - work(2)) + error_of_snaps(cycle) +
                              error_of_tolerance(cycle.loading, force_of_residual) +
                              error_of_tolerance(cycle.unloading, force_of_residual);
}

}  // namespace

std::optional<bool> AdhesiveCycleNumbers::reversible() const {
  if (std::isnan(adhesion_work_per_cycle) && std::isnan(reversible_amplitude)) return {};
  return std::isnan(reversible_amplitude);
}

bool AdhesiveCycle::converged() const {
  const auto all = [](const auto& branch) {
    return std::ranges::all_of(branch, &AdhesiveContactState::converged);
  };
  return all(loading) && all(unloading);
}

AdhesiveCycle adhesive_cycle(const Surface& surface, const Body& body,
                             const std::vector<OperatingPoint>& points, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options) {
  require_that(!points.empty(), "positions", "not given; give at least one");
  AdhesiveCycle cycle;
  CycleRun run(surface, body, adhesion, options);
  for (const OperatingPoint& point : points)
    if (!run.press_at(point, false, cycle.loading)) return cycle;
  if (!options.unload) return cycle;
  cycle.unloading.push_back(cycle.loading.back());
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point)
    if (!run.press_at(*point, true, cycle.unloading)) return cycle;
  const OperatingPoint& loosest = points.front();
  if (loosest.load_given()) {
    const bool by_force = loosest.control == ControlQuantity::normal_force;
    const double load = by_force ? loosest.value / surface.grid.area() : loosest.value;
    run.pull_off(std::max(std::abs(load) / 4, 1e-3 * adhesion.max_tension()), cycle);
    return cycle;
  }
  const double reference = detail::adhesion_reference(surface, body, adhesion);
  measure_pull_off(cycle, reference);
  measure(cycle, surface.grid.area() * reference);
  return cycle;
}

AdhesiveCycle adhesive_cycle(const Surface& surface, double contact_modulus,
                             const std::vector<OperatingPoint>& points, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options) {
  return adhesive_cycle(surface, Material::of_contact_modulus(contact_modulus), points, adhesion,
                        options);
}

}  // namespace salebra
