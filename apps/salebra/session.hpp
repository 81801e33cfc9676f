// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <set>
#include <string>
#include <string_view>

#include "command.hpp"
#include "figures/plot.hpp"
#include "io/json.hpp"
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
  std::string output;                  ///< file for the results; empty: none
  std::string plot;                    ///< picture to draw; empty: none
  std::optional<double> figure_width;  ///< of the picture, m; empty: the size of a screen
  bool no_caption = false;             ///< the picture is without its caption
  int threads = 0;                     ///< 0: as many as the machine has
  std::string progress = "auto";
};

/// What --output may name.
enum class OutputCheck {
  results,  ///< an HDF5 file that does not exist yet
  curve,    ///< a file for write_force_curve() that does not exist yet
  /// An HDF5 file; the command itself decides whether an existing file may be replaced.
  by_command,
  any_name  ///< a file that does not exist yet; the command itself checks the format
};

/// One run of a command: receives its answer, warnings and progress. With several processes only
/// the first one prints, draws and makes files; the others take part in the calls that all
/// processes must make.
class Session {
 public:
  /// Throws InvalidInput before any work if the file of --output must not be written. All processes
  /// must call. launch: must outlive the session.
  Session(CommonOptions options, std::string command_line, OutputCheck check, const Launch& launch);

  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool has_output() const { return !options_.output.empty(); }
  std::filesystem::path output() const { return options_.output; }
  /// The communicator of all processes, for work on distributed surfaces.
  const Communicator& communicator() const { return launch_.communicator; }
  void require_one_process(std::string_view what) const { cli::require_one_process(launch_, what); }
  /// Whether interrupted() is true in any process. All processes must call and get the same answer.
  bool stopped() const;
  /// Throws InvalidInput if the file of --output must not be written. All processes must call.
  void require_free_output() const;
  /// Throws InvalidInput if --output was given to a command that writes no file.
  void require_no_output(std::string_view command) const;
  /// Throws InvalidInput if --output was given and does not name an HDF5 file.
  void require_result_name() const;
  /// Registers the files that options name. After it, reads() and writes() add other files of the
  /// command, before its work. Throws InvalidInput if a file to write is also read or written under
  /// another option, and if processes would read different files. All processes must call.
  void name_files(const std::deque<Option>& options);
  void reads(std::string_view option, const std::filesystem::path& file);
  void writes(std::string_view option, const std::filesystem::path& file,
              std::string_view partner = "");
  /// Sets whether the command may read the file of --output, which it has written or continues.
  void may_read_output(bool may) { may_read_output_ = may; }
  bool quiet() const { return options_.quiet; }
  bool has_plot() const { return !options_.plot.empty(); }
  /// Draws the picture of --plot; does nothing if --plot was not given.
  void plot(const figures::Figure& figure);
  /// Options for the writers of the library. Throws InvalidInput if this process is one of several
  /// independent tasks, which would all write the same file.
  WriteOptions write_options() const;
  bool overwrites() const { return options_.overwrite; }
  Provenance provenance() const;

  /// Progress callback for the library. It draws the bar if one is wanted, and returns false after
  /// an interruption of this process.
  Progress progress();
  /// The progress callback, with a check for interruptions for work that reports no progress.
  Context context();

  /// inform() and warn() print on standard error unless --quiet was given. Each warning is printed
  /// once, and is added to the key `warnings` of a JSON answer.
  void inform(std::string_view text);
  void warn(std::string_view text);
  void warn(const std::vector<std::string>& lines);
  /// Calls warn() if there is a warning.
  void warn_if(const std::optional<std::string>& text);

  /// Prints the answer of the command: with --json `object`, otherwise `text`.
  void answer(const Json& object, const std::string& text);
  /// Prints an object completed by with_processes(), as JSON or laid out as text.
  void answer(const Json& object);
  /// Calls run() for one of several files and returns the answer that it would have printed, with its
  /// warnings. Warnings are printed with the name of the file; notes are left out.
  Json answer_of(const std::string& file, const std::function<void()>& run);
  /// Adds the numbers of processes and threads to an answer of salebra-mpi.
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
  std::vector<std::string> warnings_;  ///< all warnings that were printed
  std::string file_;                   ///< the file of answer_of() while it runs
  Json answer_;                        ///< its answer
};

/// Thrown by --merge if surfaces of the study are missing; the program then exits with status 3.
class Incomplete : public Error {
 public:
  using Error::Error;
};

/// True after the process has received SIGINT, SIGTERM, SIGUSR1 or SIGHUP.
bool interrupted();
/// Installs handlers for these four signals. The first signal only sets interrupted(), a second one
/// ends the process. SIGHUP stays ignored if nohup set it so.
void catch_interrupts();

}  // namespace salebra::cli
