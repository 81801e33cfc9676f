// SPDX-License-Identifier: GPL-3.0-or-later
// Surface that shares the memory of a NumPy array, and texts for repr().
#include "interop/surface.hpp"

#include <limits>
#include <salebra/base/units.hpp>
#include <salebra/results/quantity.hpp>

namespace salebra::python {

BoundSurface::BoundSurface(const FieldArgument& heights, double size_x, double size_y,
                           bool periodic, std::string origin) {
  surface.grid = {heights.rows(), heights.columns(), size_x, size_y};
  surface.grid.validate();
  const Eigen::Map<const Field> given(heights.data(), heights.rows(), heights.columns());
  require(!(given.abs() > std::numeric_limits<double>::max()).any(), "heights", "infinity",
          "is no height; NaN is an undefined point");
  surface.periodic = periodic;
  surface.origin = std::move(origin);
  if (adopt_memory(surface.heights, heights.data(), heights.rows(), heights.columns()))
    array = heights.array;
  else
    surface.heights = heights.copy();
}

BoundSurface::~BoundSurface() {
  if (array.is_valid()) release_memory(surface.heights);
}

nb::object range_of(const Share& rows) {
  return nb::borrow(reinterpret_cast<PyObject*>(&PyRange_Type))(rows.begin(), rows.end());
}

BoundSurface* new_surface(Surface surface) { return new BoundSurface(std::move(surface)); }

std::string describe(std::string_view type,
                     std::initializer_list<std::pair<std::string_view, double>> numbers,
                     std::string_view rest) {
  std::string text = std::string(type) + "(";
  bool first = true;
  for (const auto& [name, value] : numbers) {
    text += (first ? "" : ", ") + std::string(name) + "=" +
            format_quantity(value, find_quantity(name).dimension);
    first = false;
  }
  if (!rest.empty()) text += (first ? "" : ", ") + std::string(rest);
  return text + ")";
}

}  // namespace salebra::python
