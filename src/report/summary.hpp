// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "io/json.hpp"

namespace salebra::detail {

/// Escapes the characters that have a meaning in HTML.
std::string escaped(std::string_view text);

/// Decay length, overall verdict, assumptions and damping constants of a report's payload as HTML.
/// When JavaScript runs, the script of the page replaces this summary by its figures and tables.
std::string summary_of(const Json& payload);

}  // namespace salebra::detail
