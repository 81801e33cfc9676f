// SPDX-License-Identifier: GPL-3.0-or-later
// Windows of cells around a contact set, and checks of the arguments of solves on such a set.
#include "cell_window.hpp"

#include <algorithm>
#include <salebra/base/error.hpp>

namespace salebra::detail {

bool CellWindow::contains(const CellWindow& other) const {
  return other.nx == 0 || (other.x0 >= x0 && other.y0 >= y0 && other.x0 + other.nx <= x0 + nx &&
                           other.y0 + other.ny <= y0 + ny);
}

CellWindow bounding_window(const ContactSet& cells) {
  Index x0 = cells.rows(), x1 = -1, y0 = cells.cols(), y1 = -1;
  for (Index ix = 0; ix < cells.rows(); ++ix)
    for (Index iy = 0; iy < cells.cols(); ++iy)
      if (cells(ix, iy)) {
        x0 = std::min(x0, ix);
        x1 = std::max(x1, ix);
        y0 = std::min(y0, iy);
        y1 = std::max(y1, iy);
      }
  return x1 < 0 ? CellWindow{} : CellWindow{x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

CellWindow loading_window(const ContactSet& contact, const Grid2D& grid, Boundary boundary) {
  if (boundary == Boundary::periodic) return {0, 0, grid.nx, grid.ny};
  const CellWindow window = bounding_window(contact);
  return window.nx > 0 ? window : CellWindow{0, 0, 1, 1};
}

void require_contact(const ContactSet& contact, const Grid2D& grid, Boundary boundary) {
  require_spread_contact(contact, grid, RowPartition(grid.nx), boundary);
}

void require_spread_contact(const ContactSet& contact, const Grid2D& grid, const RowPartition& rows,
                            Boundary boundary) {
  collectively(rows.communicator(), [&] {
    require(contact.rows() == rows.count() && contact.cols() == grid.ny, "contact", contact.size(),
            "cells do not match the grid; give one value for each of nx × ny cells");
  });
  require(boundary == Boundary::free || !rows.communicator().all_agree(contact.all()), "contact",
          contact.size(),
          "cells, all of them, are in contact; a periodic surface in full contact has no finite "
          "stiffness");
}

void require_limits(double tolerance, int max_iterations) {
  require(tolerance >= 1e-14 && tolerance <= 0.1, "tolerance", tolerance,
          "must lie in 1e-14 … 0.1");
  require(max_iterations >= 1, "max_iterations", max_iterations, "must be >= 1");
}

}  // namespace salebra::detail
