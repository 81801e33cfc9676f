// SPDX-License-Identifier: GPL-3.0-or-later
// Removes the mean, a plane or a quadratic surface, or the straight line or offset of each scan
// line.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

#include "base/numerics/dense_systems.hpp"

namespace salebra {
namespace {

/// Coordinate of point i of n, from −1 to 1: this keeps the normal equations well conditioned for
/// any size and shape of the grid.
double centred(Index i, Index n) {
  return n > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0 : 0.0;
}

/// The terms of a trend at the point (x, y): 1, x, y, and for a quadratic trend also x², xy, y².
template <int Terms>
Eigen::Vector<double, Terms> terms_at(double x, double y) {
  if constexpr (Terms == 3)
    return {1, x, y};
  else
    return {1, x, y, x * x, x * y, y * y};
}

template <int Terms>
void subtract_fit(Surface& surface) {
  const Index nx = surface.grid.nx, ny = surface.grid.ny;
  const RowPartition partition = surface.partition();
  const double mean = height_statistics(surface).mean;
  // Sums for the rows of the matrix of the normal equations, followed by the sums for their
  // right-hand side.
  constexpr std::size_t equations = Terms, numbers = equations * (equations + 1);
  using Sums = std::array<double, numbers>;
  Sums total{};
  for (const Sums& block : parallel::map_blocks<Sums>(partition, [&](Index begin, Index end) {
         Sums sums{};
         for (Index row = begin; row < end; ++row) {
           for (Index iy = 0; iy < ny; ++iy) {
             const double height = surface.heights(row, iy);
             if (std::isnan(height)) continue;
             const auto terms =
                 terms_at<Terms>(centred(partition.begin() + row, nx), centred(iy, ny));
             for (std::size_t a = 0; a < equations; ++a) {
               const double term = terms(static_cast<Index>(a));
               for (std::size_t b = 0; b < equations; ++b)
                 sums[a * equations + b] += term * terms(static_cast<Index>(b));
               sums[equations * equations + a] += term * (height - mean);
             }
           }
         }
         return sums;
       }))
    for (std::size_t k = 0; k < numbers; ++k) total[k] += block[k];
  const Eigen::Map<const Eigen::Matrix<double, Terms, Terms, Eigen::RowMajor>> normal(total.data());
  const Eigen::Map<const Eigen::Vector<double, Terms>> right(total.data() + Terms * Terms);
  const Eigen::Vector<double, Terms> trend = detail::least_squares(normal, right);
  parallel::for_slabs(partition.count(), [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index iy = 0; iy < ny; ++iy)
        surface.heights(row, iy) -=
            mean +
            trend.dot(terms_at<Terms>(centred(partition.begin() + row, nx), centred(iy, ny)));
  });
}

/// Subtracts from each line along x the line's least-squares straight line. A line with one defined
/// point becomes 0 at this point; a line without defined points is left alone.
void subtract_lines(Surface& surface) {
  const Index nx = surface.grid.nx, ny = surface.grid.ny;
  height_statistics(surface);  // throws if no height is defined
  for (Index iy = 0; iy < ny; ++iy) {
    double points = 0, sum_x = 0, sum = 0;
    for (Index ix = 0; ix < nx; ++ix) {
      const double height = surface.heights(ix, iy);
      if (std::isnan(height)) continue;
      ++points, sum_x += centred(ix, nx), sum += height;
    }
    if (points == 0) continue;
    const double mean_x = sum_x / points, mean = sum / points;
    double square = 0, product = 0;
    for (Index ix = 0; ix < nx; ++ix) {
      const double height = surface.heights(ix, iy), x = centred(ix, nx) - mean_x;
      if (std::isnan(height)) continue;
      square += x * x, product += x * (height - mean);
    }
    const double slope = square > 0 ? product / square : 0;
    for (Index ix = 0; ix < nx; ++ix)
      surface.heights(ix, iy) -= mean + slope * (centred(ix, nx) - mean_x);
  }
}

/// The median; for an even number of values, the mean of the middle two. Reorders the values.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 != 0) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

/// Subtracts from each line along x its offset against the line before it: the median difference
/// between each point and the last defined height at the same x. A line without such a pair of
/// points keeps the offset of the line before it.
void subtract_offsets(Surface& surface) {
  const Index nx = surface.grid.nx, ny = surface.grid.ny;
  height_statistics(surface);  // throws if no height is defined
  Eigen::ArrayXd before = Eigen::ArrayXd::Constant(nx, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> differences;
  double offset = 0;
  for (Index iy = 0; iy < ny; ++iy) {
    differences.clear();
    for (Index ix = 0; ix < nx; ++ix)
      if (const double difference = surface.heights(ix, iy) - before(ix); !std::isnan(difference))
        differences.push_back(difference);
    if (!differences.empty()) offset = median(differences);
    for (Index ix = 0; ix < nx; ++ix) {
      double& height = surface.heights(ix, iy);
      if (std::isnan(height)) continue;
      height -= offset;
      before(ix) = height;
    }
  }
}

}  // namespace

Detrend default_detrend(const Surface& surface) {
  return surface.periodic ? Detrend::mean : Detrend::plane;
}

Surface detrended(Surface surface, Detrend method) {
  if (method == Detrend::lines || method == Detrend::median_differences)
    surface.require_whole("detrending line by line");
  switch (method) {
    case Detrend::none:
      break;
    case Detrend::mean:
      surface.heights -= height_statistics(surface).mean;
      break;
    case Detrend::plane:
      subtract_fit<3>(surface);
      break;
    case Detrend::quadratic:
      subtract_fit<6>(surface);
      break;
    case Detrend::lines:
      subtract_lines(surface);
      break;
    case Detrend::median_differences:
      subtract_offsets(surface);
      subtract_fit<3>(surface);
      break;
  }
  return surface;
}

}  // namespace salebra
