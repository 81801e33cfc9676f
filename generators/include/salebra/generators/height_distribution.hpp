// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace salebra {

/// A distribution of heights by its quantile function. Location and scale do not matter: generators
/// give the heights zero mean and the rms height of their spectrum.
struct HeightDistribution {
  /// Height that a fraction u of the surface lies below, 0 < u < 1; increasing; called from several
  /// threads at once.
  std::function<double(double u)> quantile;
  std::string name;  ///< for provenance
};

/// Inverse of Φ(x) = ½ erfc(−x/√2), to a few units in the last place. Throws InvalidInput unless 0
/// < u < 1.
double normal_quantile(double u);

HeightDistribution gaussian_heights();

/// Weibull: u = 1 − exp(−x^shape), shape > 0. Skewness 2 at shape 1, 0 near 3.6, negative above.
HeightDistribution weibull_heights(double shape);

/// The member of Johnson's system of curves with this skewness and kurtosis (3 for a Gaussian): a
/// normal variable z becomes
///     sinh((z − γ)/δ) (S_U),  exp(z/δ) (S_L)  or  1/(1 + exp(−(z − γ)/δ)) (S_B),
/// one of which fits every pair above the limit kurtosis > skewness² + 1 that all distributions
/// obey: Johnson (1949).
/// Throws InvalidInput below that limit, and so near to it that the curve is a pair of spikes.
HeightDistribution johnson_heights(double skewness, double kurtosis);

/// The distribution of given heights, straight between the middles of their steps, such as those of
/// a measured surface.
/// Throws InvalidInput for fewer than two different or for undefined values.
HeightDistribution sampled_heights(std::vector<double> heights);

}  // namespace salebra
