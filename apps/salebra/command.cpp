// SPDX-License-Identifier: GPL-3.0-or-later
// Declarations of commands and options, of command.hpp.
#include "command.hpp"

#include <algorithm>
#include <salebra/base/error.hpp>

namespace salebra::cli {
namespace {

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    parts.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The kind of value (as in "--points NUMBER") of an option for which type_name() was not called.
std::string type_of(const Option::Target& target) {
  if (std::holds_alternative<std::monostate>(target) || std::holds_alternative<bool*>(target))
    return "";
  const bool number =
      std::holds_alternative<int*>(target) || std::holds_alternative<std::optional<int>*>(target);
  return number ? "INT" : "TEXT";
}

}  // namespace

Option::Option(const std::string& names, Target target, std::string help)
    : names_(split(names)),
      target_(std::move(target)),
      help_(std::move(help)),
      type_name_(type_of(target_)) {}

Option* Option::group(std::string name) {
  group_ = std::move(name);
  return this;
}

Option* Option::type_name(std::string name) {
  type_name_ = std::move(name);
  return this;
}

Option* Option::file(FileUse use, std::string partner) {
  file_use_ = use;
  partner_ = std::move(partner);
  return type_name("FILE");
}

std::vector<std::string> Option::files() const {
  if (file_use_ == FileUse::none) return {};
  if (const auto* many = std::get_if<std::vector<std::string>*>(&target_)) return **many;
  const std::string& one = *std::get<std::string*>(target_);
  return one.empty() ? std::vector<std::string>{} : std::vector{one};
}

Option* Option::required(bool needed) {
  required_ = needed;
  return this;
}

Option* Option::value_without(std::string number) {
  value_without_ = std::move(number);
  return this;
}

Option* Option::choices(std::vector<std::string> values) {
  choices_ = std::move(values);
  return this;
}

Option* Option::range(int least, int greatest) {
  range_.emplace(least, greatest);
  return this;
}

Option* Option::check(Check check) {
  check_ = std::move(check);
  return this;
}

Option* Option::delimiter(char separator) {
  delimiter_ = separator;
  return this;
}

bool Option::help_lists_choices() const { return help_.find(" | ") != std::string::npos; }

Command::Command(std::string name, std::string what, std::array<std::string, 2> examples,
                 std::function<void()> action)
    : name_(std::move(name)),
      what_(std::move(what)),
      examples_(std::move(examples)),
      action_(std::move(action)) {
  add("-h,--help", std::monostate(), "what the command does, with its options")
      ->group(common_options);
}

void Command::require_none_of(std::string_view group, std::string_view reason) const {
  for (const Option& option : options_)
    require_that(!option.given() || option.group() != group, option.names().back(),
                 std::string(reason));
}

Option* Command::add(const std::string& names, Option::Target target, std::string help) {
  return options_.emplace_back(names, std::move(target), std::move(help)).group(heading_);
}

}  // namespace salebra::cli
