// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic sum of the Boussinesq displacements of point loads by Ewald splitting and gridding.
#include "periodic_point_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/convolution.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

// Distance, in units of 1/α, at which the short-range part erfc(αr)/r is cut off, with Ewald's
// parameter α. It drops erfc(4.5) = 2e-10, and as much of the spectrum erfc(q/2α) of the long-range
// part beyond the wave number q = 9α.
constexpr double short_reach = 4.5;
constexpr double neighbours = 40;  // per point; balances pairs and grid work
// The grid resolves waves `oversampling` times shorter than the shortest waves of the spectrum. The
// window that spreads a point load over the grid is `width` nodes wide. Its aliasing error is
// largest where the spectrum has almost vanished, so sums are ten times as accurate as that error.
constexpr double oversampling = 1.5;
constexpr Index width = 10;
const double window_exponent = 0.97 * pi * double(width) * (1 - 1 / (2 * oversampling));

double wrapped(double value, double period) {
  const double rest = value - period * std::floor(value / period);
  return rest < period ? rest : 0;
}

double nearest_image(double difference, double period) {
  return difference - period * std::round(difference / period);
}

/// Weight of a node at a distance of x nodes from a point load: exp(β(√(1 − t²) − 1)) with t =
/// 2x/width and β = window_exponent.
double window(double nodes) {
  const double t = 2 * nodes / double(width), rest = 1 - t * t;
  return rest > 0 ? std::exp(window_exponent * (std::sqrt(rest) - 1)) : 0;
}

/// ∫ window(x) cos(kx) dx, k in radians per node, by the trapezoidal rule in θ, where sin θ =
/// 2x/width. Its error is exp(−β) with β = window_exponent, like the jump of the window at its two
/// ends.
double window_transform(double k) {
  constexpr int panels = 64;
  double sum = 0;
  for (int i = 1; i < panels; ++i) {
    const double angle = pi * (double(i) / panels - 0.5);
    sum += std::exp(window_exponent * (std::cos(angle) - 1)) * std::cos(angle) *
           std::cos(k * double(width) / 2 * std::sin(angle));
  }
  return sum * pi / panels * double(width) / 2;
}

}  // namespace

PeriodicPointLoads::PeriodicPointLoads(std::vector<PlanePoint> points, double lx, double ly)
    : count_(points.size()), lx_(lx), ly_(ly) {
  for (PlanePoint& point : points) point = {wrapped(point.x, lx), wrapped(point.y, ly)};
  const double area = lx * ly;
  const double cutoff =
      std::min(std::sqrt(neighbours * area / (pi * double(count_))), 0.49 * std::min(lx, ly));
  split_ = short_reach / cutoff;
  find_pairs(points, cutoff);

  const double spacing = pi / (oversampling * 2 * short_reach * split_);
  const auto nodes = [&](double period) {
    return fast_transform_size(std::max(static_cast<Index>(std::ceil(period / spacing)), width));
  };
  nx_ = nodes(lx);
  ny_ = nodes(ly);
  place_windows(points);
  set_symbol();
  // At the position of a force itself erf(αr)/(πr) tends to 2α/π^{3/2}; this is no displacement by
  // other forces, so it is subtracted.
  self_ = -2 * split_ / (pi * std::sqrt(pi));
  background_ = -2 / (std::sqrt(pi) * split_ * area);
}

void PeriodicPointLoads::place_windows(const std::vector<PlanePoint>& points) {
  const auto index = [&](double position, Index nodes) {
    const Index first = static_cast<Index>(std::ceil(position - double(width) / 2));
    for (Index k = 0; k < width; ++k) weights_.push_back(window(double(first + k) - position));
    return (first % nodes + nodes) % nodes;
  };
  windows_.reserve(count_);
  weights_.reserve(2 * std::size_t(width) * count_);
  for (const PlanePoint& point : points) {
    const Index row = index(point.x / lx_ * double(nx_), nx_);
    windows_.push_back({row, index(point.y / ly_ * double(ny_), ny_)});
  }
}

void PeriodicPointLoads::set_symbol() {
  fft_ = std::make_unique<RealFft2D<double>>(nx_, ny_);
  field_.resize(static_cast<std::size_t>(nx_ * ny_));
  modes_.resize(static_cast<std::size_t>(nx_ * fft_->modes_y()));
  symbol_.resize(modes_.size());
  const auto transforms = [](Index nodes) {
    std::vector<double> values;
    for (Index wave = 0; wave <= nodes / 2; ++wave)
      values.push_back(window_transform(2 * pi * double(wave) / double(nodes)));
    return values;
  };
  const std::vector<double> along_x = transforms(nx_), along_y = transforms(ny_);
  for (Index i = 0; i < nx_; ++i) {
    const Index wave_x = std::min(i, nx_ - i);
    const double qx = 2 * pi * double(wave_x) / lx_;
    for (Index j = 0; j < fft_->modes_y(); ++j) {
      if (i == 0 && j == 0) continue;  // the mean plane does not move
      const double qy = 2 * pi * double(j) / ly_, q = std::sqrt(qx * qx + qy * qy);
      // The spectrum is cut off at this wave number: at larger ones, division by the transform of
      // the window would magnify aliased waves.
      if (q > 2 * short_reach * split_) continue;
      const double spectrum = 2 / q * std::erfc(q / (2 * split_)) / (lx_ * ly_);
      // Spreading the loads over the grid, and gathering the displacements from it, each multiply
      // by the transform of the window.
      const double both = along_x[std::size_t(wave_x)] * along_y[std::size_t(j)];
      symbol_[static_cast<std::size_t>(i * fft_->modes_y() + j)] = spectrum / (both * both);
    }
  }
}

void PeriodicPointLoads::find_pairs(const std::vector<PlanePoint>& points, double cutoff) {
  // Cells at least as wide as the cut-off distance, so that the neighbours of a point lie in the 3
  // × 3 cells around its cell. With fewer than three cells along a side, some cells would be
  // visited twice.
  const auto cells = [&](double period) {
    return std::max<Index>(1, static_cast<Index>(std::floor(period / cutoff)));
  };
  const Index cx = cells(lx_), cy = cells(ly_);
  std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(cx * cy));
  const auto cell_of = [&](const PlanePoint& point) {
    const Index ix = std::min(cx - 1, static_cast<Index>(point.x / lx_ * double(cx)));
    const Index iy = std::min(cy - 1, static_cast<Index>(point.y / ly_ * double(cy)));
    return std::pair{ix, iy};
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [ix, iy] = cell_of(points[i]);
    members[static_cast<std::size_t>(ix * cy + iy)].push_back(static_cast<std::uint32_t>(i));
  }
  const auto around = [](Index cell, Index count) {
    std::vector<Index> cells_around;
    for (Index shift = -1; shift <= 1; ++shift)
      cells_around.push_back((cell + shift + count) % count);
    std::ranges::sort(cells_around);
    cells_around.erase(std::unique(cells_around.begin(), cells_around.end()), cells_around.end());
    return cells_around;
  };
  std::vector<std::vector<Index>> rows_around, columns_around;
  for (Index ix = 0; ix < cx; ++ix) rows_around.push_back(around(ix, cx));
  for (Index iy = 0; iy < cy; ++iy) columns_around.push_back(around(iy, cy));
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [ix, iy] = cell_of(points[i]);
    for (const Index jx : rows_around[std::size_t(ix)])
      for (const Index jy : columns_around[std::size_t(iy)])
        for (const std::uint32_t j : members[static_cast<std::size_t>(jx * cy + jy)]) {
          if (j <= i) continue;
          const double x = nearest_image(points[i].x - points[j].x, lx_);
          const double y = nearest_image(points[i].y - points[j].y, ly_);
          const double square = x * x + y * y;
          require(square > 0, "summits.position", points[i].x,
                  "m along x belongs to two summits at the same point; remove one of them");
          if (square >= cutoff * cutoff) continue;
          const double r = std::sqrt(square);
          pairs_.push_back({static_cast<std::uint32_t>(i), j, std::erfc(split_ * r) / (pi * r)});
        }
  }
}

/// Calls at_row(nodes, weight along x, weights along y, count) for each row of nodes within the
/// window of a point; the row is passed in parts that are contiguous in memory, of `count` nodes
/// each.
template <class AtRow>
void PeriodicPointLoads::visit(std::size_t point, const AtRow& at_row) {
  const Window& window = windows_[point];
  const double* along_x = &weights_[2 * std::size_t(width) * point];
  const double* along_y = along_x + width;
  const Index before_edge = std::min(width, ny_ - window.column);
  for (Index k = 0; k < width; ++k) {
    double* row = &field_[static_cast<std::size_t>((window.row + k) % nx_ * ny_)];
    at_row(row + window.column, along_x[k], along_y, before_edge);
    if (before_edge < width) at_row(row, along_x[k], along_y + before_edge, width - before_edge);
  }
}

void PeriodicPointLoads::apply(std::span<const double> loads, std::span<double> displacements) {
  std::ranges::fill(field_, 0.0);
  double total = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (loads[i] == 0) continue;
    total += loads[i];
    visit(i, [&](double* nodes, double along_x, const double* along_y, Index count) {
      for (Index k = 0; k < count; ++k) nodes[k] += loads[i] * along_x * along_y[k];
    });
  }
  fft_->forward(field_.data(), modes_.data());
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) modes_[mode] *= symbol_[mode];
  fft_->backward(modes_.data(), field_.data());
  for (std::size_t i = 0; i < count_; ++i) {
    double sum = 0;
    visit(i, [&](const double* nodes, double along_x, const double* along_y, Index count) {
      double row = 0;
      for (Index k = 0; k < count; ++k) row += nodes[k] * along_y[k];
      sum += along_x * row;
    });
    displacements[i] = sum + self_ * loads[i] + background_ * total;
  }
  for (const Pair& pair : pairs_) {
    displacements[pair.first] += pair.kernel * loads[pair.second];
    displacements[pair.second] += pair.kernel * loads[pair.first];
  }
}

}  // namespace salebra::detail
