// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <string>

#include "command.hpp"

/// Texts that `salebra help` prints, before wrapping.
namespace salebra::cli {

/// Help of the program on one screen: the commands by purpose, which one to choose, and first
/// steps.
std::string program_help(const std::deque<Command>& commands);

/// Help of a command: description, two examples, the most used options, and the other options under
/// their headings.
std::string command_help(const Command& command);

/// Help of the options that every command has, taken from any of the commands.
std::string options_help(const Command& command);

}  // namespace salebra::cli
