// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Abbott and Firestone's bearing curve c(p): the height above which the part p of the surface
/// lies, 0 <= p <= 1, falling. Each defined point stands for one cell: with heights z_0 >= z_1 >= …
/// of N points, c((k + ½)/N) = z_k, straight between, level beyond the first and the last.
class BearingCurve {
 public:
  /// Throws InvalidInput as height_statistics. Cost: one sort of the heights; memory: a copy of
  /// them.
  explicit BearingCurve(const Surface& surface);

  /// c(p), m; ISO 25178-2 Smc(p). Throws InvalidInput unless 0 <= p <= 1.
  double height(double area_fraction) const;
  /// The part of the surface that lies above a height, m; ISO 25178-2 Smr(c). 0 above all, 1 below
  /// all heights.
  double area_fraction(double height) const;
  /// ∫ c dp from `from` to `to`, m: exact for the polygon.
  double integral(double from, double to) const;

  const std::vector<double>& heights() const { return heights_; }  ///< z_k, falling, m

 private:
  std::vector<double> heights_;
  static constexpr Index stride = 4096;
  std::vector<double> sums_;  ///< of z_0 … z_{k−1} less z_0, for every k that is a multiple

  double sum_of(Index begin, Index end) const;
};

/// Core, peaks and valleys of a bearing curve by ISO 25178-2 (and ISO 13565-2). The core is the
/// straight line fitted by least squares to the 40 % of the curve whose secant is flattest (the
/// first of several); its heights at p = 0 and 1 are the upper and lower limit of the core, Sk
/// apart. Spk and Svk are heights of the triangles over Smr1 and under 1 − Smr2 that have the area
/// between curve and limit.
struct CoreParameters {
  double core_height = 0;    ///< Sk, m
  double peak_height = 0;    ///< Spk, m; 0 where nothing stands above the core
  double valley_depth = 0;   ///< Svk, m; 0 where nothing lies below the core
  double peak_fraction = 0;  ///< Smr1, 0 … 1
  double core_fraction = 0;  ///< Smr2, 0 … 1
};

constexpr void describe(auto&& visit, std::type_identity<CoreParameters>) {
  using enum Dimension;
  using S = CoreParameters;
  visit(&S::core_height, Kept{"core_height", "Sk", length});
  visit(&S::peak_height, Kept{"peak_height", "Spk", length});
  visit(&S::valley_depth, Kept{"valley_depth", "Svk", length});
  visit(&S::peak_fraction, Kept{"peak_fraction", "Smr1"});
  visit(&S::core_fraction, Kept{"core_fraction", "Smr2"});
}

/// Cost: two passes.
CoreParameters core_parameters(const BearingCurve& curve);

/// Heights in bins of equal width from the lowest to the highest defined height.
struct HeightHistogram {
  std::vector<double> height;          ///< middle of the bin, m
  std::vector<double> height_density;  ///< part of the points in the bin over its width, 1/m; ∫ = 1
  std::vector<Index> points;           ///< in the bin
  double width = 0;  ///< of a bin, m; 0, and an infinite density, if all heights are equal
};

constexpr void describe(auto&& visit, std::type_identity<HeightHistogram>) {
  using enum Dimension;
  using S = HeightHistogram;
  visit(&S::height, Quantity{"height", length, "height"});
  visit(&S::height_density,
        Quantity{"height_density", inverse_length, "share of the points in a bin over its width"});
  visit(&S::points, Quantity{"points", dimensionless, "number of points"});
  visit(&S::width, Kept{"width", "width of a bin", length});
}

/// bins   0: of width 2·(interquartile range)/N^(1/3) of Freedman and Diaconis (1981), 10 … 200 of
///        them. One bin if all heights are
/// equal. Throws InvalidInput for bins < 0.
HeightHistogram height_histogram(const BearingCurve& curve, int bins = 0);

}  // namespace salebra
