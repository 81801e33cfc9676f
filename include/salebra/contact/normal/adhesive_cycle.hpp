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
  AdhesiveContactOptions contact = {};  ///< loading starts from its start_tension
  bool unload = false;                  ///< also unloads, for a full cycle
  /// Called with each state, including its fields, as soon as it has converged.
  std::function<void(bool unloading, const AdhesiveContactState&)> on_state = {};
};

/// Results of a cycle of adhesive contacts; NaN if unknown.
struct AdhesiveCycleNumbers {
  /// Pull-off pressure, Pa, >= 0: the largest mean tension during unloading. NaN without unloading,
  /// and if the closest position has it, because loading did not go close enough.
  double pull_off_pressure = std::numeric_limits<double>::quiet_NaN();
  /// Energy lost in a cycle between the outermost and the closest position, ∮F dδ, J. NaN in load
  /// control, where separated surfaces move apart without limit, and if the branches do not meet at
  /// the outermost position.
  double adhesion_work_per_cycle = std::numeric_limits<double>::quiet_NaN();
  /// Error of the work, J: its change when every other position is omitted, plus what two snaps
  /// between positions may add, plus the effect of tensions that are wrong everywhere by the
  /// residual.
  double adhesion_work_error = std::numeric_limits<double>::quiet_NaN();
  /// Half the distance, from the closest position outward, over which unloading retraces loading,
  /// m: an oscillation there with a smaller amplitude has no hysteresis. NaN if no hysteresis is
  /// seen at all, and in load control.
  double reversible_amplitude = std::numeric_limits<double>::quiet_NaN();
  /// Error of the amplitude, m: one position further out the forces differ by more than 1e-3 of the
  /// largest pull.
  double reversible_amplitude_error = std::numeric_limits<double>::quiet_NaN();

  /// True if both branches have the same forces at all positions, to 1e-3 of the largest pull;
  /// empty in load control.
  std::optional<bool> reversible() const;
};

constexpr void describe(auto&& visit, std::type_identity<AdhesiveCycleNumbers>) {
  using enum Dimension;
  using S = AdhesiveCycleNumbers;
  visit(&S::pull_off_pressure,
        Quantity{"pull_off_pressure", pressure, "mean tension at which the surfaces come off"});
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
  std::vector<AdhesiveContactState> loading;    ///< without fields
  std::vector<AdhesiveContactState> unloading;  ///< from the closest position outward

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
/// ones:
///     const AdhesiveCycle cycle = adhesive_cycle(
///         surface, 1e9, {at_pressure(1e5), at_pressure(1e6)}, adhesion, {.unload = true});
/// In load control the unloading then pulls: the load doubles from step to step until the surfaces
/// separate, and bisection finds the pull-off to 2 %. At given mean gaps and indentations, states
/// beyond the minimum of the force are reached.
/// points     all with one control quantity, from the loosest to the closest
/// throws     InvalidInput before any work, as press_adhesive()
/// cost       one press_adhesive() per position
AdhesiveCycle adhesive_cycle(const Surface& surface, double contact_modulus,
                             const std::vector<OperatingPoint>& points, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options = {});

}  // namespace salebra
