// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace salebra::detail {

// Constants and types of the pointwise passes over a contact. This header has no inline functions,
// because sources for several vector widths include it.

inline constexpr int tile_width = 16;
// Width of a halo in cells: the radius of the widest stencil.
inline constexpr int halo = 3;
// The halo to the left and right is as wide as a tile, so that tiles of a field with a halo begin
// on cache lines.
inline constexpr int side_halo = tile_width;

// A run of 16 cells of one row.
struct Tile {
  std::int32_t row, column;  // of the first cell; the last tile of a row may be narrower
};

}  // namespace salebra::detail
