// SPDX-License-Identifier: GPL-3.0-or-later
// Roll-off and short cut-off of a self-affine spectrum by maximum likelihood, with intervals.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/surface/self_affine_fit.hpp>
#include <vector>

#include "base/special_values.hpp"
#include "surface/dense_systems.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

using detail::unknown;
constexpr IntervalEstimate not_found{unknown, unknown, unknown};
constexpr double ended = 1e-3;        ///< of the law, where power counts as none
constexpr double bins_per_unit = 64;  ///< of ln q, for the likelihood

/// Modes of nearly one wave number: a mean over them is enough for a law that is straight in ln q.
struct Ring {
  double x = 0;       ///< ln q
  double power = 0;   ///< mean
  double weight = 0;  ///< independent complex amplitudes
};

std::vector<Ring> fine_rings(const PowerSpectrum& spectrum, double lowest, double highest) {
  std::vector<Ring> rings;
  const double start = std::log(lowest);
  for (Index i = 0; i < spectrum.grid.nx; ++i) {
    for (Index j = 0; j < spectrum.psd.cols(); ++j) {
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      if (!(q > 0) || q < lowest || q > highest) continue;
      const auto number = static_cast<std::size_t>((std::log(q) - start) * bins_per_unit);
      if (number >= rings.size()) rings.resize(number + 1);
      const double weight = spectrum.multiplicity(j) / 2;
      rings[number].weight += weight;
      rings[number].x += weight * std::log(q);
      rings[number].power += weight * spectrum.psd(i, j);
    }
  }
  std::erase_if(rings, [](const Ring& ring) { return ring.weight == 0; });
  for (Ring& ring : rings) {
    ring.x /= ring.weight;
    ring.power /= ring.weight;
  }
  return rings;
}

/// Twice the negative logarithm of the greatest likelihood of ln C = a − b·max(0, x − kink) over a and b.
double deviance(const std::vector<Ring>& rings, double kink) {
  // The likelihood of exponential variates is log-concave in a and b: Newton's method, halving a step that goes too far.
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
  const double longest = 2 * pi / std::min(spectrum.grid.lx, spectrum.grid.ly);
  const double lowest = spectrum.windowed
                            ? 3.5 * longest
                            : 0.999 * 2 * pi / std::max(spectrum.grid.lx, spectrum.grid.ly);
  const std::vector<Ring> rings = fine_rings(spectrum, lowest, hurst.wavenumber_max);
  if (rings.size() < 8) return not_found;
  const double first = rings.front().x, last = rings.back().x;
  // ±: a kink below the first ring is no plateau at all, and one near the last leaves no law.
  constexpr int steps = 200;
  const auto place = [&](int k) { return first + (last - first) * k / steps; };
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(deviance(rings, place(k)));
  const auto least = std::ranges::min_element(values);
  const auto best = static_cast<int>(least - values.begin());
  const double limit = gsl_cdf_chisq_Pinv(0.95, 1) * spectrum.correlated_modes;

  // The least deviance between the places, by golden section.
  constexpr double golden = 0.6180339887498949;
  double left = place(std::max(best - 1, 0)), right = place(std::min(best + 1, steps));
  for (int k = 0; k < 30; ++k) {
    const double a = right - golden * (right - left), b = left + golden * (right - left);
    if (deviance(rings, a) < deviance(rings, b))
      right = b;
    else
      left = a;
  }
  const double kink = (left + right) / 2;
  const double threshold = std::min(*least, deviance(rings, kink)) + limit;
  if (values.front() < threshold || values.back() < threshold) return not_found;
  // Where the deviance passes the threshold, from either side inwards.
  const auto crossing = [&](int from, int direction) {
    int k = from;
    while (values[static_cast<std::size_t>(k)] >= threshold && k != best) k += direction;
    double outside = place(k - direction), inside = k == best ? kink : place(k);
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
  struct Mode {
    double wavenumber = 0, power = 0;
  };
  std::vector<Mode> modes;
  double level = 0, weight = 0;
  const double exponent = 2 * (1 + hurst.value);
  for (Index i = 0; i < spectrum.grid.nx; ++i) {
    for (Index j = 0; j < spectrum.psd.cols(); ++j) {
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      if (!(q > 0)) continue;
      const double flat = spectrum.psd(i, j) * std::pow(q, exponent);
      if (q >= hurst.wavenumber_min && q <= hurst.wavenumber_max) {
        level += flat;
        ++weight;
      }
      if (q > hurst.wavenumber_min) modes.push_back({q, flat});
    }
  }
  level /= weight;
  std::ranges::sort(modes, {}, &Mode::wavenumber);
  // A mode of the law is below a thousandth of it with a probability of a thousandth: a run of them is the end.
  std::size_t last = modes.size();
  while (last > 0 && modes[last - 1].power < ended * level) --last;
  if (last == 0 || last == modes.size()) return not_found;
  const Grid2D& grid = spectrum.grid;
  const double step = 2 * pi / std::min(grid.lx, grid.ly);
  const double low = modes[last - 1].wavenumber, high = modes[last].wavenumber;
  // Modes of no power that lie beyond are all there are: with fewer than a ring of them the end may be the lattice's own.
  if (modes.back().wavenumber < high + 4 * step) return not_found;
  const double margin = spectrum.windowed ? 2 * step : 0;
  const double middle = (low + high) / 2 - margin / 2;
  return {2 * pi / middle, 2 * pi / high, 2 * pi / (low - 2 * margin)};
}

}  // namespace

SelfAffineFit fit_self_affine(const PowerSpectrum& spectrum) {
  SelfAffineFit fit{estimate_hurst(spectrum), not_found, not_found};
  if (!fit.hurst.found()) return fit;
  fit.rolloff = fit_rolloff(spectrum, fit.hurst);
  fit.short_cutoff = find_short_cutoff(spectrum, fit.hurst);
  return fit;
}

}  // namespace salebra
