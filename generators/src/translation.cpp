// SPDX-License-Identifier: GPL-3.0-or-later
// Translation process: a monotone transform of a Gaussian surface whose spectrum is chosen so that
// the transformed surface has the given one.
#include "translation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <utility>
#include <vector>

#include "base/fft.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

/// Normal distribution function, P(Z < z).
double below(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

/// Heights as a function of a standard normal variable z, with mean 0 and variance 1, and what it
/// does to a correlation: if z has the correlation r at two points, the heights have Σ_n w_n rⁿ with
/// w_n = n! c_n² and the coefficients c_n of g(z) in Hermite's polynomials He_n.
class HeightTransform {
 public:
  explicit HeightTransform(const HeightDistribution& distribution) : distribution_(distribution) {
    // Simpson's rule; beyond |z| = 8 lies 1e-15 of the heights.
    constexpr int steps = 3200;
    constexpr double end = 8, step = 2 * end / steps;
    std::vector<double> z, weight, height;
    for (int k = 0; k <= steps; ++k) {
      z.push_back(-end + step * k);
      const double simpson = k == 0 || k == steps ? 1 : k % 2 ? 4 : 2;
      weight.push_back(simpson * step / 3 * std::exp(-z.back() * z.back() / 2) / std::sqrt(2 * pi));
      height.push_back(quantile(z.back()));
    }
    double sum = 0, square = 0;
    for (std::size_t k = 0; k < z.size(); ++k) sum += weight[k] * height[k];
    for (std::size_t k = 0; k < z.size(); ++k)
      square += weight[k] * (height[k] - sum) * (height[k] - sum);
    require(std::isfinite(square) && square > 0, "distribution", distribution_.name,
            "must have increasing and finite quantiles");
    mean_ = sum;
    scale_ = 1 / std::sqrt(square);

    std::vector<double> previous(z.size(), 0), polynomial(z.size(), 1);  // He_{n−1}, He_n
    double rest = 1, factorial = 1;
    for (int n = 1; n < terms; ++n) {
      double coefficient = 0;
      for (std::size_t k = 0; k < z.size(); ++k) {
        const double next = z[k] * polynomial[k] - (n - 1) * previous[k];
        previous[k] = std::exchange(polynomial[k], next);
        coefficient += weight[k] * (height[k] - mean_) * scale_ * next;
      }
      factorial *= n;
      weights_[n - 1] = coefficient * coefficient / factorial;
      rest -= weights_[n - 1];
    }
    weights_[terms - 1] = std::max(rest, 0.0);
  }

  double operator()(double z) const { return (quantile(z) - mean_) * scale_; }

  /// Correlation of the heights where the normal variables have the correlation r.
  double correlation(double r) const {
    double sum = 0;
    for (int n = terms; n-- > 0;) sum = (sum + weights_[n]) * r;
    return sum;
  }

 private:
  static constexpr int terms = 24;  ///< the last takes what is left of the variance

  double quantile(double z) const {
    // Extreme heights: quantile functions take only 0 < u < 1.
    constexpr double least = 1e-16;
    return distribution_.quantile(std::clamp(below(z), least, 1 - least));
  }

  const HeightDistribution& distribution_;
  double mean_ = 0, scale_ = 1;
  double weights_[terms] = {};
};

/// Powers of the modes of a grid, with the layout of RealFft2D, as a spectrum.
class LatticeSpectrum final : public Spectrum {
 public:
  LatticeSpectrum(const Grid2D& grid, const Spectrum& target)
      : grid_(grid),
        target_(target),
        powers_(static_cast<std::size_t>(grid.nx * (grid.ny / 2 + 1))) {
    parallel::for_slabs(grid.nx, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i)
        for (Index j = 0; j <= grid.ny / 2; ++j)
          if (i > 0 || j > 0)
            powers_[at(i, j)] =
                target.density(2 * pi / grid.lx * double(2 * i > grid.nx ? i - grid.nx : i),
                               2 * pi / grid.ly * double(j));
    });
  }

  std::vector<double>& powers() { return powers_; }
  const std::vector<double>& powers() const { return powers_; }

  double density(double qx, double qy) const override {
    auto i = static_cast<Index>(std::lround(qx * grid_.lx / (2 * pi)));
    auto j = static_cast<Index>(std::lround(qy * grid_.ly / (2 * pi)));
    // C(−q) = C(q): only half of the modes along y are kept.
    if (j < 0) i = -i, j = -j;
    if (2 * std::abs(i) > grid_.nx || 2 * j > grid_.ny) return 0;
    return powers_[at(i < 0 ? i + grid_.nx : i % grid_.nx, j)];
  }
  double highest_wavenumber() const override { return target_.highest_wavenumber(); }
  SpectralMoments moments() const override { return lattice_moments(grid_); }
  std::string description() const override { return target_.description(); }

 private:
  std::size_t at(Index i, Index j) const {
    return static_cast<std::size_t>(i * (grid_.ny / 2 + 1) + j);
  }

  Grid2D grid_;
  const Spectrum& target_;
  std::vector<double> powers_;
};

/// Changes the spectrum of a Gaussian surface until its transform has the spectrum `target`.
class SpectrumFit {
 public:
  SpectrumFit(const Grid2D& grid, const HeightTransform& transform, const LatticeSpectrum& target)
      : transform_(transform),
        target_(target.powers()),
        fft_(grid.nx, grid.ny),
        correlation_(grid.nx, grid.ny),
        modes_(target_.size()) {
    total_ = sum([this](std::size_t k) { return target_[k]; });
  }

  /// Returns the relative rms difference between the amplitudes of the transformed surface and
  /// those of the target. Keeps the powers of the transformed surface for correct().
  double measure(const std::vector<double>& powers) {
    const double power = sum([&](std::size_t k) { return powers[k]; });
    for (std::size_t k = 0; k < powers.size(); ++k) modes_[k] = powers[k] / power;
    fft_.backward(modes_.data(), correlation_.data());
    parallel::for_slabs(correlation_.rows(), [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i)
        for (Index j = 0; j < correlation_.cols(); ++j)
          correlation_(i, j) = transform_.correlation(correlation_(i, j));
    });
    fft_.forward(correlation_.data(), modes_.data());
    const double scale = total_ / static_cast<double>(correlation_.size());
    for (auto& mode : modes_) mode = std::max(mode.real() * scale, 0.0);
    return std::sqrt(sum([this](std::size_t k) {
                       const double error = std::sqrt(modes_[k].real()) - std::sqrt(target_[k]);
                       return k == 0 ? 0 : error * error;
                     }) /
                     total_);
  }

  /// Scales each power by that of the target over that of the transformed surface.
  void correct(std::vector<double>& powers) const {
    for (std::size_t k = 1; k < powers.size(); ++k)
      if (target_[k] > 0 && modes_[k].real() > 0)
        powers[k] *= std::clamp(target_[k] / modes_[k].real(), 0.25, 4.0);
  }

 private:
  /// Sum over all modes; one whose conjugate is not stored counts twice.
  template <class Term>
  double sum(const Term& term) const {
    const Index columns = fft_.modes_y();
    return parallel::sum_blocks(fft_.nx(), [&](Index begin, Index end) {
      double of_rows = 0;
      for (Index i = begin; i < end; ++i)
        for (Index j = 0; j < columns; ++j)
          of_rows += (j == 0 || 2 * j == fft_.ny() ? 1 : 2) *
                     term(static_cast<std::size_t>(i * columns + j));
      return of_rows;
    });
  }

  const HeightTransform& transform_;
  const std::vector<double>& target_;
  RealFft2D<double> fft_;
  Field correlation_;
  std::vector<std::complex<double>> modes_;
  double total_ = 0;
};

}  // namespace

NonGaussianSurface translation_process(const Grid2D& grid, const Spectrum& spectrum,
                                       const HeightDistribution& distribution, std::uint64_t seed,
                                       const NonGaussianOptions& options) {
  const auto reported = [&](const NonGaussianSurface& now) {
    return !options.on_progress ||
           options.on_progress(
               {.stage = "non-gaussian",
                .fraction = static_cast<double>(now.iterations) / options.max_iterations,
                .step = now.iterations,
                .residual = now.spectrum_mismatch});
  };
  NonGaussianSurface result;
  const Progress start = [&](const ProgressReport&) { return reported(result); };
  const double rms_height = spectrum.lattice_moments(grid, start).rms_height();
  const HeightTransform transform(distribution);
  const LatticeSpectrum target(grid, spectrum);
  LatticeSpectrum gaussian = target;
  {
    SpectrumFit fit(grid, transform, target);
    result.spectrum_mismatch = fit.measure(gaussian.powers());
    while (result.iterations < options.max_iterations && !result.converged()) {
      if (!reported(result)) throw Interrupted("non-gaussian: interrupted");
      std::vector<double> next = gaussian.powers();
      fit.correct(next);
      const double after = fit.measure(next);
      ++result.iterations;
      if (!(after < result.spectrum_mismatch * (1 - options.tolerance)))
        result.termination = Termination::converged;
      if (after >= result.spectrum_mismatch) break;
      gaussian.powers() = std::move(next);
      result.spectrum_mismatch = after;
    }
  }
  result.surface = filtered_noise(grid, gaussian, seed, start);
  result.surface.origin = distribution.name + ", " + result.surface.origin;
  const double scale = 1 / gaussian.lattice_moments(grid).rms_height();
  Field& heights = result.surface.heights;
  const double mean = parallel::sum_blocks(heights.rows(),
                                           [&](Index begin, Index end) {
                                             double sum = 0;
                                             for (Index i = begin; i < end; ++i)
                                               for (Index j = 0; j < heights.cols(); ++j)
                                                 sum += heights(i, j) =
                                                     transform(heights(i, j) * scale);
                                             return sum;
                                           }) /
                      static_cast<double>(heights.size());
  heights = (heights - mean) * rms_height;
  return result;
}

}  // namespace salebra::detail
