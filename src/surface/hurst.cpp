// SPDX-License-Identifier: GPL-3.0-or-later
// Hurst exponent and self-affine range from a power spectrum, by maximum likelihood.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/spectrum.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/numerics/dense_systems.hpp"
#include "ring_means.hpp"
#include "surface/windowed_fit.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double min_span = 3;              ///< minimum ratio of the largest to the smallest q
constexpr double forgiven_deviation = 0.1;  ///< relative deviation of C from a power law that the
                                            ///< choice of the range tolerates

struct Range {
  double low = 0, high = 0;  ///< rad/m
};

/// Weighted least-squares line y = a + b·x through any run of successive points, in a time that
/// does not depend on the number of points.
class RunningFit {
 public:
  void add(double x, double y, double weight) {
    Sums sums = sums_.back();
    sums.w += weight;
    sums.x += weight * x;
    sums.y += weight * y;
    sums.xx += weight * x * x;
    sums.xy += weight * x * y;
    sums.yy += weight * y * y;
    sums_.push_back(sums);
  }
  std::size_t points() const { return sums_.size() - 1; }

  struct Line {
    double slope = 0, misfit = 0;
  };
  /// Fits the points begin … end − 1; sloped = false fits a constant.
  Line fit(std::size_t begin, std::size_t end, bool sloped) const {
    if (begin == end) return {};
    const Sums &a = sums_[begin], &b = sums_[end];
    const double w = b.w - a.w, x = (b.x - a.x) / w, y = (b.y - a.y) / w;
    const double xx = b.xx - a.xx - w * x * x, xy = b.xy - a.xy - w * x * y;
    const double yy = std::max(b.yy - a.yy - w * y * y, 0.0);
    if (!sloped || end - begin < 2) return {0, yy};
    return {xy / xx, std::max(yy - xy * xy / xx, 0.0)};
  }

 private:
  struct Sums {
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  std::vector<Sums> sums_{Sums{}};
};

/// The range of a radial spectrum in which it follows a power law; an empty range if there is none.
Range self_affine_range(const PowerSpectrum& spectrum, const RadialSpectrum& radial,
                        double highest) {
  const Grid2D& grid = spectrum.grid;
  const double nyquist = std::min(highest, pi / std::max(grid.dx(), grid.dy()));
  const double strongest = std::ranges::max(radial.psd);
  std::vector<std::size_t> bins;
  bool power_ended = false;
  for (std::size_t k = 0; k < radial.modes.size() && !power_ended; ++k) {
    if (radial.wavenumber[k] > nyquist) break;
    // Beyond a cut-off, rounding leaves 1e-32 of the strongest mode; such power counts as zero.
    power_ended = !(radial.psd[k] > 1e-24 * strongest);
    if (!power_ended) bins.push_back(k);
  }
  RunningFit fits;
  for (const std::size_t k : bins) {
    const double independent = static_cast<double>(radial.modes[k]) / 2;
    const double variance = 1 / independent + forgiven_deviation * forgiven_deviation;
    // The logarithm of the mean of n exponentially distributed powers is biased by about −1/(2n).
    fits.add(std::log(radial.wavenumber[k]), std::log(radial.psd[k]) + 0.5 / independent,
             1 / variance);
  }

  const std::size_t count = bins.size();
  const double price = std::log(std::max(static_cast<double>(count), 2.0));
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_begin = 0, best_end = 0;
  for (std::size_t begin = 0; begin < count; ++begin) {
    for (std::size_t end = begin + 3; end <= count; ++end) {
      if (radial.wavenumber[bins[end - 1]] < min_span * radial.wavenumber[bins[begin]]) continue;
      const double misfit = fits.fit(0, begin, false).misfit + fits.fit(begin, end, true).misfit +
                            fits.fit(end, count, true).misfit;
      // Number of parameters of the model. A plateau costs two: its height and its end. A tail
      // beyond the power law costs its beginning, and one more for a single bin or two more for
      // several bins.
      const double parameters = 2 + (begin > 0 ? 2.0 : 0.0) +
                                1.0 * static_cast<double>(std::min<std::size_t>(count - end, 2)) +
                                (end < count ? 1.0 : 0.0);
      if (const double criterion = misfit + price * parameters; criterion < best) {
        best = criterion;
        best_begin = begin;
        best_end = end;
      }
    }
  }
  if (!std::isfinite(best)) return {};
  // A bin at the beginning or end of the power law contains waves from both sides of that limit.
  const bool cut_above = best_end < count || power_ended;
  const std::size_t first = best_begin + (best_begin > 0 ? 1 : 0);
  const std::size_t last = best_end - 1 - (cut_above ? 1 : 0);
  if (last <= first + 1) return {};
  const auto limit = [&](std::size_t k, std::size_t neighbour) {
    return std::sqrt(radial.wavenumber[k] * radial.wavenumber[neighbour]);
  };
  const double low = bins[first] > 0 ? limit(bins[first], bins[first] - 1) : 0;
  const double high = bins[last] + 1 < radial.modes.size()
                          ? limit(bins[last], bins[last] + 1)
                          : std::numeric_limits<double>::infinity();
  return {low, std::min(high, nyquist)};
}

struct Mode {
  double x = 0;  ///< ln q; after shift(), minus its mean over all modes
  double power = 0;
  double weight = 0;  ///< number of independent complex amplitudes
};

/// The modes of a spectrum in a range of wave numbers. Each process has the modes of its columns.
class ModesWithin {
 public:
  ModesWithin(const PowerSpectrum& spectrum, const Range& range) : columns_(spectrum.columns()) {
    const auto within = [&](Index begin, Index end) {
      std::vector<Mode> modes;
      for (Index i = 0; i < spectrum.grid.nx; ++i) {
        const double qx = spectrum.wavenumber_x(i);
        for (Index k = begin; k < end; ++k) {
          const Index j = columns_.begin() + k;
          const double q = detail::length_of(qx, spectrum.wavenumber_y(j));
          if (q > 0 && q >= range.low && q <= range.high)
            modes.push_back({std::log(q), spectrum.psd(i, k), spectrum.multiplicity(j) / 2});
        }
      }
      return modes;
    };
    blocks_ = parallel::map_blocks_of<std::vector<Mode>>(size(), columns_.count(), within);
  }

  /// Calls add(sums, mode) for the modes of all processes and returns the sums over them.
  template <std::size_t numbers, class Add>
  std::array<double, numbers> sums(const Add& add) const {
    std::array<double, numbers> total;
    const std::vector<double> found =
        sums(numbers, [&](std::span<double> of_block, const Mode& mode) { add(of_block, mode); });
    std::copy_n(found.begin(), numbers, total.begin());
    return total;
  }
  template <class Add>
  std::vector<double> sums(std::size_t numbers, const Add& add) const {
    return parallel::sum_blocks(columns_, numbers,
                                [&](Index begin, Index, std::span<double> of_block) {
                                  for (const Mode& mode : block(begin)) add(of_block, mode);
                                });
  }
  /// Subtracts `centre` from ln q of all modes.
  void shift(double centre) {
    for (auto& modes : blocks_)
      for (Mode& mode : modes) mode.x -= centre;
  }
  /// The minimum and maximum of ln q.
  std::pair<double, double> range() const {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const auto& modes : blocks_) {
      for (const Mode& mode : modes) {
        least = std::min(least, mode.x);
        greatest = std::max(greatest, mode.x);
      }
    }
    return {communicator().min_of(least), -communicator().min_of(-greatest)};
  }
  const Communicator& communicator() const { return columns_.communicator(); }

 private:
  Index size() const { return parallel::block_rows(columns_.rows()); }
  const std::vector<Mode>& block(Index begin) const {
    return blocks_[static_cast<std::size_t>(begin / size())];
  }

  RowPartition columns_;
  std::vector<std::vector<Mode>> blocks_;
};

/// Maximum-likelihood fit of ln C = a + b·x over x = ln q to exponentially distributed powers.
/// Newton's method with the expected information converges from any start, because the problem is
/// convex.
Eigen::Vector2d fit_power_law(const ModesWithin& modes, double mean_power,
                              const Eigen::Matrix2d& information) {
  Eigen::Vector2d law(std::log(mean_power), 0);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const auto score = modes.sums<2>([&](std::span<double> sums, const Mode& mode) {
      const double excess =
          mode.weight * std::expm1(std::log(mode.power) - law(0) - law(1) * mode.x);
      sums[0] += excess;
      sums[1] += excess * mode.x;
    });
    // From a distant start a step of the parameters a and b may overshoot, so its length is at most
    // 1.
    Eigen::Vector2d step = detail::least_squares(information, Eigen::Vector2d(score[0], score[1]));
    step /= std::max(1.0, step.norm());
    law += step;
    // Processors of two types may differ in the last digits of a logarithm, but all processes must
    // end the iteration in the same step, so they take the parameters of the first process.
    modes.communicator().broadcast(law.data(), 2 * sizeof(double));
    double length = step.norm();
    modes.communicator().broadcast(&length, sizeof length);
    if (length < 1e-10) break;
  }
  return law;
}

/// Power spectral density of an unbounded self-affine surface as seen through Hann's window: a
/// weighted mean of the density over wave vectors displaced by −1, 0 and 1 mode along x and y, with
/// weights 1 : 4 : 1 along each axis.
detail::SelfAffineDensity windowed_density(const Grid2D& grid) {
  const double step_x = 2 * pi / grid.lx, step_y = 2 * pi / grid.ly;
  return [=](double q, double hurst, double q_rolloff) {
    const auto at = [&](double qx, double qy) {
      return std::pow(std::max(qx * qx + qy * qy, q_rolloff * q_rolloff), -1 - hurst);
    };
    // At this wave number the window changes the density by less than the bins can resolve.
    if (q > 16 * std::max(step_x, step_y)) return at(q, 0);
    double sum = 0;
    // For a wave vector in this direction, the weighted mean is about its mean over all directions.
    const double qx = q * std::cos(pi / 8), qy = q * std::sin(pi / 8);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        sum += (i == 0 ? 4 : 1) * (j == 0 ? 4 : 1) * at(qx + i * step_x, qy + j * step_y);
    return sum / 36;
  };
}

/// Hurst exponent and roll-off of a surface that is not periodic, whose spectrum has a window.
detail::WindowedFit of_windowed(const PowerSpectrum& spectrum, double highest) {
  const Grid2D& grid = spectrum.grid;
  // This number of rings resolves a power law to better than a hundredth.
  constexpr int rings_per_octave = 6;
  const RadialSpectrum radial = radial_spectrum(spectrum, rings_per_octave);
  const double lowest = 4 * 2 * pi / std::min(grid.lx, grid.ly);
  // Waves shorter than two and a half cells suffer most from aliasing, and no law describes their
  // power.
  highest = std::min(highest, 0.8 * pi / std::max(grid.dx(), grid.dy()));
  constexpr double forgiven = 0.02;
  const double strongest = radial.psd.empty() ? 0 : std::ranges::max(radial.psd);
  std::vector<detail::SpectrumBin> bins;
  std::vector<std::size_t> positions;
  for (std::size_t k = 0; k < radial.modes.size(); ++k) {
    const double q = radial.wavenumber[k];
    if (q < lowest || q > highest) continue;
    if (!(radial.psd[k] > 1e-24 * strongest)) break;
    const double independent = static_cast<double>(radial.modes[k]) / 2 / spectrum.correlated_modes;
    bins.push_back({q, radial.psd[k], 1 / (1 / independent + forgiven * forgiven)});
    positions.push_back(k);
  }
  const detail::PowerLawRange law =
      detail::fit_power_law_range(bins, windowed_density(grid), min_span);
  if (!law.found()) return {};
  const auto limit = [&](std::size_t ring, std::size_t next) {
    return std::sqrt(radial.wavenumber[ring] * radial.wavenumber[next]);
  };
  const std::size_t first = positions[law.begin], last = positions[law.end - 1];
  const ModesWithin modes(
      spectrum,
      {first > 0 ? limit(first - 1, first) : 0,
       last + 1 < radial.modes.size() ? std::min(highest, limit(last, last + 1)) : highest});
  const auto [all] =
      modes.sums<1>([](std::span<double> sums, const Mode& mode) { sums[0] += 2 * mode.weight; });
  const auto [least, greatest] = modes.range();
  return {{law.hurst, std::exp(least), std::exp(greatest), static_cast<Index>(all)}, law.rolloff()};
}

HurstEstimate found_or_not(const PowerSpectrum& spectrum, double highest) {
  if (spectrum.windowed) return of_windowed(spectrum, highest).hurst;
  const RadialSpectrum radial = radial_spectrum(spectrum);
  if (radial.modes.empty() || !(std::ranges::max(radial.psd) > 0)) return {};
  Range range = self_affine_range(spectrum, radial, highest);
  spectrum.communicator.broadcast(&range, sizeof range);
  ModesWithin modes(spectrum, range);
  const auto [count, weight, moment, power, all] =
      modes.sums<5>([](std::span<double> sums, const Mode& mode) {
        sums[0] += 1;
        sums[1] += mode.weight;
        sums[2] += mode.weight * mode.x;
        sums[3] += mode.weight * mode.power;
        sums[4] += 2 * mode.weight;
      });
  if (count < 3) return {};

  double centre = moment / weight;
  spectrum.communicator.broadcast(&centre, sizeof centre);
  modes.shift(centre);
  const auto second = modes.sums<3>([](std::span<double> sums, const Mode& mode) {
    sums[0] += mode.weight;
    sums[1] += mode.weight * mode.x;
    sums[2] += mode.weight * mode.x * mode.x;
  });
  const Eigen::Matrix2d information{{second[0], second[1]}, {second[1], second[2]}};
  const Eigen::Vector2d law = fit_power_law(modes, power / weight, information);

  // Scatter of the mean powers of rings of equal width in ln q about the fitted law, relative to
  // the scatter that exponentially distributed powers would give.
  const auto [least, greatest] = modes.range();
  const double width = std::log(2.0) / 4;
  const auto rings = static_cast<std::size_t>((greatest - least) / width) + 1;
  const auto sums =
      modes.sums(2 * rings, [&, from = least](std::span<double> of_rings, const Mode& mode) {
        const auto ring = std::min(rings - 1, static_cast<std::size_t>((mode.x - from) / width));
        of_rings[2 * ring] += mode.weight * (mode.power * std::exp(-law(0) - law(1) * mode.x) - 1);
        of_rings[2 * ring + 1] += mode.weight;
      });
  double scatter = 0, filled = 0;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const double ratio = sums[2 * ring], weight_of_ring = sums[2 * ring + 1];
    if (weight_of_ring == 0) continue;
    scatter += ratio * ratio / weight_of_ring;
    ++filled;
  }
  const double freedom = filled - 2;
  const double value = -1 - law(1) / 2;
  const double span = std::exp(greatest - least);
  if (freedom < 1 || span < min_span * (1 - 1e-9) || !(value > -0.25 && value < 1.5)) return {};
  const double dispersion = scatter / freedom;
  const double error = std::sqrt(dispersion * detail::pseudo_inverse(information)(1, 1)) / 2;
  const double half_width = gsl_cdf_tdist_Pinv(0.975, freedom) * error;
  return {{value, value - half_width, value + half_width},
          std::exp(least + centre),
          std::exp(greatest + centre),
          static_cast<Index>(all)};
}

}  // namespace

detail::WindowedFit detail::fit_windowed(const PowerSpectrum& spectrum,
                                         double shortest_wavelength) {
  if (shortest_wavelength == 0) shortest_wavelength = spectrum.asymmetric_wavelength;
  WindowedFit fit = of_windowed(spectrum, 2 * pi / shortest_wavelength);
  spectrum.communicator.broadcast(&fit, sizeof fit);
  return fit;
}

HurstEstimate estimate_hurst(const PowerSpectrum& spectrum, double shortest_wavelength) {
  if (shortest_wavelength == 0) shortest_wavelength = spectrum.asymmetric_wavelength;
  HurstEstimate estimate = found_or_not(spectrum, 2 * pi / shortest_wavelength);
  spectrum.communicator.broadcast(&estimate, sizeof estimate);
  return estimate;
}

}  // namespace salebra
