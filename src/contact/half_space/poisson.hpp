// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>

namespace salebra::detail {

/// Throws InvalidInput for a Poisson's ratio that no isotropic elastic body has.
inline void require_poisson(double poisson) {
  require(poisson > -1 && poisson <= 0.5, "poisson", poisson, "must satisfy -1 < poisson <= 0.5");
}

}  // namespace salebra::detail
