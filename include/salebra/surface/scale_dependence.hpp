// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/axis.hpp>
#include <vector>

namespace salebra {

/// Slope and curvature along one axis by finite differences over s = k steps, k from one step on,
/// k+1 or about a tenth apart, as long as the stencil fits twice into the profile, as Sanner et al.
/// (2022):
///     slope       (h(x+s) − h(x))/s,               over the distance s
///     curvature   (h(x+s) − 2h(x) + h(x−s))/s²,    over the distance 2s, the length of its stencil
/// over all stencils that touch no undefined point, with wrap where the surface is periodic. An
/// entry stands for the distance s of the slope; the curvature beside it belongs to 2s.
struct ScaleDependence {
  std::vector<double> spacing;        ///< s, m
  std::vector<double> profile_slope;  ///< √⟨slope²⟩ = √S(s)/s of the structure function
  std::vector<double> profile_curvature;  ///< √⟨curvature²⟩, 1/m
  std::vector<double> min_curvature;      ///< of all stencils: the sharpest peak, 1/m
  std::vector<Index> stencils;            ///< of the curvature
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

/// Throws InvalidInput if the heights have not the shape of the grid or hold no complete stencil of
/// three neighbours along the axis. Cost: one pass over memory, with about 40 over each profile of
/// 1000 points. A surface may be spread over processes, as in height_statistics.
ScaleDependence scale_dependence(const Surface& surface, Axis axis);

/// Wavelengths below which a measured surface is the instrument's rather than its own.
struct ReliabilityOptions {
  std::optional<double> tip_radius = {};  ///< of a scanning probe, m
  std::optional<double> resolution = {};  ///< lateral, of an optical instrument, m
  double safety_factor = 0.5;             ///< of the tip's curvature that peaks may have, > 0
};

struct ReliabilityLimit {
  double pixel = 0;  ///< 2·max(dx, dy): no grid holds shorter waves, m
  /// Least stencil length 2s from which on no curvature along x or y is below
  /// −safety_factor/tip_radius: a tip cannot see sharper peaks. 0 where even the grid itself shows
  /// none, infinity where all scales do. m
  std::optional<double> tip = {};
  std::optional<double> resolution = {};  ///< as given, m

  double wavelength() const;  ///< the longest of them, m
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

/// Throws InvalidInput unless radius, resolution and factor are > 0, and as scale_dependence.
ReliabilityLimit short_wavelength_limit(const Surface& surface, const ReliabilityOptions& options);

}  // namespace salebra
