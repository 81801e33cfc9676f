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

/// Options and arguments of commands. Only program.cpp knows the library that parses the command
/// line and passes these declarations to it. Help and completion read them too.
namespace salebra::cli {

/// Heading of the options that every command has.
inline constexpr const char* common_options = "Options of every command";

/// What a command does with the file that an option names.
enum class FileUse {
  none,   ///< the option names no file
  input,  ///< the command reads the file
  output  ///< the command writes the file
};

/// An option, a flag or a positional argument. Setters return the option, so that a declaration is
/// one expression.
class Option {
 public:
  /// The variable that receives the converted value; a flag sets a bool, --help sets nothing.
  using Target = std::variant<std::monostate, bool*, std::string*, int*, std::optional<int>*,
                              std::vector<std::string>*, std::function<void(const std::string&)>>;
  /// Returns the error message for the text of a value; empty if the text is valid.
  using Check = std::function<std::string(const std::string&)>;

  /// names: "-o,--output" for an option, or the name of a positional argument.
  Option(const std::string& names, Target target, std::string help);

  /// Sets the heading under which the help lists the option; default: the current heading of the
  /// command.
  Option* group(std::string name);
  /// Sets the kind of value that the help shows, such as FILE.
  Option* type_name(std::string name);
  /// Declares that the value is the name of a file. partner: an option that may name the same file
  /// as this option.
  Option* file(FileUse use, std::string partner = "");
  Option* required(bool needed = true);
  /// Sets the number that the option has if the command line gives it without a number.
  Option* value_without(std::string number);
  /// Sets the allowed values; the error for a misspelt value suggests the nearest.
  Option* choices(std::vector<std::string> values);
  /// Sets the range of a whole number, both ends included.
  Option* range(int least, int greatest);
  Option* check(Check check);
  /// Allows several values in one argument, separated by this character.
  Option* delimiter(char separator);

  const std::vector<std::string>& names() const { return names_; }
  const Target& target() const { return target_; }
  const std::string& help() const { return help_; }
  const std::string& group() const { return group_; }
  /// The kind of value; empty for a flag.
  const std::string& type_name() const { return type_name_; }
  const std::vector<std::string>& choices() const { return choices_; }
  /// Whether the help text already lists the choices: "a | b | c".
  bool help_lists_choices() const;
  const std::optional<std::pair<int, int>>& range() const { return range_; }
  const Check& check() const { return check_; }
  std::optional<char> delimiter() const { return delimiter_; }
  FileUse file_use() const { return file_use_; }
  const std::string& partner() const { return partner_; }
  /// Names of the files that the command line gave for this option.
  std::vector<std::string> files() const;
  bool positional() const { return names_.front().front() != '-'; }
  bool required() const { return required_; }
  /// The number for an option given without one; empty if a number must follow.
  const std::string& value_without() const { return value_without_; }
  /// Whether the command line contains the option.
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
  /// what: one line for the list of commands. examples: two command lines for the help. action:
  /// runs the command after all options have been read.
  Command(std::string name, std::string what, std::array<std::string, 2> examples,
          std::function<void()> action);

  /// Sets the heading under which the help lists the options that are declared next. Returns the
  /// previous heading.
  std::string under(std::string heading) { return std::exchange(heading_, std::move(heading)); }
  /// Declares an option that sets `target`, which must outlive the parsing of the command line. The
  /// returned pointer stays valid.
  template <class T>
  Option* add_option(const std::string& names, T& target, std::string help) {
    return add(names, &target, std::move(help));
  }
  /// Declares an option whose text is passed to read(), which may throw InvalidInput.
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
  /// Throws InvalidInput with this reason if the command line gave an option under the heading
  /// `group`.
  void require_none_of(std::string_view group, std::string_view reason) const;

 private:
  Option* add(const std::string& names, Option::Target target, std::string help);

  std::string name_, what_;
  std::array<std::string, 2> examples_;
  std::function<void()> action_;
  std::deque<Option> options_;
  std::string heading_ = "Options";
};

/// Puts all options that are declared during its lifetime under this heading.
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
