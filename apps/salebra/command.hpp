// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// What a command takes. Commands declare it here; program.cpp alone knows the library that parses
/// the command line, and hands it over. Help and completion read the same declarations.
namespace salebra::cli {

/// Heading of the options that every command has.
inline constexpr const char* common_options = "Options of every command";

/// What a command does with a file that an option names.
enum class FileUse {
  none,   ///< the option names no file
  input,  ///< reads it
  output  ///< writes it
};

/// An option, a flag or a positional argument. What is set here returns the option, so that one
/// declaration is one expression.
class Option {
 public:
  /// Where a given value goes, converted; a flag is a bool. --help has no place.
  using Target = std::variant<std::monostate, bool*, std::string*, int*, std::optional<int>*,
                              std::vector<std::string>*, std::function<void(const std::string&)>>;
  /// Says what is wrong with a text; empty if nothing is.
  using Check = std::function<std::string(const std::string&)>;

  /// names: "-o,--output", or the one name of a positional argument.
  Option(const std::string& names, Target target, std::string help);

  /// Heading under which the help lists it, in place of that of the command.
  Option* group(std::string name);
  /// Kind of value, such as FILE.
  Option* type_name(std::string name);
  /// Names a file: FILE. partner: another option that may name the file that this one writes.
  Option* file(FileUse use, std::string partner = "");
  Option* required(bool needed = true);
  /// Takes a number, and stands for this one where none follows.
  Option* value_without(std::string number);
  /// The only values allowed; a misspelt one is answered with the nearest.
  Option* choices(std::vector<std::string> values);
  /// For whole numbers, both ends included.
  Option* range(int least, int greatest);
  Option* check(Check check);
  /// One argument may hold several values, with this between them.
  Option* delimiter(char separator);

  const std::vector<std::string>& names() const { return names_; }
  const Target& target() const { return target_; }
  const std::string& help() const { return help_; }
  const std::string& group() const { return group_; }
  /// Empty for a flag.
  const std::string& type_name() const { return type_name_; }
  const std::vector<std::string>& choices() const { return choices_; }
  /// The help's text has the choices in it: "a | b | c".
  bool help_lists_choices() const;
  const std::optional<std::pair<int, int>>& range() const { return range_; }
  const Check& check() const { return check_; }
  std::optional<char> delimiter() const { return delimiter_; }
  FileUse file_use() const { return file_use_; }
  const std::string& partner() const { return partner_; }
  /// The files that were named.
  std::vector<std::string> files() const;
  bool positional() const { return names_.front().front() != '-'; }
  bool required() const { return required_; }
  /// Empty where a value must follow.
  const std::string& value_without() const { return value_without_; }
  /// Whether the command line has it.
  bool given() const { return given_; }
  void note_given() { given_ = true; }

 private:
  std::vector<std::string> names_;
  Target target_;
  std::string help_, group_, type_name_, partner_, value_without_;
  FileUse file_use_ = FileUse::none;
  std::vector<std::string> choices_;
  std::optional<std::pair<int, int>> range_;
  Check check_;
  std::optional<char> delimiter_;
  bool required_ = false, given_ = false;
};

class Command {
 public:
  /// what: in one line. examples: two command lines. action: runs after all options have been read.
  Command(std::string name, std::string what, std::array<std::string, 2> examples,
          std::function<void()> action);

  /// Heading under which the help lists what is declared from here on. Returns the one before.
  std::string under(std::string heading) { return std::exchange(heading_, std::move(heading)); }
  /// Targets must outlive the parsing. An option stays where it is.
  template <class T>
  Option* add_option(const std::string& names, T& target, std::string help) {
    return add(names, &target, std::move(help));
  }
  /// read: is given the text, and may throw InvalidInput.
  Option* add_option_function(const std::string& names,
                              std::function<void(const std::string&)> read, std::string help) {
    return add(names, std::move(read), std::move(help));
  }
  Option* add_flag(const std::string& names, bool& target, std::string help) {
    return add(names, &target, std::move(help));
  }

  const std::string& name() const { return name_; }
  const std::string& what() const { return what_; }
  const std::array<std::string, 2>& examples() const { return examples_; }
  const std::function<void()>& action() const { return action_; }
  /// The options in the order of their declaration, --help first.
  const std::deque<Option>& options() const { return options_; }
  std::deque<Option>& options() { return options_; }
  /// Throws InvalidInput with the reason where an option under that heading was given.
  void require_none_of(std::string_view group, std::string_view reason) const;

 private:
  Option* add(const std::string& names, Option::Target target, std::string help);

  std::string name_, what_;
  std::array<std::string, 2> examples_;
  std::function<void()> action_;
  std::deque<Option> options_;
  std::string heading_ = "Options";
};

/// Options that are declared while it lives stand under this heading.
class Heading {
 public:
  Heading(Command& command, std::string name)
      : command_(command), before_(command.under(std::move(name))) {}
  ~Heading() { command_.under(before_); }
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  Command& command_;
  std::string before_;
};

}  // namespace salebra::cli
