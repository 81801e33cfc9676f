// SPDX-License-Identifier: GPL-3.0-or-later
// Check shared by all modules: a value is a finite number > 0.
#include <cmath>
#include <salebra/base/error.hpp>

namespace salebra {

void require_positive(double value, std::string_view field) {
  require(std::isfinite(value) && value > 0, field, value, "must be a finite number > 0");
}

}  // namespace salebra
