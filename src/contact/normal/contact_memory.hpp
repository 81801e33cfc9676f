// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/contact/normal/normal.hpp>

namespace salebra::detail {

/// What a contact takes in this process in addition to the heights, bytes: 43 a cell with contact
/// on a tenth of them, with Precision::full 58. Full contact takes 24 and 31 more, a free boundary
/// the padding of its transforms. One of several processes sets up the multilevel kernel, or the response of
/// an isolated surface, for the whole grid. Measured: docs/performance.md, "Memory", and
/// bench/scaling.
inline double contact_memory(const Surface& surface, const NormalContactOptions& options) {
  const auto cells = static_cast<double>(surface.grid.points());
  const double mine = static_cast<double>(surface.heights.size());
  const double whole = surface.communicator.alone() ? 0 : options.boundary == Boundary::free ? 70 : 1;
  return (options.precision == Precision::mixed ? 43 : 58) * mine + whole * cells;
}

/// What a stick solve takes, bytes: 65 a cell with contact on a tenth of them, of the window of the
/// contact where the boundary is free.
inline double stick_memory(const Grid2D& grid) { return 65 * static_cast<double>(grid.points()); }

}  // namespace salebra::detail
