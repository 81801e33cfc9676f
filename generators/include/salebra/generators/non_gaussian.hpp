// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <salebra/base/progress.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/generators/spectrum.hpp>
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

/// Which of the two holds exactly in the end; the other holds as well as the iteration brings it.
enum class Exact { heights, spectrum };

template <>
struct EnumNames<Exact> {
  static constexpr auto values = std::to_array<std::pair<Exact, std::string_view>>(
      {{Exact::heights, "heights"}, {Exact::spectrum, "spectrum"}});
};

struct NonGaussianOptions {
  Exact exact = Exact::heights;
  int max_iterations = 200;  ///< >= 1
  /// Stop when an iteration lowers the mismatch by less than this part of it; 0 … 1.
  double tolerance = 1e-3;
  /// "non-gaussian", many times an iteration; step: iterations done. A stop before the first has
  /// begun throws Interrupted.
  Progress on_progress = {};
};

struct NonGaussianSurface {
  Surface surface;
  int iterations = 0;
  /// √(Σ(|a| − a_target)²/Σa_target²) over all modes of the surface with the exact heights. It ends
  /// above 0: what is left is what the pair of distribution and spectrum cannot have at once on
  /// this grid.
  double spectrum_mismatch = 0;
  /// Converged: the mismatch has stopped falling. Interrupted: the surface is that of the last
  /// iteration that was finished.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<NonGaussianSurface>) {
  using enum Dimension;
  using S = NonGaussianSurface;
  visit(&S::surface, Kept{"surface", "the surface"});
  visit(&S::iterations, Quantity{"iterations", dimensionless, "iterations of the solver"});
  visit(&S::spectrum_mismatch, Quantity{"spectrum_mismatch", dimensionless,
                                        "relative error of the spectrum of the heights"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged,
        Quantity{"converged", dimensionless, "whether the mismatch has stopped falling"});
}

/// A periodic surface with a given spectrum and a given height distribution, by the iterated
/// amplitude-adjusted Fourier transform of Schreiber and Schmitz (1996): in turn, heights are
/// replaced by those of the distribution in the same order, and mode amplitudes by those of the
/// spectrum with the same phases. It starts from random_phase of the seed, whose mode powers are
/// the target, and has the rms height of that surface. Same bits for every thread count; since
/// ranks depend on all points, a finer grid is another surface. The grid cuts the tails: N points
/// reach the quantiles 1/(2N) and 1 − 1/(2N). Errors as random_phase, of the memory that
/// non_gaussian_memory says. Cost: two real FFTs and a sort of all points for an iteration.
NonGaussianSurface non_gaussian(const Grid2D& grid, const Spectrum& spectrum,
                                const HeightDistribution& distribution, std::uint64_t seed,
                                const NonGaussianOptions& options = {});

/// Peak memory of non_gaussian on this grid, bytes: six and a half times the heights.
std::size_t non_gaussian_memory(const Grid2D& grid);

}  // namespace salebra
