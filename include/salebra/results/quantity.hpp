// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <string_view>

/// The glossary: every quantity of the described structs by its name.
namespace salebra {

/// Returns the glossary entry of a name, e.g. `find_quantity("decay_length").dimension`. An
/// unlisted name returns a dimensionless quantity with the name as its long name.
Quantity find_quantity(std::string_view name);

/// Returns true if a name is in the glossary.
bool is_quantity(std::string_view name);

}  // namespace salebra
