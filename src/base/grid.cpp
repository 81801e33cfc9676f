// SPDX-License-Identifier: GPL-3.0-or-later
// Validity of a grid, number of undefined points of a surface, and the check for complete data.
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>
#include <string>

#include "undefined_points.hpp"

namespace salebra {

void Grid2D::validate() const {
  require(nx >= 1, "nx", nx, "must be >= 1");
  require(ny >= 1, "ny", ny, "must be >= 1");
  require_positive(lx, "size_x");
  require_positive(ly, "size_y");
}

Index Surface::undefined_points() const { return heights.isNaN().count(); }

RowPartition Surface::partition() const { return {communicator, grid.nx}; }

void Surface::require_whole(const std::string& purpose) const {
  if (communicator.alone()) return;
  throw InvalidInput("surface", "",
                     "is spread over " + std::to_string(communicator.size()) + " processes, and " +
                         purpose + " needs it whole; gather it or use one process");
}

void Surface::require_complete(const std::string& purpose) const {
  require_whole(purpose);
  require_complete_rows(purpose);
}

void Surface::require_complete_rows(const std::string& purpose) const {
  grid.validate();
  const Index rows = partition().count();
  require(
      heights.rows() == rows && heights.cols() == grid.ny, "heights",
      std::to_string(heights.rows()) + " x " + std::to_string(heights.cols()),
      "must have the shape of the grid, " + std::to_string(rows) + " x " + std::to_string(grid.ny));
  // Valid heights, the common case, take one pass; undefined and infinite heights are told apart
  // only if one of them occurs.
  const double wrong = parallel::sum_blocks(
      rows,
      [&](Index begin, Index end) {
        Index count = 0;
        for (Index k = begin * grid.ny; k < end * grid.ny; ++k)
          count += !std::isfinite(heights.data()[k]);
        return static_cast<double>(count);
      },
      rows * grid.ny);
  if (wrong == 0) return;
  const Index undefined = undefined_points();
  if (undefined > 0)
    throw UndefinedPoints(
        "heights", std::to_string(undefined),
        "undefined points cannot be used in " + purpose + "; fill them or crop them first");
  require(false, "heights", "infinity", "cannot be used in " + purpose);
}

}  // namespace salebra
