// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>

namespace salebra {

/// Numerical error of a loss, divided by cause, J. The error of a cause that was not examined is
/// NaN, and total() is then NaN too.
struct ErrorBudget {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double cells = unknown;      ///< discretisation: change of the loss on cells of another size
  double noise = unknown;      ///< from cells and patches entering singly: 1.8 standard deviations
  double intervals = unknown;  ///< change of the loss with half as many intervals
  /// Change if K_t/((G*/E*)K) is linear in ln F. With slip on a body that is not a half-space also
  /// |m| times the loss for K_t/K ∝ F^m, as springs slip by Coulomb's law only where m = 0.
  double stiffness_ratio = unknown;
  double seam = 0;          ///< from continuing a scan periodically; 0: not estimated
  double solver = unknown;  ///< from the tolerance of the contact solver
  /// Change of the loss if the force law continues exponentially below the lowest solved load; 0
  /// if no part of the motion lies there.
  double first_touch = 0;

  /// Square root of the sum of squares of the errors of all causes, J.
  double total() const {
    return std::sqrt(cells * cells + noise * noise + intervals * intervals +
                     stiffness_ratio * stiffness_ratio + seam * seam + solver * solver +
                     first_touch * first_touch);
  }
};

constexpr void describe(auto&& visit, std::type_identity<ErrorBudget>) {
  using enum Dimension;
  using S = ErrorBudget;
  visit(&S::cells, Quantity{"cell_error", energy, "error of work_per_cycle by the size of cells"});
  visit(&S::noise, Quantity{"noise_error", energy,
                            "error of work_per_cycle by cells and patches that enter singly"});
  visit(&S::intervals, Quantity{"interval_error", energy,
                                "error of work_per_cycle by the intervals of the oscillation"});
  visit(&S::stiffness_ratio,
        Quantity{"ratio_error", energy, "error of work_per_cycle by the ratio of stiffnesses"});
  visit(&S::seam, Quantity{"seam_error", energy, "error of work_per_cycle by the seam of a scan"});
  visit(&S::solver,
        Quantity{"solver_error", energy, "error of work_per_cycle by the solver's tolerance"});
  visit(&S::first_touch,
        Quantity{"first_touch_error", energy,
                 "error of work_per_cycle by the part of the motion below the lowest load"});
}

/// Energy that a contact loses in a cycle of a motion, and the damping constant γ = P/⟨ẋ²⟩ (mean
/// dissipated power over mean square tangential velocity). Unknown numbers are NaN.
///
///     double relative_error = loss.damping_constant_error() / loss.damping_constant;
///
/// `work_per_cycle` and `damping_constant` describe the motion as the user described it: with slip
/// if a coefficient of friction is known, without slip if none is given, which means an infinite
/// one. The numbers without slip always have `_without_slip` in their names.
struct Loss {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double work_per_cycle = unknown;                 ///< W, J
  double damping_constant = unknown;               ///< γ, N s/m
  double work_per_cycle_without_slip = unknown;    ///< J
  double damping_constant_without_slip = unknown;  ///< N s/m
  double relaxation_work = unknown;  ///< part of W by springs that open and close, J; NaN without μ
  double slip_work = unknown;        ///< part of W by springs that stay closed, J; NaN without μ
  ErrorBudget error = {};            ///< of work_per_cycle
  ErrorBudget error_without_slip = {};  ///< of work_per_cycle_without_slip
  double damping_per_work = unknown;    ///< damping constant of a loss of 1 J, N s/m

  double work_per_cycle_error() const { return error.total(); }
  double damping_constant_error() const { return error.total() * damping_per_work; }
  double damping_constant_without_slip_error() const {
    return error_without_slip.total() * damping_per_work;
  }
  /// Computes the damping constants γ = P/⟨ẋ²⟩ from the losses per cycle, with ⟨ẋ²⟩ = v² for a Drag
  /// and (u_x ω)²/2 for an EqualFrequency; NaN if ω is unknown.
  void set_damping_constants(const Oscillation& motion);
  /// Sets the loss to NaN if its error is not smaller than its magnitude, and likewise the loss
  /// without slip; the errors stay.
  void drop_uncertain();
  /// Sets the loss and its parts to NaN; the numbers without slip stay.
  void forget();
  double relaxation_share() const { return relaxation_work / work_per_cycle; }
  double slip_share() const { return slip_work / work_per_cycle; }
};

constexpr void describe(auto&& visit, std::type_identity<Loss>) {
  using enum Dimension;
  using S = Loss;
  visit(&S::work_per_cycle, Extensive{quantity::work_per_cycle});
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::work_per_cycle_without_slip, WhereKnown{"work_per_cycle_without_slip", energy,
                                                    "energy dissipated in a cycle without slip"});
  visit(&S::damping_constant_without_slip, WhereKnown{quantity::damping_constant_without_slip});
  visit(&S::relaxation_work, WhereKnown{quantity::relaxation_work});
  visit(&S::slip_work, WhereKnown{quantity::slip_work});
  visit(&S::error, Kept{"error", "numerical error of work_per_cycle by its causes"});
  visit(&S::error_without_slip,
        Kept{"error_without_slip", "numerical error of work_per_cycle_without_slip by its causes"});
  visit(&S::damping_per_work, Kept{});
  visit(&S::work_per_cycle_error, WhereKnown{quantity::work_per_cycle_error});
  visit(&S::damping_constant_error, WhereKnown{quantity::damping_constant_error});
  visit(&S::damping_constant_without_slip_error,
        WhereKnown{"damping_constant_without_slip_error", damping,
                   "numerical error of the damping constant without slip"});
  visit(&S::relaxation_share, WhereKnown{quantity::relaxation_share});
  visit(&S::slip_share, WhereKnown{quantity::slip_share});
}

}  // namespace salebra
