// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/memory.hpp"
#include "half_space.hpp"
#include "tile.hpp"

namespace salebra::detail {

// The tiles of a row of ny cells.
inline Index tiles_across(Index ny) { return (ny + tile_width - 1) / tile_width; }
// Appends the tiles of a row that are in use, one flag each.
void append_tiles(const unsigned char* in_use, Index row, Index across, std::vector<Tile>& tiles);

// A field (nx, ny) with a halo around it, so that a stencil needs no test for the edge: as many
// rows as the widest stencil reaches and one more, for splines of the next coarser grid, and at
// least a tile at both sides.
template <class Real>
class HaloField {
 public:
  HaloField() = default;
  HaloField(Index nx, Index ny);  // zero

  explicit operator bool() const { return data_ != nullptr; }
  Index nx() const { return nx_; }
  Index ny() const { return ny_; }
  Index stride() const { return stride_; }
  // The first cell of a row, −rows_around <= row < nx + rows_around.
  Real* row(Index row) const { return data_.get() + (row + rows_around) * stride_ + side_halo; }

  void clear();
  // Puts the cells of the opposite edge into the halo, where the field repeats, and the rows of
  // other processes, where it is spread over several. Collective.
  void fill_halo(Boundary boundary, const RowExchange& halo_rows);

 private:
  static constexpr Index rows_around = halo + 1;
  Index nx_ = 0, ny_ = 0, stride_ = 0;
  LargeArray<Real> data_;
};

// Returns the exchange that fills the halo of a field whose rows are shared so.
RowExchange halo_rows(const RowPartition& rows, Boundary boundary);

}  // namespace salebra::detail
