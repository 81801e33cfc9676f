// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <string_view>

/// The glossary: every quantity of the described structs by its name.
namespace salebra {

/// The entry of a name; a name that is not listed comes back dimensionless, with itself as its long
/// name.
Quantity find_quantity(std::string_view name);

/// Whether a name is listed.
bool is_quantity(std::string_view name);

}  // namespace salebra
