// SPDX-License-Identifier: GPL-3.0-or-later
// Translates arguments in messages of the library to options of the running command.
#include "option_words.hpp"

#include <algorithm>
#include <set>

namespace salebra::cli {
namespace {

std::set<std::string>& options() {
  static std::set<std::string> names;
  return names;
}

/// The option of the running command for an argument of the library: "--size-x" for "size_x",
/// "--tangential-forces" for "tangential_force", "--normal-force" for "force". Empty if the command
/// has no such option.
std::string option_of(std::string_view argument) {
  std::string option = "--" + std::string(argument);
  std::ranges::replace(option, '_', '-');
  for (const std::string& name : {option, option + "s", "--normal" + option.substr(1)})
    if (options().contains(name)) return name;
  return "";
}

}  // namespace

void name_options(const Command& command) {
  options().clear();
  for (const Option& option : command.options())
    options().insert(option.names().begin(), option.names().end());
}

std::string in_options(std::string_view message) {
  std::string text;
  for (;;) {
    const std::size_t begin = message.find('`');
    const std::size_t end = begin == message.npos ? message.npos : message.find('`', begin + 1);
    if (end == message.npos) return text + std::string(message);
    const std::string_view argument = message.substr(begin + 1, end - begin - 1);
    const std::string option = option_of(argument);
    text +=
        std::string(message.substr(0, begin)) + (option.empty() ? std::string(argument) : option);
    message.remove_prefix(end + 1);
  }
}

std::string with_option(const InvalidInput& refusal) {
  // A library cannot name the command for a body that relaxes, which an elastic command refuses.
  if (refusal.field().ends_with("relaxation") && refusal.statement().starts_with("an elastic"))
    return std::string(refusal.what()) + " (salebra viscoelastic SURFACE --body FILE)";
  const std::string option = option_of(refusal.field());
  return option.empty() ? refusal.what() : option + ": " + refusal.statement();
}

}  // namespace salebra::cli
