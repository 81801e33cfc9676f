// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of quantities and maps over grids.
#include "axes.hpp"

#include <algorithm>
#include <salebra/analysis/damping.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>

#include "results/columns.hpp"

namespace salebra::figures {

Axis axis_of(std::string_view name, bool logarithmic) {
  Quantity quantity = find_quantity(name);
  if (!is_quantity(name))
    if (const Column* own = find_column<DampingProblem, DampingSolution>(name))
      quantity = {own->name, own->dimension, own->long_name};
  const std::string unit(si_unit(quantity.dimension));
  return {.quantity = std::string(name),
          .label = plain_text(quantity.long_name.empty() ? name : quantity.long_name),
          .unit = unit == "1" ? "" : unit,
          .logarithmic = logarithmic};
}

bool spans_decades(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return low > 0 && high > 30 * low;
}

Panel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                const Axis& scale) {
  return {.title = title,
          .x = {.label = "x", .unit = "m"},
          .y = {.label = "y", .unit = "m"},
          .image = Image{.x = positions(grid.nx, grid.dx()),
                         .y = positions(grid.ny, grid.dy()),
                         .values = values,
                         .scale = scale},
          .equal_scales = true};
}

}  // namespace salebra::figures
