// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the tiles on which the active-set CG works, and changes its set of free cells.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "active_set_cg.hpp"
#include "tile_sums.hpp"

namespace salebra::detail {
template <class Real>
TileArrays<Real> ActiveSetCg<Real>::arrays(double bound) {
  return {tiles_.data(),
          static_cast<Index>(tiles_.size()),
          grid_.ny,
          r_.stride(),
          r_.row(-halo) - side_halo,
          p_,
          g_,
          t_,
          w_,
          z_,
          m_,
          quiet_.data(),
          stencil_.data(),
          bound};
}

template <class Real>
void ActiveSetCg<Real>::reset() {
  operator_chosen_ = on_multilevel_ = false;
  tiles_.clear();
  row_begins_.assign(static_cast<std::size_t>(rows_.count() + 1), 0);
  in_use_.assign(static_cast<std::size_t>(rows_.count() * tiles_per_row_), 0);
  nearest_.resize(in_use_.size());
  if (r_) {
    r_.clear();
  } else {
    r_ = HaloField<Real>(rows_.count(), grid_.ny);
  }
}

template <class Real>
std::byte* ActiveSetCg<Real>::pool(std::size_t bytes) {
  if (bytes > pool_size_) {
    pool_.reset();  // free the old memory first
    // Leave space for a contact that grows: new memory would have to be cleared by the system, and
    // memory that is not touched costs nothing.
    pool_size_ = bytes + bytes / 2;
    pool_ = large_array<std::byte>(pool_size_);
  }
  return pool_.get();
}

// Lists the tiles in use and lays out the packed arrays. The last search direction is dropped:
// carrying it over to the new tiles costs more iterations than it saves, since it belongs to the
// old residual.
template <class Real>
void ActiveSetCg<Real>::list_tiles() {
  tiles_.clear();
  row_begins_.clear();
  for (Index row = 0; row < rows_.count(); ++row) {
    row_begins_.push_back(static_cast<Index>(tiles_.size()));
    append_tiles(in_use_.data() + row * tiles_per_row_, row, tiles_per_row_, tiles_);
  }
  row_begins_.push_back(static_cast<Index>(tiles_.size()));
  const auto size = static_cast<std::size_t>(tile_points());
  std::byte* memory = pool(size * (2 * sizeof(double) + 4 * sizeof(Real)));
  p_ = reinterpret_cast<double*>(memory);
  g_ = p_ + size;
  z_ = reinterpret_cast<Real*>(g_ + size);
  m_ = z_ + size;
  t_ = m_ + size;
  w_ = t_ + size;
  for_tiles([&](Index begin, Index end) {
    std::fill(t_ + begin * tile_width, t_ + end * tile_width, Real(0));
    std::fill(w_ + begin * tile_width, w_ + end * tile_width, Real(0));
  });
  quiet_.assign(tiles_.size(), 0);
  choose_operator();
}

// Returns the fraction of the points that the first tiles of a solve may hold for the multilevel
// kernel to be worthwhile; later there are fewer tiles. Measured on one core (docs/performance.md):
// the multilevel kernel is as fast as a transform if the tiles of a contact hold about 0.6 of the
// points of 512², or all points of 1024². All tiles of a punch hold cells in contact, and the punch
// needs fewer exact transforms: there the limit is 0.85, down to 256². Work other than that of the
// stencils weighs less on large grids.
template <class Real>
double ActiveSetCg<Real>::worthwhile_share(bool punch) const {
  const double doublings = 0.5 * std::log2(points_of_transform() / (512.0 * 512.0));
  if (doublings < -0.1 && !punch) return 0;
  return (punch ? 0.85 : 0.6) * std::pow(1.7, std::max(doublings, 0.0));
}

// Chooses the multilevel kernel if few tiles are in use: its work grows with the number of tiles,
// that of a transform does not. The choice is made once per solve, since a change of the operator
// costs more than it saves.
template <class Real>
void ActiveSetCg<Real>::choose_operator() {
  if constexpr (std::is_same_v<Real, float>) {
    if (!operator_chosen_) {
      operator_chosen_ = true;
      double tile_points = 0;  // over all processes
      for (const double of_block : over_tiles<double>([](Index begin, Index end) {
             return static_cast<double>((end - begin) * tile_width);
           }))
        tile_points += of_block;
      if (tile_points > multilevel_share_ * points_of_transform()) return;
      if (!multilevel_) multilevel_ = operators_->multilevel();
      on_multilevel_ = multilevel_.has_value();
    }
    if (on_multilevel_) multilevel_->list_tiles(in_use_);
  }
}

// Chooses the tiles that have a cell under pressure or closer to the contact plane than
// margin·h_rms, and sets which cells of these tiles are free.
template <class Real>
void ActiveSetCg<Real>::choose_tiles(Run& run, double margin) {
  const double near = run.plane_height + margin * rms_height_, bound = run.target.bound;
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * tiles_per_row_; k < end * tiles_per_row_; ++k) {
      const Index row = k / tiles_per_row_, column = k % tiles_per_row_ * tile_width;
      const bool needed = nearest_[static_cast<std::size_t>(k)] < near;
      unsigned char& used = in_use_[static_cast<std::size_t>(k)];
      if (used && !needed)
        std::fill_n(r_.row(row) + column, std::min<Index>(tile_width, grid_.ny - column), Real(0));
      used = needed;
    }
  });
  list_tiles();
  run.has_direction = false;
  // The processor does not predict where the next tile lies in the fields of all cells.
  constexpr Index ahead = 16;
  begin_set(
      run, over_tiles<SetSums>([&](Index begin, Index end) {
        SetSums sums;
        for (Index k = begin; k < end; ++k) {
          const Tile tile = tiles_[static_cast<std::size_t>(k)];
          const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
          const Index dense = tile.row * grid_.ny + tile.column;
          const Index packed = k * tile_width;
          if (k + ahead < end) {
            const Tile next = tiles_[static_cast<std::size_t>(k + ahead)];
            const Index index = next.row * grid_.ny + next.column;
            for (const double* field : {run.p, run.g})
              for (Index line = 0; line < tile_width; line += 8)
                __builtin_prefetch(field + index + line);
          }
          std::copy_n(run.p + dense, width, p_ + packed);
          std::copy_n(run.g + dense, width, g_ + packed);
          // Cells of a tile beyond the end of the row are never free.
          std::fill_n(p_ + packed + width, tile_width - width, 0.0);
          std::fill_n(g_ + packed + width, tile_width - width, 0.0);
          std::fill_n(m_ + packed, tile_width, Real(0));
          // Most of the other tiles have neither load nor a cell below the contact plane.
          if (!(nearest_[static_cast<std::size_t>(tile.row * tiles_per_row_ +
                                                  tile.column / tile_width)] < run.plane_height)) {
            quiet_[static_cast<std::size_t>(k)] = 1;
            continue;
          }
          for (Index i = 0; i < width; ++i) {
            const double p = p_[packed + i], g = g_[packed + i];
            if (!(p >= bound ? g > run.plane_height : p > 0 || g < run.plane_height)) continue;
            m_[packed + i] = Real(1);
            sums.count += 1;
            sums.g += g;
          }
        }
        return sums;
      }));
}

// Copies the pressures of the tiles into the field of all cells, within their bounds and with the
// requested load.
template <class Real>
void ActiveSetCg<Real>::collect_pressure(Run& run) {
  double sum = 0;
  for (const double part : over_tiles<double>([&](Index begin, Index end) {
         return kernels_.clip(p_ + begin * tile_width, (end - begin) * tile_width,
                              run.target.bound);
       }))
    sum += part;
  const bool scaled = run.load_given() && std::isinf(run.target.bound) && sum > 0;
  const double scale = scaled ? run.target.value * static_cast<double>(grid_.points()) / sum : 1;
  unpack_pressure(run, scale);
  if (run.load_given() && !scaled) correct_load(run.target, run.p);
}

// Writes scale·p of the tiles, within the bounds, into the field of all cells, which nothing reads
// between two refreshes.
template <class Real>
void ActiveSetCg<Real>::unpack_pressure(const Run& run, double scale) const {
  for_tiles([&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Tile tile = tiles_[static_cast<std::size_t>(k)];
      const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
      double* p = run.p + tile.row * grid_.ny + tile.column;
      for (Index i = 0; i < width; ++i)
        p[i] = scale * std::min(std::max(p_[k * tile_width + i], 0.0), run.target.bound);
    }
  });
}

// Computes the number of free cells, the plane height and the residual after a change of the set of
// free cells or of g = Gp − h.
template <class Real>
void ActiveSetCg<Real>::begin_set(Run& run, const std::vector<SetSums>& parts) {
  const SetSums total = total_of(parts);
  run.count = total.count;
  if (run.load_given() && run.count > 0) run.plane_height = total.g / run.count;
  const auto a = arrays(run.target.bound);
  for_tiles([&](Index begin, Index end) { kernels_.residual(a, begin, end, run.plane_height); });
}

// Fills the halo of the residual, through which the stencil reads the periodic images and the rows
// of other processes.
template <class Real>
void ActiveSetCg<Real>::fill_halo_of_residual() {
  r_.fill_halo(boundary_, halo_rows_);
}

// Returns the correction that gives the pressures p on the tiles the requested load again, from
// `pressure` = Σp over the cells below the bound.
template <class Real>
LoadCorrection ActiveSetCg<Real>::correction_over_tiles(const Run& run, double pressure) const {
  const double load = run.target.value * static_cast<double>(grid_.points()),
               bound = run.target.bound;
  if (std::isinf(bound)) return {.scale = pressure > 0 ? load / pressure : 1};
  return correction_for_load(load, bound, [&](const LoadCorrection& trial) {
    LoadSums total;
    for (const LoadSums& part : over_tiles<LoadSums>([&](Index begin, Index end) {
           LoadSums sums;
           for (Index k = begin; k < end; ++k) {
             const double* p = p_ + k * tile_width;
             const Index width =
                 std::min<Index>(tile_width, grid_.ny - tiles_[static_cast<std::size_t>(k)].column);
             for (Index i = 0; i < width; ++i) sums.add(trial(p[i], bound), bound);
           }
           return sums;
         }))
      total += part;
    return total;
  });
}

// Changes the set of free cells. With truncate it also puts the pressures within their bounds and
// restores their load, at the cost of one application of the normal compliance.
template <class Real>
void ActiveSetCg<Real>::change_set(Run& run, bool truncate, double pressure) {
  const auto a = arrays(run.target.bound);
  if (!truncate) {
    begin_set(run, over_tiles<SetSums>([&](Index begin, Index end) {
                return kernels_.change_set(a, begin, end, run.plane_height);
              }));
    return;
  }
  const LoadCorrection correction =
      run.load_given() ? correction_over_tiles(run, pressure) : LoadCorrection{};
  for_tiles([&](Index begin, Index end) {
    kernels_.truncate(a, begin, end, run.plane_height,
                      {correction.scale, correction.shift, correction.full_from});
  });
  // The last search direction and its displacement stay valid: CG continues without a restart.
  std::vector<SetSums> sums;
  {
    const Applying applying(*this, run.outcome);
    sums = by_blocks(
        rows_, displace<SetSums>([&](Index begin, Index end,
                                     Real* row) { kernels_.spread_change(a, begin, end, row); },
                                 [&](Index begin, Index end, const Real* row) {
                                   return kernels_.add_displacement(a, begin, end, row);
                                 }));
  }
  begin_set(run, sums);
}

template class ActiveSetCg<float>;
template class ActiveSetCg<double>;

}  // namespace salebra::detail
