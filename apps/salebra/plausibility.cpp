// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks on input that is allowed and most likely a slip of the user's hand.
#include "plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
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

}  // namespace salebra::cli
