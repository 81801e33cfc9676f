// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "contact/half_space/half_space.hpp"

namespace salebra::detail {

// Approximate inverse of normal_compliance() on a set of cells, E* = 1, without a transform of the
// grid: CG in float with the multilevel kernel in its place, until the error in the norm of G is
// about a tenth. It is not the same linear map for every vector: an iteration that is
// preconditioned with it needs β = −<z, Ad>/<d, Ad>.
class SetInverse {
 public:
  SetInverse(const Grid2D& grid, const RowPartition& rows, Boundary boundary);
  SetInverse(SetInverse&&) noexcept;
  SetInverse& operator=(SetInverse&&) noexcept;
  ~SetInverse();

  // The set: ix·ny + iy of the rows of this process, in row order. False where the grid has no
  // multilevel kernel: apply() must not be called then. Both are collective.
  bool hold(const std::vector<Index>& cells);
  // One value for each cell of the set; q may be u.
  void apply(const double* u, double* q);
  int multilevel_count() const;  // applications so far

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace salebra::detail
