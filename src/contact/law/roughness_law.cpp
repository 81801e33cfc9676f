// SPDX-License-Identifier: GPL-3.0-or-later
// Decay length of the force law of a joint from the roughness of its sides.
#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/roughness_law.hpp>

namespace salebra {
namespace {

/// l/h with its 95 % limits.
struct Ratio {
  double low, middle, high;
};
using Row = std::array<Ratio, 5>;

constexpr std::array loads{5e-4, 2e-3, 8e-3, 3e-2, 1e-1};
constexpr std::array skewnesses{-1.4, -1.05, -0.8, -0.6, -0.4, -0.2, 0.0};
constexpr std::array<Row, 7> by_skewness{{{{{0.02, 0.10, 0.20},
                                            {0.03, 0.14, 0.22},
                                            {0.05, 0.17, 0.26},
                                            {0.08, 0.20, 0.30},
                                            {0.12, 0.22, 0.30}}},
                                          {{{0.02, 0.12, 0.21},
                                            {0.03, 0.15, 0.23},
                                            {0.06, 0.19, 0.27},
                                            {0.11, 0.23, 0.31},
                                            {0.17, 0.28, 0.32}}},
                                          {{{0.02, 0.16, 0.24},
                                            {0.04, 0.19, 0.27},
                                            {0.07, 0.24, 0.31},
                                            {0.14, 0.29, 0.35},
                                            {0.22, 0.32, 0.36}}},
                                          {{{0.03, 0.19, 0.29},
                                            {0.06, 0.23, 0.32},
                                            {0.11, 0.28, 0.36},
                                            {0.18, 0.34, 0.39},
                                            {0.27, 0.35, 0.39}}},
                                          {{{0.05, 0.22, 0.35},
                                            {0.09, 0.27, 0.36},
                                            {0.13, 0.33, 0.39},
                                            {0.22, 0.37, 0.42},
                                            {0.31, 0.37, 0.41}}},
                                          {{{0.07, 0.26, 0.40},
                                            {0.12, 0.31, 0.41},
                                            {0.18, 0.37, 0.44},
                                            {0.29, 0.41, 0.46},
                                            {0.35, 0.40, 0.44}}},
                                          {{{0.17, 0.30, 0.43},
                                            {0.24, 0.36, 0.43},
                                            {0.31, 0.41, 0.47},
                                            {0.37, 0.45, 0.50},
                                            {0.39, 0.43, 0.47}}}}};
/// All pairs of the ensemble, for sides of unknown skewness.
constexpr Row of_all{{{0.03, 0.20, 0.40},
                      {0.06, 0.25, 0.41},
                      {0.09, 0.30, 0.44},
                      {0.13, 0.35, 0.47},
                      {0.18, 0.36, 0.46}}};

Ratio between(const Ratio& a, const Ratio& b, double share) {
  return {std::lerp(a.low, b.low, share), std::lerp(a.middle, b.middle, share),
          std::lerp(a.high, b.high, share)};
}

/// Position of x on a scale: the number of the point below, and the share of the way to the next.
template <std::size_t count>
std::pair<std::size_t, double> position(const std::array<double, count>& scale, double x) {
  const auto above = std::ranges::upper_bound(scale, x) - scale.begin();
  const auto below =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(count) - 2));
  return {below, std::clamp((x - scale[below]) / (scale[below + 1] - scale[below]), 0.0, 1.0)};
}

Row row_of(double skewness) {
  if (std::isnan(skewness)) return of_all;
  const auto [below, share] = position(skewnesses, skewness);
  Row row;
  for (std::size_t k = 0; k < row.size(); ++k)
    row[k] = between(by_skewness[below][k], by_skewness[below + 1][k], share);
  return row;
}

Ratio ratio_of(const Row& row, double load) {
  if (std::isnan(load)) {
    Ratio any = row[loads.size() / 2];
    for (const Ratio& one : row) {
      any.low = std::min(any.low, one.low);
      any.high = std::max(any.high, one.high);
    }
    return any;
  }
  std::array<double, loads.size()> scale;
  std::ranges::transform(loads, scale.begin(), [](double one) { return std::log(one); });
  const auto [below, share] = position(scale, std::log(load));
  return between(row[below], row[below + 1], share);
}

void check(const SideRoughness& side) {
  require_positive(side.rms_height, "rms_height");
  if (!std::isnan(side.rms_slope)) require_positive(side.rms_slope, "rms_slope");
  require(!(side.skewness < -2 || side.skewness > 0.3), "skewness", side.skewness,
          "must be from -2 to 0.3, where contacts were computed; give a map of the surface");
}

}  // namespace

RoughnessLaw law_of_roughness(const std::vector<SideRoughness>& sides,
                              double pressure_over_modulus) {
  require(sides.size() == 1 || sides.size() == 2, "rms_height", sides.size(),
          "values are given; a joint has two sides, of which one may be smooth");
  RoughnessLaw law;
  double height = 0, slope = 0, cube = 0;
  for (const SideRoughness& side : sides) {
    check(side);
    height += side.rms_height * side.rms_height;
    slope += side.rms_slope * side.rms_slope;
    cube += side.skewness * std::pow(side.rms_height, 3);
  }
  law.rms_height = std::sqrt(height);
  law.rms_slope = std::sqrt(slope);
  law.skewness = cube / std::pow(height, 1.5);
  if (!std::isnan(pressure_over_modulus))
    require_positive(pressure_over_modulus, "pressure_over_modulus");
  law.relative_pressure = pressure_over_modulus / law.rms_slope;
  require(
      !(law.relative_pressure < loads.front() || law.relative_pressure > loads.back()), "pressure",
      law.relative_pressure,
      "of E* times the rms slope is outside 0.0005 to 0.1, where contacts were computed; give a "
      "map of the surfaces");
  Row row = row_of(law.skewness);
  // The sum of two sides is less skew than one alone: the ensemble of pairs does not hold for it.
  if (sides.size() == 1 && std::isnan(law.skewness))
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k].low = std::min(row[k].low, by_skewness.front()[k].low);
      row[k].high = std::max(row[k].high, by_skewness.back()[k].high);
    }
  const Ratio ratio = ratio_of(row, law.relative_pressure);
  law.decay_length = ratio.middle * law.rms_height;
  law.decay_length_low = ratio.low * law.rms_height;
  law.decay_length_high = ratio.high * law.rms_height;
  return law;
}

}  // namespace salebra
