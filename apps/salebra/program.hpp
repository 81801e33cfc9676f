// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <string>

#include "command.hpp"
#include "launch.hpp"
#include "session.hpp"

namespace salebra::cli {

/// Parses the command line and runs the command that it names. Returns the exit status: 0 done, 1
/// failed while running, 2 bad usage or input, 3 surfaces of a study are missing, 130 interrupted.
/// With several processes an error of all processes is printed by the first one. An error of only
/// some processes is printed by these, with their numbers, and ends all processes.
int run_program(int argc, char** argv, const Launch& launch = {});

/// All commands of the program, each with the common options. The action of a command runs after
/// all options have been read.
class Program {
 public:
  using Action = std::function<void(Session&)>;

  /// launch: must outlive the program.
  Program(std::string command_line, const Launch& launch)
      : command_line_(std::move(command_line)), launch_(launch) {}

  /// examples: two command lines that --help shows. picture: description of the picture in the help
  /// of --plot; empty: the command has no --plot.
  Command& add_command(const std::string& name, const std::string& what,
                       const std::array<std::string, 2>& examples, Action action,
                       const std::string& picture = "", OutputCheck check = OutputCheck::results);

  /// The commands in the order of the help. References to them stay valid.
  const std::deque<Command>& commands() const { return commands_; }
  std::deque<Command>& commands() { return commands_; }

 private:
  std::string command_line_;
  const Launch& launch_;
  std::deque<Command> commands_;
};

// Each command defines void add_<name>_command(Program&) in cmd_<name>.cpp; the list is in
// CMakeLists.txt.
#define SALEBRA_COMMAND(name) void add_##name##_command(Program& program);
#include "command_list.inc"
#undef SALEBRA_COMMAND

}  // namespace salebra::cli
