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

/// The window of cells on which a contact set is solved: the whole grid if periodic, otherwise the
/// bounding window of the set; at least one cell.
CellWindow loading_window(const ContactSet& contact, const Grid2D& grid, Boundary boundary);

/// Throws InvalidInput unless the contact set has the grid's shape and, with a periodic boundary,
/// lacks at least one cell.
void require_contact(const ContactSet& contact, const Grid2D& grid, Boundary boundary);
/// Like require_contact(), for a set whose rows are distributed over processes. Collective.
void require_spread_contact(const ContactSet& contact, const Grid2D& grid, const RowPartition& rows,
                            Boundary boundary);
/// Throws InvalidInput unless tolerance lies in 1e-14 … 0.1 and max_iterations is >= 1.
void require_limits(double tolerance, int max_iterations);

}  // namespace salebra::detail
