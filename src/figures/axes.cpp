// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of quantities and maps over grids.
#include "axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/analysis/damping.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/realisation.hpp>

#include "results/columns.hpp"

namespace salebra::figures {

Axis axis_of(std::string_view name, bool logarithmic, std::string_view label) {
  Quantity quantity = find_quantity(name);
  if (!is_quantity(name))
    if (const Column* own = find_column<DampingProblem, DampingSolution, SpotStatistics>(name))
      quantity = {own->name, own->dimension, own->long_name};
  // No described struct has frequencies, which are angular in all of them.
  for (const auto& [frequency, meaning] :
       {std::pair("frequency", "frequency of the normal motion"),
        {"tangential_frequency", "frequency of the tangential motion"}})
    if (name == frequency) quantity = {frequency, Dimension::frequency, meaning};
  const std::string unit(si_unit(quantity.dimension));
  return {.quantity = std::string(name),
          .label = !label.empty()
                       ? std::string(label)
                       : plain_text(quantity.long_name.empty() ? name : quantity.long_name),
          .unit = unit == "1" ? "" : unit,
          .logarithmic = logarithmic};
}

std::string interval_text(double value, double low, double high, Dimension dimension) {
  const std::string text = format_quantity(value, dimension, 3);
  if (!std::isfinite(low) || !std::isfinite(high)) return text;
  // A limit with the unit of the value is written without it.
  const auto unit_of = [](const std::string& words) {
    return words.substr(std::min(words.find(' '), words.size()));
  };
  const std::string unit = unit_of(text);
  const auto limit = [&](double number) {
    const std::string words = format_quantity(number, dimension, 3);
    return unit_of(words) == unit ? words.substr(0, words.size() - unit.size()) : words;
  };
  return fmt::format("{} ({} … {})", text, limit(low), limit(high));
}

std::string error_text(double value, double error, Dimension dimension) {
  const std::string text = format_quantity(value, dimension, 3);
  if (!std::isfinite(error) || !std::isfinite(value)) return text;
  if (error >= std::abs(value)) return "below its error of " + format_quantity(error, dimension, 2);
  return fmt::format("{} ± {:.2g} %", text, 100 * error / std::abs(value));
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
