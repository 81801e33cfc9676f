// SPDX-License-Identifier: GPL-3.0-or-later
// Hertzian caps of a list of measured summits, and the parameters that their models share.
#include "given_summits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>

#include "hertz_ellipse.hpp"

namespace salebra::detail {
namespace {

double mean_of_heights(const std::vector<Summit>& summits) {
  require(!summits.empty(), "summits", 0, "given; a contact needs at least one");
  double sum = 0;
  for (const Summit& summit : summits) {
    require(std::isfinite(summit.height), "summits.height", summit.height, "must be finite");
    require_positive(summit.curvature1 + summit.curvature2, "summits.curvature");
    sum += summit.height;
  }
  return sum / static_cast<double>(summits.size());
}

}  // namespace

std::vector<HertzCap> hertz_caps(const std::vector<Summit>& summits, SummitShape shape) {
  const double mean = mean_of_heights(summits);
  std::vector<HertzCap> caps;
  caps.reserve(summits.size());
  for (const Summit& summit : summits) {
    HertzCap cap{summit.height - mean, summit.mean_radius(), summit.mean_radius()};
    if (shape == SummitShape::elliptical) {
      const auto [larger, smaller] =
          std::minmax({summit.curvature1, summit.curvature2}, std::ranges::greater{});
      const HertzEllipse ellipse = hertz_ellipse(larger, smaller);
      cap.force_radius = ellipse.force_radius;
      cap.area_radius = ellipse.area_radius;
    }
    caps.push_back(cap);
  }
  return caps;
}

AsperityModel::Common given_summits(std::string name, const std::vector<Summit>& summits,
                                    const Material& material, double nominal_area,
                                    double mean_plane, double rms_height) {
  const double mean = mean_of_heights(summits);
  const double highest = std::ranges::max(summits, {}, &Summit::height).height - mean;
  double square = 0;
  for (const Summit& summit : summits) square += (summit.height - mean) * (summit.height - mean);
  const double deviation = std::sqrt(square / static_cast<double>(summits.size()));
  return {.name = std::move(name),
          .material = material,
          .nominal_area = nominal_area,
          .mean_height = mean - mean_plane,
          .first_touch = highest,
          .upper_separation = highest,
          .height_scale = deviation > 0 ? deviation : summits.front().mean_radius(),
          .rms_height = rms_height};
}

}  // namespace salebra::detail
