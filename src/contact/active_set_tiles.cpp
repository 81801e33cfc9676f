// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "active_set_cg.hpp"

namespace salebra::detail {

template <class Real>
TileArrays<Real> ActiveSetCg<Real>::arrays(double bound) {
  return {
      tiles_.data(), grid_.ny,        framed_stride_, t_.get(), w_.get(), r_.get(), p_, g_, z_, m_,
      quiet_.data(), stencil_.data(), bound};
}

template <class Real>
void ActiveSetCg<Real>::reset() {
  tiles_.clear();
  in_use_.assign(static_cast<std::size_t>(grid_.nx * tiles_per_row_), 0);
  const Index framed_rows = grid_.nx + 2 * frame;
  if (!t_) {
    t_ = large_array<Real>(static_cast<std::size_t>(points()));
    w_ = large_array<Real>(static_cast<std::size_t>(points()));
    // A tile's vectors may end beyond the frame of the last row.
    r_ = large_array<Real>(static_cast<std::size_t>(framed_rows * framed_stride_ + tile_width));
  }
  for_rows([&](Index begin, Index end) {
    std::fill(t_.get() + begin * grid_.ny, t_.get() + end * grid_.ny, Real(0));
    std::fill(w_.get() + begin * grid_.ny, w_.get() + end * grid_.ny, Real(0));
    const Index last = end == grid_.nx ? framed_rows : end;
    std::fill(r_.get() + begin * framed_stride_, r_.get() + last * framed_stride_, Real(0));
  });
  std::fill_n(r_.get() + framed_rows * framed_stride_, tile_width, Real(0));
}

template <class Real>
std::byte* ActiveSetCg<Real>::pool(std::size_t bytes) {
  if (bytes > pool_size_) {
    pool_.reset();  // first, lest both are there at once
    pool_ = large_array<std::byte>(bytes);
    pool_size_ = bytes;
  }
  return pool_.get();
}

// The tiles that are in use, row by row, with room for what is stored tile after tile.
template <class Real>
void ActiveSetCg<Real>::list_tiles() {
  tiles_.clear();
  for (Index row = 0; row < grid_.nx; ++row)
    for (Index k = 0; k < tiles_per_row_; ++k)
      if (in_use_[static_cast<std::size_t>(row * tiles_per_row_ + k)])
        tiles_.push_back(
            {static_cast<std::int32_t>(row), static_cast<std::int32_t>(k * tile_width)});
  const auto size = static_cast<std::size_t>(tile_points());
  std::byte* memory = pool(size * 2 * (sizeof(double) + sizeof(Real)));
  p_ = reinterpret_cast<double*>(memory);
  g_ = p_ + size;
  z_ = reinterpret_cast<Real*>(g_ + size);
  m_ = z_ + size;
  quiet_.assign(tiles_.size(), 0);
}

// The tiles of all cells that carry pressure or are closer to the plane than margin·h_rms, and the free cells in them.
template <class Real>
void ActiveSetCg<Real>::choose_tiles(Run& run, double margin) {
  const double near = run.level + margin * rms_height_, bound = run.target.bound;
  for_rows([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index k = 0; k < tiles_per_row_; ++k) {
        const Index column = k * tile_width, width = std::min<Index>(tile_width, grid_.ny - column);
        const double* p = run.p + row * grid_.ny + column;
        const double* g = run.g + row * grid_.ny + column;
        bool needed = false;
        for (Index i = 0; i < width; ++i) needed |= (p[i] > 0) | (g[i] < near);
        unsigned char& used = in_use_[static_cast<std::size_t>(row * tiles_per_row_ + k)];
        if (used && !needed) {
          std::fill_n(t_.get() + row * grid_.ny + column, width, Real(0));
          std::fill_n(r_.get() + (row + frame) * framed_stride_ + column + side_frame, width,
                      Real(0));
        }
        used = needed;
      }
  });
  list_tiles();
  begin_set(
      run, over_tiles<SetSums>([&](Index begin, Index end) {
        SetSums sums;
        for (Index k = begin; k < end; ++k) {
          const Tile tile = tiles_[static_cast<std::size_t>(k)];
          const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
          const Index dense = tile.row * grid_.ny + tile.column;
          const Index packed = k * tile_width;
          bool busy = false;
          for (Index i = 0; i < tile_width; ++i) {
            const double p = i < width ? run.p[dense + i] : 0, g = i < width ? run.g[dense + i] : 0;
            const bool free = i < width && (p >= bound ? g > run.level : p > 0 || g < run.level);
            p_[packed + i] = p;
            g_[packed + i] = g;
            m_[packed + i] = free ? Real(1) : Real(0);
            sums.count += free ? 1 : 0;
            sums.g += free ? g : 0;
            busy |= free || p != 0;
          }
          if (busy) continue;
          quiet_[static_cast<std::size_t>(k)] = 1;
          std::fill_n(t_.get() + dense, width, Real(0));
          std::fill_n(r_.get() + (tile.row + frame) * framed_stride_ + tile.column + side_frame,
                      width, Real(0));
        }
        return sums;
      }));
}

// Puts p back into the dense array, within its bounds and at its load.
template <class Real>
void ActiveSetCg<Real>::collect_pressure(Run& run) {
  double sum = 0;
  for (const double part : over_tiles<double>([&](Index begin, Index end) {
         return kernels_.clip(p_ + begin * tile_width, (end - begin) * tile_width,
                              run.target.bound);
       }))
    sum += part;
  const bool scaled = run.load_given() && std::isinf(run.target.bound) && sum > 0;
  const double scale = scaled ? run.target.value * static_cast<double>(points()) / sum : 1;
  for_tiles([&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Tile tile = tiles_[static_cast<std::size_t>(k)];
      const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
      double* p = run.p + tile.row * grid_.ny + tile.column;
      for (Index i = 0; i < width; ++i) p[i] = scale * p_[k * tile_width + i];
    }
  });
  if (run.load_given() && !scaled) correct_load(run.target, run.p);
}

// Number of free cells, the level, and the residual on them, after the set or g changed.
template <class Real>
void ActiveSetCg<Real>::begin_set(Run& run, const std::vector<SetSums>& parts) {
  SetSums total;
  for (const SetSums& part : parts) {
    total.count += part.count;
    total.g += part.g;
  }
  run.count = total.count;
  if (run.load_given() && run.count > 0) run.level = total.g / run.count;
  const auto a = arrays(run.target.bound);
  for_tiles([&](Index begin, Index end) { kernels_.residual(a, begin, end, run.level); });
}

// Copies the edges of the residual into its frame, so that the stencil sees the periodic images.
template <class Real>
void ActiveSetCg<Real>::frame_residual() {
  if (boundary_ == Boundary::free) return;
  const Index nx = grid_.nx, ny = grid_.ny;
  const auto wrapped = [](Index k, Index n) { return (k % n + n) % n; };
  for_rows([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      Real* r = r_.get() + (row + frame) * framed_stride_ + side_frame;
      for (Index k = 1; k <= frame; ++k) {
        r[-k] = r[wrapped(-k, ny)];
        r[ny + k - 1] = r[wrapped(k - 1, ny)];
      }
    }
  });
  const auto copy_row = [&](Index to, Index from) {
    std::copy_n(r_.get() + (from + frame) * framed_stride_, framed_stride_,
                r_.get() + (to + frame) * framed_stride_);
  };
  for (Index k = 1; k <= frame; ++k) {
    copy_row(-k, wrapped(-k, nx));
    copy_row(nx + k - 1, wrapped(k - 1, nx));
  }
}

// The correction that puts p on the tiles back to the load, given Σp over the cells below the bound.
template <class Real>
LoadCorrection ActiveSetCg<Real>::correction_over_tiles(const Run& run, double pressure) const {
  const double load = run.target.value * static_cast<double>(points()), bound = run.target.bound;
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

// Takes new free cells; with truncate also puts p back within its bounds and to
// its load, at the cost of one transform pair.
template <class Real>
void ActiveSetCg<Real>::change_set(Run& run, bool truncate, double pressure) {
  const auto a = arrays(run.target.bound);
  if (!truncate) {
    begin_set(run, over_tiles<SetSums>([&](Index begin, Index end) {
                return kernels_.change_set(a, begin, end, run.level);
              }));
    return;
  }
  const LoadCorrection correction =
      run.load_given() ? correction_over_tiles(run, pressure) : LoadCorrection{};
  for_tiles([&](Index begin, Index end) {
    kernels_.truncate(a, begin, end, run.level, correction.scale, correction.shift);
  });
  // The last direction and its image come back afterwards: CG goes on without a restart.
  transform(run, t_.get(), w_.get());
  const auto sums = over_tiles<SetSums>(
      [&](Index begin, Index end) { return kernels_.add_displacement(a, begin, end); });
  begin_set(run, sums);
}

template class ActiveSetCg<float>;
template class ActiveSetCg<double>;

}  // namespace salebra::detail
