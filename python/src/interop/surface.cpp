// SPDX-License-Identifier: GPL-3.0-or-later
// Surface that shares the memory of a NumPy array.
#include "interop/surface.hpp"

#include <limits>

namespace salebra::python {

BoundSurface::BoundSurface(const FieldArgument& heights, double size_x, double size_y,
                           bool periodic, std::string origin) {
  surface.grid = {heights.rows(), heights.columns(), size_x, size_y};
  surface.grid.validate();
  const Eigen::Map<const Field> given(heights.data(), heights.rows(), heights.columns());
  // Not (...).any(): it visits the points column by column, which takes far longer than to read them.
  const double highest = given.abs().maxCoeff<Eigen::PropagateNumbers>();
  require(!(highest > std::numeric_limits<double>::max()), "heights", "infinity",
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

nb::object range_of(const RowPartition& rows) {
  return nb::borrow(reinterpret_cast<PyObject*>(&PyRange_Type))(rows.begin(), rows.end());
}

BoundSurface* new_surface(Surface surface) { return new BoundSurface(std::move(surface)); }

}  // namespace salebra::python
