// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a figure by gnuplot in a child process; the file appears complete or not at all.
#include "plot.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <salebra/base/error.hpp>
#include <sstream>

#include "gnuplot_script.hpp"
#include "io/atomic_file.hpp"
#include "io/child_program.hpp"

namespace salebra::figures {
namespace {

/// Empty for a file of numbers, .json.
std::optional<PictureFormat> format_of(const std::filesystem::path& file) {
  const std::string suffix = file.extension().string();
  if (suffix == ".json") return {};
  for (const auto& [known, format] : {std::pair{".png", PictureFormat::png},
                                      {".svg", PictureFormat::svg},
                                      {".pdf", PictureFormat::pdf}})
    if (suffix == known) return format;
  require(false, "plot", "'" + file.string() + "'",
          "does not end in the suffix of a picture; use .png, .svg, .pdf or .json");
  return {};
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw IoError(file.string() + ": " + reason + "; no picture was written");
}

void require_gnuplot(const std::filesystem::path& file) {
  if (detail::found_on_path("gnuplot").empty())
    fail(file, "gnuplot is not installed; pictures need it (Debian package gnuplot-nox)");
}

// The line of gnuplot's error messages that says what is wrong. It comes after the line of the
// script and a caret below that line.
std::string complaint(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos)
      last = line.substr(line.find_first_not_of(" \t"));
  return last.substr(0, 200);
}

/// Returns the picture that gnuplot draws; `file` is only named in messages.
std::string run_gnuplot(const std::filesystem::path& file, std::string_view script) {
  const detail::ChildRun run = detail::run_child({"gnuplot", "--default-settings", "-"}, script);
  if (run.start_error != 0)
    fail(file, std::string("gnuplot cannot be started (") + std::strerror(run.start_error) + ")");
  if (run.late) fail(file, "gnuplot took longer than ten minutes and was stopped");
  if (run.signal != 0) fail(file, "gnuplot was stopped by signal " + std::to_string(run.signal));
  if (run.status != 0) fail(file, "gnuplot failed (" + complaint(run.errors) + ")");
  return run.output;
}

// Throws IoError if the end of the picture is missing, since gnuplot does not report every failed
// write.
void require_whole(const std::filesystem::path& file, std::string_view picture,
                   PictureFormat format) {
  constexpr std::size_t tail = 32;
  const std::string_view end = picture.substr(picture.size() - std::min(picture.size(), tail));
  const char* const last = format == PictureFormat::png   ? "IEND"
                           : format == PictureFormat::svg ? "</svg>"
                                                          : "%%EOF";
  if (end.find(last) == std::string_view::npos)
    fail(file, "gnuplot left the picture incomplete; is the memory full?");
}

}  // namespace

void require_plot(const std::filesystem::path& file, const WriteOptions& options) {
  const bool drawn = format_of(file).has_value();
  require_output(file, options);
  if (drawn) require_gnuplot(file);
}

void write_plot(const std::filesystem::path& file, const Figure& figure,
                const WriteOptions& options, std::optional<double> width, bool caption) {
  const std::optional<PictureFormat> format = format_of(file);
  if (format) require_gnuplot(file);
  detail::AtomicFile target(file, options);
  const std::string content =
      format ? run_gnuplot(file, gnuplot_script(figure, *format, width, caption))
             : figure_json(figure);
  if (format) require_whole(file, content, *format);
  target.write(content);
  target.commit();
}

}  // namespace salebra::figures
