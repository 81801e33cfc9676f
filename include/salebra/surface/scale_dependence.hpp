// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/axis.hpp>
#include <vector>

namespace salebra {

/// Scale-dependent slope and curvature along one axis by finite differences [Sanner et al. (2022)].
/// The distance s starts at one point spacing and grows each time by one spacing or by about a
/// tenth, whichever is more, as long as the stencil of the curvature fits twice into the profile:
///     slope       (h(x+s) − h(x))/s,               over the distance s
///     curvature   (h(x+s) − 2h(x) + h(x−s))/s²,    over the distance 2s, the length of its stencil
/// All stencils without undefined points count, across the border too if the surface is periodic.
/// In each entry, the slope is that over the distance s, the curvature that over the distance 2s.
struct ScaleDependence {
  std::vector<double> spacing;            ///< s, m
  std::vector<double> profile_slope;      ///< √⟨slope²⟩ = √S(s)/s, S: structure function
  std::vector<double> profile_curvature;  ///< √⟨curvature²⟩, 1/m
  std::vector<double> min_curvature;      ///< minimum over all stencils: the sharpest peak, 1/m
  std::vector<Index> stencils;            ///< number of stencils of the curvature
};

constexpr void describe(auto&& visit, std::type_identity<ScaleDependence>) {
  using enum Dimension;
  using S = ScaleDependence;
  visit(&S::spacing, Quantity{"spacing", length, "distance s of the differences"});
  visit(&S::profile_slope, Quantity{"profile_slope", dimensionless, "rms of (h(x+s) - h(x))/s"});
  visit(&S::profile_curvature,
        Quantity{"profile_curvature", inverse_length, "rms of (h(x+s) - 2 h(x) + h(x-s))/s^2"});
  visit(&S::min_curvature,
        Quantity{"min_curvature", inverse_length, "curvature of the sharpest peak"});
  visit(&S::stencils, Quantity{"stencils", dimensionless, "stencils of the curvature"});
}

/// Computes slope and curvature over distance:
///     const ScaleDependence scales = scale_dependence(surface, Axis::x);
/// Throws InvalidInput if the heights do not have the shape of the grid or have no complete stencil
/// of three neighbours along the axis. Cost: one pass through memory, in which each profile of 1000
/// points is evaluated at about 40 distances. The surface may be distributed over processes, as in
/// height_statistics.
ScaleDependence scale_dependence(const Surface& surface, Axis axis);

/// Inputs for finding the wavelength below which a scan shows the instrument, not the surface.
struct ReliabilityOptions {
  std::optional<double> tip_radius = {};  ///< radius of a scanning probe, m
  std::optional<double> resolution = {};  ///< lateral resolution of an optical instrument, m
  double safety_factor = 0.5;             ///< largest peak curvature over the tip's, > 0
};

struct ReliabilityLimit {
  double pixel = 0;  ///< 2·max(dx, dy), m: the grid holds no shorter waves
  /// Limit set by the tip, m, which cannot resolve sharper peaks: the smallest stencil length 2s
  /// such that, at this and all larger lengths, no curvature along x or y is below
  /// −safety_factor/tip_radius. 0 if there is no such curvature at any length, infinity if there is
  /// one at the largest length.
  std::optional<double> tip = {};
  std::optional<double> resolution = {};  ///< ReliabilityOptions::resolution, m

  double wavelength() const;  ///< longest of pixel, tip and resolution, m
};

constexpr void describe(auto&& visit, std::type_identity<ReliabilityLimit>) {
  using enum Dimension;
  using S = ReliabilityLimit;
  visit(&S::pixel,
        Quantity{"pixel_limit", length, "two cells, the shortest wavelength of the grid"});
  visit(&S::tip,
        Quantity{"tip_limit", length, "wavelength below which the tip shows in the curvatures"});
  visit(&S::resolution, Quantity{"resolution", length, "lateral resolution of the instrument"});
  visit(&S::wavelength, Quantity{"wavelength", length, "shortest reliable wavelength"});
}

/// Finds the shortest reliable wavelength of a scan:
///     const double limit = short_wavelength_limit(surface, {.tip_radius = 10e-9}).wavelength();
/// Throws InvalidInput unless tip radius, resolution and safety factor are > 0, and wherever
/// scale_dependence does.
ReliabilityLimit short_wavelength_limit(const Surface& surface, const ReliabilityOptions& options);

}  // namespace salebra
