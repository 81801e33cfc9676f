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

// A stand-in G~ for the normal compliance G where fields live on few tiles of a grid:
//     G~ = T1 + P (T2 + P (… + P C Pᵀ …) Pᵀ) Pᵀ,
// stencils T on the tiles in use, level below level, cubic B-splines P between them, and a
// transform C on a grid 2^depth times coarser each way. (1 − eps) G <= G~ <= (1 + eps) G as
// quadratic forms, eps <= error(): a solve with G~ about an exact gap contracts the error by eps/(1
// − eps), whatever the grid, the load or the contact set (src/contact/README.md).
//
// In float. G~ is symmetric up to rounding, and its result has the same bits for every number of
// threads and processes. One object may run in one thread at a time. Memory: 8/3 bytes for each
// cell of the grid.
//
// Over several processes a row of a level belongs to the process of the row of the finer level that
// it lies on. An application sends the halo of each level, and the rows of the coarsest.
class MultilevelKernel {
 public:
  // What the multilevel kernels of equal grids have in common.
  struct Plan {
    Boundary boundary = Boundary::periodic;
    Index nx = 0, ny = 0;                     // of the grid
    std::vector<MultilevelStencil> stencils;  // T1, T2, … in m/Pa
    double error = 0;
    QuarterSymbol left;  // C

    // None where the grid is too small for it, or has no stencils that are good enough: cells
    // longer than about 1:2, or a period that does not halve.
    // rows: those of the grid that each process holds.
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

  // The tiles of the grid that hold the source and where the result is wanted: (rows of this
  // process, tiles per row), 1 where a tile is in use. Collective.
  void list_tiles(const std::vector<unsigned char>& in_use);

  // Everything that one application needs on the coarser levels. source: on the tiles in use, else
  // zero; its halo is filled here. Collective.
  void descend(HaloField<float>& source);
  // G~x on tiles [begin, end) of one row, all in use, into its cells.
  void collect(const Tile* tiles, Index begin, Index end, float* row) const;

 private:
  struct Level {
    Level(const RowPartition& of_spring, Boundary boundary)
        : rows(of_spring), halo_rows(detail::halo_rows(of_spring, boundary)) {}

    RowPartition rows;
    RowExchange halo_rows;
    HaloField<float> source, image;
    Shift shift = {0, 0};                // of its cells on the finer grid, of all processes
    Shift local_shift = {0, 0};          // the same, rows counted from the first of this process
    std::array<float, 25> stencil = {};  // T there; of the coarsest unused
    std::vector<unsigned char> in_use;   // (nx, tiles per row)
    std::vector<Tile> tiles;
  };

  void add_level(Index& nx, Index& ny);
  void add_coarsest(Index nx, Index ny, const QuarterSymbol& left);

  Boundary boundary_ = Boundary::periodic;
  RowPartition rows_;  // of the grid
  std::optional<RowExchange> halo_rows_;
  double error_ = 0;
  Index ny_ = 0;
  std::array<float, 49> stencil_ = {};  // T1
  std::vector<Level> levels_;           // the coarsest last
  // The transform of the coarsest, whose rows are shared by whole blocks, and their way there and
  // back.
  RowPartition coarsest_rows_;
  std::optional<Convolution2D<float>> coarsest_;
  std::optional<RowExchange> to_coarsest_, from_coarsest_;
  LargeArray<float> coarsest_field_;
  HaloView source_ = {};  // of the last descend()
};

}  // namespace salebra::detail
