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

// What the contacts on equal grids have in common: the symbol, transforms, the stencil of the
// preconditioner and the multilevel kernel, each made when it is first needed. Any thread may ask.
class NormalOperators {
 public:
  NormalOperators(const Grid2D& grid, double contact_modulus, Boundary boundary, const RowPartition& rows);
  // The same one for equal grids, where these are among the last ones of 12 million points in all,
  // which takes 36 MB, and 90 MB of free contacts: the contacts of a sweep, and each with its
  // stiffness. Of a grid that is spread over processes always a new one.
  static std::shared_ptr<NormalOperators> of(const Grid2D& grid, double contact_modulus,
                                             Boundary boundary, const RowPartition& rows);

  const NormalSymbol& symbol() const { return symbol_; }
  const InverseStencil& inverse() const { return inverse_; }
  template <class Real>
  Convolution2D<Real> compliance();
  std::optional<MultilevelKernel> multilevel();

 private:
  bool serves(const Grid2D& grid, double contact_modulus, Boundary boundary) const;

  Grid2D grid_;
  double contact_modulus_;
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
