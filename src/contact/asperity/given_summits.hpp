// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <string>
#include <vector>

namespace salebra::detail {

/// A summit as Hertz's theory sees it (hertz_ellipse.hpp).
struct HertzCap {
  double height;  ///< from the mean of the summits, m
  double force_radius, area_radius;
};

/// The caps in the order of the summits. Throws InvalidInput for no summits, or one without a
/// finite height and a curvature > 0.
std::vector<HertzCap> hertz_caps(const std::vector<Summit>& summits, SummitShape shape);

/// What a model of these summits has in common with others; throws as hertz_caps.
AsperityModel::Common given_summits(std::string name, const std::vector<Summit>& summits,
                                    const Material& material, double nominal_area,
                                    double mean_plane, double rms_height);

}  // namespace salebra::detail
