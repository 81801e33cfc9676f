// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// Bearing curve c(p) of Abbott and Firestone: the area fraction p, 0 <= p <= 1, of the surface
/// lies above the height c(p), which falls with p. Each defined point represents one cell: for N
/// sorted heights z_0 >= z_1 >= …, c((k + ½)/N) = z_k, linear in between and constant beyond both
/// ends.
///     const double median = BearingCurve(surface).height(0.5);
class BearingCurve {
 public:
  /// Throws InvalidInput as height_statistics does. Cost: one sort of the heights and a copy of
  /// them.
  explicit BearingCurve(const Surface& surface);

  /// c(p), m; ISO 25178-2 Smc(p). Throws InvalidInput unless 0 <= p <= 1.
  double height(double area_fraction) const;
  /// Fraction of the surface above a height given in m; ISO 25178-2 Smr(c). It is 0 above all
  /// heights and 1 below them.
  double area_fraction(double height) const;
  /// ∫ c dp from `from` to `to`, m; exact for the piecewise linear curve.
  double integral(double from, double to) const;

  const std::vector<double>& heights() const { return heights_; }  ///< z_k, falling, m

 private:
  std::vector<double> heights_;
  static constexpr Index stride = 4096;
  std::vector<double> sums_;  ///< sum of z_i − z_0 over i < k, for every k that is a multiple of
                              ///< `stride`

  double sum_of(Index begin, Index end) const;
};

/// Core, peaks and valleys of a bearing curve by ISO 25178-2 (and ISO 13565-2). The core is a
/// least-squares line through the 40 % of the curve with the flattest secant (the first, if there
/// are several). Its heights at p = 0 and p = 1 are the upper and lower limit of the core and
/// differ by Sk. Spk and Svk are the heights of triangles on the bases Smr1 and 1 − Smr2 with the
/// same area as between curve and limit.
struct CoreParameters {
  double core_height = 0;    ///< Sk, m
  double peak_height = 0;    ///< Spk, m; 0 if no peak rises above the core
  double valley_depth = 0;   ///< Svk, m; 0 if no valley lies below the core
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

/// Computes the core parameters, e.g. `core_parameters(BearingCurve(surface))`. Cost: two passes.
CoreParameters core_parameters(const BearingCurve& curve);

/// Heights in bins of equal width from the lowest to the highest defined height.
struct HeightHistogram {
  std::vector<double> height;          ///< middle of the bin, m
  std::vector<double> height_density;  ///< fraction of the points in the bin per width, 1/m; ∫ = 1
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

/// Computes the histogram of heights, e.g. `height_histogram(BearingCurve(surface))`. With bins = 0
/// it has 10 … 200 bins of the width 2·(interquartile range)/N^(1/3) of Freedman and Diaconis
/// (1981), and one bin if all heights are equal. Throws InvalidInput for bins < 0.
HeightHistogram height_histogram(const BearingCurve& curve, int bins = 0);

}  // namespace salebra
