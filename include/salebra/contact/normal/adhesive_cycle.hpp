// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <vector>

namespace salebra {

struct AdhesiveCycleOptions {
  AdhesiveContactOptions contact = {};  ///< its start_tension starts the loading
  bool unload = false;                  ///< true: unloads after loading, for a full cycle
  /// Called with each state, including its fields, as soon as it has converged.
  std::function<void(bool unloading, const AdhesiveContactState&)> on_state = {};
};

/// Results of a cycle of adhesive contacts; NaN if unknown.
struct AdhesiveCycleNumbers {
  /// Pull-off pressure, Pa, >= 0: the largest mean tension at the positions of the unloading. NaN
  /// without unloading, if the largest tension occurs at the closest position, because then the
  /// loading did not bring the surfaces close enough, and if it occurs at the outermost position,
  /// because then the surfaces have not come off.
  double pull_off_pressure = std::numeric_limits<double>::quiet_NaN();
  /// How much larger the tension may be between the positions, Pa. In load control the pull-off lies
  /// between pull_off_pressure and pull_off_pressure + pull_off_error, by bisection. Otherwise the
  /// tension beside its maximum lies below the straight lines through two positions on either side,
  /// as that of every concave curve, and the error is the height of the point where these lines meet;
  /// if the surfaces snap apart behind the position of the largest tension, the tension may rise
  /// until the next position as it did before.
  double pull_off_error = std::numeric_limits<double>::quiet_NaN();
  /// Energy lost in a cycle between the outermost and the closest position, ∮F dδ, J. NaN in load
  /// control, where separated surfaces move apart without limit, and if the branches do not meet at
  /// the outermost position.
  double adhesion_work_per_cycle = std::numeric_limits<double>::quiet_NaN();
  /// Error of adhesion_work_per_cycle, J, the sum of three parts: its change when every other
  /// position is omitted; the work that two snaps (into and out of contact) between positions may
  /// add; and the effect of an error of the tension equal to the residual in every cell.
  double adhesion_work_error = std::numeric_limits<double>::quiet_NaN();
  /// Half the distance, from the closest position outward, over which unloading retraces loading,
  /// m: an oscillation within this distance has no hysteresis. The value is thus the largest
  /// amplitude of such an oscillation. NaN if no hysteresis is seen at all, and in load control.
  double reversible_amplitude = std::numeric_limits<double>::quiet_NaN();
  /// Error of reversible_amplitude due to the spacing of the positions, m: one position further
  /// out, the forces of loading and unloading differ by more than 1e-3 of the largest pull.
  double reversible_amplitude_error = std::numeric_limits<double>::quiet_NaN();

  /// True if loading and unloading have the same forces at all positions, to 1e-3 of the largest
  /// pull; empty in load control.
  std::optional<bool> reversible() const;
};

constexpr void describe(auto&& visit, std::type_identity<AdhesiveCycleNumbers>) {
  using enum Dimension;
  using S = AdhesiveCycleNumbers;
  visit(&S::pull_off_pressure,
        Quantity{"pull_off_pressure", pressure, "mean tension at which the surfaces come off"});
  visit(&S::pull_off_error, Quantity{"pull_off_error", pressure,
                                     "error of the pull-off pressure by the steps between "
                                     "positions"});
  visit(&S::adhesion_work_per_cycle,
        Quantity{"adhesion_work_per_cycle", energy, "energy that adhesion loses in a cycle"});
  visit(&S::adhesion_work_error,
        Quantity{"adhesion_work_error", energy,
                 "error of the adhesion work by the steps between positions"});
  visit(&S::reversible_amplitude,
        Quantity{"reversible_amplitude", length,
                 "amplitude out of the closest position below which no hysteresis is seen"});
  visit(&S::reversible_amplitude_error,
        Quantity{"reversible_amplitude_error", length,
                 "by which larger an amplitude hysteresis is seen at"});
  visit(&S::reversible,
        Quantity{"reversible", dimensionless, "whether unloading retraces loading"});
}

/// A sequence of contacts, each started from the previous one. A state that did not converge is the
/// last of its branch and ends the cycle.
struct AdhesiveCycle : AdhesiveCycleNumbers {
  std::vector<AdhesiveContactState>
      loading;  ///< states without fields, in the order of the positions
  std::vector<AdhesiveContactState>
      unloading;  ///< states without fields, from the closest position outward

  bool converged() const;
};

constexpr void describe(auto&& visit, std::type_identity<AdhesiveCycle>) {
  using S = AdhesiveCycle;
  describe(visit, std::type_identity<AdhesiveCycleNumbers>{});
  visit(&S::loading, Kept{"loading", "states from the outermost position to the closest"});
  visit(&S::unloading, Kept{"unloading", "states from the closest position outward"});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
}

/// Presses a surface from position to position and, with `unload`, separates it through the same
/// positions in reverse order:
///     const AdhesiveCycle cycle = adhesive_cycle(
///         surface, 1e9, {at_pressure(1e5), at_pressure(1e6)}, adhesion, {.unload = true});
/// In load control the unloading then pulls: the load doubles from step to step until the surfaces
/// separate, and bisection finds the pull-off to 2 %, which pull_off_error states. At given mean gaps and indentations, states
/// beyond the minimum of the force are reached.
/// points     positions, all with the same control quantity, from the loosest to the closest
/// throws     InvalidInput, before any computation, wherever press_adhesive() does
/// cost       one press_adhesive() per position
AdhesiveCycle adhesive_cycle(const Surface& surface, double contact_modulus,
                             const std::vector<OperatingPoint>& points, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options = {});
/// On any body, as press_adhesive().
AdhesiveCycle adhesive_cycle(const Surface& surface, const Body& body,
                             const std::vector<OperatingPoint>& points, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options = {});

}  // namespace salebra
