// SPDX-License-Identifier: GPL-3.0-or-later
// Operators that contacts on equal grids share, made once.
#include "normal_operators.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace salebra::detail {

NormalOperators::NormalOperators(const Grid2D& grid, const NormalResponse& response,
                                 Boundary boundary, const RowPartition& rows)
    : grid_(grid),
      response_(response),
      boundary_(boundary),
      rows_(rows),
      symbol_(normal_symbol(grid, response, boundary, rows)),
      inverse_(inverse_stencil(grid, response)) {}

bool NormalOperators::serves(const Grid2D& grid, const NormalResponse& response,
                             Boundary boundary) const {
  return grid.nx == grid_.nx && grid.ny == grid_.ny && grid.lx == grid_.lx && grid.ly == grid_.ly &&
         response == response_ && boundary == boundary_;
}

std::shared_ptr<NormalOperators> NormalOperators::of(const Grid2D& grid,
                                                     const NormalResponse& response,
                                                     Boundary boundary, const RowPartition& rows) {
  constexpr Index max_points = 12'000'000;
  static std::mutex mutex;
  static std::vector<std::shared_ptr<NormalOperators>> last;  // most recently used: last
  const auto make = [&] {
    return std::make_shared<NormalOperators>(grid, response, boundary, rows);
  };
  if (!rows.communicator().alone() || grid.points() > max_points) return make();
  const std::lock_guard lock(mutex);
  const auto found = std::ranges::find_if(
      last, [&](const auto& one) { return one->serves(grid, response, boundary); });
  if (found == last.end())
    last.push_back(make());
  else
    std::rotate(found, found + 1, last.end());
  Index points = 0;
  auto first = last.end();
  while (first != last.begin() && (points += (*(first - 1))->grid_.points()) <= max_points) --first;
  last.erase(last.begin(), first);
  return last.back();
}

template <class Real>
Convolution2D<Real> NormalOperators::compliance() {
  const std::lock_guard lock(mutex_);
  auto& made = [&]() -> auto& {
    if constexpr (std::is_same_v<Real, float>)
      return single_;
    else
      return exact_;
  }();
  if (!made) made = normal_compliance<Real>(grid_, symbol_, rows_);
  return *made;
}

std::optional<MultilevelKernel> NormalOperators::multilevel() {
  if (response_.body) return std::nullopt;
  const std::lock_guard lock(mutex_);
  if (!multilevel_)
    multilevel_ =
        MultilevelKernel::Plan::make(grid_, rows_, symbol_, response_.contact_modulus, boundary_);
  if (!*multilevel_) return std::nullopt;
  return MultilevelKernel(**multilevel_, rows_);
}

template Convolution2D<float> NormalOperators::compliance<float>();
template Convolution2D<double> NormalOperators::compliance<double>();

}  // namespace salebra::detail
