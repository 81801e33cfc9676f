// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/row_partition.hpp>

#include "half_space.hpp"

namespace salebra::detail {

// The Fourier transform of the kernel of normal_compliance() and its period, which is the grid or,
// for a free contact, the grid padded with empty cells. For a free contact the symbol takes longer
// to compute than a convolution with it, so one convolution in float and one in double share it.
struct NormalSymbol {
  Index period_x = 0, period_y = 0;
  // The symbol at frequency (i, j). For a free contact it covers only the columns that a
  // convolution of this process's rows needs.
  Convolution2D<double>::Symbol value;
  // Computes any columns of a free contact's symbol, collectively. Returns a field
  // (indices.count(), period_x/2 + 1), whose row for each index of this process is the column
  // column_at(index) of the symbol. Empty for a periodic contact, whose `value` covers all columns.
  std::function<Field(const RowPartition& indices,
                      const std::function<Index(Index index)>& column_at)>
      columns;
};
NormalSymbol normal_symbol(const Grid2D& grid, double contact_modulus, Boundary boundary,
                           const RowPartition& rows);

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const RowPartition& rows);

}  // namespace salebra::detail
