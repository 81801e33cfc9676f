// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace salebra::detail {

// What the pointwise passes over a contact share. No inline functions here: sources for several
// vector widths include it.

inline constexpr int tile_width = 16;
inline constexpr int frame = 3;  // cells around a framed field: the radius of the widest stencil
// The frame to the left and right is as wide as a tile, so that tiles of a framed field begin on
// cache lines.
inline constexpr int side_frame = tile_width;

// A run of 16 cells of one row.
struct Tile {
  std::int32_t row, column;  // of the first cell; the last tile of a row may be narrower
};

}  // namespace salebra::detail
