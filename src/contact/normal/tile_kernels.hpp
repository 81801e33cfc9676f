// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "contact/half_space/tile.hpp"

namespace salebra::detail {

// Pointwise passes of the active-set solver; reference_kernels.hpp of the tests defines each of
// these passes in plain loops. The passes walk over tiles, runs of 16 cells of one row that hold
// contact or are close to it, because runs of varying length do not vectorise. One source file is
// compiled for each vector width. That file must not include a header with inline functions: the
// linker could then give code for a wide machine to a narrow one.

inline constexpr int stencil_size = (2 * halo + 1) * (2 * halo + 1);

struct NewDirection {
  double z_mean, beta, t_mean;
};

// The members of a LoadCorrection.
struct Truncation {
  double scale, shift, full_from;
};

// The fields of a solve on tiles. A field either has a halo or is packed: stored tile after tile,
// with zeros where a row ends within a tile. Search directions and their displacements are packed,
// because as whole fields they would be half of what an iteration reads and writes. A Fourier
// transform spreads them to rows and collects its result from rows.
template <class Real>
struct TileArrays {
  const Tile* tiles;
  std::ptrdiff_t tile_count;
  std::ptrdiff_t ny;           // cells of a row
  std::ptrdiff_t halo_stride;  // from one row of r to the next
  Real* r;                     // with a halo: residual g − plane height, 0 on held cells
  double* p;                   // packed: pressure
  double* g;                   // packed: displacement by p minus height
  Real* t;                     // packed: search direction
  Real* w;                     // packed: displacement by t
  Real* z;                     // packed: preconditioned residual; after truncate() the change of p
  // packed: 1 on free cells, where g = plane height is solved; 0 where p is held at a bound
  Real* m;
  // One for each tile: 1 if no cell of the tile is free or loaded. Then t is zero on the tile, and
  // r is zero after the next call of residual().
  unsigned char* quiet;
  const Real* stencil;  // stencil_size weights, symmetric about both axes
  double bound;         // upper bound of the pressure; may be infinite
};

struct PreconditionSums {
  double z = 0, zw = 0, zz = 0, t = 0, w = 0, r = 0, zr = 0, tr = 0;  // sums over the free cells
};
struct CurvatureSums {
  double tw = 0, w = 0;  // <t, w>, and Σw over the free cells
};
struct StepSums {
  double outside = 0;   // Σ (distance of p to its bounds)²
  double wrong = 0;     // Σ (g − plane height)² over held cells whose gap has the wrong sign
  double clipped = 0;   // Σ distance of p to its bounds
  double pressure = 0;  // Σ p over cells below the bound, p clipped to its bounds
  // Σ p|g − plane height| over the cells below the bound, plus Σ bound·(g − plane height) over
  // saturated cells above the plane
  double misfit = 0;
  double signed_misfit = 0;  // same, with p(g − plane height)
  double saturated = 0;      // number of cells at the bound
  double least = 0;          // minimum of g over cells below the bound
};
struct SetSums {
  double count = 0, g = 0;  // number of free cells and Σg over them
};
struct GapSums {
  double pressure = 0;      // Σp
  double count = 0, g = 0;  // number of cells with 0 < p < bound and Σg over them
  double misfit = 0;        // Σ p(g − plane)
  double distance = 0;      // Σ p|g − plane|
  double saturated = 0;     // number of cells at the bound
  double least = 0;         // minimum of g
};

// A row of cells whose gap is computed anew from the displacement u.
struct GapRow {
  const double* heights;
  double zero;      // height from which heights count
  const double* p;  // pressure
  // One for each tile: 0 where p is zero and is not read; nullptr: p is read everywhere.
  const unsigned char* in_use;
  std::ptrdiff_t count;  // number of cells
  double bound;          // upper bound of the pressure
  double plane;          // approximate height of the contact plane
  // g is written only on tiles whose minimum of g is below this value: large gaps are not read
  // again.
  double kept_below;
  double* g;        // displacement − (height − zero)
  double* nearest;  // minimum of g in each tile; −∞ if a cell of it carries load
};

// The passes. begin and end are indices of tiles; if a row of ny cells is passed, they are the
// tiles of that row. Multiplication by m restricts a field to the free cells; z, t, w, p, g and r
// are the fields of TileArrays.
template <class Real>
struct TileKernels {
  // r = m(g − plane_height)
  void (*residual)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                   double plane_height);
  // z = m(S r), where S is the stencil
  PreconditionSums (*precondition)(const TileArrays<Real>&, std::ptrdiff_t begin,
                                   std::ptrdiff_t end);
  // New search direction t = m(z − z_mean + beta(t − t_mean)); also writes t into `row`.
  void (*direct)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                 const NewDirection& direction, Real* row);
  // Reads w, the displacement by t, from `row`.
  CurvatureSums (*take_image)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                              const Real* row);
  // p −= alpha t, g −= alpha w, r = m(g − plane_height)
  StepSums (*step)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end, double alpha,
                   double plane_height);
  // Changes the set of free cells: frees held cells whose gap has the wrong sign, and holds free
  // cells whose pressure left its bounds.
  SetSums (*change_set)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                        double plane_height);
  // Changes the set of free cells like change_set(), and sets p to min(scale·max(p, 0) + shift,
  // bound), or to the bound if p >= full_from. z receives the change of p.
  void (*truncate)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                   double plane_height, const Truncation& correction);
  // Writes z, the change of p by truncate(), into `row`.
  void (*spread_change)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                        Real* row);
  // Adds the displacement in `row` to g; returns the number of free cells and Σg over them. r must
  // be computed anew afterwards.
  SetSums (*add_displacement)(const TileArrays<Real>&, std::ptrdiff_t begin, std::ptrdiff_t end,
                              const Real* row);

  // Computes g and the minimum of g in each tile from the displacement u of a row, and the sums
  // that give the contact plane.
  GapSums (*gap)(const Real* u, const GapRow&);
  GapSums (*exact_gap)(const double* u, const GapRow&);
  // Clips `count` consecutive pressures to [0, bound] and returns their sum.
  double (*clip)(double* p, std::ptrdiff_t count, double bound);
};

// The kernels for the widest vectors that this processor has.
template <class Real>
const TileKernels<Real>& tile_kernels();

// The kernels for each vector width; avx2 and avx512 exist only in builds for x86-64.
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
