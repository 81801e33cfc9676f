// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate inverse of the normal compliance on a contact set, by the multilevel kernel.
#include "set_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "active_set_cg.hpp"

namespace salebra::detail {
namespace {

// CG in apply() ends when a step gains less than this fraction of the total gain. With 1e-3 the
// outer iteration, which it preconditions, takes 6 to 9 steps instead of 6 to 11 (1024²,
// bench/stick) and the same time; with 1e-1 up to 18 steps and 30 % longer.
constexpr double step_ends = 1e-2;

// The grid with lengths in cell sizes: with this and E* = 1, no number of a solve leaves the range
// of float.
Grid2D in_cells(const Grid2D& grid) {
  const double cell = std::sqrt(grid.cell_area());
  return {grid.nx, grid.ny, grid.lx / cell, grid.ly / cell};
}

}  // namespace

struct SetInverse::Parts {
  RowPartition rows;
  double per_cell;  // 1/m, scale of the inverse with lengths in cells
  ActiveSetCg<float> solver;
  std::vector<double> scaled;
  std::size_t count = 0;
  PunchOutcome outcome = {};
};

SetInverse::SetInverse(const Grid2D& grid, const RowPartition& rows, Boundary boundary)
    : parts_(std::make_unique<Parts>(Parts{
          rows, 1 / std::sqrt(grid.cell_area()), {in_cells(grid), rows, 1, boundary, {}, 0}, {}})) {
}
SetInverse::SetInverse(SetInverse&&) noexcept = default;
SetInverse& SetInverse::operator=(SetInverse&&) noexcept = default;
SetInverse::~SetInverse() = default;

bool SetInverse::hold(const std::vector<Index>& cells) {
  if (!parts_) return false;
  parts_->count = cells.size();
  if (parts_->solver.hold(cells)) return true;
  parts_.reset();  // no set of this grid has a multilevel kernel
  return false;
}

void SetInverse::apply(const double* u, double* q) {
  const std::size_t count = parts_->count;
  double largest = 0;
  for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, std::abs(u[k]));
  largest = -parts_->rows.communicator().min_of(-largest);
  if (!(largest > 0)) {
    std::fill_n(q, count, 0.0);
    return;
  }
  parts_->scaled.resize(count);
  for (std::size_t k = 0; k < count; ++k) parts_->scaled[k] = u[k] / largest;
  parts_->solver.invert(parts_->scaled.data(), step_ends, q, parts_->outcome);
  const double scale = largest * parts_->per_cell;
  for (std::size_t k = 0; k < count; ++k) q[k] *= scale;
}

int SetInverse::multilevel_count() const { return parts_ ? parts_->outcome.multilevel_count : 0; }

}  // namespace salebra::detail
