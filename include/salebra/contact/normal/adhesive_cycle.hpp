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
  AdhesiveContactOptions contact = {};  ///< its start_tension begins the loading
  bool unload = false;                  ///< draws the surfaces off again: a cycle
  /// Called with each state as soon as it has converged, with its fields.
  std::function<void(bool unloading, const AdhesiveContactState&)> on_state = {};
};

/// What a cycle of adhesive contacts comes to; NaN where it is not known.
struct AdhesiveCycleNumbers {
  /// Largest mean tension of unloading, Pa: that at which the surfaces come off, >= 0; NaN of no
  /// cycle, and where the closest position has it, which is not close enough.
  double pull_off_pressure = std::numeric_limits<double>::quiet_NaN();
  /// ∮F dδ, J, the energy that a cycle between its outermost and its closest position loses; NaN
  /// under given loads, where surfaces that come off part without end, and where both branches do
  /// not meet at the outermost position.
  double adhesion_work_per_cycle = std::numeric_limits<double>::quiet_NaN();
  /// What it changes by without every other position, what two snaps somewhere between positions may
  /// add, and what tensions do that are wrong everywhere by the residual, J.
  double adhesion_work_error = std::numeric_limits<double>::quiet_NaN();
  /// Half of the way out of the closest position on which unloading retraces loading, m: an
  /// oscillation there of a smaller amplitude passes the same states in and out. NaN where no
  /// hysteresis is seen at all, and under given loads.
  double reversible_amplitude = std::numeric_limits<double>::quiet_NaN();
  /// One position more, and the forces differ by more than 1e-3 of the largest pull, m.
  double reversible_amplitude_error = std::numeric_limits<double>::quiet_NaN();

  /// Whether the forces of both branches are the same at all positions, to 1e-3 of the largest pull;
  /// unknown under given loads.
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

/// Contacts each of which follows from the one before. A state that did not converge is the last of
/// its branch, and ends the cycle.
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

/// Presses a surface from position to position and, of a cycle, draws it off through the same ones.
/// Under pressures or forces the unloading then pulls: by twice as much from step to step until the
/// surfaces part, and between by bisection until the pull-off is known to 2 %. At given mean gaps and
/// indentations the force passes its minimum.
/// positions  of one kind, from the loosest to the closest
/// throws     InvalidInput before any work, as press_adhesive()
/// cost       press_adhesive() for each position
AdhesiveCycle adhesive_cycle(const Surface& surface, double contact_modulus,
                             const std::vector<Target>& positions, const Adhesion& adhesion,
                             const AdhesiveCycleOptions& options = {});

}  // namespace salebra
