// SPDX-License-Identifier: GPL-3.0-or-later
// Services for one run of a command: common options, output checks, progress, notes, answer,
// interruption.
#include "session.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "base/printable.hpp"
#include "io/input.hpp"
#include "io/input_file.hpp"
#include "io/sidecar.hpp"
#include "option_words.hpp"
#include "terminal.hpp"
#include "text.hpp"
#include "version_text.hpp"

namespace salebra::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;
extern "C" void note_interrupt(int) {
  interrupt_seen = 1;
  // A second signal of any kind ends the command.
  for (const int sign : {SIGINT, SIGTERM, SIGUSR1, SIGHUP}) {
    struct sigaction now = {};
    if (sigaction(sign, nullptr, &now) == 0 && now.sa_handler == note_interrupt)
      std::signal(sign, SIG_DFL);
  }
}

/// "one of 64 tasks", from the environment variables of MPI launchers and Slurm; empty for a single
/// task. PMIX_RANK tells only that there are several tasks and the number of this one.
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
  // Job schedulers can be set to send SIGUSR1 some time before they kill a job.
  sigaction(SIGUSR1, &action, nullptr);
  // Leaves SIGHUP ignored if nohup has set it so.
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

Session::Session(CommonOptions options, std::string command_line, OutputCheck check,
                 const Launch& launch)
    : launch_(launch),
      options_(std::move(options)),
      command_line_(std::move(command_line)),
      bar_(launch.communicator.is_root() &&
           (options_.progress == "always" ||
            (options_.progress == "auto" && !options_.quiet && isatty(STDERR_FILENO) != 0))) {
  if (check == OutputCheck::curve) {
    if (has_output()) require_curve_name(output());
  } else if (check != OutputCheck::any_name) {
    require_result_name();
  }
  if (check != OutputCheck::by_command) require_free_output();
  collectively(communicator(), [&] {
    if (has_plot() && communicator().is_root())
      figures::require_plot(options_.plot, write_options());
  });
  if (!communicator().alone()) warn_of_few_cores();
  // A file may name other files to read, so each file is checked when it is opened. With several
  // processes this is not done: only the first one knows the files to write, and if it threw alone
  // the others would wait.
  if (options_.overwrite && communicator().alone())
    detail::set_input_watcher([this](const std::filesystem::path& file) {
      if (!may_read_output_) files_.opens(file);
    });
}

Session::~Session() { detail::set_input_watcher({}); }

void Session::warn_of_few_cores() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  if (sched_getaffinity(0, sizeof mine, &mine) != 0)
    for (long core = 0; core < std::min<long>(sysconf(_SC_NPROCESSORS_ONLN), CPU_SETSIZE); ++core)
      CPU_SET(core, &mine);
  const std::string bytes(reinterpret_cast<const char*>(&mine), sizeof mine);
  cpu_set_t cores = mine;
  for (const std::string& other : launch_.communicator_of_node.gather_all(bytes)) {
    cpu_set_t set;
    std::memcpy(&set, other.data(), sizeof set);
    CPU_OR(&cores, &cores, &set);
  }
  int threads = 0;
  for (const std::string& count :
       launch_.communicator_of_node.gather_all(std::to_string(parallel::threads())))
    threads += std::stoi(count);
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const int available = CPU_COUNT(&cores);
  const std::string line =
      threads > available ? fmt::format(
                                "{} processes with {} threads in total share {} cores of {}; use "
                                "fewer processes or --threads, or bind the processes to more cores",
                                launch_.communicator_of_node.size(), threads, available, host)
                          : "";
  for (const std::string& found : communicator().gather_all(line))
    if (!found.empty()) return warn(found);
}

bool Session::stopped() const { return !communicator().all_agree(!interrupted()); }

WriteOptions Session::write_options() const {
  const std::string task = communicator().alone() ? place_among_tasks() : "";
  if (!task.empty() && !launch_.mpi.empty())
    throw InvalidInput("--output",
                       fmt::format("would be written by each of several tasks: this process is {} "
                                   "but runs alone; start it with the mpirun of its own MPI",
                                   task));
  if (!task.empty())
    throw InvalidInput(
        "--output",
        fmt::format("would be written by each of several tasks: this process is {}; start only "
                    "one, or use salebra-mpi for one surface and study --shard for many",
                    task));
  return {.overwrite = options_.overwrite};
}

void Session::require_no_output(std::string_view command) const {
  require(!has_output(), "--output", output().string(),
          fmt::format("is not an option of {}, which writes no file; use --json and redirect",
                      command));
}

void Session::require_result_name() const {
  const std::string extension = output().extension().string();
  require(!has_output() || extension == ".h5" || extension == ".hdf5", "--output",
          output().string(),
          "is not a name of an HDF5 file; name it .h5, or print the results: --json > result.json");
}

void Session::require_free_output() const {
  collectively(communicator(), [&] {
    if (has_output() && communicator().is_root()) require_output(output(), write_options());
  });
}

void Session::name_files(const std::deque<Option>& options) {
  for (const Option& option : options)
    for (const std::string& file : option.files()) {
      const std::string& name = option.names().back();
      require(!file.empty(), name, "''", "does not name a file");
      if (file == "-")
        throw InvalidInput(name, file,
                           "is not a file; standard input and output cannot be used here. Name a "
                           "file, or write ./- for a file named -");
      if (option.file_use() == FileUse::output) {
        writes(name, file, option.partner());
        if (std::filesystem::path(file).extension() == ".npy")
          writes(name, detail::sidecar_of(file), option.partner());
      } else {
        reads(name, file);
      }
    }
}

void Session::reads(std::string_view option, const std::filesystem::path& file) {
  require_one_file(file, communicator());
  collectively(communicator(), [&] {
    if (communicator().is_root()) files_.reads(option, file);
  });
}

void Session::writes(std::string_view option, const std::filesystem::path& file,
                     std::string_view partner) {
  collectively(communicator(), [&] {
    if (communicator().is_root()) files_.writes(option, file, partner);
  });
}

Provenance Session::provenance() const {
  Provenance provenance;
  provenance.command_line = command_line_;
  provenance.started = started_;
  provenance.revision = source_revision();
  return provenance;
}

void Session::plot(const figures::Figure& figure) {
  if (has_plot() && communicator().is_root())
    figures::write_plot(options_.plot, figure, write_options(), options_.figure_width,
                        !options_.no_caption);
}

Progress Session::progress() {
  return [this](const ProgressReport& report) {
    if (communicator().is_root()) bar_.draw(report);
    return !interrupted();
  };
}

Context Session::context() { return {progress(), interrupted}; }

void Session::inform(std::string_view text) {
  if (options_.quiet || !file_.empty() || !communicator().is_root()) return;
  bar_.clear();
  print_to_stderr(fmt::format("{}\n", printable(text)));
}

void Session::warn(std::string_view text) {
  if (!communicator().is_root() || !warned_.emplace(text).second) return;
  const std::string& said = warnings_.emplace_back(printable(in_options(text)));
  if (options_.quiet) return;
  bar_.clear();
  // Readers of files name the file themselves.
  const std::string of_file =
      file_.empty() || said.starts_with(file_ + ": ") ? "" : printable(file_) + ": ";
  print_to_stderr(fmt::format("{}: {} {}{}\n", program_name(),
                              emphasised("warning:", Emphasis::warning, STDERR_FILENO), of_file,
                              said));
}

void Session::warn(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) warn(line);
}

void Session::warn_if(const std::optional<std::string>& text) {
  if (text) warn(*text);
}

void Session::answer(const Json& object, const std::string& text) {
  if (!communicator().is_root()) return;
  Json all = object;
  if (all.is_object() && !warnings_.empty()) all["warnings"] = warnings_;
  if (!file_.empty()) {
    answer_ = std::move(all);
    return;
  }
  bar_.clear();
  if (options_.json) {
    print_answer(all.dump(2) + "\n");
  } else {
    print_answer(printable(text));
  }
}

Json Session::answer_of(const std::string& file, const std::function<void()>& run) {
  struct Guard {
    Session& session;
    ~Guard() {
      session.file_.clear();
      session.warned_.clear();
      session.warnings_.clear();
    }
  } guard{*this};
  file_ = file;
  answer_ = {};
  run();
  return std::move(answer_);
}

void Session::answer(const Json& object) {
  const Json all = with_processes(object);
  answer(all, options_.json ? "" : to_text(all));
}

Json Session::with_processes(Json object) const {
  if (!launch_.mpi.empty()) {
    object["ranks"] = communicator().size();
    object["threads"] = parallel::threads();
  }
  return object;
}

}  // namespace salebra::cli
