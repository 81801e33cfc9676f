// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/row_partition.hpp>
#include <salebra/contact/half_space/contact_set.hpp>

#include "half_space.hpp"

namespace salebra::detail {

/// A rectangle of cells of a grid.
struct CellWindow {
  Index x0 = 0, y0 = 0, nx = 0, ny = 0;

  bool contains(const CellWindow& other) const;
};

/// The smallest window that holds every cell of the set; empty for an empty set.
CellWindow bounding_window(const ContactSet& cells);

/// The window on which a set is solved: the whole grid where periodic; at least one cell.
CellWindow loading_window(const ContactSet& contact, const Grid2D& grid, Boundary boundary);

/// Throws InvalidInput unless the set has the grid's shape and, where periodic, a cell that is not
/// in contact.
void require_contact(const ContactSet& contact, const Grid2D& grid, Boundary boundary);
/// Does so for a set whose rows are spread over processes. Collective.
void require_spread_contact(const ContactSet& contact, const Grid2D& grid, const RowPartition& rows,
                            Boundary boundary);
/// Throws InvalidInput unless a solve on a contact set can be held to these: 1e-14 … 0.1, and >= 1.
void require_limits(double tolerance, int max_iterations);

}  // namespace salebra::detail
