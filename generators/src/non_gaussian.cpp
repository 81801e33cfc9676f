// SPDX-License-Identifier: GPL-3.0-or-later
// Surface with a given height distribution and spectrum, by the iterated amplitude-adjusted Fourier
// transform.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "base/fft.hpp"
#include "base/memory.hpp"
#include "synthesis.hpp"
#include "translation.hpp"

namespace salebra {
namespace {

using Complex = std::complex<double>;

// As many heights as there are points, in increasing order, whose distribution is the given one,
// with zero mean and the given rms height.
std::vector<double> ordered_heights(const HeightDistribution& distribution, Index points,
                                    double rms_height) {
  std::vector<double> heights(static_cast<std::size_t>(points));
  parallel::for_slabs(points, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      heights[static_cast<std::size_t>(k)] =
          distribution.quantile((static_cast<double>(k) + 0.5) / static_cast<double>(points));
  });
  require(std::is_sorted(heights.begin(), heights.end()) && std::isfinite(heights.front()) &&
              std::isfinite(heights.back()) && heights.front() < heights.back(),
          "distribution", distribution.name, "must have increasing and finite quantiles");
  const double count = static_cast<double>(points);
  const double mean = std::accumulate(heights.begin(), heights.end(), 0.0) / count;
  double square = 0;
  for (const double height : heights) square += (height - mean) * (height - mean);
  const double scale = rms_height / std::sqrt(square / count);
  for (double& height : heights) height = (height - mean) * scale;
  return heights;
}

// Replaces the lowest height by the lowest of the ordered heights, the second lowest by the second,
// and so on. Points of equal height keep their order.
class RankMap {
 public:
  explicit RankMap(std::vector<double> ordered)
      : ordered_(std::move(ordered)), ranking_(ordered_.size()) {}

  /// Replaces the heights. Calls keep_going after every million comparisons, a small part of a
  /// second. If keep_going returns false, the heights stay unchanged.
  bool apply(Field& heights, const std::function<bool()>& keep_going) {
    for (std::size_t k = 0; k < ranking_.size(); ++k)
      ranking_[k] = {heights.data()[k], static_cast<Index>(k)};
    struct Stopped {};
    std::size_t comparisons = 0;
    const auto lower = [&](const Ranked& a, const Ranked& b) {
      if (++comparisons % 1'000'000 == 0 && !keep_going()) throw Stopped{};
      return a < b;
    };
    try {
      std::sort(ranking_.begin(), ranking_.end(), lower);
    } catch (const Stopped&) {
      return false;
    }
    for (std::size_t k = 0; k < ranking_.size(); ++k)
      heights.data()[ranking_[k].second] = ordered_[k];
    return true;
  }

 private:
  using Ranked = std::pair<double, Index>;
  std::vector<double> ordered_;
  std::vector<Ranked> ranking_;
};

// The Fourier modes of a field, and the amplitudes that they should have.
class TargetAmplitudes {
 public:
  explicit TargetAmplitudes(const Field& field)
      : fft_(field.rows(), field.cols()),
        modes_(static_cast<std::size_t>(field.rows() * fft_.modes_y())),
        targets_(modes_.size()) {
    fft_.forward(field.data(), modes_.data());
    std::transform(modes_.begin(), modes_.end(), targets_.begin(),
                   [](const Complex& mode) { return std::abs(mode); });
  }

  // Transforms the field and returns the relative rms difference between the amplitudes of its
  // modes and the target amplitudes.
  double measure(const Field& field) {
    fft_.forward(field.data(), modes_.data());
    const double difference = sum([this](std::size_t k) {
      const double error = std::abs(modes_[k]) - targets_[k];
      return error * error;
    });
    return std::sqrt(difference / sum([this](std::size_t k) { return targets_[k] * targets_[k]; }));
  }

  // Replaces `field` by a field whose modes have the phases of the last measured field and the
  // target amplitudes.
  void impose(Field& field) {
    const double scale = 1 / static_cast<double>(field.size());
    parallel::for_slabs(fft_.nx(), [&](Index begin, Index end) {
      for (Index k = begin * fft_.modes_y(); k < end * fft_.modes_y(); ++k) {
        Complex& mode = modes_[static_cast<std::size_t>(k)];
        const double target = targets_[static_cast<std::size_t>(k)] * scale;
        const double amplitude = std::abs(mode);
        mode = amplitude > 0 ? mode * (target / amplitude) : Complex(target);
      }
    });
    fft_.backward(modes_.data(), field.data());
  }

 private:
  // Sum of term(index of a mode) over the whole spectrum: a mode whose conjugate is not stored
  // counts twice.
  template <class Term>
  double sum(const Term& term) const {
    return parallel::sum_blocks(fft_.nx(), [&](Index begin, Index end) {
      double of_rows = 0;
      for (Index i = begin; i < end; ++i)
        for (Index j = 0; j < fft_.modes_y(); ++j)
          of_rows += (j == 0 || 2 * j == fft_.ny() ? 1 : 2) *
                     term(static_cast<std::size_t>(i * fft_.modes_y() + j));
      return of_rows;
    });
  }

  RealFft2D<double> fft_;
  std::vector<Complex> modes_;
  std::vector<double> targets_;
};

}  // namespace

std::size_t non_gaussian_memory(const Grid2D& grid) {
  // Memory for the heights, the previous heights, the ordered heights, and two numbers per point
  // for the ranking; for the modes and their target amplitudes.
  const auto points = static_cast<std::size_t>(grid.points());
  const auto modes = static_cast<std::size_t>(grid.nx * (grid.ny / 2 + 1));
  return (5 * points + 3 * modes) * sizeof(double);
}

NonGaussianSurface non_gaussian(const Grid2D& grid, const Spectrum& spectrum,
                                const HeightDistribution& distribution, std::uint64_t seed,
                                const NonGaussianOptions& options) {
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
  require(options.tolerance >= 0 && options.tolerance < 1, "tolerance", options.tolerance,
          "must lie in 0 <= tolerance < 1");
  spectrum.require_carried_by(grid);
  require_memory(grid, double(non_gaussian_memory(grid)), "a non-Gaussian surface");
  if (options.exact == Exact::process)
    return detail::translation_process(grid, spectrum, distribution, seed, options);
  NonGaussianSurface result;
  const std::function<bool()> keep_going = [&] {
    return !options.on_progress ||
           options.on_progress(
               {.stage = "non-gaussian",
                .fraction = static_cast<double>(result.iterations) / options.max_iterations,
                .step = result.iterations,
                .residual = result.spectrum_mismatch});
  };
  const Progress start = [&](const ProgressReport&) { return keep_going(); };
  const double rms_height = spectrum.lattice_moments(grid, start).rms_height();
  result.surface = random_phase(grid, spectrum, seed, start);
  result.surface.origin = distribution.name + ", " + result.surface.origin;
  Field& heights = result.surface.heights;

  TargetAmplitudes amplitudes(heights);
  RankMap communicator(ordered_heights(distribution, grid.points(), rms_height));
  if (!keep_going() || !communicator.apply(heights, keep_going))
    throw Interrupted("non-gaussian: interrupted");
  result.spectrum_mismatch = amplitudes.measure(heights);
  while (result.iterations < options.max_iterations && !result.converged()) {
    const Field previous = heights;
    const double before = result.spectrum_mismatch;
    amplitudes.impose(heights);
    if (!keep_going() || !communicator.apply(heights, keep_going) || !keep_going()) {
      heights = previous;
      result.termination = Termination::interrupted;
      break;
    }
    const double after = amplitudes.measure(heights);
    ++result.iterations;
    if (!(after < before * (1 - options.tolerance))) result.termination = Termination::converged;
    if (after > before)
      heights = previous;
    else
      result.spectrum_mismatch = after;
  }
  if (options.exact == Exact::spectrum) {
    amplitudes.measure(heights);
    amplitudes.impose(heights);
  }
  return result;
}

}  // namespace salebra
