// SPDX-License-Identifier: GPL-3.0-or-later
// Hurst exponent and self-affine range from a power spectrum, by maximum likelihood.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/surface/spectrum.hpp>
#include <vector>

#include "surface/dense_systems.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double least_span = 3;            ///< of the fitted range, q_max/q_min
constexpr double forgiven_deviation = 0.1;  ///< of C from a power law, in the choice of the range

struct Range {
  double low = 0, high = 0;  ///< rad/m
};

/// Weighted least squares of y = a + b·x over any run of points, in constant time.
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
  /// sloped = false fits a constant.
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

/// The power-law piece of a radial spectrum; an empty range if there is none.
Range self_affine_range(const PowerSpectrum& spectrum, const RadialSpectrum& radial) {
  const Grid2D& grid = spectrum.grid;
  const double nyquist = pi / std::max(grid.dx(), grid.dy());
  const double longest = 2 * pi / std::min(grid.lx, grid.ly);
  const double strongest = std::ranges::max(radial.psd);
  std::vector<std::size_t> bins;
  bool power_ended = false;
  for (std::size_t k = 0; k < radial.modes.size() && !power_ended; ++k) {
    if (spectrum.windowed && radial.wavenumber[k] < 3.5 * longest) continue;
    if (radial.wavenumber[k] > nyquist) break;
    // Rounding leaves 1e-32 of the strongest mode where a spectrum is cut off.
    power_ended = !(radial.psd[k] > 1e-24 * strongest);
    if (!power_ended) bins.push_back(k);
  }
  RunningFit fits;
  for (const std::size_t k : bins) {
    const double independent = static_cast<double>(radial.modes[k]) / 2;
    const double variance =
        spectrum.correlated_modes / independent + forgiven_deviation * forgiven_deviation;
    // The mean of n exponential variates has a logarithm that is low by about 1/(2n).
    fits.add(std::log(radial.wavenumber[k]), std::log(radial.psd[k]) + 0.5 / independent,
             1 / variance);
  }

  const std::size_t count = bins.size();
  const double price = std::log(std::max(static_cast<double>(count), 2.0));
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_begin = 0, best_end = 0;
  for (std::size_t begin = 0; begin < count; ++begin) {
    for (std::size_t end = begin + 3; end <= count; ++end) {
      if (radial.wavenumber[bins[end - 1]] < least_span * radial.wavenumber[bins[begin]]) continue;
      const double misfit = fits.fit(0, begin, false).misfit + fits.fit(begin, end, true).misfit +
                            fits.fit(end, count, true).misfit;
      // A plateau costs its level and its end; a tail its beginning and one or two parameters.
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
  // The bins at an end that was found hold waves of both sides.
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
  double x = 0;  ///< ln q, from the mean of all modes
  double power = 0;
  double weight = 0;  ///< independent complex amplitudes
};

std::vector<Mode> modes_within(const PowerSpectrum& spectrum, const Range& range) {
  std::vector<Mode> modes;
  for (Index i = 0; i < spectrum.grid.nx; ++i) {
    for (Index j = 0; j < spectrum.psd.cols(); ++j) {
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      if (q > 0 && q >= range.low && q <= range.high)
        modes.push_back({std::log(q), spectrum.psd(i, j), spectrum.multiplicity(j) / 2});
    }
  }
  return modes;
}

/// ln C = a + b·x by maximum likelihood for exponentially distributed powers: Newton's method with the expected information, which
/// is convex and hence safe from any start.
Eigen::Vector2d fit_power_law(const std::vector<Mode>& modes, const Eigen::Matrix2d& information) {
  double power = 0, weight = 0;
  for (const Mode& mode : modes) {
    power += mode.weight * mode.power;
    weight += mode.weight;
  }
  Eigen::Vector2d law(std::log(power / weight), 0);
  for (int iteration = 0; iteration < 100; ++iteration) {
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (const Mode& mode : modes) {
      const double excess = std::expm1(std::log(mode.power) - law(0) - law(1) * mode.x);
      score += mode.weight * excess * Eigen::Vector2d(1, mode.x);
    }
    // A far start overshoots; a step of more than one unit is shortened.
    Eigen::Vector2d step = detail::least_squares(information, score);
    step /= std::max(1.0, step.norm());
    law += step;
    if (step.norm() < 1e-10) break;
  }
  return law;
}

}  // namespace

HurstEstimate estimate_hurst(const PowerSpectrum& spectrum) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const HurstEstimate not_found{none, none, none, none, none, 0};
  const RadialSpectrum radial = radial_spectrum(spectrum);
  if (radial.modes.empty() || !(std::ranges::max(radial.psd) > 0)) return not_found;
  const Range range = self_affine_range(spectrum, radial);
  std::vector<Mode> modes = modes_within(spectrum, range);
  if (modes.size() < 3) return not_found;

  double weight = 0, centre = 0;
  for (const Mode& mode : modes) {
    weight += mode.weight;
    centre += mode.weight * mode.x;
  }
  centre /= weight;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (Mode& mode : modes) {
    mode.x -= centre;
    information += mode.weight * Eigen::Matrix2d{{1, mode.x}, {mode.x, mode.x * mode.x}};
  }
  const Eigen::Vector2d law = fit_power_law(modes, information);

  // Scatter of rings of equal width in ln q about the law, in units of what exponential powers have.
  const auto [least, greatest] = std::ranges::minmax(modes, {}, &Mode::x);
  const double width = std::log(2.0) / 4;
  const auto rings = static_cast<std::size_t>((greatest.x - least.x) / width) + 1;
  std::vector<double> ratio(rings, 0), count(rings, 0);
  for (const Mode& mode : modes) {
    const auto ring = std::min(rings - 1, static_cast<std::size_t>((mode.x - least.x) / width));
    ratio[ring] += mode.weight * (mode.power * std::exp(-law(0) - law(1) * mode.x) - 1);
    count[ring] += mode.weight;
  }
  double scatter = 0, filled = 0;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    if (count[ring] == 0) continue;
    scatter += ratio[ring] * ratio[ring] / count[ring];
    ++filled;
  }
  const double freedom = filled - 2;
  const double value = -1 - law(1) / 2;
  const double span = std::exp(greatest.x - least.x);
  if (freedom < 1 || span < least_span * (1 - 1e-9) || !(value > -0.25 && value < 1.5))
    return not_found;
  // A window makes neighbouring modes alike: rings that happen to scatter less than that are luck, not knowledge.
  const double dispersion =
      std::max(scatter / freedom, spectrum.windowed ? spectrum.correlated_modes : 0);
  const double error = std::sqrt(dispersion * detail::pseudo_inverse(information)(1, 1)) / 2;
  const double half_width = gsl_cdf_tdist_Pinv(0.975, freedom) * error;
  Index all = 0;
  for (const Mode& mode : modes) all += static_cast<Index>(2 * mode.weight);
  return {value,
          value - half_width,
          value + half_width,
          std::exp(least.x + centre),
          std::exp(greatest.x + centre),
          all};
}

}  // namespace salebra
