// SPDX-License-Identifier: GPL-3.0-or-later
// Profile parameters of ISO 21920-2 from the rows or columns of a surface.
#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/profile_parameters.hpp>
#include <span>

#include "gaussian.hpp"
#include "profiles.hpp"

namespace salebra {
namespace {

/// The parameters of one profile: Ra, Rq, Rz, Rsm.
using OneProfile = std::array<double, 4>;

/// Sums over profiles. Rsm is known for fewer profiles than the other parameters.
struct ProfileSums {
  std::array<double, 4> sum{}, squares{};
  std::array<Index, 4> count{};

  void add(const OneProfile& found) {
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (std::isnan(found[k])) continue;
      sum[k] += found[k];
      squares[k] += found[k] * found[k];
      ++count[k];
    }
  }
  void add(const ProfileSums& other) {
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += other.sum[k];
      squares[k] += other.squares[k];
      count[k] += other.count[k];
    }
  }
};

struct Sections {
  std::size_t points, count;
};

/// Mean over the sections in the middle of the profile of the highest minus the lowest point.
double mean_section_height(std::span<const double> heights, const Sections& sections) {
  const std::size_t start = (heights.size() - sections.points * sections.count) / 2;
  double sum = 0;
  for (std::size_t k = 0; k < sections.count; ++k) {
    const auto section = heights.subspan(start + k * sections.points, sections.points);
    const auto [low, high] = std::ranges::minmax(section);
    sum += high - low;
  }
  return sum / static_cast<double>(sections.count);
}

/// Mean distance, in points, of the places where the profile rises through zero between a dale
/// deeper than `reach` and a hill higher than `reach`; NaN if there are fewer than two.
double mean_spacing(std::span<const double> heights, double reach) {
  double first = 0, last = 0, rise = 0;
  Index count = 0;
  bool below = false;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double here = heights[i];
    if (i > 0 && heights[i - 1] < 0 && here >= 0)
      rise = static_cast<double>(i) - here / (here - heights[i - 1]);
    if (here < -reach) below = true;
    if (!below || here <= reach) continue;
    below = false;
    if (count++ == 0) first = rise;
    last = rise;
  }
  return count < 2 ? ProfileParameters::unknown : (last - first) / static_cast<double>(count - 1);
}

OneProfile parameters_of(std::span<double> heights, double step, const Sections& sections) {
  const auto points = static_cast<double>(heights.size());
  double mean = 0, absolute = 0, squares = 0;
  for (const double height : heights) mean += height / points;
  for (double& height : heights) {
    height -= mean;
    absolute += std::abs(height) / points;
    squares += height * height / points;
  }
  const double height = mean_section_height(heights, sections);
  return {absolute, std::sqrt(squares), height, step * mean_spacing(heights, 0.1 * height)};
}

}  // namespace

ProfileParameters profile_parameters(const Surface& surface, Axis axis,
                                     const GaussianFilters& filters) {
  const bool along_x = axis == Axis::x;
  surface.require_whole("profile parameters");
  surface.grid.validate();
  const Surface rough = detail::filtered_along(surface, filters, {along_x, !along_x});
  const auto points = static_cast<std::size_t>(along_x ? surface.grid.nx : surface.grid.ny);
  const double step = along_x ? surface.grid.dx() : surface.grid.dy();
  Sections sections{points, 1};
  if (filters.l_filter) {
    sections.points =
        std::clamp<std::size_t>(std::size_t(std::lround(*filters.l_filter / step)), 1, points);
    sections.count = points / sections.points;
  }
  ProfileSums total;
  for (const ProfileSums& block : detail::map_profiles<ProfileSums>(
           rough, axis, {}, [&](ProfileSums& sums, std::span<double> heights) {
             if (std::ranges::none_of(heights, [](double height) { return std::isnan(height); }))
               sums.add(parameters_of(heights, step, sections));
           }))
    total.add(block);
  ProfileParameters found;
  found.profiles = total.count[0];
  found.sections = static_cast<Index>(sections.count);
  std::array<double*, 4> means{&found.Ra, &found.Rq, &found.Rz, &found.Rsm},
      deviations{&found.Ra_deviation, &found.Rq_deviation, &found.Rz_deviation,
                 &found.Rsm_deviation};
  for (std::size_t k = 0; k < means.size(); ++k) {
    // Profiles with few elements are those with the longest ones, so their loss would bias Rsm.
    const auto count = static_cast<double>(total.count[k]);
    if (count < 0.9 * static_cast<double>(found.profiles) || count == 0) continue;
    const double mean = *means[k] = total.sum[k] / count;
    if (count > 1)
      *deviations[k] =
          std::sqrt(std::max(0.0, total.squares[k] - count * mean * mean) / (count - 1));
  }
  return found;
}

}  // namespace salebra
