// SPDX-License-Identifier: GPL-3.0-or-later
// Command line: commands, errors of usage, exit statuses.
#include "program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/version.hpp>
#include <span>

#include "base/printable.hpp"
#include "base/stop_check.hpp"
#include "base/suggestion.hpp"
#include "base/undefined_points.hpp"
#include "confinement/confinement.hpp"
#include "help_text.hpp"
#include "import_helper.hpp"
#include "option_words.hpp"
#include "options.hpp"
#include "scarce_memory.hpp"
#include "terminal.hpp"
#include "version_text.hpp"

namespace salebra::cli {
namespace {

int fail(int status, std::string_view message) {
  // Shortens the message, because the parser quotes arguments of any length.
  constexpr std::size_t longest = 2000;
  std::string line = printable(shortened(in_options(message), longest));
  std::ranges::replace_if(line, [](char symbol) { return symbol == '\n' || symbol == '\t'; }, ' ');
  print_to_stderr(fmt::format("{}: {} {}\n", program_name(),
                              emphasised("error:", Emphasis::error, STDERR_FILENO), line));
  return status;
}

std::string join(int argc, char** argv) {
  std::string line(program_name());
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_of(" \t\n'\"$*?") == std::string::npos;
    line += plain ? " " + word : " '" + word + "'";
  }
  return line;
}

std::string help_hint(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty()
             ? fmt::format("see {} --help", program_name())
             : fmt::format("see {} {} --help", program_name(), chosen.front()->get_name());
}

/// The error message for a command line that the parser refused. A misspelt option is reported
/// before errors that follow from it, such as the absence of the correct option.
std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  // The parser counts words, as in "--angle: At Most 1 required but received 2" or "--law: 1
  // required NAME missing".
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    const std::string said = error.what(), option = said.substr(0, said.find(':'));
    if (said.ends_with(" missing")) return option + ": has no value; write one after it";
    if (said.find("At Most") != std::string::npos)
      return option +
             ": given more than once; write several values after one option, separated by commas";
  }
  const auto chosen = app.get_subcommands();
  const std::vector<std::string> words = app.remaining(true);
  if (chosen.empty()) return error.what();
  if (words.empty()) {
    if (!dynamic_cast<const CLI::RequiredError*>(&error)) return error.what();
    std::vector<std::string> missing;
    for (const CLI::Option* known : chosen.front()->get_options())
      if (known->get_required() && known->count() == 0) missing.push_back(known->get_name());
    return missing.size() < 2 ? error.what()
                              : fmt::format("{} are required", fmt::join(missing, ", "));
  }
  const auto option = std::ranges::find_if(words, [](const auto& word) { return word[0] == '-'; });
  if (option == words.end()) {
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error);
    return extra ? words.front() + ": one argument too many" : error.what();
  }
  std::vector<std::string> options;
  for (const CLI::Option* known : chosen.front()->get_options())
    for (const std::string& name : known->get_lnames()) options.push_back("--" + name);
  const std::string name = option->substr(0, option->find('='));
  const bool adhesion = name == "--work-of-adhesion" || name == "--adhesion-range";
  return fmt::format(
      "{}: is not an option of {} {}{}", name, program_name(), chosen.front()->get_name(),
      adhesion ? ": with adhesion points may separate in another order than they touched, and then "
                 "the loss is not known; use contact, or [adhesion] of a study"
               : did_you_mean(name, options));
}

CLI::Validator validator_of(const std::vector<std::string>& choices) {
  return CLI::Validator(
      [choices](const std::string& text) {
        return std::ranges::find(choices, text) != choices.end()
                   ? std::string()
                   : fmt::format("'{}' is not one of {}{}", text, fmt::join(choices, ", "),
                                 did_you_mean(text, choices));
      },
      "");
}

CLI::Option* declare(CLI::App& app, const Option& option) {
  const std::string names = fmt::format("{}", fmt::join(option.names(), ","));
  CLI::Option* made = std::visit(
      [&](const auto& target) -> CLI::Option* {
        using T = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<T, std::monostate>)
          return app.set_help_flag(names, option.help());
        else if constexpr (std::is_same_v<T, bool*>)
          return app.add_flag(names, *target, option.help());
        else if constexpr (std::is_pointer_v<T>)
          return app.add_option(names, *target, option.help());
        else
          return app.add_option_function<std::string>(names, target, option.help());
      },
      option.target());
  if (!option.type_name().empty()) made->type_name(option.type_name());
  if (option.required()) made->required();
  if (option.check()) made->check(option.check());
  if (option.range()) made->check(CLI::Range(option.range()->first, option.range()->second));
  if (!option.choices().empty()) made->check(validator_of(option.choices()));
  if (option.delimiter()) made->delimiter(*option.delimiter());
  return made;
}

void declare(CLI::App& app, Command& command) {
  CLI::App* made = app.add_subcommand(command.name(), command.what());
  std::vector<std::pair<Option*, CLI::Option*>> declared;
  for (Option& option : command.options()) declared.emplace_back(&option, declare(*made, option));
  made->callback([declared, &command] {
    for (const auto& [option, parsed] : declared)
      if (parsed->count() > 0) option->note_given();
    command.action()();
  });
}

/// Commands that several processes can compute together; all other commands take one process.
constexpr std::string_view spread_commands[] = {"contact", "generate", "statistics", "study"};
/// Commands that keep finished results when they are interrupted, and so check for an interruption
/// themselves.
constexpr std::string_view keeping_commands[] = {"compare", "contact", "oscillate", "study"};

bool is_one_of(std::string_view name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// The picture of --plot without a name.
constexpr const char* picture_by_input = "<input>.png";

/// The name of the first input with the suffix .png, in the current folder; without an input that of
/// the command.
std::string picture_name(const Command& command) {
  for (const Option& option : command.options())
    if (option.positional() && option.file_use() == FileUse::input)
      for (const std::string& file : option.files())
        return std::filesystem::path(file).stem().string() + ".png";
  return command.name() + ".png";
}

void check_width(const CommonOptions& options) {
  if (!options.figure_width) return;
  require_that(std::filesystem::path(options.plot).extension() != ".json" && !options.plot.empty(),
               "--figure-width", "needs a picture; give --plot FILE.png, .svg or .pdf");
  require(*options.figure_width >= 0.06 && *options.figure_width <= 1, "--figure-width",
          format_quantity(*options.figure_width, Dimension::length),
          "must be from 60 mm to 1 m; write for example 85mm");
}

}  // namespace

Command& Program::add_command(const std::string& name, const std::string& what,
                              const std::array<std::string, 2>& examples, Action action,
                              const std::string& picture, OutputCheck check) {
  auto common = std::make_shared<CommonOptions>();
  Command& command = commands_.emplace_back(
      name, what, examples,
      [this, common, name, action = std::move(action), line = command_line_, check,
       &launch = launch_] {
        if (!is_one_of(name, spread_commands)) require_one_process(launch, name);
        // With several processes a check that throws in one process would leave the others waiting.
        std::optional<detail::StopCheck> stops;
        if (launch.communicator.alone() && !is_one_of(name, keeping_commands))
          stops.emplace(interrupted);
        const int threads = std::min(common->threads, parallel::max_threads());
        parallel::set_threads(threads);
        const Command& self = *std::ranges::find(commands_, name, &Command::name);
        if (common->plot == picture_by_input) common->plot = picture_name(self);
        check_width(*common);
        Session session(*common, line, check, launch);
        if (threads < common->threads)
          session.warn(fmt::format("--threads {}: too many for this machine; {} are used",
                                   common->threads, threads));
        session.name_files(self.options());
        action(session);
      });
  command.under(common_options);
  command.add_flag(
      "--json", common->json,
      "print exactly one JSON object, in SI units; of several surfaces a list of objects");
  command.add_option("-o,--output", common->output, "file to write")->file(FileUse::output);
  command.add_flag("--overwrite", common->overwrite, "replace an existing output file");
  command.add_option("--threads", common->threads, "threads to use; 0 means all")
      ->check([](const std::string& text) {
        int threads = 0;
        return CLI::detail::lexical_cast(text, threads) && threads >= 0
                   ? std::string()
                   : text + " must be a whole number >= 0";
      });
  command.add_flag("--quiet", common->quiet, "print nothing but errors on stderr");
  add_choice(command, "--progress", common->progress, {"auto", "always", "never"},
             "progress bar; default auto, on a terminal only");
  command.under("Options");
  if (!picture.empty()) {
    command
        .add_option(
            "--plot", common->plot,
            "picture to draw, .png, .svg or .pdf, or its numbers, .json: " + picture +
                "; without a name, last or before another option, it is named as the input, "
                ".png")
        ->file(FileUse::output)
        ->value_without(picture_by_input);
    add_quantity(command, "--figure-width", common->figure_width, Dimension::length,
                 "width of the printed picture, with texts of 7 points, such as 85mm or 170mm; "
                 "default the size of a screen");
    command.add_flag("--no-caption", common->no_caption,
                     "leaves the caption out of the picture, for a journal that sets it");
  }
  return command;
}

namespace {

/// Thrown for a command line that cannot be parsed.
struct NotUnderstood : Error {
  using Error::Error;
};

/// Throws InvalidInput if processes were started with different arguments: they would wait for each
/// other for ever.
void require_one_command(const std::string& command_line, const Communicator& communicator) {
  const std::vector<std::string> lines =
      communicator.gather_all(fmt::format("{} {}", version(), command_line));
  for (std::size_t rank = 1; rank < lines.size(); ++rank)
    if (lines[rank] != lines.front())
      throw InvalidInput(fmt::format("process {}", rank + 1),
                         "has different arguments or a different version of the program than "
                         "process 1; give all processes the same");
}

/// Commands of earlier versions, each with the command and options that replace it.
struct FormerCommand {
  std::string_view name, now;
};
constexpr FormerCommand former_commands[]{
    {"damper", "damping, without --drag-velocity, or with --mass or --falling-slope"},
    {"figure3", "oscillate, with --shape cylinder,paraboloid,pyramids,sinusoids"},
    {"friction", "sliding, with the same options"},
    {"gw", "contact, with --model gw_moments or gw_deterministic"},
    {"info", "statistics"},
    {"manual", "help, with the name of a command"},
    {"mdr", "damping, with --law and the shape of the indenter"},
    {"slider", "sliding, with --velocities for --velocity"},
    {"sweep", "contact, with several values of --pressure"},
};

/// Inserts the default number after each option that may be given without one; otherwise the parser
/// would take the next word for the number.
void complete_options(const Command& command, std::vector<std::string>& words) {
  for (const Option& option : command.options()) {
    if (option.value_without().empty()) continue;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (std::ranges::find(option.names(), words[i]) == option.names().end()) continue;
      double number = 0;
      const bool bare =
          i + 1 == words.size() ||
          (option.file_use() == FileUse::none ? !CLI::detail::lexical_cast(words[i + 1], number)
                                              : words[i + 1].starts_with('-'));
      if (bare) words[i] += "=" + option.value_without();
    }
  }
}

/// Parses the command line and runs the command. Throws NotUnderstood and the errors of the
/// command.
void run(int argc, char** argv, const Launch& launch) {
  require_one_command(join(argc, argv), launch.communicator);
  const std::string name(program_name());
  CLI::App app("Statistics of rough-surface contact and its relaxation damping.", name);
  app.set_version_flag("-V,--version", name + " " + std::string(version()));
  app.require_subcommand(1);
  Program program(join(argc, argv), launch);
#define SALEBRA_COMMAND(name) add_##name##_command(program);
#include "command_list.inc"
#undef SALEBRA_COMMAND

  const auto show = [&](const std::string& text) {
    if (launch.communicator.is_root()) print_answer(wrapped(text, text_width()));
  };
  std::vector<std::string> words(argv + 1, argv + argc);
  // The command line is "salebra help" or "salebra help COMMAND"
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    if (words == std::vector<std::string>{"options"})
      return show(options_help(program.commands().front()));
    words.emplace_back("--help");
  }
  if (words.empty()) words = {"--help"};
  if (words == std::vector<std::string>{"--version", "--verbose"})
    return show(version_text(launch));
  std::vector<std::string> names;
  for (const Command& command : program.commands()) names.push_back(command.name());
  const std::string word = words.front();
  if (!word.starts_with('-') && std::ranges::find(names, word) == names.end()) {
    const auto* former = std::ranges::find(former_commands, word, &FormerCommand::name);
    if (former != std::end(former_commands))
      throw InvalidInput(word, fmt::format("is now {}", former->now));
    throw InvalidInput(
        word, fmt::format("is not a command{}; see {} --help", did_you_mean(word, names), name));
  }
  const auto chosen = std::ranges::find(program.commands(), word, &Command::name);
  if (chosen != program.commands().end()) {
    name_options(*chosen);
    complete_options(*chosen, words);
  }
  // Declares only options of commands that the command line names. Declaring those of all commands
  // took a third of the start-up time.
  for (Command& command : program.commands())
    if (std::ranges::find(words, command.name()) != words.end()) declare(app, command);
  try {
    std::ranges::reverse(words);  // the parser takes the words in reverse order
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    show(chosen == program.commands().end() ? program_help(program.commands())
                                            : command_help(*chosen));
  } catch (const CLI::CallForVersion& version) {
    show(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    throw NotUnderstood(fmt::format("{}; {}", describe(app, error), help_hint(app)));
  }
}

constexpr std::string_view no_memory = "memory: not enough for this grid; use fewer points";

/// Prints that memory is lacking, without allocating memory.
void print_lack_of_memory() noexcept {
  print_to_stderr(program_name());
  print_to_stderr(": error: ");
  print_to_stderr(no_memory);
  print_to_stderr("\n");
}

/// Ends the program if an allocation fails where an exception cannot propagate: in an OpenMP
/// thread, in a destructor, or while another exception is thrown.
[[noreturn]] void end_without_unwinding() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    print_lack_of_memory();
    _exit(1);
  } catch (...) {
  }
  std::abort();
}

/// Prints a failure and returns its exit status. If all processes have failed, the first process
/// prints the message. Otherwise this process prints it and ends the other processes.
int end(const Launch& launch, int status, std::string_view message) {
  if (launch.communicator.alone()) return fail(status, message);
  if (launch.all_here()) return launch.communicator.is_root() ? fail(status, message) : status;
  fail(status, fmt::format("process {} of {}: {}", launch.communicator.rank() + 1,
                           launch.communicator.size(), message));
  launch.abort(status);
  return status;
}

}  // namespace

int run_program(int argc, char** argv, const Launch& launch) {
  name_program(launch.name);
  std::set_terminate(end_without_unwinding);
  // Writing past a file-size limit or to a pipe without a reader must fail like writing to a full
  // disk, and not kill the process and leave a half-written file.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  catch_interrupts();
  // Confinement and import helper start child processes, which network libraries of MPI do not
  // survive. With several processes, files are therefore read without confinement and must be
  // trusted.
  if (launch.communicator.alone()) {
    confinement::install();
    install_import_helper();
  }
  prepare_for_scarce_memory();
  try {
    run(argc, argv, launch);
    return 0;
  } catch (const UndefinedPoints& error) {
    return end(launch, 2, std::string(error.what()) + " (salebra convert --fill)");
  } catch (const InvalidInput& error) {
    return end(launch, 2, with_option(error));
  } catch (const NotUnderstood& error) {
    return end(launch, 2, error.what());
  } catch (const Incomplete& error) {
    return end(launch, 3, error.what());
  } catch (const Interrupted& error) {
    return end(launch, 130, error.what());
  } catch (const std::bad_alloc&) {
    if (!launch.communicator.alone()) return end(launch, 1, no_memory);
    print_lack_of_memory();
    return 1;
  } catch (const std::exception& error) {
    return end(launch, interrupted() ? 130 : 1, error.what());
  }
}

}  // namespace salebra::cli
