// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

namespace salebra {

struct TrajectoryDampingOptions {
  double friction_coefficient =
      std::numeric_limits<double>::infinity();  ///< μ; infinite: full stick
};

/// Steady state of a contact under a periodic motion.
struct TrajectoryDamping {
  double work_per_cycle = 0;  ///< energy lost per period, J
  double relaxation_work =
      0;                 ///< of it, by levels that open and close (all of it in full stick), J
  double slip_work = 0;  ///< of it, by levels in permanent contact: slip of Cattaneo and Mindlin, J
  double power = 0;      ///< W per period, W
  double damping_constant = 0;  ///< γ = P/⟨ẋ²⟩, N s/m; NaN for a motion without ẋ
  /// Part of F_x in phase with x: ⟨F_x(x − ⟨x⟩)⟩/⟨(x − ⟨x⟩)²⟩ over a period, N/m; NaN for a motion with drift or
  /// without x.
  double storage_stiffness = 0;
  double loss_factor =
      0;  ///< W/(2π · storage_stiffness · ⟨(x − ⟨x⟩)²⟩), W/(2πU) of a harmonic motion; NaN as storage_stiffness
  /// At the samples of the trajectory, in its order: the loop is (displacement, tangential_force).
  std::vector<double>
      tangential_force;  ///< F_x, N; with drift without the permanent levels' share, which grows for
                         ///< ever in full stick
  std::vector<double> dissipated;  ///< energy lost since the first sample, J
  std::size_t memory = 0;          ///< most pieces of history held at a time
};

/// Steady state of a periodic trajectory, by a TangentialContact. Without drift it is reached in the second period. With drift and friction
/// the contact slides: a period that begins with every level at the limit of its stretch where δ is least makes the next one steady (docs/theory.md,
/// section 8). Exact for the straight steps of the trajectory; a sampled harmonic motion is met at second order in its step. Throws InvalidInput for a trajectory
/// that is not valid or leaves the law's range, and for friction < 0. Cost: O(samples).
TrajectoryDamping trajectory_damping(const ContactLaw& law, const SampledMotion& trajectory,
                                     const TrajectoryDampingOptions& options = {});

}  // namespace salebra
