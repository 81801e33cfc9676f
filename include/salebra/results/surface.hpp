// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/results/describe.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

namespace salebra {

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<Grid2D>) {
  using enum Dimension;
  visit(&Grid2D::nx, Quantity{"nx", dimensionless, "points along x"});
  visit(&Grid2D::ny, Quantity{"ny", dimensionless, "points along y"});
  visit(&Grid2D::lx, Quantity{"size_x", length, "length of the surface along x"});
  visit(&Grid2D::ly, Quantity{"size_y", length, "length of the surface along y"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<HeightStatistics>) {
  using enum Dimension;
  using S = HeightStatistics;
  visit(&S::defined_points, Kept{"defined_points", "points with a height"});
  visit(&S::minimum, Kept{"minimum", "lowest height, m"});
  visit(&S::maximum, Kept{"maximum", "highest height, m"});
  visit(&S::mean, Kept{"mean", "mean height, m"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::skewness, Quantity{"skewness", dimensionless, "skewness of heights"});
  visit(&S::kurtosis, Quantity{"kurtosis", dimensionless, "kurtosis of heights, 3 for a Gaussian"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<SpectralMoments>) {
  using enum Dimension;
  using S = SpectralMoments;
  visit(&S::moment0, Quantity{"moment0", length_squared, "spectral moment m0"});
  visit(&S::moment2_x, Kept{"moment2_x", "mean square slope along x"});
  visit(&S::moment2_y, Kept{"moment2_y", "mean square slope along y"});
  visit(&S::moment4_x, Kept{"moment4_x", "mean square curvature along x, 1/m^2"});
  visit(&S::moment4_y, Kept{"moment4_y", "mean square curvature along y, 1/m^2"});
  visit(&S::moment2, Quantity{"moment2", dimensionless, "spectral moment m2 of a profile"});
  visit(&S::moment4,
        Quantity{"moment4", inverse_length_squared, "spectral moment m4 of a profile"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::nayak, Quantity{"nayak", dimensionless, "Nayak parameter m0 m4 / m2^2"});
}

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<SummitStatistics>) {
  using enum Dimension;
  using S = SummitStatistics;
  visit(&S::density, Quantity{"summit_density", inverse_length_squared, "summits per area"});
  visit(&S::mean_height,
        Quantity{"mean_height", length, "mean summit height above the mean plane"});
  visit(&S::rms_height, Quantity{"summit_rms", length, "standard deviation of summit heights"});
  visit(&S::mean_radius, Quantity{"mean_radius", length, "mean radius of summits"});
}

}  // namespace salebra
