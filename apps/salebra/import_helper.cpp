// SPDX-License-Identifier: GPL-3.0-or-later
// Reads files of instruments through the program salebra-import (import_helper.hpp).
#include "import_helper.hpp"

#include <cstring>
#include <salebra/base/error.hpp>
#include <sstream>

#include "io/child_program.hpp"
#include "io/surface_importer.hpp"
#include "session.hpp"

namespace salebra::cli {
namespace {

constexpr const char* helper = "salebra-import";

/// The texts of all lines "salebra-import: KIND: FILE: TEXT" of one kind, such as "note".
std::vector<std::string> lines_of(const std::string& kind, const std::string& text,
                                  const std::string& file) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  const std::string head = std::string(helper) + ": " + kind + ": " + file + ": ";
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(head)) found.push_back(line.substr(head.size()));
  return found;
}

std::vector<std::string> import_surface(const std::filesystem::path& from,
                                        const std::filesystem::path& to, const std::string& channel,
                                        const UnknownFormat& refusal) {
  if (detail::found_on_path(helper).empty())
    throw InvalidInput(from.string(),
                       refusal.statement() +
                           "; pip install 'salebra[formats]' adds the file formats of instruments");
  // An absolute path cannot be read as an option.
  const std::string file = std::filesystem::absolute(from).string();
  // Limits of the child process: a minute and more for large files, and memory, part of which its
  // libraries use before they read anything.
  const detail::ChildLimits limits{
      .time = std::chrono::seconds(60 + std::filesystem::file_size(from) / 1'000'000),
      .memory = (std::uint64_t{1} << 30) + 64 * std::uint64_t(std::filesystem::file_size(from)),
      .stopped = interrupted};
  std::vector<std::string> command{helper, file, to.string()};
  if (!channel.empty()) command.push_back("--channel=" + channel);
  const detail::ChildRun run = detail::run_child(command, "", limits);
  if (run.start_error != 0)
    throw IoError(std::string(helper) + ": cannot be started (" + std::strerror(run.start_error) +
                  ")");
  if (run.signal == 0 && run.status == 0) return lines_of("note", run.errors, file);
  const std::vector<std::string> errors = lines_of("error", run.errors, file);
  const std::string reason = run.late          ? "took too long and was stopped"
                             : !errors.empty() ? errors.front()
                             : run.signal != 0
                                 ? "was stopped by signal " + std::to_string(run.signal)
                                 : "failed with status " + std::to_string(run.status);
  // The message contains the errors of the library and of salebra-import.
  throw InvalidInput(from.string(),
                     refusal.statement() + "; " + std::string(helper) + ": " + reason);
}

}  // namespace

void install_import_helper() { set_surface_importer(import_surface); }

}  // namespace salebra::cli
