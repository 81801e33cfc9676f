// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Bearing curve c(p) of Abbott and Firestone: the area fraction p, 0 <= p <= 1, of the surface
/// lies above the height c(p), which falls with p. Each defined point represents one cell of area
/// 1/N: with the N heights sorted from the highest, z_0, to the lowest, c((k + ½)/N) = z_k. The
/// curve is linear between these values of p, and constant below p = ½/N and above p = 1 − ½/N.
///     const double median = BearingCurve(surface).height(0.5);
class BearingCurve {
 public:
  /// Throws InvalidInput wherever height_statistics does. Cost: a sorted copy of the heights.
  explicit BearingCurve(const Surface& surface);

  /// c(p), m; ISO 25178-2 Smc(p). Throws InvalidInput unless 0 <= p <= 1.
  double height(double area_fraction) const;
  /// Fraction of the surface above a height given in m; ISO 25178-2 Smr(c). It is 0 above all
  /// heights and 1 below them.
  double area_fraction(double height) const;
  /// ∫ c(p) dp from p = `from` to p = `to`, m; exact for the piecewise linear curve.
  double integral(double from, double to) const;

  const std::vector<double>& heights() const { return heights_; }  ///< z_k, falling, m

 private:
  std::vector<double> heights_;
  static constexpr Index stride = 4096;
  std::vector<double> sums_;  ///< sum of z_i − z_0 over i < k, for every k that is a multiple of
                              ///< `stride`

  double sum_of(Index begin, Index end) const;
};

/// Core, peaks and valleys of a bearing curve by ISO 25178-2 (and ISO 13565-2). The core is the
/// least-squares line through the section of the curve of width 40 % in p whose secant is flattest
/// (the first such section, if there are several). The heights of this line at p = 0 and p = 1 are
/// the upper and the lower limit of the core; Sk is their difference. Smr1 and Smr2 are the p at
/// which the curve crosses the upper and the lower limit. Spk is the height of a triangle on the
/// base Smr1 with the area between the curve and the upper limit; Svk is likewise that of a
/// triangle on the base 1 − Smr2 at the lower limit.
struct CoreParameters {
  double core_height = 0;    ///< Sk, m
  double peak_height = 0;    ///< Spk, m; 0 if no peak rises above the core
  double valley_depth = 0;   ///< Svk, m; 0 if no valley lies below the core
  double peak_fraction = 0;  ///< Smr1, between 0 and 1
  double core_fraction = 0;  ///< Smr2, between 0 and 1
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

/// Computes the core parameters, e.g. `core_parameters(BearingCurve(surface))`. Cost: two passes
/// over the heights.
CoreParameters core_parameters(const BearingCurve& curve);

/// Heights in bins of equal width from the lowest to the highest defined height.
struct HeightHistogram {
  std::vector<double> height;          ///< middle of the bin, m
  std::vector<double> height_density;  ///< fraction of all points in the bin over its width, 1/m
  std::vector<Index> points;           ///< number of points in the bin
  double width = 0;  ///< width of a bin, m; 0, with infinite density, if all heights are equal
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

/// Computes the histogram of heights, e.g. `height_histogram(BearingCurve(surface))`. With bins =
/// 0, the bins have the width 2·(interquartile range)/N^(1/3) of Freedman and Diaconis (1981) for N
/// points, but there are at least 10 and at most 200 bins, and one bin if all heights are equal.
/// Throws InvalidInput for bins < 0.
HeightHistogram height_histogram(const BearingCurve& curve, int bins = 0);

}  // namespace salebra
