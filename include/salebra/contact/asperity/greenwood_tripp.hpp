// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

/// Contact of two rough sides: Greenwood and Tripp (1970). Summits of radii R1 and R2 whose axes
/// lie r apart interfere by w = z − s − r²/(2(R1+R2)), z the sum of their heights, and carry
/// Hertz's force with R = R1R2/(R1+R2); the tilt of the contacts is neglected. Over all pairs,
/// positions independent and z Gaussian with σ² = σ1² + σ2², M_n = ∫(z−s)^n φ:
///     N = 2π(R1+R2)η1η2A0 M_1,   A_c = π²R1R2η1η2A0 M_2,   F = (4/3)E*√R·(2/5)·2π(R1+R2)η1η2A0 M_{5/2},
/// K and F'' its derivatives. s is the distance between the mean planes of the two sides' summits.
class GreenwoodTripp final : public AsperityModel {
 public:
  /// Throws InvalidInput unless density, radius and summit_rms of both sides are > 0 and both are
  /// Gaussian.
  GreenwoodTripp(const SummitEnsemble& first, const SummitEnsemble& second,
                 const Material& material, double nominal_area);
  ~GreenwoodTripp() override;
  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  double normal_stiffness(double separation) const override;
  double force_curvature(double separation) const override;

 private:
  std::unique_ptr<const detail::HeightDensity> heights_;  ///< of the sum of two heights
  double pairs_, area_, scale_;                           ///< factors of M_1, M_2, M_{5/2}
};

}  // namespace salebra
