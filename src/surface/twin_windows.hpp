// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "surface/twin_response.hpp"

/// Windows of scans and cells of spectra, for the responses of isotropic surfaces and of surfaces
/// with a lay.
namespace salebra::twin_detail {

using std::numbers::pi;

constexpr double tilt = 3.4;        ///< C ∝ κ^−tilt within a cell of the spectrum C
constexpr double longest = 0.01;    ///< κ of the longest waves
constexpr double max_tapered = 30;  ///< maximum κ of waves in the bins of the sine tapers
constexpr double max_hann = 60;
constexpr double window_reach =
    10;  ///< distance in modes beyond which a Hann window passes less than 1e-7 of a wave
constexpr double flat_above =
    3;  ///< κ above which the plane of a wave is negligible in the modes of the Hann bins

inline double sinc(double x) { return std::abs(x) < 1e-8 ? 1 : std::sin(pi * x) / (pi * x); }

inline double sinc_slope(double x) {
  if (std::abs(x) < 1e-3) return -pi * pi * x / 3 * (1 - pi * pi * x * x / 10);
  return (std::cos(pi * x) - sinc(x)) / x;
}

/// Window w(ξ) along one side, −½ <= ξ <= ½. Its Fourier transform at the frequency δ,
/// counted in modes of the side, is ∫w(ξ) e^{2πiδξ}dξ. combined(taper, δ, sinc) returns this
/// transform, without the factor i that it has for the odd taper second_sine; combined(taper, δ,
/// sinc_slope) returns its derivative with respect to δ.
enum class Taper { first_sine, second_sine, hann };

template <class Kernel>
double combined(Taper taper, double delta, const Kernel& kernel) {
  switch (taper) {
    case Taper::first_sine:
      return std::numbers::sqrt2 / 2 * (kernel(delta - 0.5) + kernel(delta + 0.5));
    case Taper::second_sine:
      return std::numbers::sqrt2 / 2 * (kernel(delta + 1) - kernel(delta - 1));
    case Taper::hann:
      break;
  }
  return std::sqrt(8.0 / 3) * (kernel(delta) / 2 + (kernel(delta - 1) + kernel(delta + 1)) / 4);
}

/// Area of the ring from κ = a to b, weighted by the spectrum relative to its value at κ = c:
/// ∫κ^{1−tilt} dκ·2π c^tilt, with c = `centre`.
inline double ring(double a, double b, double centre) {
  a = std::max(a, 1e-3 * b);
  return 2 * pi * std::pow(centre, tilt) * (std::pow(a, 2 - tilt) - std::pow(b, 2 - tilt)) /
         (tilt - 2);
}

inline Response empty_response(double highest, std::size_t bins) {
  Response response;
  const double ratio = std::pow(1.15, 1.0 / 3);
  const auto down = static_cast<int>(std::ceil(std::log(8.5 / longest) / std::log(ratio)));
  response.limits.push_back(0);
  for (int j = -down;; ++j) {
    const double limit = 8.5 * std::pow(1.15, j / 3.0);
    response.middle.push_back(response.limits.size() == 1
                                  ? limit / std::sqrt(ratio)
                                  : std::sqrt(limit * response.limits.back()));
    response.limits.push_back(limit);
    if (limit > highest) break;
  }
  response.bins = bins;
  response.weights.assign(response.middle.size() * bins, 0.0);
  return response;
}

inline std::size_t cell_of(const Response& response, double kappa) {
  const auto after = std::ranges::upper_bound(response.limits, kappa) - response.limits.begin();
  return std::min(static_cast<std::size_t>(after) - 1, response.middle.size() - 1);
}

/// Fraction of a wave's power that is found, through a Hann window, at wave numbers below its own
/// plus `modes` modes.
inline double hann_below(double modes) {
  constexpr double reach_of_table = 8, spacing = 0.02;
  static const std::vector<double> table = [] {
    std::vector<double> sums{0};
    for (double at = -reach_of_table + spacing / 2; at < reach_of_table; at += spacing)
      sums.push_back(sums.back() + spacing * std::pow(combined(Taper::hann, at, sinc), 2));
    for (double& sum : sums) sum /= sums.back();
    return sums;
  }();
  const double position = (modes + reach_of_table) / spacing;
  if (position <= 0) return 0;
  if (position >= static_cast<double>(table.size() - 1)) return 1;
  const auto before = static_cast<std::size_t>(position);
  return table[before] +
         (position - static_cast<double>(before)) * (table[before + 1] - table[before]);
}

}  // namespace salebra::twin_detail
