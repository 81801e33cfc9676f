// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "tile.hpp"

namespace salebra::detail {

// Pointwise passes of the multilevel kernel over tiles [begin, end) of a list, and the
// InverseStencil pass at_cells. multilevel_reference.hpp of the tests defines each of these passes
// in plain loops. One source file is compiled for each vector width; that file must not include a
// header with inline functions.

// A field with a halo: pointer to its first cell, distance from one row to the next, and number of
// cells in a row.
struct HaloView {
  float* first;
  std::ptrdiff_t stride, ny;
};

// Cell (I, J) of a coarse grid lies at cell (2I − x, 2J − y) of the next finer grid; the shifts x
// and y are even.
struct Shift {
  std::ptrdiff_t x, y;
};

// The operands of an ascent, which computes T source + P coarse, where T is a stencil and P the
// interpolation from the coarse grid.
struct Ascent {
  HaloView source;
  const float* stencil;
  HaloView coarse;
  Shift shift;
};

struct MultilevelKernels {
  // Restricts the field `fine` to the field `coarse`, with the weights (1 4 6 4 1)/8 along each
  // axis.
  void (*restriction)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const HaloView& fine, const Shift& shift, const HaloView& coarse);
  // Writes T source + P coarse into the field `image`; the stencil T has 5 × 5 weights.
  void (*ascent)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end, const Ascent& sum,
                 const HaloView& image);
  // Writes T source + P coarse, for tiles of one row, into the cells of `row`; the stencil T has 7
  // × 7 weights.
  void (*last_ascent)(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const Ascent& sum, float* row);
  // Applies a stencil of 7 × 7 weights, symmetric about both axes, to a field with a halo, at the
  // cells [begin, end) of the list `cells`, which holds the distance of each cell from the first
  // cell of the field, in ascending order.
  void (*at_cells)(const double* field, std::ptrdiff_t stride, const double* stencil,
                   const std::ptrdiff_t* cells, std::ptrdiff_t begin, std::ptrdiff_t end,
                   double* sums);
};

// The passes for the widest vectors that this processor has.
const MultilevelKernels& multilevel_passes();

// The passes for each vector width; avx2 and avx512 exist only in builds for x86-64.
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
