// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/half_space/half_space.hpp>

namespace salebra::detail {

// The transform of normal_compliance() and its period, which is the grid itself or, of a free contact, the grid with empty cells. Of a
// free one it takes longer than the convolution that is made of it: one in float and one in double share it.
struct NormalSymbol {
  Index period_x = 0, period_y = 0;
  Convolution2D<double>::Symbol value;
};
NormalSymbol normal_symbol(const Grid2D& grid, double contact_modulus, Boundary boundary);

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const Share& rows);

}  // namespace salebra::detail
