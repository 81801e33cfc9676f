// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <vector>

namespace salebra::detail {

/// The normalised density φ(z) of the summit heights of an ensemble.
class HeightDensity {
 public:
  /// Throws InvalidInput, as StatisticalSummits does, for invalid members of the ensemble that
  /// define φ.
  explicit HeightDensity(const SummitEnsemble& ensemble);

  /// ∫_s^∞ (z−s)^n φ(z) dz in m^n, with n = `exponent`, which is >= −1/2 and a multiple of 1/2, and
  /// s = `separation`. Relative error below 1e-10.
  double moment(double exponent, double separation) const;
  double density(double height) const;  ///< φ(z), 1/m
  /// Returns heights z >= `from` for a quadrature over φ: the lowest and highest z at which φ is
  /// not negligible, and break points between these two. Empty if no summit is higher than `from`.
  std::vector<double> support(double from) const;
  /// Height below which the fraction 0 < probability < 1 of all summits lies; not for Gaussian
  /// heights.
  double quantile(double probability) const;
  /// Height above which no summit lies, to double precision.
  double highest() const;
  /// Heights where φ is not smooth.
  std::vector<double> breaks() const;
  /// A change of the separation over which the moments change by a factor of two to ten, m.
  double scale() const;

 private:
  double tabulated_moment(double exponent, double separation) const;

  SummitDistribution distribution_;
  double sigma_;
  std::vector<HeightDensityPoint> table_;
  std::vector<double> cumulative_;
};

}  // namespace salebra::detail
