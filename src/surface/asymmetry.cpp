// SPDX-License-Identifier: GPL-3.0-or-later
// Scales at which the peaks of a surface differ from its valleys.
#include "surface/asymmetry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/row_partition.hpp>
#include <span>
#include <vector>

#include "profiles.hpp"

namespace salebra::detail {
namespace {

constexpr Index parts = 36;
/// For Gaussian heights, Student's t of a mean over 36 parts exceeds this value with a probability
/// of 3e-4.
constexpr double significant = 4;

/// Sums of the powers 0, 1, 2 and 3 of second differences of heights.
using Moments = Eigen::Array4d;
constexpr std::size_t powers = 4;

Moments moments(const double* heights, Index begin, Index end, Index lag) {
  double first = 0, square = 0, cube = 0;
  for (Index i = begin; i < end; ++i) {
    const double second = (heights[i + lag] - heights[i]) - (heights[i] - heights[i - lag]);
    first += second;
    square += second * second;
    cube += second * second * second;
  }
  return {static_cast<double>(end - begin), first, square, cube};
}

/// Student's t of the mean third central moment of second differences over the parts of a surface.
double student(const Eigen::Array4Xd& of_parts) {
  const Moments whole = of_parts.rowwise().sum();
  const double mean = whole(1) / whole(0);
  double filled = 0, sum = 0, square = 0;
  for (const auto& part : of_parts.colwise()) {
    if (part(0) == 0) continue;
    const double third =
        (part(3) - mean * (3 * part(2) - mean * (3 * part(1) - mean * part(0)))) / part(0);
    ++filled;
    sum += third;
    square += third * third;
  }
  return sum / std::sqrt((filled * square - sum * sum) / (filled - 1));
}

double along(const Surface& surface, Axis axis) {
  const Index n = axis == Axis::x ? surface.grid.nx : surface.grid.ny;
  const double step = axis == Axis::x ? surface.grid.dx() : surface.grid.dy();
  const RowPartition profiles = profiles_of(surface, axis);
  // A surface with few profiles is divided into parts along its profiles only.
  const Index groups = profiles.rows() < parts ? 1 : 6, pieces = parts / groups;
  std::vector<Index> lags;
  for (Index lag = 1; 4 * lag * pieces <= n; lag = std::max(lag + 1, 3 * lag / 2))
    lags.push_back(lag);
  if (lags.empty()) return 0;
  const std::size_t count = lags.size() * powers * static_cast<std::size_t>(parts);
  const auto of_blocks = map_profiles(
      surface, axis,
      std::vector<Moments>(lags.size() * static_cast<std::size_t>(pieces), Moments::Zero()),
      [&](std::vector<Moments>& sums, std::span<const double> heights) {
        auto to = sums.begin();
        for (const Index lag : lags)
          for (Index piece = 0; piece < pieces; ++piece) {
            const Index triples = n - 2 * lag;
            *to++ += moments(heights.data(), lag + triples * piece / pieces,
                             lag + triples * (piece + 1) / pieces, lag);
          }
      });
  std::vector<double> mine(count * of_blocks.size());
  for (std::size_t block = 0; block < of_blocks.size(); ++block) {
    const Index row = profiles.begin() +
                      static_cast<Index>(block) * parallel::block_rows(profiles.rows()),
                group = row * groups / profiles.rows();
    for (std::size_t k = 0; k < lags.size(); ++k)
      std::copy_n(of_blocks[block][k * static_cast<std::size_t>(pieces)].data(),
                  powers * static_cast<std::size_t>(pieces),
                  &mine[block * count + powers * (k * static_cast<std::size_t>(parts) +
                                                  static_cast<std::size_t>(group * pieces))]);
  }
  const std::vector<double> all = parallel::add_blocks(profiles, count, mine);
  double longest = 0;
  for (std::size_t k = 0; k < lags.size(); ++k)
    if (std::abs(student(Eigen::Map<const Eigen::Array4Xd>(
            &all[k * powers * static_cast<std::size_t>(parts)], 4, parts))) > significant)
      longest = k + 1 == lags.size() ? std::numeric_limits<double>::infinity()
                                     : 4 * static_cast<double>(lags[k]) * step;
  return longest;
}

}  // namespace

double asymmetric_wavelength(const Surface& surface) {
  return std::max(along(surface, Axis::x), along(surface, Axis::y));
}

}  // namespace salebra::detail
