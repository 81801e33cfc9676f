// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <salebra/base/row_partition.hpp>

#include "base/convolution.hpp"
#include "half_space.hpp"
#include "multilevel_kernel.hpp"
#include "normal_symbol.hpp"

namespace salebra::detail {

// Operators that contacts on equal grids share: symbol and transforms of the normal compliance, the
// stencil of the preconditioner and the multilevel kernel. Each is made at first use. Any thread
// may call the functions.
class NormalOperators {
 public:
  NormalOperators(const Grid2D& grid, const NormalResponse& response, Boundary boundary,
                  const RowPartition& rows);
  // Returns the same object for equal grids while it is among the most recently used objects, whose
  // grids have 12 million points in all (36 MB, or 90 MB for free contacts). The contacts of a
  // sweep share it, and so do a contact and the computation of its stiffness. A grid whose rows are
  // distributed over processes always gets a new object.
  static std::shared_ptr<NormalOperators> of(const Grid2D& grid, const NormalResponse& response,
                                             Boundary boundary, const RowPartition& rows);

  const NormalSymbol& symbol() const { return symbol_; }
  const InverseStencil& inverse() const { return inverse_; }
  template <class Real>
  Convolution2D<Real> compliance();
  // None also for any body but a half-space, for whose kernel the stencils are designed.
  std::optional<MultilevelKernel> multilevel();

 private:
  bool serves(const Grid2D& grid, const NormalResponse& response, Boundary boundary) const;

  Grid2D grid_;
  NormalResponse response_;
  Boundary boundary_;
  RowPartition rows_;
  NormalSymbol symbol_;
  InverseStencil inverse_;
  std::mutex mutex_;
  std::optional<Convolution2D<float>> single_;
  std::optional<Convolution2D<double>> exact_;
  std::optional<std::optional<MultilevelKernel::Plan>> multilevel_;
};

}  // namespace salebra::detail
