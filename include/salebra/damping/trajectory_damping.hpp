// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <salebra/damping/loss.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <span>
#include <vector>

namespace salebra {

struct TrajectoryDampingOptions {
  double friction_coefficient =
      std::numeric_limits<double>::infinity();  ///< μ; infinite: full stick
  Progress on_progress = {};                    ///< a stop throws Interrupted
};

/// Steady state of a contact under a periodic motion.
struct TrajectoryDamping {
  double work_per_cycle = 0;  ///< energy lost per period, J
  double work_per_cycle_error() const { return error.total(); }
  /// Part of work_per_cycle lost by springs that open and close (all of it in full stick), J.
  double relaxation_work = 0;
  /// Part of work_per_cycle lost by springs in permanent contact, J: the slip loss of Cattaneo and
  /// Mindlin.
  double slip_work = 0;
  /// Errors of work_per_cycle by the samples of a table; unknown for other laws. The steps of the
  /// trajectory are taken as exact.
  ErrorBudget error = {};
  double power = 0;             ///< work_per_cycle divided by the period, W
  double damping_constant = 0;  ///< γ = P/⟨ẋ²⟩, N s/m; NaN for a motion without ẋ
  /// Part of F_x in phase with x: ⟨F_x(x − ⟨x⟩)⟩/⟨(x − ⟨x⟩)²⟩ over a period, N/m; NaN for a motion
  /// with drift or without tangential displacement.
  double storage_stiffness = 0;
  /// work_per_cycle/(2π · storage_stiffness · ⟨(x − ⟨x⟩)²⟩); for a harmonic motion this is W/(2πU)
  /// with the largest stored energy U. NaN if storage_stiffness is NaN.
  double loss_factor = 0;
  /// F_x at each sample of the trajectory, N; plotted over SampledMotion::displacement it is the
  /// friction loop. Springs that never separate or slip are taken as free of stress in the middle
  /// of a periodic motion. With drift, the force of these springs would grow without bound in full
  /// stick and is left out.
  std::vector<double> tangential_force;
  std::vector<double> transverse_force;  ///< F_y at each sample, N; empty without motion along y
  std::vector<double> dissipated;        ///< energy lost up to each sample, J
  std::size_t memory = 0;                ///< largest number of pieces of the stored history
};

constexpr void describe(auto&& visit, std::type_identity<TrajectoryDamping>) {
  using enum Dimension;
  using S = TrajectoryDamping;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::slip_work, quantity::slip_work);
  visit(&S::error, Kept{"error", "error of work_per_cycle by the samples of a table"});
  visit(&S::work_per_cycle_error, WhereKnown{quantity::work_per_cycle_error});
  visit(&S::power, quantity::power);
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::storage_stiffness, quantity::storage_stiffness);
  visit(&S::loss_factor, quantity::loss_factor);
  visit(&S::tangential_force, quantity::tangential_force);
  visit(&S::transverse_force, Quantity{"transverse_force", force, "tangential force along y"});
  visit(&S::dissipated, quantity::dissipated);
  visit(&S::memory, Kept{"memory", "most pieces of history held at a time"});
}

/// Computes the steady state of a periodic trajectory with a TangentialContact.
///
///     TrajectoryDamping loss = trajectory_damping(law, sample(motion, 1e-8, 2000));
///
/// Without drift the steady state is reached in the second period. With drift and finite friction
/// the contact slides: the first period starts, at the smallest δ, with every spring at its stretch
/// limit, and the second period is steady (docs/theory.md, section 8). The result is exact for the
/// straight steps of the trajectory, and of second order in the step for a sampled harmonic motion.
/// Throws InvalidInput for a trajectory that fails SampledMotion::validate() or leaves the range of
/// the law, for a table whose loss comes from springs below its lowest sample, and for a friction
/// coefficient < 0. Cost: O(samples).
TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& trajectory,
                                     const TrajectoryDampingOptions& options = {});

/// Computes the steady state in full stick for a motion in two tangential directions: x of the
/// trajectory, and y = transverse. The stretch s of a released spring is then a vector, and
/// ½K_t'|s|² per depth is lost, i.e. the sum of the losses of motion along x and along y; K_t must
/// be the same in all directions. The damping constant is P/⟨ẋ² + ẏ²⟩, and the storage stiffness
/// uses F_x x + F_y y and x² + y². Finite friction is not supported.
/// transverse   y at the samples, m; its last value may differ from the first (drift). Throws
///              InvalidInput unless there is one finite value per sample.
TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& trajectory,
                                     std::span<const double> transverse);

}  // namespace salebra
