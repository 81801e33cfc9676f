// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "half_space.hpp"
#include "halo_field.hpp"
#include "multilevel_design.hpp"
#include "multilevel_passes.hpp"
#include "normal_symbol.hpp"

namespace salebra::detail {

// Approximation G~ of the normal compliance G for fields on few tiles of a grid:
//     G~ = T1 + P (T2 + P (… + P C Pᵀ …) Pᵀ) Pᵀ,
// with a stencil T1, T2 and so on for each level, applied to the tiles in use of that level,
// interpolation P by cubic B-splines from each level to the next finer one, and a convolution C on
// a grid 2^depth times coarser along each axis. (1 − eps) G <= G~ <= (1 + eps) G as quadratic
// forms, with eps <= error(): a solve with G~ that starts from an exact gap reduces the error of
// the solution by the factor eps/(1 − eps), for any grid, load and contact set
// (src/contact/README.md).
//
// It computes in float. G~ is symmetric up to rounding, and its result has the same bits for every
// number of threads and processes. One object may run in one thread at a time. Memory: 8/3 bytes
// for each cell of the grid.
//
// With several processes, a row of a level belongs to the process that has the row of the finer
// level at the same position. An application exchanges the halo of each level and the rows of the
// coarsest level between processes.
class MultilevelKernel {
 public:
  // The part of the kernel that equal grids share.
  struct Plan {
    Boundary boundary = Boundary::periodic;
    Index nx = 0, ny = 0;                     // cells of the grid
    std::vector<MultilevelStencil> stencils;  // one for each level, T1 first, in m/Pa
    double error = 0;
    QuarterSymbol left;  // symbol C of the coarsest level

    // Returns nothing if the grid is too small or no stencils are accurate enough: cells are longer
    // than about 1:2, or a period cannot be halved.
    // rows: the rows of the grid that each process has.
    static std::optional<Plan> make(const Grid2D& grid, const RowPartition& rows,
                                    const NormalSymbol& symbol, double contact_modulus,
                                    Boundary boundary);
  };
  MultilevelKernel(const Plan& plan, const RowPartition& rows);
  static std::optional<MultilevelKernel> make(const Grid2D& grid, const RowPartition& rows,
                                              const NormalSymbol& symbol, double contact_modulus,
                                              Boundary boundary) {
    const auto plan = Plan::make(grid, rows, symbol, contact_modulus, boundary);
    if (!plan) return std::nullopt;
    return MultilevelKernel(*plan, rows);
  }

  int depth() const { return static_cast<int>(levels_.size()); }
  double error() const { return error_; }

  // Sets the tiles of the grid that hold the source and on which the result is needed. in_use: one
  // number for each tile of the rows of this process, row by row; 1 if the tile is in use.
  // Collective.
  void list_tiles(const std::vector<unsigned char>& in_use);

  // Computes everything on the coarser levels that an application to `source` needs. source: values
  // on the tiles in use, zero elsewhere; its halo is filled by this call. Collective.
  void descend(HaloField<float>& source);
  // Writes G~x for the source x of the last descend(), on the tiles [begin, end) of one row, all in
  // use, into the cells of `row`.
  void collect(const Tile* tiles, Index begin, Index end, float* row) const;

 private:
  struct Level {
    Level(const RowPartition& of_spring, Boundary boundary)
        : rows(of_spring), halo_rows(detail::halo_rows(of_spring, boundary)) {}

    RowPartition rows;
    RowExchange halo_rows;
    HaloField<float> source, image;
    Shift shift = {0, 0};                // of this level's cells on the finer grid
    Shift local_shift = {0, 0};          // same, rows from the first of this process
    std::array<float, 25> stencil = {};  // T of this level; unused on the coarsest
    std::vector<unsigned char> in_use;   // (nx, tiles per row)
    std::vector<Tile> tiles;
  };

  void add_level(Index& nx, Index& ny);
  void add_coarsest(Index nx, Index ny, const QuarterSymbol& left);

  Boundary boundary_ = Boundary::periodic;
  RowPartition rows_;  // rows of the grid
  std::optional<RowExchange> halo_rows_;
  double error_ = 0;
  Index ny_ = 0;
  std::array<float, 49> stencil_ = {};  // T1
  std::vector<Level> levels_;           // the coarsest is last
  // Transform on the coarsest level. Its rows are distributed by whole blocks; two exchanges send
  // them there and back.
  RowPartition coarsest_rows_;
  std::optional<Convolution2D<float>> coarsest_;
  std::optional<RowExchange> to_coarsest_, from_coarsest_;
  LargeArray<float> coarsest_field_;
  HaloView source_ = {};  // source of the last descend()
};

}  // namespace salebra::detail
