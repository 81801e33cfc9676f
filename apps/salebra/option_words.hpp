// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>
#include <string>
#include <string_view>

#include "command.hpp"

namespace salebra::cli {

/// The command whose options the next two speak of.
void name_options(const Command& command);

/// A message of the library as this program says it: `size_x` becomes --size-x, if the command has
/// that option.
std::string in_options(std::string_view message);

/// Does so with a refusal, whose field is the option that has its name.
std::string with_option(const InvalidInput& refusal);

}  // namespace salebra::cli
