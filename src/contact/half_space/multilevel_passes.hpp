// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "tile.hpp"

namespace salebra::detail {

// The pointwise passes of the multilevel kernel, over tiles [begin, end) of a list, and the stencil
// that stands in for an inverse. The tests' multilevel_reference.hpp says in plain loops what each
// does. One source is compiled for each vector width; no header with inline functions may be
// included there.

// A field with a halo: its first cell, the cells from one row to the next, and the cells of a row.
struct HaloView {
  float* first;
  std::ptrdiff_t stride, ny;
};

// Cell (I, J) of a coarse grid lies at (2I − shift_x, 2J − shift_y) of the finer one; shifts are
// even.
struct Shift {
  std::ptrdiff_t x, y;
};

// What an ascent adds: T source, T a stencil, and P coarse.
struct Ascent {
  HaloView source;
  const float* stencil;
  HaloView coarse;
  Shift shift;
};

struct MultilevelKernels {
  // coarse = Pᵀ fine: (1 4 6 4 1)/8 along each axis
  void (*restriction)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const HaloView& fine, const Shift& shift, const HaloView& coarse);
  // Into the image, with a stencil of 5 × 5.
  void (*ascent)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end, const Ascent& sum,
                 const HaloView& image);
  // With a stencil of 7 × 7, for tiles of one row, into its cells.
  void (*last_ascent)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const Ascent& sum, float* row);
  // A stencil of 7 × 7, symmetric about both axes, on a field with a halo, for cells [begin, end) of a
  // list: their distances from the first cell of the field, in ascending order.
  void (*at_cells)(const double* field, std::ptrdiff_t stride, const double* stencil,
                   const std::ptrdiff_t* cells, std::ptrdiff_t begin, std::ptrdiff_t end,
                   double* sums);
};

// The table for the widest vectors that this processor has.
const MultilevelKernels& multilevel_passes();

// The table of each width; the last two exist in builds for x86-64.
namespace baseline {
MultilevelKernels multilevel_table();
}
namespace avx2 {
MultilevelKernels multilevel_table();
}
namespace avx512 {
MultilevelKernels multilevel_table();
}

}  // namespace salebra::detail
