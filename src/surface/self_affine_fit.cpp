// SPDX-License-Identifier: GPL-3.0-or-later
// Roll-off and short cut-off of a self-affine spectrum by maximum likelihood, with intervals.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <span>
#include <vector>

#include "base/numerics/dense_systems.hpp"
#include "ring_means.hpp"
#include "surface/windowed_fit.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double ended = 1e-3;        ///< power below this part of the law counts as zero
constexpr double bins_per_unit = 64;  ///< bins per unit of ln q, for the likelihood

/// Modes of nearly equal wave number q. Their mean power suffices to fit a law that is straight in
/// ln q.
struct Ring {
  double x = 0;       ///< ln q
  double power = 0;   ///< mean power
  double weight = 0;  ///< number of independent complex amplitudes
};

/// Calls body(q, power, number of independent complex amplitudes) for each mode in the columns
/// begin … end − 1 of this process, except q = 0.
template <class Body>
void for_modes(const PowerSpectrum& spectrum, Index begin, Index end, const Body& body) {
  const Index first = spectrum.columns().begin();
  for (Index i = 0; i < spectrum.grid.nx; ++i) {
    const double qx = spectrum.wavenumber_x(i);
    for (Index k = begin; k < end; ++k) {
      const double q = detail::length_of(qx, spectrum.wavenumber_y(first + k));
      if (q > 0) body(q, spectrum.psd(i, k), spectrum.multiplicity(first + k) / 2);
    }
  }
}

std::vector<Ring> fine_rings(const PowerSpectrum& spectrum, double lowest, double highest) {
  const double start = std::log(lowest);
  const auto number_of = [&](double logarithm) {
    return static_cast<std::size_t>((logarithm - start) * bins_per_unit);
  };
  const std::size_t count = highest < lowest ? 0 : number_of(std::log(highest)) + 1;
  const std::vector<double> sums = parallel::sum_blocks(
      spectrum.columns(), 3 * count, [&](Index begin, Index end, std::span<double> of_block) {
        for_modes(spectrum, begin, end, [&](double q, double power, double weight) {
          if (q < lowest || q > highest) return;
          const double logarithm = std::log(q);
          const auto ring = of_block.subspan(3 * std::min(number_of(logarithm), count - 1), 3);
          ring[0] += weight;
          ring[1] += weight * logarithm;
          ring[2] += weight * power;
        });
      });
  std::vector<Ring> rings;
  for (std::size_t at = 0; at < sums.size(); at += 3)
    if (const double weight = sums[at]; weight > 0)
      rings.push_back({sums[at + 1] / weight, sums[at + 2] / weight, weight});
  return rings;
}

/// Minus twice the maximum log-likelihood, over a and b, of the law ln C = a − b·max(0, x − kink)
/// with x = ln q.
double deviance(const std::vector<Ring>& rings, double kink) {
  // The likelihood of exponentially distributed powers is log-concave in a and b, so Newton's
  // method converges if steps that go too far are halved.
  const auto basis = [&](const Ring& ring) {
    return Eigen::Vector2d(1, -std::max(0.0, ring.x - kink));
  };
  const auto value = [&](const Eigen::Vector2d& law) {
    double sum = 0;
    for (const Ring& ring : rings) {
      const double logarithm = law.dot(basis(ring));
      sum += 2 * ring.weight * (logarithm + ring.power * std::exp(-logarithm));
    }
    return sum;
  };
  double plateau = 0, weight = 0;
  for (const Ring& ring : rings) {
    if (weight > 0 && ring.x > kink) continue;
    plateau += ring.weight * ring.power;
    weight += ring.weight;
  }
  Eigen::Vector2d law(std::log(plateau / weight), 3);
  double best = value(law);
  for (int iteration = 0; iteration < 100; ++iteration) {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
    for (const Ring& ring : rings) {
      const Eigen::Vector2d terms = basis(ring);
      const double ratio = ring.power * std::exp(-law.dot(terms));
      gradient += ring.weight * (1 - ratio) * terms;
      curvature += ring.weight * std::max(ratio, 1e-3) * terms * terms.transpose();
    }
    Eigen::Vector2d step = detail::least_squares(curvature, -gradient);
    double next = value(law + step);
    for (int halving = 0; next > best && halving < 40; ++halving) {
      step /= 2;
      next = value(law + step);
    }
    if (next > best) break;
    law += step;
    const bool settled = best - next < 1e-10;
    best = next;
    if (settled) break;
  }
  return best;
}

IntervalEstimate fit_rolloff(const PowerSpectrum& spectrum, const HurstEstimate& hurst) {
  const double lowest = 0.999 * 2 * pi / std::max(spectrum.grid.lx, spectrum.grid.ly);
  const std::vector<Ring> rings = fine_rings(spectrum, lowest, hurst.wavenumber_max);
  if (rings.size() < 8) return {};
  const double first = rings.front().x, last = rings.back().x;
  // Position of the kink, the roll-off: before the first ring it means no plateau, near the last
  // ring it leaves no power law.
  constexpr int steps = 200;
  const auto position = [&](int k) { return first + (last - first) * k / steps; };
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(deviance(rings, position(k)));
  const auto least = std::ranges::min_element(values);
  const auto best = static_cast<int>(least - values.begin());
  const double limit = gsl_cdf_chisq_Pinv(0.95, 1);

  // Golden-section search for the minimum of the deviance near the best of the tested positions.
  constexpr double golden = 0.6180339887498949;
  double left = position(std::max(best - 1, 0)), right = position(std::min(best + 1, steps));
  for (int k = 0; k < 30; ++k) {
    const double a = right - golden * (right - left), b = left + golden * (right - left);
    if (deviance(rings, a) < deviance(rings, b))
      right = b;
    else
      left = a;
  }
  const double kink = (left + right) / 2;
  const double threshold = std::min(*least, deviance(rings, kink)) + limit;
  if (values.front() < threshold || values.back() < threshold) return {};
  // Finds where the deviance crosses the threshold, searching inwards from the first or last
  // position.
  const auto crossing = [&](int from, int direction) {
    int k = from;
    while (values[static_cast<std::size_t>(k)] >= threshold && k != best) k += direction;
    double outside = position(k - direction), inside = k == best ? kink : position(k);
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (outside + inside) / 2;
      (deviance(rings, middle) >= threshold ? outside : inside) = middle;
    }
    return inside;
  };
  const double low = crossing(0, 1), high = crossing(steps, -1);
  return {2 * pi / std::exp(kink), 2 * pi / std::exp(high), 2 * pi / std::exp(low)};
}

IntervalEstimate find_short_cutoff(const PowerSpectrum& spectrum, const HurstEstimate& hurst) {
  const RowPartition columns = spectrum.columns();
  const double exponent = 2 * (1 + hurst.value);
  const auto flat = [&](double q, double power) { return power * std::pow(q, exponent); };
  const std::vector<double> sums =
      parallel::sum_blocks(columns, 2, [&](Index begin, Index end, std::span<double> of_block) {
        for_modes(spectrum, begin, end, [&](double q, double power, double) {
          if (q < hurst.wavenumber_min || q > hurst.wavenumber_max) return;
          of_block[0] += flat(q, power);
          of_block[1] += 1;
        });
      });
  const double min_power = ended * sums[0] / sums[1];
  // The minimum (sign 1) or maximum (sign −1) of the wave numbers above `from`, of all modes or
  // only of modes with power.
  const auto extreme = [&](double sign, double from, bool with_power) {
    double best = std::numeric_limits<double>::infinity();
    for (const double of_block : parallel::map_blocks_of<double>(
             parallel::block_rows(columns.rows()), columns.count(), [&](Index begin, Index end) {
               double found = std::numeric_limits<double>::infinity();
               for_modes(spectrum, begin, end, [&](double q, double power, double) {
                 if (q > from && (!with_power || flat(q, power) >= min_power))
                   found = std::min(found, sign * q);
               });
               return found;
             }))
      best = std::min(best, of_block);
    return sign * spectrum.communicator.min_of(best);
  };
  // A mode whose power follows the law has less than a thousandth of the law's power with a
  // probability of a thousandth, so a run of such modes marks the cut-off.
  const double low = extreme(-1, hurst.wavenumber_min, true);
  const double high = extreme(1, low, false);
  const double last = extreme(-1, low, false);
  if (!std::isfinite(low) || !std::isfinite(high)) return {};
  const Grid2D& grid = spectrum.grid;
  const double step = 2 * pi / std::min(grid.lx, grid.ly);
  // The blur of a lens or a tip lowers the power gradually; just before the end of a spectrum it
  // follows the law.
  const std::vector<double> before =
      parallel::sum_blocks(columns, 2, [&](Index begin, Index end, std::span<double> of_block) {
        for_modes(spectrum, begin, end, [&](double q, double power, double) {
          if (q < 0.8 * low || q > 0.9 * low) return;
          of_block[0] += flat(q, power);
          of_block[1] += 1;
        });
      });
  if (before[0] / before[1] < 0.5 * sums[0] / sums[1]) return {};
  // The wave number `last` is the largest of all modes. If the modes without power fill less than a
  // ring, the cut-off may just be the largest wave number of the grid.
  if (last < high + 4 * step) return {};
  const double margin = spectrum.windowed ? 2 * step : 0;
  const double middle = (low + high) / 2 - margin / 2;
  return {2 * pi / middle, 2 * pi / high, 2 * pi / (low - 2 * margin)};
}

}  // namespace

SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum, double shortest_wavelength) {
  SelfAffineFit fit;
  if (spectrum.windowed) {
    const detail::WindowedFit windowed = detail::fit_windowed(spectrum, shortest_wavelength);
    fit = {windowed.hurst, windowed.rolloff, {}};
  } else {
    fit.hurst = estimate_hurst(spectrum, shortest_wavelength);
    if (fit.hurst.found()) fit.rolloff = fit_rolloff(spectrum, fit.hurst);
  }
  if (!fit.hurst.found()) return fit;
  fit.short_cutoff = find_short_cutoff(spectrum, fit.hurst);
  return fit;
}

}  // namespace salebra
