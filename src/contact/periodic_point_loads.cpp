// SPDX-License-Identifier: GPL-3.0-or-later
#include "periodic_point_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <salebra/base/convolution.hpp>
#include <salebra/base/error.hpp>

namespace salebra::detail {
namespace {

using std::numbers::pi;

// erfc(4.5) = 2e-10 is dropped beyond the cut-off, and as much of the spectrum erfc(q/2α) beyond q = 9α.
constexpr double short_reach = 4.5;
constexpr double neighbours = 80;  // balances the pairs against the grid
// The grid resolves waves twice as short as the spectrum has. A Gaussian cut off after `reach` nodes is e^−23 there, and its images
// beyond the grid's Nyquist wave are below what the spectrum has left.
constexpr Index reach = 9;
constexpr double cut_exponent = 23;

double wrapped(double value, double period) {
  const double rest = value - period * std::floor(value / period);
  return rest < period ? rest : 0;
}

double nearest_image(double difference, double period) {
  return difference - period * std::round(difference / period);
}

/// exp(−(k + 1 − fraction)²h²/4τ) for the nodes −reach+1 … reach around a point `fraction` cells above node 0.
std::array<double, 2 * reach> gaussian_weights(double fraction, double decay) {
  std::array<double, 2 * reach> weights;
  for (Index k = 0; k < 2 * reach; ++k) {
    const double distance = static_cast<double>(k - reach + 1) - fraction;
    weights[static_cast<std::size_t>(k)] = std::exp(-decay * distance * distance);
  }
  return weights;
}

}  // namespace

PeriodicPointLoads::PeriodicPointLoads(std::vector<PlanePoint> points, double lx, double ly)
    : points_(std::move(points)), lx_(lx), ly_(ly) {
  for (PlanePoint& point : points_) point = {wrapped(point.x, lx), wrapped(point.y, ly)};
  const double area = lx * ly;
  const double cutoff =
      std::min(std::sqrt(neighbours * area / (pi * static_cast<double>(points_.size()))),
               0.49 * std::min(lx, ly));
  split_ = short_reach / cutoff;
  find_pairs(cutoff);

  const double spacing = pi / (2 * 2 * short_reach * split_);
  const auto nodes = [&](double period) {
    return fast_transform_size(
        std::max<Index>(static_cast<Index>(std::ceil(period / spacing)), 2 * reach + 2));
  };
  nx_ = nodes(lx);
  ny_ = nodes(ly);
  fft_ = std::make_unique<RealFft2D<double>>(nx_, ny_);
  field_.resize(static_cast<std::size_t>(nx_ * ny_));
  modes_.resize(static_cast<std::size_t>(nx_ * fft_->modes_y()));
  symbol_.resize(modes_.size());
  // In units of the cell, along both axes alike: the Gaussian is isotropic in index space, which only the symbol needs to know.
  width_ = static_cast<double>(reach * reach) / (4 * cut_exponent);
  for (Index i = 0; i < nx_; ++i) {
    const Index wave_x = i <= nx_ / 2 ? i : i - nx_;
    for (Index j = 0; j < fft_->modes_y(); ++j) {
      const double qx = 2 * pi * static_cast<double>(wave_x) / lx;
      const double qy = 2 * pi * static_cast<double>(j) / ly;
      const double q = std::hypot(qx, qy);
      double& symbol = symbol_[static_cast<std::size_t>(i * fft_->modes_y() + j)];
      if (q == 0) {
        symbol = 0;
        continue;
      }
      const double spectrum = 2 / q * std::erfc(q / (2 * split_)) / area;
      // Spreading and gathering each multiply by the transform 4πτ exp(−τκ²) of the Gaussian, κ = q in units of 1/cell.
      const double kx = 2 * pi * static_cast<double>(wave_x) / static_cast<double>(nx_);
      const double ky = 2 * pi * static_cast<double>(j) / static_cast<double>(ny_);
      const double gaussian = 4 * pi * width_ * std::exp(-width_ * (kx * kx + ky * ky));
      symbol = spectrum / (gaussian * gaussian);
    }
  }
  // erf(αr)/(πr) → 2α/π^{3/2} at the force's own place is not a displacement by other forces.
  self_ = -2 * split_ / (pi * std::sqrt(pi));
  background_ = -2 / (std::sqrt(pi) * split_ * area);
}

void PeriodicPointLoads::find_pairs(double cutoff) {
  // Cells at least as wide as the cut-off: neighbours lie in the 3 × 3 cells around. Fewer than three cells a side would be visited twice.
  const auto cells = [&](double period) {
    return std::max<Index>(1, static_cast<Index>(std::floor(period / cutoff)));
  };
  const Index cx = cells(lx_), cy = cells(ly_);
  std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(cx * cy));
  const auto cell_of = [&](const PlanePoint& point) {
    const Index ix = std::min(cx - 1, static_cast<Index>(point.x / lx_ * static_cast<double>(cx)));
    const Index iy = std::min(cy - 1, static_cast<Index>(point.y / ly_ * static_cast<double>(cy)));
    return std::pair{ix, iy};
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto [ix, iy] = cell_of(points_[i]);
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
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto [ix, iy] = cell_of(points_[i]);
    for (const Index jx : around(ix, cx))
      for (const Index jy : around(iy, cy))
        for (const std::uint32_t j : members[static_cast<std::size_t>(jx * cy + jy)]) {
          if (j <= i) continue;
          const double r = std::hypot(nearest_image(points_[i].x - points_[j].x, lx_),
                                      nearest_image(points_[i].y - points_[j].y, ly_));
          require(r > 0, "summits.position", points_[i].x,
                  "m along x is that of two summits at one place; remove one of them");
          if (r < cutoff)
            pairs_.push_back({static_cast<std::uint32_t>(i), j, std::erfc(split_ * r) / (pi * r)});
        }
  }
}

void PeriodicPointLoads::apply(std::span<const double> loads, std::span<double> displacements) {
  const double decay = 1 / (4 * width_);
  const auto visit = [&](const PlanePoint& point, auto&& at_node) {
    const double x = point.x / lx_ * static_cast<double>(nx_);
    const double y = point.y / ly_ * static_cast<double>(ny_);
    const Index ix = static_cast<Index>(x), iy = static_cast<Index>(y);
    const auto weights_x = gaussian_weights(x - static_cast<double>(ix), decay);
    const auto weights_y = gaussian_weights(y - static_cast<double>(iy), decay);
    for (Index kx = 0; kx < 2 * reach; ++kx) {
      const Index row = (ix + kx - reach + 1 + nx_) % nx_ * ny_;
      const double weight_x = weights_x[static_cast<std::size_t>(kx)];
      for (Index ky = 0; ky < 2 * reach; ++ky)
        at_node(static_cast<std::size_t>(row + (iy + ky - reach + 1 + ny_) % ny_),
                weight_x * weights_y[static_cast<std::size_t>(ky)]);
    }
  };

  std::ranges::fill(field_, 0.0);
  double total = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (loads[i] == 0) continue;
    total += loads[i];
    visit(points_[i], [&](std::size_t node, double weight) { field_[node] += weight * loads[i]; });
  }
  fft_->forward(field_.data(), modes_.data());
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) modes_[mode] *= symbol_[mode];
  fft_->backward(modes_.data(), field_.data());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    double sum = 0;
    visit(points_[i], [&](std::size_t node, double weight) { sum += weight * field_[node]; });
    displacements[i] = sum + self_ * loads[i] + background_ * total;
  }
  for (const Pair& pair : pairs_) {
    displacements[pair.first] += pair.kernel * loads[pair.second];
    displacements[pair.second] += pair.kernel * loads[pair.first];
  }
}

}  // namespace salebra::detail
