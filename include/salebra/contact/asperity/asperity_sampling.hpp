// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <vector>

namespace salebra {

/// Draws `count` summits from an ensemble: heights from the height density of the ensemble,
/// measured from its plane z = 0; positions uniform over a square of side `size`, m; curvatures
/// 1/R. Summit i depends only on (seed, i, realisation). Throws InvalidInput for an ensemble that
/// StatisticalSummits rejects, or count < 1.
std::vector<Summit> draw_summits(const SummitEnsemble& ensemble, int count, double size,
                                 std::uint64_t seed, int realisation = 0);

struct MonteCarloOptions {
  int realisations = 100;  ///< >= 2
  std::uint64_t seed = 1;
};

/// Force curve of surfaces of finite size: each sample is the mean over realisations at one
/// separation of the smooth plane from the plane z = 0 of the ensemble.
struct MonteCarloCurve {
  ForceCurve mean;
  /// Standard deviation over realisations of the quantities of each sample, in the order of `mean`.
  /// For F'' it is NaN: the variance of F'' of a finite ensemble is infinite, because ∫φ/(z−s)
  /// diverges.
  std::vector<AsperityContact> deviation;
  int realisations = 0;
  int summits = 0;  ///< summits per realisation: density × area, rounded

  /// Returns the half-width of the 95 % confidence interval of the mean of a quantity with this
  /// standard deviation over realisations (Student's t).
  double interval(double standard_deviation) const;
};

constexpr void describe(auto&& visit, std::type_identity<MonteCarloCurve>) {
  using S = MonteCarloCurve;
  visit(&S::mean, Kept{"mean", "means over realisations"});
  visit(&S::deviation, Kept{});
  visit(&S::realisations, Kept{"realisations", "number of realisations"});
  visit(&S::summits, Kept{"summits", "summits of each realisation"});
}

/// Computes the curve from realisations of an ensemble. Each realisation has round(density ×
/// nominal area) >= 1 summits, drawn as by draw_summits():
///     const MonteCarloCurve curve = monte_carlo_curve(ensemble, material, area, {0, 1e-8, 2e-8});
/// separations: m, any order. The bits are the same for every thread count. Cost: realisations ×
/// summits × separations.
MonteCarloCurve monte_carlo_curve(const SummitEnsemble& ensemble, const Material& material,
                                  double nominal_area, const std::vector<double>& separations,
                                  const MonteCarloOptions& options = {});

}  // namespace salebra
