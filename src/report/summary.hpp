// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "io/json.hpp"

namespace salebra::detail {

/// Text as HTML shows it.
std::string escaped(std::string_view text);

/// Decay length, verdict, assumptions and damping constants of a report's payload as HTML. The page's script
/// puts its sections in their place.
std::string summary_of(const Json& payload);

}  // namespace salebra::detail
