// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace salebra::cli {

/// What the help of a command says beyond its one line: what it needs, what it computes, and where
/// one goes from there. The same text is in its manual page.
struct CommandHelp {
  std::string_view name;
  std::string_view group;  ///< heading of the list of commands under which it stands
  std::string_view text;   ///< paragraphs, parted by an empty line
};

/// nullptr for a command that is not described.
const CommandHelp* find_help(std::string_view command);

/// What the help of the program itself ends with.
std::string_view first_steps();

}  // namespace salebra::cli
