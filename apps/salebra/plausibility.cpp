// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks on input that is allowed and most likely a slip of the user's hand.
#include "plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <salebra/base/units.hpp>

namespace salebra::cli {
namespace {

std::string ratio_text(double ratio) {
  return ratio < 100 ? fmt::format("{:.2g}", ratio) : fmt::format("{:.0f}", ratio);
}

}  // namespace

std::vector<std::string> doubts_of_cells(const Grid2D& grid) {
  constexpr double most_ratio = 10;
  const auto [shorter, longer] = std::minmax({grid.dx(), grid.dy()});
  if (longer <= most_ratio * shorter) return {};
  return {fmt::format("cells of {} x {} have sides of {} to 1; check the size and the points",
                      format_quantity(grid.dx(), Dimension::length),
                      format_quantity(grid.dy(), Dimension::length), ratio_text(longer / shorter))};
}

std::vector<std::string> doubts_of_path(double drag_velocity, double angular_frequency,
                                        double spot_radius) {
  const double path = 2 * std::numbers::pi * drag_velocity / angular_frequency;
  if (!(path > 2 * spot_radius)) return {};
  return {fmt::format(
      "the slow motion moves on by 2 pi v/w = {} in one normal cycle, beyond a contact spot of {} "
      "across; take a lower --drag-velocity or a higher --frequency",
      format_quantity(path, Dimension::length),
      format_quantity(2 * spot_radius, Dimension::length))};
}

std::vector<std::string> doubts_of_profile(const IndenterProfile& profile, double contact_radius) {
  constexpr double most_change = 0.05, most_radius = 1;
  const auto* table = dynamic_cast<const TabulatedProfile*>(&profile);
  if (table == nullptr) return {};
  std::vector<std::string> doubts;
  if (table->largest_radius() > most_radius)
    doubts.push_back(fmt::format("the table has radii up to {}; check the unit, a table is in m",
                                 format_quantity(table->largest_radius(), Dimension::length)));
  const double change = table->image_error(contact_radius);
  if (change > most_change)
    doubts.push_back(fmt::format(
        "the table is coarse: without every other point the indentation at the contact radius {} "
        "changes by {:.2g} %; sample it more finely",
        format_quantity(contact_radius, Dimension::length), 100 * change));
  return doubts;
}

}  // namespace salebra::cli
