// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::detail {

/// Hertz's contact of an elliptic paraboloid, by the two radii that make it look like a sphere's:
///     F = (4/3)E*√force_radius δ^{3/2},   A = π area_radius δ.
struct HertzEllipse {
  double force_radius, area_radius;
};

/// curvature1 >= curvature2 >= 0, curvature1 > 0. Exact (complete elliptic integrals) down to a
/// ratio of 1e-3: a summit that is longer than that is a ridge whose ends the paraboloid does not
/// know, and is taken to have that ratio.
HertzEllipse hertz_ellipse(double curvature1, double curvature2);

}  // namespace salebra::detail
