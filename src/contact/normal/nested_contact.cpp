// SPDX-License-Identifier: GPL-3.0-or-later
// Coarser grids of a contact problem, and transfer of a solution to the next finer grid.
#include "nested_contact.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/row_partition.hpp>

#include "base/memory.hpp"

namespace salebra::detail {
namespace {

constexpr Index coarsest_points = 64 * 64;
constexpr Index min_cells_across = 16;

Index halved(Index n) {
  if (n <= min_cells_across) return n;
  return n % 2 == 0 ? n / 2 : fast_transform_size(n / 2);
}

// Minimum rows of a process that takes part on a coarse grid: for fewer rows, communication takes
// longer than computation.
constexpr Index min_coarse_rows = 64;

RowExchange::Edge edge_of(Boundary boundary) {
  return boundary == Boundary::periodic ? RowExchange::Edge::repeat : RowExchange::Edge::clamp;
}

Index into(Index k, Index n, Boundary boundary) {
  return boundary == Boundary::periodic ? (k % n + n) % n : std::clamp<Index>(k, 0, n - 1);
}

// Position of a point of one axis on another axis of the same length that has another number of
// points.
struct Place {
  Index base;       // last point at or before the position
  double fraction;  // part of the distance to the next point
};
Place index(Index k, Index from, Index to) {
  const Index position = k * to;
  return {position / from, static_cast<double>(position % from) / static_cast<double>(from)};
}

// Interpolation at one position from the points base − 1 … base + 2: weights of these four points
// for linear and for cubic (Lagrange) interpolation.
struct Weights {
  Index base;
  std::array<Index, 4> point;  // indices of the four points, wrapped or clamped
  std::array<float, 4> linear, cubic;
};
std::vector<Weights> interpolation(Index coarse, Index fine, Boundary boundary) {
  std::vector<Weights> weights(static_cast<std::size_t>(fine));
  for (Index k = 0; k < fine; ++k) {
    const auto [base, f] = index(k, fine, coarse);
    Weights& w = weights[static_cast<std::size_t>(k)];
    w.base = base;
    for (Index i = 0; i < 4; ++i)
      w.point[static_cast<std::size_t>(i)] = into(base - 1 + i, coarse, boundary);
    w.linear = {0, static_cast<float>(1 - f), static_cast<float>(f), 0};
    w.cubic = {static_cast<float>(-f * (f - 1) * (f - 2) / 6),
               static_cast<float>((f + 1) * (f - 1) * (f - 2) / 2),
               static_cast<float>(-(f + 1) * f * (f - 2) / 2),
               static_cast<float>((f + 1) * f * (f - 1) / 6)};
  }
  return weights;
}

// Heights on a coarser grid, for the rows of this process.
Field sampled(const MultigridLevel& fine, const RowPartition& rows, Index ny, Boundary boundary) {
  const Index fine_ny = fine.grid.ny;
  const auto wanted = [&](int rank) {
    const Index begin = rows.begin_of(rank), end = rows.end_of(rank);
    if (begin == end) return RowExchange::Window{};
    const Index first = index(begin, rows.rows(), fine.grid.nx).base;
    return RowExchange::Window{first, index(end - 1, rows.rows(), fine.grid.nx).base + 2 - first};
  };
  const Index first = wanted(rows.communicator().rank()).first;
  const std::size_t row_bytes = static_cast<std::size_t>(fine_ny) * sizeof(double);
  std::vector<std::byte> buffer;
  const auto fetched = RowExchange(fine.rows, wanted, edge_of(boundary))
                           .fetch(fine.heights.values, row_bytes, row_bytes, buffer);
  Field coarse(rows.count(), ny);
  std::vector<Place> along_y;
  for (Index j = 0; j < ny; ++j) along_y.push_back(index(j, ny, fine_ny));
  parallel::for_slabs(
      rows.count(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const auto [a, x] = index(rows.begin() + i, rows.rows(), fine.grid.nx);
          const auto* row =
              static_cast<const double*>(fetched[static_cast<std::size_t>(a - first)]);
          const auto* next =
              static_cast<const double*>(fetched[static_cast<std::size_t>(a + 1 - first)]);
          const double zero = fine.heights.zero;
          for (Index j = 0; j < ny; ++j) {
            const auto [b, y] = along_y[static_cast<std::size_t>(j)];
            double value = row[b] - zero;
            if (x > 0 || y > 0) {
              const Index beyond = into(b + 1, fine_ny, boundary);
              value = (1 - x) * ((1 - y) * value + y * (row[beyond] - zero)) +
                      x * ((1 - y) * (next[b] - zero) + y * (next[beyond] - zero));
            }
            coarse(i, j) = value;
          }
        }
      },
      rows.count() * ny);
  return coarse;
}

// Interpolates pressure and displacement of one coarse row to the points of a row of the finer
// grid. Copies of the coarse row have one more point before and two more after it, which the
// four-point interpolation needs.
class RowStretch {
 public:
  RowStretch(Index coarse, const std::vector<Weights>& along, Boundary boundary)
      : coarse_(coarse),
        along_(along),
        boundary_(boundary),
        p_with_halo_(static_cast<std::size_t>(coarse + 3)),
        u_with_halo_(p_with_halo_) {}

  // Takes a row of the pressure, gap and heights of a coarse solution.
  void load(const CoarseSolution& from, const double* pressure, const double* gap,
            const double* heights) {
    float *p = p_with_halo_.data() + 1, *u = u_with_halo_.data() + 1;
    const double zero = from.grid.heights.zero;
    for (Index j = 0; j < coarse_; ++j) {
      p[j] = static_cast<float>(pressure[j]);
      u[j] = static_cast<float>(gap[j] + (heights[j] - zero) - from.plane_height);
    }
    for (const Index j : {Index(-1), coarse_, coarse_ + 1}) {
      p[j] = p[into(j, coarse_, boundary_)];
      u[j] = u[into(j, coarse_, boundary_)];
    }
  }

  void write(float* p_row, float* u_row) const {
    const float *p = p_with_halo_.data() + 1, *u = u_with_halo_.data() + 1;
    const auto fine = static_cast<Index>(along_.size());
    if (fine == 2 * coarse_) {
      const Weights& between = along_[1];
      const float outer = between.cubic[0], inner = between.cubic[1];
      for (Index j = 0; j < coarse_; ++j) {
        p_row[2 * j] = p[j];
        p_row[2 * j + 1] = 0.5f * (p[j] + p[j + 1]);
        u_row[2 * j] = u[j];
        u_row[2 * j + 1] = inner * (u[j] + u[j + 1]) + outer * (u[j - 1] + u[j + 2]);
      }
      return;
    }
    for (Index j = 0; j < fine; ++j) {
      const Weights& w = along_[static_cast<std::size_t>(j)];
      p_row[j] = w.linear[1] * p[w.point[1]] + w.linear[2] * p[w.point[2]];
      u_row[j] = 0;
      for (std::size_t k = 0; k < 4; ++k) u_row[j] += w.cubic[k] * u[w.point[k]];
    }
  }

 private:
  const Index coarse_;
  const std::vector<Weights>& along_;
  const Boundary boundary_;
  std::vector<float> p_with_halo_, u_with_halo_;
};

// The four coarse rows, already interpolated along y, around one row of the finer grid, and the
// weights of these rows.
struct FourRows {
  const Weights& w;
  std::array<const float*, 4> p, u;
};

void predict_row(const FourRows& rows, const MultigridLevel& fine, Index row_of_fine, double step,
                 double* row) {
  const auto& [w, p, u] = rows;
  const Index ny = fine.grid.ny;
  const double* heights = fine.heights.values + row_of_fine * ny;
  const double zero = fine.heights.zero;
  const auto predict = [&](Index j, float p_here, float u_here) {
    const double predicted =
        static_cast<double>(p_here) - step * (static_cast<double>(u_here) - (heights[j] - zero));
    row[j] = predicted > 0 ? predicted : 0;
  };
  if (w.linear[2] == 0) {
    for (Index j = 0; j < ny; ++j) predict(j, p[1][j], u[1][j]);
  } else {
    for (Index j = 0; j < ny; ++j)
      predict(j, w.linear[1] * p[1][j] + w.linear[2] * p[2][j],
              w.cubic[0] * u[0][j] + w.cubic[1] * u[1][j] + w.cubic[2] * u[2][j] +
                  w.cubic[3] * u[3][j]);
  }
}

}  // namespace

std::vector<MultigridLevel> multigrid_levels(const Grid2D& grid, const RowPartition& rows,
                                             const Heights& heights, Boundary boundary, int most) {
  std::vector<MultigridLevel> levels;
  levels.push_back({grid, rows, {}, heights});
  while (levels.back().grid.points() > coarsest_points && static_cast<int>(levels.size()) < most) {
    const MultigridLevel& fine = levels.back();
    const Index nx = halved(fine.grid.nx), ny = halved(fine.grid.ny);
    if (nx == fine.grid.nx && ny == fine.grid.ny) break;
    const RowPartition coarse_rows(rows.communicator(), nx, min_coarse_rows);
    MultigridLevel coarse{
        {nx, ny, grid.lx, grid.ly}, coarse_rows, sampled(fine, coarse_rows, ny, boundary), {}};
    levels.push_back(std::move(coarse));
    levels.back().heights = {
        levels.back().coarse_heights.data()};  // a moved Eigen array keeps its memory
  }
  return levels;
}

void prolong(const CoarseSolution& coarse, const MultigridLevel& fine, Boundary boundary,
             double step, double* pressure) {
  const RowPartition& coarse_rows = coarse.grid.rows;
  const Index coarse_ny = coarse.grid.grid.ny, ny = fine.grid.ny;
  const auto along_y = interpolation(coarse_ny, ny, boundary);
  const auto along_x = interpolation(coarse.grid.grid.nx, fine.grid.nx, boundary);
  // The window of coarse rows from which the rows of process `rank` are interpolated.
  const auto wanted = [&](int rank) {
    const Index begin = fine.rows.begin_of(rank), end = fine.rows.end_of(rank);
    if (begin == end) return RowExchange::Window{};
    const Index first = along_x[static_cast<std::size_t>(begin)].base - 1;
    return RowExchange::Window{first, along_x[static_cast<std::size_t>(end - 1)].base + 3 - first};
  };
  const RowExchange neighbours(coarse_rows, wanted, edge_of(boundary));
  const Index first = wanted(fine.rows.communicator().rank()).first;
  const std::size_t row_bytes = static_cast<std::size_t>(coarse_ny) * sizeof(double);
  std::array<std::vector<std::byte>, 3> buffers;
  const auto fetch = [&](const double* rows, std::vector<std::byte>& buffer) {
    return neighbours.fetch(rows, row_bytes, row_bytes, buffer);
  };
  const auto pressures = fetch(coarse.pressure.data(), buffers[0]),
             gaps = fetch(coarse.gap.data(), buffers[1]),
             heights = fetch(coarse.grid.heights.values, buffers[2]);
  parallel::for_slabs(
      fine.rows.count(),
      [&](Index begin, Index end) {
        RowStretch stretch(coarse_ny, along_y, boundary);
        // The last four coarse rows, interpolated along y, each at its index modulo 4.
        std::vector<float> stretched(static_cast<std::size_t>(8 * ny));
        std::array<std::size_t, 4> held;
        held.fill(pressures.size());
        for (Index i = begin; i < end; ++i) {
          const Weights& w = along_x[static_cast<std::size_t>(fine.rows.begin() + i)];
          std::array<const float*, 4> p{}, u{};
          for (std::size_t k = 0; k < 4; ++k) {
            const auto row = static_cast<std::size_t>(w.base - 1 - first) + k;
            float* p_row = stretched.data() + 2 * static_cast<Index>(row % 4) * ny;
            float* u_row = p_row + ny;
            if (held[row % 4] != row) {
              const auto values = [&](const std::vector<const void*>& rows) {
                return static_cast<const double*>(rows[row]);
              };
              stretch.load(coarse, values(pressures), values(gaps), values(heights));
              stretch.write(p_row, u_row);
              held[row % 4] = row;
            }
            p[k] = p_row;
            u[k] = u_row;
          }
          predict_row({w, p, u}, fine, i, step, pressure + i * ny);
        }
      },
      fine.rows.count() * ny);
}

}  // namespace salebra::detail
