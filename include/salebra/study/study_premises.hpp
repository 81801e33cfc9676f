// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/premises.hpp>
#include <salebra/study/study.hpp>
#include <vector>

namespace salebra {

/// Whether the damping of a study may be used, at each of its pressures, and what friction makes of it. Of the mean curve of the
/// boundary elements: gap, area and stiffnesses averaged over the surfaces at each pressure.
struct StudyPremises {
  std::vector<Premises> premises;  ///< for each pressure
  /// For each pressure; unknown without a coefficient of friction.
  std::vector<LossWithSlip> losses;
  /// P/⟨ẋ²⟩ of the losses, N s/m. The curve is interpolated between the pressures: compare it with no damping constant that is not.
  std::vector<double> damping_constant_with_slip;
};

/// Facts: those of the configuration, and of the surfaces their side, mean contact pressure and rms slope. Where no contact converged,
/// and everywhere where fewer than four pressures make no curve, the premises are unknown.
/// Throws InvalidInput for a hardness below the largest pressure.
/// Cost: 10 ms for each pressure.
StudyPremises premises_of(const StudyResult& result);

}  // namespace salebra
