// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
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
  double relaxation_work =
      0;                 ///< part of it by springs that open and close (all of it in full stick), J
  double slip_work = 0;  ///< part of it by springs in permanent contact: slip of Cattaneo and
                         ///< Mindlin, J
  double power = 0;      ///< W per period, W
  double damping_constant = 0;  ///< γ = P/⟨ẋ²⟩, N s/m; NaN for a motion without ẋ
  /// Part of F_x in phase with x: ⟨F_x(x − ⟨x⟩)⟩/⟨(x − ⟨x⟩)²⟩ over a period, N/m; NaN for a motion
  /// with drift or without x.
  double storage_stiffness = 0;
  double loss_factor =
      0;  ///< W/(2π · storage_stiffness · ⟨(x − ⟨x⟩)²⟩), W/(2πU) of a harmonic motion; NaN as
  ///< storage_stiffness
  /// These columns have one entry per sample of the trajectory; the loop is (displacement,
  /// tangential_force).
  /// F_x, N. Springs that never separate or slip are free of stress in the middle of a periodic
  /// motion; with drift their force, which grows without bound in full stick, is left out.
  std::vector<double> tangential_force;
  std::vector<double> transverse_force;  ///< F_y, N, likewise; empty without motion along y
  std::vector<double> dissipated;        ///< energy lost since the first sample, J
  std::size_t memory = 0;                ///< maximum number of history pieces
};

constexpr void describe(auto&& visit, std::type_identity<TrajectoryDamping>) {
  using enum Dimension;
  using S = TrajectoryDamping;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::slip_work, quantity::slip_work);
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
/// Without drift it is reached in the second period. With drift and friction the contact slides:
/// after a period that begins, at the smallest δ, with every spring at its stretch limit the next
/// one is steady (docs/theory.md, section 8). The result is exact for the straight steps of the
/// trajectory, and of second order in the step for a sampled harmonic motion.
/// Throws InvalidInput for a trajectory that is not valid or leaves the law's range, and for
/// friction < 0. Cost: O(samples).
TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& trajectory,
                                     const TrajectoryDampingOptions& options = {});

/// The same in full stick for a motion in two tangential directions, x of the trajectory and y. The
/// stretch s of a released spring is a vector, and ½K_t'|s|² is lost: the sum of the losses of both
/// directions, for a law whose K_t is the same in all of them. Means are those of the vectors: the
/// damping constant is P/⟨ẋ² + ẏ²⟩, the storage stiffness that of F_x x + F_y y. Friction, whose
/// slip limit would be one of |s|, is not supported here.
/// transverse   y at the samples, m, which may advance over the period. Throws InvalidInput unless
///              there is one finite value per sample.
TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& trajectory,
                                     std::span<const double> transverse);

}  // namespace salebra
