// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <vector>

namespace salebra::detail {

/// The density φ(z) of summit heights of an ensemble, normalised.
class HeightDensity {
 public:
  /// Throws InvalidInput as StatisticalSummits does for what belongs to φ.
  explicit HeightDensity(const SummitEnsemble& ensemble);

  /// ∫_s^∞ (z−s)^n φ(z) dz, m^n, for n >= −1/2 a multiple of 1/2. Relative error below 1e-10.
  double moment(double exponent, double separation) const;
  double density(double height) const;  ///< φ(z), 1/m
  /// From a height on, where φ is more than nothing: both ends, and places between to integrate by;
  /// empty where no summit is higher.
  std::vector<double> support(double from) const;
  /// z below which the fraction 0 < probability < 1 of all summits lies, for distributions other
  /// than Gaussian.
  double quantile(double probability) const;
  /// No summit lies above, or none that double precision could tell from none.
  double highest() const;
  /// Heights where φ is not smooth.
  std::vector<double> breaks() const;
  /// A step of s in which the moments change by a factor of a few.
  double scale() const;

 private:
  double tabulated_moment(double exponent, double separation) const;

  SummitDistribution distribution_;
  double sigma_;
  std::vector<HeightDensityPoint> table_;
  std::vector<double> cumulative_;
};

}  // namespace salebra::detail
