// SPDX-License-Identifier: GPL-3.0-or-later
#include <salebra/base/error.hpp>

#include <cmath>

namespace salebra {

void require_positive(double value, std::string_view field) {
  require(std::isfinite(value) && value > 0, field, value, "must be a finite number > 0");
}

}  // namespace salebra
