// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <string>

#include "command.hpp"

/// What `salebra help` prints, before it is wrapped.
namespace salebra::cli {

/// One screen: the commands under what they are for, which one to take, and the first steps.
std::string program_help(const std::deque<Command>& commands);

/// What a command does, two examples, the options most used, and the others under their headings.
std::string command_help(const Command& command);

/// The options that every command has, of any of them.
std::string options_help(const Command& command);

}  // namespace salebra::cli
