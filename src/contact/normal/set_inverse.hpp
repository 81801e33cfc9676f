// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "contact/half_space/half_space.hpp"

namespace salebra::detail {

// Approximate inverse of normal_compliance() for E* = 1 on a set of cells, without a Fourier
// transform of the grid: CG in float, with the multilevel kernel in place of the transform, until
// the error in the energy norm of the compliance is about a tenth. It is not the same linear map
// for every vector, so an outer iteration on A x = b that it preconditions must use β = −<z,
// Ad>/<d, Ad> with the last direction d and the preconditioned residual z.
class SetInverse {
 public:
  SetInverse(const Grid2D& grid, const RowPartition& rows, Boundary boundary);
  SetInverse(SetInverse&&) noexcept;
  SetInverse& operator=(SetInverse&&) noexcept;
  ~SetInverse();

  // Sets the cells: the numbers ix·ny + iy in the rows of this process, in row order. Returns false
  // if the grid has no multilevel kernel; then apply() must not be called. hold() and apply() are
  // collective.
  bool hold(const std::vector<Index>& cells);
  // Computes the pressures q for the displacements u, one value for each cell of the set; q may be
  // u.
  void apply(const double* u, double* q);
  int multilevel_count() const;  // of the multilevel kernel

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace salebra::detail
