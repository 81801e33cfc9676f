// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/memory.hpp"
#include "half_space.hpp"
#include "tile.hpp"

namespace salebra::detail {

// Number of tiles in a row of ny cells.
inline Index tiles_across(Index ny) { return (ny + tile_width - 1) / tile_width; }
// Appends to `tiles` the tiles of a row that are in use; in_use has one flag for each tile.
void append_tiles(const unsigned char* in_use, Index row, Index across, std::vector<Tile>& tiles);

// A field (nx, ny) with a halo around it, so that a stencil need not test for the edge. Above and
// below, the halo is one row wider than the radius of the widest stencil, because interpolation
// from the next coarser grid needs this row; at the left and right it is at least a tile wide.
template <class Real>
class HaloField {
 public:
  HaloField() = default;
  HaloField(Index nx, Index ny);  // all zero

  explicit operator bool() const { return data_ != nullptr; }
  Index nx() const { return nx_; }
  Index ny() const { return ny_; }
  Index stride() const { return stride_; }
  // The first cell of a row, for −rows_around <= row < nx + rows_around.
  Real* row(Index row) const { return data_.get() + (row + rows_around) * stride_ + side_halo; }

  void clear();
  // Fills the halo: with the opposite edge if periodic, and with the rows of other processes if the
  // field is distributed over several processes. Collective.
  void fill_halo(Boundary boundary, const RowExchange& halo_rows);

 private:
  static constexpr Index rows_around = halo + 1;
  Index nx_ = 0, ny_ = 0, stride_ = 0;
  LargeArray<Real> data_;
};

// Returns the exchange between processes that fills the halo of a field with this distribution of
// rows.
RowExchange halo_rows(const RowPartition& rows, Boundary boundary);

}  // namespace salebra::detail
