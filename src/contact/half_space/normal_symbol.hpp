// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/row_partition.hpp>

#include "half_space.hpp"

namespace salebra::detail {

// The transform of normal_compliance() and its period, which is the grid itself or, of a free
// contact, the grid with empty cells. Of a free one it takes longer than the convolution that is
// made of it: one in float and one in double share it.
struct NormalSymbol {
  Index period_x = 0, period_y = 0;
  // A free contact has the columns of this process alone, those of a convolution of its rows.
  Convolution2D<double>::Symbol value;
  // Any columns of a free contact, collectively: (places.count(), period_x/2 + 1), column_at(place)
  // for each place of this process. Empty for a periodic one, which has its value in every column.
  std::function<Field(const RowPartition& indices, const std::function<Index(Index index)>& column_at)>
      columns;
};
NormalSymbol normal_symbol(const Grid2D& grid, double contact_modulus, Boundary boundary,
                           const RowPartition& rows);

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const RowPartition& rows);

}  // namespace salebra::detail
