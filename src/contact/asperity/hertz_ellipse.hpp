// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::detail {

/// Hertz contact of an elliptic paraboloid. Two radii put it into the formulas of a sphere:
///     F = (4/3)E*√force_radius δ^{3/2},   A = π area_radius δ.
struct HertzEllipse {
  double force_radius, area_radius;
};

/// Hertz contact of a paraboloid with the principal curvatures curvature1 >= curvature2 >= 0,
/// curvature1 > 0. Exact (complete elliptic integrals) down to curvature2/curvature1 = 1e-3. With a
/// smaller ratio the summit is a ridge, whose ends the paraboloid does not describe; the ratio is
/// then set to 1e-3.
HertzEllipse hertz_ellipse(double curvature1, double curvature2);

}  // namespace salebra::detail
