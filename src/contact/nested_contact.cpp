// SPDX-License-Identifier: GPL-3.0-or-later
#include "nested_contact.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>

namespace salebra::detail {
namespace {

constexpr Index coarsest_points = 64 * 64;
constexpr Index least_cells_across = 16;

Index halved(Index n) {
  if (n <= least_cells_across) return n;
  return n % 2 == 0 ? n / 2 : fast_transform_size(n / 2);
}

Index into(Index k, Index n, Boundary boundary) {
  return boundary == Boundary::periodic ? (k % n + n) % n : std::clamp<Index>(k, 0, n - 1);
}

// Where the points of one axis lie on an axis with another number of points over the same length.
struct Place {
  Index base;       // the point at or before
  double fraction;  // of the way to the next
};
Place place(Index k, Index from, Index to) {
  const Index position = k * to;
  return {position / from, static_cast<double>(position % from) / static_cast<double>(from)};
}

// Four-point interpolation at one place: linear and cubic (Lagrange) weights of the points base − 1 … base + 2.
struct Weights {
  std::array<Index, 4> point;
  std::array<float, 4> linear, cubic;
};
std::vector<Weights> interpolation(Index coarse, Index fine, Boundary boundary) {
  std::vector<Weights> weights(static_cast<std::size_t>(fine));
  for (Index k = 0; k < fine; ++k) {
    const auto [base, f] = place(k, fine, coarse);
    Weights& w = weights[static_cast<std::size_t>(k)];
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

Field sampled(const Grid2D& fine, const Heights& heights, Index nx, Index ny, Boundary boundary) {
  Field coarse(nx, ny);
  const auto at = [&](Index i, Index j) {
    return heights[into(i, fine.nx, boundary) * fine.ny + into(j, fine.ny, boundary)];
  };
  parallel::for_slabs(
      nx,
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
          for (Index j = 0; j < ny; ++j) {
            const auto [a, x] = place(i, nx, fine.nx);
            const auto [b, y] = place(j, ny, fine.ny);
            double value = at(a, b);
            if (x > 0 || y > 0)
              value = (1 - x) * ((1 - y) * value + y * at(a, b + 1)) +
                      x * ((1 - y) * at(a + 1, b) + y * at(a + 1, b + 1));
            coarse(i, j) = value;
          }
      },
      nx * ny);
  return coarse;
}

}  // namespace

std::vector<ContactLevel> contact_levels(const Grid2D& grid, const Heights& heights,
                                         Boundary boundary, int most) {
  std::vector<ContactLevel> levels;
  levels.push_back({grid, {}, heights});
  while (levels.back().grid.points() > coarsest_points && static_cast<int>(levels.size()) < most) {
    const ContactLevel& fine = levels.back();
    const Index nx = halved(fine.grid.nx), ny = halved(fine.grid.ny);
    if (nx == fine.grid.nx && ny == fine.grid.ny) break;
    ContactLevel coarse{
        {nx, ny, grid.lx, grid.ly}, sampled(fine.grid, fine.heights, nx, ny, boundary), {}};
    levels.push_back(std::move(coarse));
    levels.back().heights = {
        levels.back().coarse_heights.data()};  // a moved Eigen array keeps its memory
  }
  return levels;
}

void prolong(const ContactLevel& coarse, const Field& coarse_pressure, const Field& coarse_gap,
             double level, const ContactLevel& fine, Boundary boundary, double step,
             double* pressure) {
  using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Index ny = fine.grid.ny;
  const auto along_y = interpolation(coarse.grid.ny, ny, boundary);
  const auto along_x = interpolation(coarse.grid.nx, fine.grid.nx, boundary);
  Rows p_rows(coarse.grid.nx, ny), u_rows(coarse.grid.nx, ny);
  parallel::for_slabs(
      coarse.grid.nx,
      [&](Index begin, Index end) {
        std::vector<float> displacement(static_cast<std::size_t>(coarse.grid.ny));
        for (Index i = begin; i < end; ++i) {
          for (Index j = 0; j < coarse.grid.ny; ++j)
            displacement[static_cast<std::size_t>(j)] = static_cast<float>(
                coarse_gap(i, j) + coarse.heights[i * coarse.grid.ny + j] - level);
          for (Index j = 0; j < ny; ++j) {
            const Weights& w = along_y[static_cast<std::size_t>(j)];
            float p = 0, u = 0;
            for (std::size_t k = 0; k < 4; ++k) {
              p += w.linear[k] * static_cast<float>(coarse_pressure(i, w.point[k]));
              u += w.cubic[k] * displacement[static_cast<std::size_t>(w.point[k])];
            }
            p_rows(i, j) = p;
            u_rows(i, j) = u;
          }
        }
      },
      coarse.grid.points());
  parallel::for_slabs(
      fine.grid.nx,
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const Weights& w = along_x[static_cast<std::size_t>(i)];
          for (Index j = 0; j < ny; ++j) {
            float p = 0, u = 0;
            for (std::size_t k = 0; k < 4; ++k) {
              p += w.linear[k] * p_rows(w.point[k], j);
              u += w.cubic[k] * u_rows(w.point[k], j);
            }
            const double predicted =
                static_cast<double>(p) - step * (static_cast<double>(u) - fine.heights[i * ny + j]);
            pressure[i * ny + j] = std::max(0.0, predicted);
          }
        }
      },
      fine.grid.points());
}

}  // namespace salebra::detail
