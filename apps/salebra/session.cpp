// SPDX-License-Identifier: GPL-3.0-or-later
// What one command run needs: common options, output checks, progress, notes, answer, interruption.
#include "session.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <salebra/base/error.hpp>

#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;
extern "C" void note_interrupt(int) { interrupt_seen = 1; }

void write_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw IoError("standard output: cannot be written; check the disk or the reader of the pipe");
  }
}

}  // namespace

bool interrupted() { return interrupt_seen != 0; }

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

Session::Session(CommonOptions options, std::string command_line, OutputCheck check)
    : options_(std::move(options)),
      command_line_(std::move(command_line)),
      bar_(options_.progress == "always" ||
           (options_.progress == "auto" && !options_.quiet && isatty(STDERR_FILENO) != 0)) {
  if (check == OutputCheck::at_start) require_free_output();
  if (has_plot()) require_plot(options_.plot, write_options());
}

void Session::require_free_output() const {
  if (has_output()) require_output(output(), write_options());
}

Provenance Session::provenance() const {
  Provenance provenance;
  provenance.command_line = command_line_;
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
  fmt::print(stderr, "{}\n", text);
}

void Session::warn(std::string_view text) {
  if (options_.quiet) return;
  bar_.clear();
  fmt::print(stderr, "salebra: {} {}\n", emphasised("warning:", Emphasis::warning, STDERR_FILENO),
             text);
}

void Session::answer(const Json& object, const std::string& text) {
  bar_.clear();
  if (options_.json) {
    // File names need not be valid UTF-8, JSON must be.
    write_stdout(object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } else {
    write_stdout(text);
  }
}

void Session::answer(const Json& object) { answer(object, options_.json ? "" : to_text(object)); }

}  // namespace salebra::cli
