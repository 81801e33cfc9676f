// SPDX-License-Identifier: GPL-3.0-or-later
// The multilevel kernel as an operator: its levels, the tiles of each level, and its application to
// a field.
#include "multilevel_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/parallel.hpp>

namespace salebra::detail {
namespace {

// Minimum number of points along the shorter side of the transform on the coarsest level: a smaller
// transform would hardly make the whole kernel cheaper.
constexpr Index min_period = 128;
// Largest accepted error of the kernel: with a larger error, more additional exact transforms are
// needed than the kernel saves.
constexpr double acceptable_error = 0.2;
// Number of cells by which the splines of a coarser level reach beyond each edge of an isolated
// patch.
constexpr Index reach = 2;

HaloView view(const HaloField<float>& field) { return {field.row(0), field.stride(), field.ny()}; }

// First and last of the coarse cells I with |2I − x| <= 2: the B-spline restricts cell x of the
// finer grid to these cells and interpolates the value at x from them.
Index first_reached(Index x) { return ((x + 1) >> 1) - 1; }
Index last_reached(Index x) { return (x >> 1) + 1; }

// Minimum rows of a process that takes part in the coarsest transform: for fewer rows, sending
// takes longer than transforming.
constexpr Index min_coarsest_rows = 64;

// Distributes the nx rows of the next coarser level. Row I goes to the process that has row 2I −
// shift of the finer level, or row 2I − shift + 1 if a process begins between the two rows; the
// passes can then count the rows of both levels from 0 in each process.
RowPartition coarser(const RowPartition& finer, Index nx, Index shift) {
  const int ranks = finer.communicator().size();
  std::vector<Index> begins{0};
  for (int rank = 1; rank <= ranks; ++rank)
    begins.push_back(finer.begin_of(rank) == finer.rows()
                         ? nx
                         : std::min(nx, (finer.begin_of(rank) + shift) / 2));
  return {finer.communicator(), std::move(begins)};
}

template <class Body>
void for_tiles_of(const std::vector<Tile>& tiles, const Body& body) {
  parallel::for_slabs(static_cast<Index>(tiles.size()), body,
                      static_cast<Index>(tiles.size()) * tile_width);
}

template <std::size_t size>
std::array<float, size> whole_stencil(const MultilevelStencil& stencil) {
  std::array<float, size> weights{};
  std::size_t k = 0;
  for (int i = -stencil.radius; i <= stencil.radius; ++i)
    for (int j = -stencil.radius; j <= stencil.radius; ++j)
      weights[k++] = static_cast<float>(stencil.weight(i, j));
  return weights;
}

}  // namespace

std::optional<MultilevelKernel::Plan> MultilevelKernel::Plan::make(const Grid2D& grid,
                                                                   const RowPartition& rows,
                                                                   const NormalSymbol& symbol,
                                                                   double contact_modulus,
                                                                   Boundary boundary) {
  int depth = 0;
  for (Index x = symbol.period_x, y = symbol.period_y;
       x % 2 == 0 && y % 2 == 0 && std::min(x, y) / 2 >= min_period && depth < max_intervals;
       x /= 2, y /= 2)
    ++depth;
  if (depth == 0) return std::nullopt;
  const double ratio = grid.dx() / grid.dy();
  // Grids whose cells are longer than 1:8 are rejected without a fit.
  if (ratio > 8 || ratio < 1.0 / 8) return std::nullopt;
  Plan plan{boundary, grid.nx, grid.ny, {}, 0, {}};
  const double scale = std::sqrt(grid.cell_area()) / contact_modulus;
  for (auto& [stencil, error] : multilevel_design(ratio, boundary, depth)) {
    plan.error += error;
    for (double& weight : stencil.weights) weight *= scale;
    plan.stencils.push_back(std::move(stencil));
  }
  if (!(plan.error < acceptable_error)) return std::nullopt;
  plan.left = coarse_symbol(symbol, plan.stencils.front(), rows.communicator());
  for (std::size_t k = 1; k < plan.stencils.size(); ++k)
    plan.left = coarse_symbol(plan.left, plan.stencils[k]);
  if (boundary == Boundary::free) {
    Index nx = grid.nx, ny = grid.ny;
    for (int k = 0; k < depth; ++k) {
      nx = (nx + 1) / 2 + 2 * reach;
      ny = (ny + 1) / 2 + 2 * reach;
    }
    if (nx > plan.left.period_x || ny > plan.left.period_y) return std::nullopt;
  }
  return plan;
}

MultilevelKernel::MultilevelKernel(const Plan& plan, const RowPartition& rows)
    : boundary_(plan.boundary),
      rows_(rows),
      halo_rows_(halo_rows(rows, plan.boundary)),
      error_(plan.error),
      ny_(plan.ny),
      stencil_(whole_stencil<49>(plan.stencils.front())) {
  Index nx = plan.nx, ny = plan.ny;
  for (std::size_t k = 0; k < plan.stencils.size(); ++k) {
    if (k > 0) levels_.back().stencil = whole_stencil<25>(plan.stencils[k]);
    add_level(nx, ny);
  }
  add_coarsest(nx, ny, plan.left);
}

// Adds the next coarser level. nx, ny: number of cells of the last level on entry, of the new level
// on return.
void MultilevelKernel::add_level(Index& nx, Index& ny) {
  Shift shift = {0, 0};
  if (boundary_ == Boundary::periodic) {
    nx /= 2;
    ny /= 2;
  } else {
    // Cell `reach` of every coarse level lies at cell 0 of the grid.
    const Index finer_reach = levels_.empty() ? 0 : reach;
    nx = (nx + 1) / 2 + 2 * reach;
    ny = (ny + 1) / 2 + 2 * reach;
    shift = {2 * reach - finer_reach, 2 * reach - finer_reach};
  }
  const RowPartition& finer = levels_.empty() ? rows_ : levels_.back().rows;
  const RowPartition of_spring = coarser(finer, nx, shift.x);
  Level level(of_spring, boundary_);
  level.shift = level.local_shift = shift;
  level.local_shift.x += finer.begin() - 2 * of_spring.begin();
  level.source = HaloField<float>(of_spring.count(), ny);
  level.image = HaloField<float>(of_spring.count(), ny);
  levels_.push_back(std::move(level));
}

// Adds the coarsest level, a convolution with the symbol `left` that the stencils leave. Its rows
// are distributed by whole blocks of 16.
void MultilevelKernel::add_coarsest(Index nx, Index ny, const QuarterSymbol& left) {
  const RowPartition last = levels_.back().rows,
                     whole_blocks(rows_.communicator(), nx, min_coarsest_rows);
  const auto all_of = [](const RowPartition& partition) {
    return [partition](int rank) {
      return RowExchange::Window{partition.begin_of(rank),
                                 partition.end_of(rank) - partition.begin_of(rank)};
    };
  };
  coarsest_rows_ = whole_blocks;
  to_coarsest_.emplace(last, all_of(whole_blocks), RowExchange::Edge::none);
  from_coarsest_.emplace(whole_blocks, all_of(last), RowExchange::Edge::none);
  coarsest_field_ = large_array<float>(static_cast<std::size_t>(whole_blocks.count() * ny));
  coarsest_.emplace(Convolution2D<float>::Shape{nx, ny, left.period_x, left.period_y}, 1,
                    whole_blocks);
  coarsest_->set_symbol(0, 0, [&](Index i, Index j) { return left.value[left.index(i, j)]; });
}

void MultilevelKernel::list_tiles(const std::vector<unsigned char>& in_use) {
  const bool periodic = boundary_ == Boundary::periodic;
  const std::vector<unsigned char>* finer = &in_use;
  const RowPartition* finer_rows = &rows_;
  Index finer_ny = ny_;
  for (Level& level : levels_) {
    const Index ny = level.source.ny(), across = tiles_across(ny);
    const Index finer_across = tiles_across(finer_ny);
    // The tiles of a coarse row that each tile of a finer row is restricted to; they are the same
    // for every row.
    std::vector<std::vector<Index>> reached(static_cast<std::size_t>(finer_across));
    for (Index k = 0; k < finer_across; ++k) {
      const Index first = k * tile_width, last = std::min(first + tile_width, finer_ny) - 1;
      auto& tiles = reached[static_cast<std::size_t>(k)];
      for (Index j = first_reached(first + level.shift.y); j <= last_reached(last + level.shift.y);
           ++j) {
        const Index tile = (periodic ? (j % ny + ny) % ny : j) / tile_width;
        if (std::find(tiles.begin(), tiles.end(), tile) == tiles.end()) tiles.push_back(tile);
      }
    }
    // Rows of the finer grid that are restricted to the rows of process `rank`.
    const auto reaching = [&](int rank) {
      const Index begin = level.rows.begin_of(rank), end = level.rows.end_of(rank);
      if (begin == end) return RowExchange::Window{};
      return RowExchange::Window{2 * begin - level.shift.x - reach,
                                 2 * (end - 1 - begin) + 2 * reach + 1};
    };
    const auto window = reaching(level.rows.communicator().rank());
    std::vector<unsigned char> used_rows(static_cast<std::size_t>(window.count * finer_across), 0);
    const auto row_bytes = static_cast<std::size_t>(finer_across);
    RowExchange(*finer_rows, reaching,
                periodic ? RowExchange::Edge::repeat : RowExchange::Edge::none)(
        finer->data(), row_bytes, used_rows.data(), row_bytes, row_bytes);
    level.in_use.assign(static_cast<std::size_t>(level.rows.count() * across), 0);
    for (Index row = 0; row < window.count; ++row) {
      const unsigned char* used = used_rows.data() + row * finer_across;
      const Index x = window.first + row + level.shift.x;
      const Index first = std::max(first_reached(x), level.rows.begin()),
                  last = std::min(last_reached(x), level.rows.end() - 1);
      for (Index k = 0; k < finer_across; ++k) {
        if (!used[k]) continue;
        for (Index i = first; i <= last; ++i)
          for (const Index tile : reached[static_cast<std::size_t>(k)])
            level.in_use[static_cast<std::size_t>((i - level.rows.begin()) * across + tile)] = 1;
      }
    }
    level.tiles.clear();
    for (Index row = 0; row < level.rows.count(); ++row)
      append_tiles(level.in_use.data() + row * across, row, across, level.tiles);
    level.source.clear();
    finer = &level.in_use;
    finer_rows = &level.rows;
    finer_ny = ny;
  }
}

void MultilevelKernel::descend(HaloField<float>& source) {
  const MultilevelKernels& kernels = multilevel_passes();
  source.fill_halo(boundary_, *halo_rows_);
  source_ = view(source);
  HaloView finer = source_;
  for (Level& level : levels_) {
    const HaloView coarse = view(level.source);
    for_tiles_of(level.tiles, [&](Index begin, Index end) {
      kernels.restriction(level.tiles.data(), begin, end, finer, level.local_shift, coarse);
    });
    level.source.fill_halo(boundary_, level.halo_rows);
    finer = coarse;
  }
  Level& last = levels_.back();
  const Index ny = last.source.ny();
  float* field = coarsest_field_.get();
  const auto bytes = [](Index cells) { return static_cast<std::size_t>(cells) * sizeof(float); };
  (*to_coarsest_)(last.source.row(0), bytes(last.source.stride()), field, bytes(ny), bytes(ny));
  coarsest_->apply(field, field);
  (*from_coarsest_)(field, bytes(ny), last.image.row(0), bytes(last.image.stride()), bytes(ny));
  last.image.fill_halo(boundary_, last.halo_rows);
  for (std::size_t k = levels_.size() - 1; k-- > 0;) {
    Level& level = levels_[k];
    const Ascent sum{view(level.source), level.stencil.data(), view(levels_[k + 1].image),
                     levels_[k + 1].local_shift};
    const HaloView image = view(level.image);
    for_tiles_of(level.tiles, [&](Index begin, Index end) {
      kernels.ascent(level.tiles.data(), begin, end, sum, image);
    });
    level.image.fill_halo(boundary_, level.halo_rows);
  }
}

void MultilevelKernel::collect(const Tile* tiles, Index begin, Index end, float* row) const {
  const Level& first = levels_.front();
  multilevel_passes().last_ascent(
      tiles, begin, end, {source_, stencil_.data(), view(first.image), first.local_shift}, row);
}

}  // namespace salebra::detail
