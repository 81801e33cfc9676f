// SPDX-License-Identifier: GPL-3.0-or-later
// Line profile of equal steps from positions and heights.
#include <algorithm>
#include <cmath>

#include "loaded_surface.hpp"

namespace salebra::detail {

LoadedSurface profile_of(const std::filesystem::path& file, const std::vector<double>& positions,
                         const std::vector<double>& heights) {
  const std::size_t count = positions.size();
  if (count < 2 || heights.size() != count)
    refuse(file, "is a line profile with less than two points, or without a height for each");
  if (std::ranges::any_of(positions, [](double x) { return !std::isfinite(x); }))
    refuse(file, "is a line profile with a point that has no position; remove it");
  const double first = positions.front();
  const double step = (positions.back() - first) / static_cast<double>(count - 1);
  LoadedSurface profile;
  profile.is_profile = true;
  profile.size_x = step * static_cast<double>(count);
  profile.heights = Eigen::Map<const Eigen::ArrayXd>(heights.data(), static_cast<Index>(count));
  double farthest = 0;
  for (std::size_t i = 0; i < count; ++i)
    farthest = std::max(farthest, std::abs(positions[i] - first - static_cast<double>(i) * step));
  if (!(farthest > 0.1 * step)) return profile;
  profile.remarks.emplace_back(
      "its points are not equally spaced; heights between them are interpolated");
  for (std::size_t i = 0; i < count; ++i) {
    const double x = first + static_cast<double>(i) * step;
    const auto above =
        static_cast<std::size_t>(std::ranges::lower_bound(positions, x) - positions.begin());
    const std::size_t right = std::clamp<std::size_t>(above, 1, count - 1), left = right - 1;
    const double share = (x - positions[left]) / (positions[right] - positions[left]);
    profile.heights(static_cast<Index>(i), 0) =
        heights[left] + std::clamp(share, 0., 1.) * (heights[right] - heights[left]);
  }
  return profile;
}

}  // namespace salebra::detail
