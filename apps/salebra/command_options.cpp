// SPDX-License-Identifier: GPL-3.0-or-later
// Commands and options as data, for completion scripts and manual pages.
#include "command_options.hpp"

namespace salebra::cli {
namespace {

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

/// As add_choice() words them: "what it is: one | two | three"; or as CLI11's own check does: "TEXT:{one,two}".
std::vector<std::string> choices_of(const std::string& what, const std::string& type) {
  if (const auto open = type.find('{'); open != std::string::npos && type.back() == '}')
    return split(std::string_view(type).substr(open + 1, type.size() - open - 2), ",");
  const auto colon = what.rfind(": ");
  if (what.find(" | ") == std::string::npos || colon == std::string::npos) return {};
  return split(std::string_view(what).substr(colon + 2), " | ");
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<OptionDescription> options_of(const CLI::App& command) {
  std::vector<OptionDescription> result;
  for (const CLI::Option* option : command.get_options()) {
    OptionDescription description;
    description.positional = option->get_positional();
    description.required = option->get_required();
    if (description.positional) description.names.push_back(option->get_name(true, false));
    for (const std::string& name : option->get_snames()) description.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) description.names.push_back("--" + name);
    description.group = option->get_group();
    description.what = option->get_description();
    const std::string type = option->get_type_name();
    if (option->get_items_expected_max() > 0) {
      description.choices = choices_of(description.what, type);
      description.value = type.empty() ? "VALUE" : type.substr(0, type.find(':'));
    }
    result.push_back(std::move(description));
  }
  return result;
}

}  // namespace salebra::cli
