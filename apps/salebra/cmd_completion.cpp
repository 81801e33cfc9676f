// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra completion`: completion scripts for bash and zsh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <salebra/base/error.hpp>

#include "io/text_file.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

std::string command_names(const Program& program) {
  std::string names;
  for (const Command& command : program.commands())
    names += (names.empty() ? "" : " ") + command.name();
  return names;
}

std::string bash_script(const Program& program) {
  std::string options, choices;
  for (const Command& command : program.commands()) {
    std::vector<std::string> names;
    for (const Option& option : command.options()) {
      if (option.positional() && option.choices().empty()) continue;
      if (option.positional()) {
        choices += fmt::format("    '{} ') choices='{}' ;;\n", command.name(),
                               fmt::join(option.choices(), " "));
        continue;
      }
      names.insert(names.end(), option.names().begin(), option.names().end());
      if (!option.choices().empty())
        choices += fmt::format("    '{} {}') choices='{}' ;;\n", command.name(),
                               option.names().back(), fmt::join(option.choices(), " "));
    }
    options += fmt::format("    {}) options='{}' ;;\n", command.name(), fmt::join(names, " "));
  }
  return fmt::format(R"(# Completion of salebra for bash, made by: salebra completion bash
_salebra() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  local command= options= choices= i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${{COMP_WORDS[i]}} != -* ]]; then command=${{COMP_WORDS[i]}}; break; fi
  done
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case $command in
{}  esac
  [[ $previous == -* ]] || previous=
  case "$command $previous" in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [[ -n $choices ]]; then
    COMPREPLY=($(compgen -W "$choices" -- "$word"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -F _salebra salebra
)",
                     command_names(program), options, choices);
}

/// Escapes text for a word of zsh between single quotes, inside the brackets of _arguments.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

std::string zsh_argument(const Option& option) {
  // A blank tells zsh that there is nothing to complete.
  std::string action = option.positional() || option.type_name() == "FILE" ? "_files" : " ";
  if (!option.choices().empty()) action = fmt::format("({})", fmt::join(option.choices(), " "));
  if (option.positional())
    return fmt::format("'::{}:{}'", zsh_text(option.names().front()), action);
  std::string argument;
  for (const std::string& name : option.names()) {
    argument +=
        fmt::format("{}'*{}[{}]", argument.empty() ? "" : " ", name, zsh_text(option.help()));
    if (!option.type_name().empty())
      argument += fmt::format(":{}:{}", zsh_text(option.type_name()), action);
    argument += "'";
  }
  return argument;
}

std::string zsh_script(const Program& program) {
  std::string commands, options;
  for (const Command& command : program.commands()) {
    commands += fmt::format("    '{}:{}'\n", command.name(), zsh_text(command.what()));
    options += fmt::format("      {}) _arguments", command.name());
    for (const Option& option : command.options())
      options += " \\\n        " + zsh_argument(option);
    options += " ;;\n";
  }
  return fmt::format(R"(#compdef salebra
# Completion of salebra for zsh, made by: salebra completion zsh
_salebra() {{
  local state
  local -a commands
  commands=(
{}  )
  _arguments '--help[print a help message]' '--version[print the version]' '1:command:->command' '*::argument:->argument'
  case $state in
    command) _describe -t commands command commands ;;
    argument)
      case $words[1] in
{}      esac ;;
  esac
}}
if [[ $funcstack[1] == _salebra ]]; then _salebra "$@"; else compdef _salebra salebra; fi
)",
                     commands, options);
}

void write_script(const std::string& text, Session& session) {
  if (!session.has_output()) return session.answer(Json{{"text", text}}, text);
  write_text_file(session.output(), text, session.write_options());
  session.answer(Json{{"file", session.output().string()}}, "");
}

}  // namespace

void add_completion_command(Program& program) {
  auto name = std::make_shared<std::string>();
  Command& command = program.add_command(
      "completion", "print a script with which a shell completes commands and options",
      {"salebra completion bash -o ~/.local/share/bash-completion/completions/salebra",
       "salebra completion zsh"},
      [name, &program](Session& session) {
        write_script(*name == "bash" ? bash_script(program) : zsh_script(program), session);
      },
      "", OutputCheck::any_name);
  add_choice(command, "SHELL", *name, {"bash", "zsh"}, "the shell")->required();
}

}  // namespace salebra::cli
