// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>
#include <string>
#include <string_view>

#include "command.hpp"

namespace salebra::cli {

/// Sets the command whose options in_options() and with_option() use.
void name_options(const Command& command);

/// Returns a message of the library with names of arguments replaced by options: `size_x` becomes
/// --size-x if the command has that option.
std::string in_options(std::string_view message);

/// The message of an error of the library, beginning with the option for the argument that was
/// refused.
std::string with_option(const InvalidInput& refusal);

}  // namespace salebra::cli
