// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/premises.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Whether the damping of a study may be used, at each of its pressures, and what friction makes of
/// it. By the mean curve of the boundary elements: gap, area and stiffnesses averaged over the
/// surfaces at each pressure.
struct StudyPremises {
  std::vector<Premises> premises;  ///< for each pressure
  /// The loss at each pressure; unknown without a coefficient of friction. The curve is
  /// interpolated between pressures and gives only the ratio of the losses with slip and without:
  /// they are times what makes full_stick_work the W of StudyResult::stated_damping().
  std::vector<LossWithSlip> losses;
  std::vector<double> damping_constant_with_slip;  ///< P/⟨ẋ²⟩ of the losses, N s/m

  std::vector<double> work_per_cycle_with_slip() const;  ///< of the losses, J
};

constexpr void describe(auto&& visit, std::type_identity<StudyPremises>) {
  using enum Dimension;
  using S = StudyPremises;
  visit(&S::premises, Kept{"premises", "premises at each pressure"});
  visit(&S::losses, Kept{"losses", "loss with slip at each pressure"});
  visit(&S::work_per_cycle_with_slip,
        Quantity{"work_per_cycle_with_slip", energy, "energy dissipated in a cycle with friction"});
  visit(&S::damping_constant_with_slip,
        Quantity{"damping_constant_with_slip", damping, "damping constant P/v^2 with friction"});
}

/// Facts: those of the configuration, and of the surfaces their side, mean contact pressure and rms
/// slope. Where no contact converged, and everywhere where fewer than four pressures make no curve,
/// the premises are unknown.
/// Throws InvalidInput for a hardness below the largest pressure.
/// Cost: 10 ms for each pressure.
StudyPremises premises_of(const StudyResult& result);

/// "no slip at 1 MPa to 5 MPa, sliding at 20 MPa", one for each run of pressures; empty where no
/// regime is known.
std::string regimes(const StudyPremises& found, const std::vector<double>& pressures);

}  // namespace salebra
