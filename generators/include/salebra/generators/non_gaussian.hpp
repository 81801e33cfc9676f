// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// A distribution of heights, given by its quantile function. Location and scale do not matter:
/// generators shift and scale heights to zero mean and the rms height of the spectrum.
struct HeightDistribution {
  /// Height below which a fraction u of the surface lies, 0 < u < 1; increasing; called from
  /// several threads at once.
  std::function<double(double u)> quantile;
  std::string name;  ///< for provenance
};

/// Returns the standard normal quantile, i.e. the x with ½ erfc(−x/√2) = u, exact to a few units in
/// the last digit. Throws InvalidInput unless 0 < u < 1.
double normal_quantile(double u);

HeightDistribution gaussian_heights();

/// Weibull distribution of heights x, u = 1 − exp(−x^shape), shape > 0. Its skewness is 2 for shape
/// 1, 0 for a shape of about 3.6, and negative for larger shapes.
HeightDistribution weibull_heights(double shape);

/// Returns the distribution of Johnson's system with this skewness and kurtosis (3 for a Gaussian).
/// Its heights are functions of a normal variable z with parameters γ and δ,
///     sinh((z − γ)/δ) (S_U),  exp(z/δ) (S_L)  or  1/(1 + exp(−(z − γ)/δ)) (S_B).
/// One of these types exists for every pair with kurtosis > skewness² + 1, which holds for all
/// distributions [Johnson (1949)]. Throws InvalidInput if this condition is violated, or so nearly
/// violated that the density consists of two spikes.
HeightDistribution johnson_heights(double skewness, double kurtosis);

/// Returns the distribution of given heights, such as those of a measured surface. Its quantile
/// function is linear between the sorted heights z_k, k from 0 to N − 1, which belong to u = (k +
/// ½)/N. Throws InvalidInput for fewer than two different values or for undefined ones.
HeightDistribution sampled_heights(std::vector<double> heights);

/// The property that is exact in the result, heights (their distribution) or spectrum; the
/// iteration makes the remaining one as accurate as possible. With `process` both are those of the
/// random process from which the surface is a sample, as for the Gaussian surfaces of
/// filtered_noise(): skewness and rms height fluctuate from seed to seed.
enum class Exact { heights, spectrum, process };

template <>
struct EnumNames<Exact> {
  static constexpr auto values = std::to_array<std::pair<Exact, std::string_view>>(
      {{Exact::heights, "heights"}, {Exact::spectrum, "spectrum"}, {Exact::process, "process"}});
};

struct NonGaussianOptions {
  Exact exact = Exact::heights;
  int max_iterations = 200;  ///< >= 1
  /// The iteration stops when a step lowers the spectrum mismatch by less than this fraction; 0 to
  /// 1.
  double tolerance = 1e-3;
  /// Called many times per iteration with the stage "non-gaussian"; step counts finished
  /// iterations. A stop before the first iteration has begun throws Interrupted.
  Progress on_progress = {};
};

struct NonGaussianSurface {
  Surface surface;
  int iterations = 0;
  /// Deviation of the mode amplitudes |a| from those of the spectrum, √(Σ(|a| −
  /// a_target)²/Σa_target²) over all modes, for the surface with exact heights, or for the means of
  /// |a|² of the process. It stays above 0 if height distribution and spectrum cannot be exact
  /// together on this grid.
  double spectrum_mismatch = 0;
  /// `converged`: the mismatch has stopped falling. `interrupted`: the surface is that of the last
  /// finished iteration.
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

/// Generates a periodic surface with a given spectrum and height distribution:
///     const NonGaussianSurface made = non_gaussian(grid, spectrum, johnson_heights(-1, 5), 1);
/// It iterates the amplitude-adjusted Fourier transform of Schreiber and Schmitz (1996): in turn,
/// it replaces the heights by the heights of the distribution with the same ranks, and the mode
/// amplitudes by those of the spectrum with the same phases. It starts from random_phase of the
/// seed, whose mode powers are the target and whose rms height is kept. With Exact::process the
/// surface is h = g(z) with an increasing function g and a Gaussian z by filtered_noise() of the
/// seed (translation process); the spectrum of z is corrected until that of h is the given one in
/// the mean [Yamazaki and Shinozuka (1988)]. The bits are the same for
/// every thread count; since the order of heights depends on all points, a finer grid gives another
/// surface. The tails of the distribution are truncated: N points reach the quantiles 1/(2N) and 1
/// − 1/(2N). Throws wherever random_phase does. Memory: non_gaussian_memory(). Cost: two real FFTs
/// per iteration and, except for a process, a sort of all points.
NonGaussianSurface non_gaussian(const Grid2D& grid, const Spectrum& spectrum,
                                const HeightDistribution& distribution, std::uint64_t seed,
                                const NonGaussianOptions& options = {});

/// Returns the peak memory of non_gaussian on this grid, bytes: six and a half times the heights.
std::size_t non_gaussian_memory(const Grid2D& grid);

}  // namespace salebra
