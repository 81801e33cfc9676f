// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// What the program's own help knows of its commands, for completion and manual pages.
namespace salebra::cli {

struct OptionDescription {
  std::vector<std::string> names;  ///< "-o", "--output"; the one name of a positional argument
  std::string group;
  std::string value;  ///< kind of value, such as FILE; empty for a flag
  std::string what;
  std::vector<std::string> choices;  ///< where only a few values are allowed
  bool positional = false;
  bool required = false;
};

std::vector<const CLI::App*> commands_of(const CLI::App& app);
std::vector<OptionDescription> options_of(const CLI::App& command);

}  // namespace salebra::cli
