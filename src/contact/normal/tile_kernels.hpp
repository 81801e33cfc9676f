// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "contact/half_space/tile.hpp"

namespace salebra::detail {

// The pointwise passes of the active-set solver; the tests' reference_kernels.hpp says in plain
// loops what each does. They walk tiles: runs of 16 cells of one row that hold contact or are close
// to it, since short runs of any length do not vectorise. One source is compiled for each vector
// width; no header with inline functions may be included there, because the linker could then give
// code for a wide machine to a narrow one.

inline constexpr int stencil_size = (2 * halo + 1) * (2 * halo + 1);

struct NewDirection {
  double z_mean, beta, t_mean;
};

// What a LoadCorrection says.
struct Truncation {
  double scale, shift, full_from;
};

// A field either has a halo, or stands tile after tile (packed) with zeros where a row ends within a tile.
// Directions and their images are packed too: as whole fields they would be the half of what an
// iteration reads and writes. The transform spreads and collects them row by row.
template <class Real>
struct TileArrays {
  const Tile* tiles;
  std::ptrdiff_t tile_count;
  std::ptrdiff_t ny;           // cells of a row
  std::ptrdiff_t halo_stride;  // from one row of r to the next
  Real* r;                     // with a halo: (g − level) on the free cells, zero elsewhere
  double* p;                   // packed: pressure
  double* g;                   // packed: Gp − h
  Real* t;                     // packed: search direction
  Real* w;                     // packed: Gt
  Real* z;                     // packed: preconditioned residual, and what truncate() changes
  Real* m;  // packed: 1 on free cells, where g = level is wanted; 0 where p is held at a bound
  unsigned char*
      // of each tile: 1 where no cell is free or loaded, and then t is zero, and r from the next
      // residual() on
      quiet;
  const Real* stencil;  // stencil_size weights, symmetric about both axes
  double bound;         // largest pressure allowed; may be infinite
};

struct PreconditionSums {
  double z = 0, zw = 0, zz = 0, t = 0, w = 0, r = 0, zr = 0, tr = 0;  // sums over the free cells
};
struct CurvatureSums {
  double tw = 0, w = 0;  // <t, w>, and Σw over the free cells
};
struct StepSums {
  double outside = 0;   // Σ (distance of p to its bounds)²
  double wrong = 0;     // Σ (g − level)² over held cells where it has the wrong sign
  double clipped = 0;   // Σ distance of p to its bounds
  double pressure = 0;  // Σ p over cells below the bound, p clipped to its bounds
  double misfit = 0;  // Σ p|g − level| there, plus bound·(g − level) of saturated cells still apart
  double signed_misfit = 0;  // the same with p(g − level)
  double saturated = 0;      // number of cells at the bound
  double least = 0;          // least g over cells below the bound
};
struct SetSums {
  double count = 0, g = 0;  // free cells and Σg over them
};
struct GapSums {
  double pressure = 0;      // Σp
  double count = 0, g = 0;  // cells with 0 < p < bound and Σg over them
  double misfit = 0;        // Σ p(g − plane)
  double distance = 0;      // Σ p|g − plane|
  double saturated = 0;     // cells at the bound
  double least = 0;         // least g
};

// A row of cells whose gap is computed afresh.
struct GapRow {
  const double* heights;
  double zero;      // of the heights
  const double* p;  // pressure
  const unsigned char*
      in_use;  // of each tile: 0 where p is zero, which is not read; nullptr: p is read everywhere
  std::ptrdiff_t count;  // cells
  double bound;          // largest pressure allowed
  double plane;          // close to the contact plane
  double
      // g is written on tiles whose `nearest` is below this: what is far away is not read again
      kept_below;
  double* g;        // u − (heights − zero)
  double* nearest;  // of each tile: its least g; −∞ where a cell of it carries load
};

// begin and end count tiles. Where a row is given they are the tiles of that row, and it holds its
// ny cells.
template <class Real>
struct TileKernels {
  // r = m(g − level)
  void (*residual)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end, double plane_height);
  // z = m(S r)
  PreconditionSums (*precondition)(const TileArrays<Real>&, std::ptrdiff_t begin,
                                   std::ptrdiff_t end);
  // t = m(z − z_mean + beta(t − t_mean)), and into the row
  void (*direct)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                 const NewDirection& direction, Real* row);
  // w from the row
  CurvatureSums (*take_image)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                              const Real* row);
  // p −= alpha t, g −= alpha w, r = m(g − level)
  StepSums (*step)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end, double alpha,
                   double plane_height);
  // Frees held cells whose gap has the wrong sign, holds free cells whose pressure left its bounds.
  SetSums (*change_set)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                        double plane_height);
  // Does so, and p becomes min(scale·max(p, 0) + shift, bound), or the bound where it is full_from
  // or more, z the change of p.
  void (*truncate)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end, double plane_height,
                   const Truncation& correction);
  // z into the row
  void (*spread_change)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                        Real* row);
  // g += row; the free cells and Σg as they are then. r has to be made again.
  SetSums (*add_displacement)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                              const Real* row);

  // g and `nearest` of a row from its displacement, and what the contact plane follows from.
  GapSums (*gap)(const Real* u, const GapRow&);
  GapSums (*exact_gap)(const double* u, const GapRow&);
  // Σp over consecutive cells, p clipped to [0, bound] first.
  double (*clip)(double* p, std::ptrdiff_t count, double bound);
};

// The table for the widest vectors that this processor has.
template <class Real>
const TileKernels<Real>& tile_kernels();

// The tables of each width; the last two exist in builds for x86-64.
namespace baseline {
TileKernels<float> table_float();
TileKernels<double> table_double();
}  // namespace baseline
namespace avx2 {
TileKernels<float> table_float();
TileKernels<double> table_double();
}  // namespace avx2
namespace avx512 {
TileKernels<float> table_float();
TileKernels<double> table_double();
}  // namespace avx512

}  // namespace salebra::detail
