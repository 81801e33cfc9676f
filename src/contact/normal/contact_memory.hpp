// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/contact/normal/normal.hpp>

namespace salebra::detail {

/// Memory of a contact in this process besides the heights, bytes. If a tenth of the cells is in
/// contact it is 43 bytes per cell, and 58 with Precision::full; full contact takes 24 and 31 bytes
/// per cell more, and a free boundary the padding of its transforms. Each of several processes sets
/// up the multilevel kernel, or the response of an isolated surface, for the whole grid. Measured:
/// docs/performance.md, "Memory", and bench/scaling.
inline double contact_memory(const Surface& surface, const NormalContactOptions& options) {
  const auto cells = static_cast<double>(surface.grid.points());
  const double mine = static_cast<double>(surface.heights.size());
  const double whole = surface.communicator.alone()         ? 0
                       : options.boundary == Boundary::free ? 70
                                                            : 1;
  return (options.precision == Precision::mixed ? 43 : 58) * mine + whole * cells;
}

/// Memory of a solve for the tangential stiffness of a stuck contact, bytes: 65 per cell if a tenth
/// of the cells is in contact; with a free boundary only the cells of the contact's window count.
inline double stick_memory(const Grid2D& grid) { return 65 * static_cast<double>(grid.points()); }

}  // namespace salebra::detail
