// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <new>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/version.hpp>

namespace salebra::cli {
namespace {

int fail(int status, std::string_view message) {
  std::string line(message);
  std::ranges::replace(line, '\n', ' ');
  fmt::print(stderr, "salebra: error: {}\n", line);
  return status;
}

std::string join(int argc, char** argv) {
  std::string line = "salebra";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_of(" \t\n'\"$*?") == std::string::npos;
    line += plain ? " " + word : " '" + word + "'";
  }
  return line;
}

std::string help_hint(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "see salebra --help"
                        : "see salebra " + chosen.front()->get_name() + " --help";
}

}  // namespace

CLI::App& Program::add_command(const std::string& name, const std::string& what,
                               const std::array<std::string, 2>& examples, Action action,
                               const std::string& picture, OutputCheck check) {
  auto common = std::make_shared<CommonOptions>();
  CLI::App* command = app_.add_subcommand(name, what);
  command->footer(
      "Values take units (10um, 20kHz, 115GPa, 90deg); a bare number is SI.\n\nExamples:\n  " +
      examples[0] + "\n  " + examples[1]);
  const std::string group = "Common options";
  command->add_flag("--json", common->json, "print exactly one JSON object, in SI units")
      ->group(group);
  command->add_option("-o,--output", common->output, "file to write")->group(group);
  if (!picture.empty())
    command->add_option("--plot", common->plot, "picture to draw, .png or .svg: " + picture)
        ->type_name("FILE")
        ->group(group);
  command->add_flag("--force", common->force, "replace an existing output file")->group(group);
  command->add_option("--threads", common->threads, "threads to use; 0 means all")
      ->group(group)
      ->check([](const std::string& text) {
        int threads = 0;
        return CLI::detail::lexical_cast(text, threads) && threads >= 0
                   ? std::string()
                   : text + " must be a whole number >= 0";
      });
  command->add_flag("--quiet", common->quiet, "no remarks on stderr")->group(group);
  command->add_option("--progress", common->progress, "auto: on a terminal only; always; never")
      ->group(group)
      ->check(CLI::IsMember({"auto", "always", "never"}));
  command->callback([common, action = std::move(action), line = command_line_, check] {
    parallel::set_threads(common->threads);
    Session session(*common, line, check);
    action(session);
  });
  return *command;
}

int run_program(int argc, char** argv) {
  // Past a file-size limit a write must fail like on a full disk, not kill the process beside a half-written file.
  std::signal(SIGXFSZ, SIG_IGN);
  catch_interrupts();

  CLI::App app("Statistics of rough-surface contact and its relaxation damping.", "salebra");
  app.set_version_flag("--version", "salebra " + std::string(version()));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  Program program(app, join(argc, argv));
#define SALEBRA_COMMAND(name) add_##name##_command(program);
#include "command_list.inc"
#undef SALEBRA_COMMAND

  if (argc < 2) return fail(2, "command: none is given; see salebra --help");
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  const std::string word = argv[1];
  if (word[0] != '-' && std::ranges::find(commands, word, &CLI::App::get_name) == commands.end()) {
    return fail(2, fmt::format("{}: is not a command; see salebra --help", word));
  }
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return fail(2, fmt::format("{}; {}", error.what(), help_hint(app)));
  } catch (const InvalidInput& error) {
    return fail(2, error.what());
  } catch (const Interrupted& error) {
    return fail(130, error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, "memory: not enough for this grid; use fewer points");
  } catch (const std::exception& error) {
    return fail(interrupted() ? 130 : 1, error.what());
  }
}

}  // namespace salebra::cli
