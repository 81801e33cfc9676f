// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Result of a study for its motion at each of its pressures, and the validity of the result. The
/// assumptions are checked for the mean curve of the boundary elements, in which gap, area and
/// stiffnesses are averaged over the surfaces at each pressure.
struct StudySolution {
  std::vector<double> pressures = {};  ///< nominal pressures, Pa
  /// StudyResult::stated() of the boundary elements: damping constant and loss of the motion as
  /// described, and the damping constant without slip. The loss is NaN if the text `unknown` gives
  /// a reason.
  std::vector<StatedMean> damping_constant = {};               ///< γ = P/⟨ẋ²⟩, N s/m
  std::vector<StatedMean> work_per_cycle = {};                 ///< W, J
  std::vector<StatedMean> damping_constant_without_slip = {};  ///< N s/m
  /// Fractions of work_per_cycle lost by springs that open and close, and by slip of springs that
  /// stay closed; NaN if slip is not computed.
  std::vector<double> relaxation_share = {}, slip_share = {};
  /// Conductance of the boundary elements per nominal area, W/(m² K) and S/m²; empty if the
  /// configuration does not request it.
  std::vector<EnsembleMean> thermal_conductance = {}, electrical_conductance = {};
  double direction = ForceSample::unknown;  ///< StudyResult::direction(), rad
  bool slip_followed = false;               ///< true: the coefficient of friction is known
  std::string unknown = {};  ///< text of why_loss_unknown(); empty: the loss is known
  std::vector<Assumptions> assumptions = {};
  std::vector<AssumptionVerdict> verdicts = {};  ///< worst first
  Validity validity = Validity::not_checked;

  /// Whether damping_constant includes slip.
  bool slips() const { return slip_followed && unknown.empty(); }
};

constexpr void describe(auto&& visit, std::type_identity<StudySolution>) {
  using S = StudySolution;
  visit(&S::pressures, Kept{"pressures", "nominal pressures", Dimension::pressure});
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::damping_constant_without_slip, quantity::damping_constant_without_slip);
  visit(&S::relaxation_share, Kept{"relaxation_share", "parts by springs that open and close"});
  visit(&S::slip_share, Kept{"slip_share", "parts by slip in permanent contact"});
  visit(&S::thermal_conductance, Quantity{"thermal_conductance", Dimension::thermal_conductance,
                                          "thermal conductance over nominal area"});
  visit(&S::electrical_conductance,
        Quantity{"electrical_conductance", Dimension::conductance_per_area,
                 "electrical conductance over nominal area"});
  visit(&S::direction, Kept{quantity::direction.name, quantity::direction.long_name,
                            quantity::direction.dimension});
  visit(&S::slip_followed, Kept{"slip_followed", "whether the coefficient of friction is known"});
  visit(&S::unknown, Kept{"unknown", "why the loss is unknown; empty: it is known"});
  visit(&S::assumptions, Kept{"assumptions", "assumptions at each pressure"});
  visit(&S::verdicts, Kept{"verdicts", "assumptions in words, worst first"});
  visit(&S::validity, Kept{"validity", "one word for all verdicts"});
}

/// Evaluates the result of a study for its motion.
///
///     StudySolution solution = solution_of(run_study(study));
///
/// The contact parameters come from the configuration and, for the side of the surface, the mean
/// contact pressure and the rms slope, from the surfaces. The assumptions are unknown at pressures
/// at which no contact converged, and at all pressures if there are fewer than four, too few for a
/// curve. Throws InvalidInput for a hardness below the largest pressure.
/// Cost: 10 ms for each pressure.
StudySolution solution_of(const StudyResult& result);

/// Returns the number of surfaces needed at each pressure for a 95 % interval of the mean damping
/// constant of ±precision (relative). It is estimated from the n surfaces of the study: n·(half the
/// width of their interval/(precision·mean))², at least 2. The relative error of the estimate is at
/// least √(2/(n − 1)), that of a variance of n surfaces. NaN without an interval. Throws
/// InvalidInput for a precision that is not > 0.
std::vector<double> surfaces_for(const StudyResult& result, double precision);

}  // namespace salebra
