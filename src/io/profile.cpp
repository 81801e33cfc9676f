// SPDX-License-Identifier: GPL-3.0-or-later
// Line profile with equal steps, from positions and heights.
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
  double max_offset = 0;
  for (std::size_t i = 0; i < count; ++i)
    max_offset =
        std::max(max_offset, std::abs(positions[i] - first - static_cast<double>(i) * step));
  if (!(max_offset > 0.1 * step)) return profile;
  // Evaluates the straight lines between the points on a grid of equal steps. The grid is fine
  // compared with the shortest of these lines, so sums over it are good integrals along the
  // profile.
  const double length = positions.back() - first;
  double shortest = length;
  for (std::size_t i = 1; i < count; ++i)
    shortest = std::min(shortest, positions[i] - positions[i - 1]);
  constexpr double steps_of_piece = 16, most = 1 << 22;
  const double points = std::min(most, std::ceil(steps_of_piece * length / shortest));
  if (!(points * shortest >= 2 * length))
    refuse(file, "is a line profile with points that are closer than " +
                     std::to_string(2e6 / most) + "e-6 of its length; resample it");
  const auto fine = static_cast<Index>(points);
  profile.warnings.emplace_back(
      "its points are not equally spaced; straight lines between them are "
      "evaluated at " +
      std::to_string(fine) + " points");
  profile.size_x = length;
  profile.heights.resize(fine, 1);
  std::size_t right = 1;
  for (Index i = 0; i < fine; ++i) {
    const double x = first + (static_cast<double>(i) + 0.5) * length / points;
    while (right + 1 < count && positions[right] < x) ++right;
    const std::size_t left = right - 1;
    const double share = (x - positions[left]) / (positions[right] - positions[left]);
    profile.heights(i, 0) = heights[left] + share * (heights[right] - heights[left]);
  }
  return profile;
}

}  // namespace salebra::detail
