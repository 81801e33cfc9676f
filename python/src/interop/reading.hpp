// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/surface/crop.hpp>
#include <utility>
#include <variant>
#include <vector>

namespace salebra::python {

using PixelSize = std::optional<std::variant<double, std::vector<double>>>;

/// The distances of points along x and y; a single given distance stands for both.
inline std::optional<std::pair<double, double>> pixel_size_of(const PixelSize& given) {
  if (!given) return {};
  if (const auto* step = std::get_if<double>(&*given)) return std::pair(*step, *step);
  const auto& steps = std::get<std::vector<double>>(*given);
  require(steps.size() == 2, "pixel_size", steps.size(), "numbers; give one or (dx, dy)");
  return std::pair(steps.front(), steps.back());
}

/// The rectangle with the corners (x0, y0) and (x1, y1), from a list of these four numbers.
inline std::optional<Rectangle> rectangle_of(const std::optional<std::vector<double>>& given) {
  if (!given) return {};
  require(given->size() == 4, "crop", given->size(), "numbers; give (x0, y0, x1, y1)");
  return Rectangle{(*given)[0], (*given)[1], (*given)[2], (*given)[3]};
}

}  // namespace salebra::python
