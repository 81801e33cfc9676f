// SPDX-License-Identifier: GPL-3.0-or-later
// What one command run needs: common options, output checks, progress, notes, answer, interruption.
#include "session.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <salebra/base/error.hpp>
#include <salebra/base/printable.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "option_words.hpp"
#include "revision.inc"
#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;
extern "C" void note_interrupt(int) { interrupt_seen = 1; }

/// "one of 64 tasks", as MPI's launchers and Slurm say in the environment; empty: of one. PMIX_RANK tells the place alone.
std::string place_among_tasks() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* text = std::getenv(variable); text && std::atoi(text) > 1)
      return fmt::format("one of {} tasks", std::atoi(text));
  const char* rank = std::getenv("PMIX_RANK");
  return rank && std::atoi(rank) > 0 ? "one of several tasks" : "";
}

}  // namespace

bool interrupted() { return interrupt_seen != 0; }

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // As schedulers are told to send it some time before they kill.
  sigaction(SIGUSR1, &action, nullptr);
  // nohup has it ignored.
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

Session::Session(CommonOptions options, std::string command_line, OutputCheck check)
    : options_(std::move(options)),
      command_line_(std::move(command_line)),
      bar_(options_.progress == "always" ||
           (options_.progress == "auto" && !options_.quiet && isatty(STDERR_FILENO) != 0)) {
  if (check == OutputCheck::curve) {
    if (has_output()) require_curve_name(output());
  } else if (check != OutputCheck::any_name) {
    require_result_name();
  }
  if (check != OutputCheck::by_command) require_free_output();
  if (has_plot()) require_plot(options_.plot, write_options());
}

WriteOptions Session::write_options() const {
  if (const std::string place = place_among_tasks(); !place.empty())
    throw InvalidInput("--output", fmt::format("would be written by each of several tasks, for "
                                               "this is {}; start one, or use study --shard",
                                               place));
  return {.overwrite = options_.overwrite};
}

void Session::require_result_name() const {
  const std::string extension = output().extension().string();
  require(!has_output() || extension == ".h5" || extension == ".hdf5", "--output",
          output().string(),
          "is no name for results in HDF5; name it .h5, or print them: --json > result.json");
}

void Session::require_free_output() const {
  if (has_output()) require_output(output(), write_options());
}

Provenance Session::provenance() const {
  Provenance provenance;
  provenance.command_line = command_line_;
  provenance.started = started_;
  provenance.revision = source_revision;
  return provenance;
}

void Session::plot(const Figure& figure) {
  if (has_plot()) write_plot(options_.plot, figure, write_options());
}

Progress Session::progress() {
  return [this](const ProgressReport& report) {
    bar_.draw(report);
    return !interrupted();
  };
}

void Session::note(std::string_view text) {
  if (options_.quiet) return;
  bar_.clear();
  print_remark(fmt::format("{}\n", printable(text)));
}

void Session::warn(std::string_view text) {
  if (options_.quiet) return;
  bar_.clear();
  print_remark(fmt::format("salebra: {} {}\n",
                           emphasised("warning:", Emphasis::warning, STDERR_FILENO),
                           printable(in_options(text))));
}

void Session::answer(const Json& object, const std::string& text) {
  bar_.clear();
  if (options_.json) {
    print_answer(object.dump(2) + "\n");
  } else {
    print_answer(printable(text));
  }
}

void Session::answer(const Json& object) { answer(object, options_.json ? "" : to_text(object)); }

}  // namespace salebra::cli
