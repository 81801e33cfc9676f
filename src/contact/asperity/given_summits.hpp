// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <string>
#include <vector>

namespace salebra::detail {

/// The parameters of a summit in Hertz's theory (hertz_ellipse.hpp).
struct HertzCap {
  double height;  ///< above the mean summit height, m
  double force_radius, area_radius;
};

/// Returns a cap for each summit, in the order of the summits. Throws InvalidInput for an empty
/// list, or a summit without a finite height and a curvature > 0.
std::vector<HertzCap> hertz_caps(const std::vector<Summit>& summits, SummitShape shape);

/// The parameters that every asperity model needs, from these summits; throws like hertz_caps().
AsperityModel::Common given_summits(std::string name, const std::vector<Summit>& summits,
                                    const Material& material, double nominal_area,
                                    double mean_plane, double rms_height);

}  // namespace salebra::detail
