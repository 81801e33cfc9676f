// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra manual`: manual pages in roff from the commands' own help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/suggestion.hpp>
#include <salebra/base/version.hpp>

#include "help_text.hpp"
#include "program.hpp"
#include "written_text.hpp"

namespace salebra::cli {
namespace {

constexpr std::string_view exit_status =
    ".SH EXIT STATUS\n0: done. 1: failed while running. 2: bad usage or input. 3: surfaces are "
    "missing "
    "(study \\-\\-merge). 130: interrupted.\n";

/// Text in which roff finds no requests of its own.
std::string roff(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    const bool begins = k == 0 || text[k - 1] == '\n';
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

/// Paragraphs; one whose lines are indented keeps its lines.
std::string paragraphs(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto end = text.find("\n\n");
    const std::string_view paragraph = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
    const bool indented = paragraph.find("\n  ") != std::string_view::npos;
    result += ".PP\n" + std::string(indented ? ".nf\n" : "") + roff(paragraph) +
              std::string(indented ? "\n.fi\n" : "\n");
  }
  return result;
}

std::string title(const std::string& page) {
  std::string upper = page;
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH \"{}\" 1 \"\" \"salebra {}\" \"Manual of salebra\"\n", roff(upper),
                     version());
}

std::string option_list(const std::vector<const Option*>& options) {
  std::string result;
  for (const Option* option : options) {
    std::string names;
    for (const std::string& name : option->names())
      names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    if (!option->type_name().empty() && !option->positional())
      names += fmt::format(" \\fI{}\\fR", roff(option->type_name()));
    result += fmt::format(".TP\n{}\n{}\n", names, roff(option->help()));
    if (!option->choices().empty() && !option->help_lists_choices())
      result +=
          fmt::format("One of {}.\n", roff(fmt::format("{}", fmt::join(option->choices(), ", "))));
  }
  return result;
}

std::string command_page(const Command& command) {
  const std::string name = command.name();
  std::string page = title("salebra-" + name) +
                     fmt::format(".SH NAME\nsalebra\\-{} \\- {}\n.SH SYNOPSIS\n.B salebra {}\n",
                                 name, roff(command.what()), name);
  std::vector<std::string> groups;
  std::vector<const Option*> arguments;
  for (const Option& option : command.options()) {
    if (option.positional()) {
      const std::string argument = fmt::format("\\fI{}\\fR", option.names().front());
      page += (option.required() ? argument : "[" + argument + "]") + "\n";
      arguments.push_back(&option);
    } else if (std::ranges::find(groups, option.group()) == groups.end()) {
      groups.push_back(option.group());
    }
  }
  page += "[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n";
  if (const CommandHelp* help = find_help(name)) page += paragraphs(help->text);
  page += ".PP\nValues take units (10um, 20kHz, 115GPa, 90deg); a bare number is SI.\n";
  if (!arguments.empty()) page += ".SH ARGUMENTS\n" + option_list(arguments);
  page += ".SH OPTIONS\n";
  for (const std::string& group : groups) {
    std::vector<const Option*> members;
    for (const Option& option : command.options())
      if (!option.positional() && option.group() == group) members.push_back(&option);
    if (group != "Options") page += ".SS " + roff(group) + "\n";
    page += option_list(members);
  }
  page += ".SH EXAMPLES\n.nf\n" +
          roff("  " + command.examples()[0] + "\n  " + command.examples()[1]) + "\n.fi\n";
  return page + std::string(exit_status) + ".SH SEE ALSO\n.BR salebra (1)\n";
}

std::string program_page(const Program& program) {
  std::string page =
      title("salebra") + fmt::format(
                             ".SH NAME\nsalebra \\- {}\n.SH SYNOPSIS\n.B salebra\n"
                             "\\fICOMMAND\\fR [\\fIARGUMENTS\\fR] [\\fIOPTIONS\\fR]\n"
                             ".SH DESCRIPTION\n",
                             roff("statistics of rough-surface contact and relaxation damping"));
  page += paragraphs(first_steps());
  page += ".SH COMMANDS\n";
  std::string also;
  for (const Command& command : program.commands()) {
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(command.name()), roff(command.what()));
    also += fmt::format("{}.BR salebra\\-{} (1)", also.empty() ? "" : ",\n", command.name());
  }
  return page + std::string(exit_status) + ".SH SEE ALSO\n" + also + "\n";
}

std::string page_of(const Program& program, const std::string& name) {
  if (name.empty()) return program_page(program);
  std::vector<std::string> names;
  for (const Command& command : program.commands()) {
    if (command.name() == name) return command_page(command);
    names.push_back(command.name());
  }
  throw InvalidInput(
      "COMMAND", name,
      fmt::format("is not a command{}; see salebra --help", did_you_mean(name, names)));
}

}  // namespace

void add_manual_command(Program& program) {
  auto name = std::make_shared<std::string>();
  Command& command = program.add_command(
      "manual", "a manual page of the program or of one command",
      {"salebra manual study | man -l -", "salebra manual -o salebra.1"},
      [name, &program](Session& session) { answer_text(page_of(program, *name), session); }, "",
      OutputCheck::any_name);
  command.add_option("COMMAND", *name, "the command; without it the program")->type_name("NAME");
}

}  // namespace salebra::cli
