// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <nanobind/nanobind.h>

#include <algorithm>
#include <cmath>
#include <salebra/damping/oscillation.hpp>
#include <salebra/figures/figures.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "figures/axes.hpp"

namespace salebra::python {

namespace nb = nanobind;

/// The Python object of a result whose figure needs what the result was computed from: figure()
/// calls draw(const Result&). Its class has nb::dynamic_attr(). A pickle does not contain `draw`.
template <class Result, class Draw>
nb::typed<nb::object, Result> with_figure(Result result, Draw draw) {
  nb::object made = nb::cast(std::move(result));
  made.attr("_draw") =
      nb::cpp_function([draw](const Result& self) -> figures::Figure { return draw(self); });
  return nb::borrow<nb::typed<nb::object, Result>>(made);
}

/// The half ranges and the period of a sampled motion, for captions.
inline std::string motion_text_of(const SampledMotion& path) {
  const auto half_range = [](const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return format_quantity((high - low) / 2, Dimension::length, 4);
  };
  return fmt::format("{} tangential and {} normal (half ranges), {} long",
                     half_range(path.displacement), half_range(path.indentation),
                     format_quantity(path.period(), Dimension::time, 4));
}

}  // namespace salebra::python
