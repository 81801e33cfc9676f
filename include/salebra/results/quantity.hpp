// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/units.hpp>
#include <string_view>

namespace salebra {

/// What stands behind a name that salebra uses in options, JSON and files: one meaning and one unit
/// everywhere.
struct Quantity {
  std::string_view name;  ///< "decay_length"
  Dimension dimension = Dimension::dimensionless;
  std::string_view long_name;  ///< "decay length of force with mean gap"
};

/// The entry of a name; a name that is not listed comes back dimensionless, with itself as its long
/// name.
Quantity find_quantity(std::string_view name);

/// Whether a name is listed.
bool is_quantity(std::string_view name);

}  // namespace salebra
