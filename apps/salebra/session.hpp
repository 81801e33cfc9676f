// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <set>
#include <string>
#include <string_view>

#include "command.hpp"
#include "io/json.hpp"
#include "io/plot.hpp"
#include "launch.hpp"
#include "named_files.hpp"
#include "progress_bar.hpp"

namespace salebra {
struct Context;
}

namespace salebra::cli {

/// The options that every command has.
struct CommonOptions {
  bool json = false;
  bool overwrite = false;
  bool quiet = false;
  std::string output;  ///< empty: none
  std::string plot;    ///< picture to draw; empty: none
  int threads = 0;     ///< 0: all
  std::string progress = "auto";
};

/// What --output may name.
enum class OutputCheck {
  results,     ///< an HDF5 file that is not there yet
  curve,       ///< a file of a curve that is not there yet, as write_force_curve() knows them
  by_command,  ///< an HDF5 file; one that is in the way is a matter for the command itself
  any_name     ///< a file that is not there yet; the command knows formats of its own
};

/// One run of a command: where its answer, its warnings and its progress go. Of several processes
/// the root alone prints, draws and makes files; the others do what is collective.
class Session {
 public:
  /// Throws InvalidInput where the output may not be written, so that no work is done
  /// unnecessarily. Collective. launch: outlives it.
  Session(CommonOptions options, std::string command_line, OutputCheck check, const Launch& launch);

  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool has_output() const { return !options_.output.empty(); }
  std::filesystem::path output() const { return options_.output; }
  /// The processes that compute together, for what is spread over them.
  const Communicator& communicator() const { return launch_.communicator; }
  void require_one_process(std::string_view what) const { cli::require_one_process(launch_, what); }
  /// interrupted() of any process. Collective: all processes get the same answer.
  bool stopped() const;
  /// Throws as the constructor does. Collective.
  void require_free_output() const;
  /// Throws InvalidInput unless --output, where it was given, names an HDF5 file.
  void require_result_name() const;
  /// The files that options name, then others that the command reads or writes, before its work.
  /// Throws InvalidInput where one that is written is read or written under another name too, and
  /// where processes would read different files. Collective.
  void name_files(const std::deque<Option>& options);
  void reads(std::string_view option, const std::filesystem::path& file);
  void writes(std::string_view option, const std::filesystem::path& file,
              std::string_view partner = "");
  /// Whether the command may read its own output from now on: what it has written, or is to continue.
  void may_read_output(bool may) { may_read_output_ = may; }
  bool quiet() const { return options_.quiet; }
  bool has_plot() const { return !options_.plot.empty(); }
  /// Draws what --plot asked for; nothing where it was not given.
  void plot(const Figure& figure);
  /// The library's writers take these. Throws InvalidInput in one of several tasks, which would all
  /// write the same file.
  WriteOptions write_options() const;
  bool overwrites() const { return options_.overwrite; }
  Provenance provenance() const;

  /// The library reports to it: draws the bar where one is wanted, and returns false after Ctrl-C
  /// of this process.
  Progress progress();
  /// The same, and Ctrl-C for what reports no progress.
  Context context();

  /// A warning for the person at the terminal, on stderr; --quiet leaves out both, and errors only
  /// remain. The same warning is given once, and is among the `warnings` of a JSON answer.
  void inform(std::string_view text);
  void warn(std::string_view text);
  void warn(const std::vector<std::string>& lines);
  /// warn() where there is a doubt.
  void warn_if(const std::optional<std::string>& text);

  /// The command's answer: the object with --json, the text without.
  void answer(const Json& object, const std::string& text);
  /// Prints the object itself laid out as text, with with_processes().
  void answer(const Json& object);
  /// An answer of salebra-mpi has the numbers of processes and threads too.
  Json with_processes(Json object) const;

 private:
  void warn_of_few_cores();

  const std::string started_ = utc_now();
  const Launch& launch_;
  CommonOptions options_;
  std::string command_line_;
  ProgressBar bar_;
  NamedFiles files_;
  bool may_read_output_ = false;
  std::set<std::string> warned_;
  std::vector<std::string> warnings_;  ///< as they were said
};

/// Surfaces are missing in a study that was to be merged: the program exits with 3.
class Incomplete : public Error {
 public:
  using Error::Error;
};

/// True once SIGINT, SIGTERM, SIGUSR1 or SIGHUP has come.
bool interrupted();
/// From now on the first of these only sets interrupted(), a second one ends the process. SIGHUP
/// stays ignored where nohup has it so.
void catch_interrupts();

}  // namespace salebra::cli
