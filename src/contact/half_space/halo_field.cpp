// SPDX-License-Identifier: GPL-3.0-or-later
// A field with a halo around it. The halo repeats the opposite edge of the field, holds rows of
// other processes, or is zero.
#include "halo_field.hpp"

#include <algorithm>
#include <salebra/base/parallel.hpp>

namespace salebra::detail {
namespace {

// Numbers allocated behind the last row: vector loads of a tile, and of two tiles on the finer
// grid, may end beyond the halo of the last row.
constexpr Index slack = 4 * tile_width;

}  // namespace

void append_tiles(const unsigned char* in_use, Index row, Index across, std::vector<Tile>& tiles) {
  for (Index k = 0; k < across; ++k)
    if (in_use[k])
      tiles.push_back({static_cast<std::int32_t>(row), static_cast<std::int32_t>(k * tile_width)});
}

template <class Real>
HaloField<Real>::HaloField(Index nx, Index ny)
    : nx_(nx),
      ny_(ny),
      stride_(tiles_across(ny) * tile_width + 2 * side_halo),
      data_(large_array<Real>(static_cast<std::size_t>((nx + 2 * rows_around) * stride_ + slack))) {
  clear();
}

template <class Real>
void HaloField<Real>::clear() {
  const Index rows = nx_ + 2 * rows_around;
  parallel::for_slabs(
      rows,
      [&](Index begin, Index last) {
        std::fill(data_.get() + begin * stride_, data_.get() + last * stride_, Real(0));
      },
      nx_ * ny_);
  std::fill_n(data_.get() + rows * stride_, slack, Real(0));
}

template <class Real>
void HaloField<Real>::fill_halo(Boundary boundary, const RowExchange& halo_rows) {
  const auto wrapped = [](Index k, Index n) { return (k % n + n) % n; };
  if (boundary == Boundary::periodic)
    parallel::for_slabs(
        nx_,
        [&](Index begin, Index end) {
          for (Index i = begin; i < end; ++i) {
            Real* cells = row(i);
            for (Index k = 1; k <= halo; ++k) {
              cells[-k] = cells[wrapped(-k, ny_)];
              cells[ny_ + k - 1] = cells[wrapped(k - 1, ny_)];
            }
          }
        },
        nx_ * ny_);
  const std::size_t bytes = static_cast<std::size_t>(stride_) * sizeof(Real);
  halo_rows(row(0) - side_halo, bytes, row(-halo) - side_halo, bytes, bytes);
}

RowExchange halo_rows(const RowPartition& rows, Boundary boundary) {
  const auto with_halo = [&](int rank) {
    return RowExchange::Window{rows.begin_of(rank) - halo,
                               rows.end_of(rank) - rows.begin_of(rank) + 2 * halo};
  };
  return {rows, with_halo,
          boundary == Boundary::periodic ? RowExchange::Edge::repeat : RowExchange::Edge::none};
}

template class HaloField<float>;
template class HaloField<double>;

}  // namespace salebra::detail
