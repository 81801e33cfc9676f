// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a report page to PDF by headless Chromium; the file appears complete or not at all.
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <salebra/base/error.hpp>
#include <salebra/report/report.hpp>
#include <string>
#include <vector>

#include "io/child_program.hpp"
#include "io/text_file.hpp"

namespace salebra {
namespace {

/// A folder beside a file, removed with the object. It is not in the folder for temporary files,
/// which a Chromium from a snap cannot read.
class Scratch {
 public:
  explicit Scratch(const std::filesystem::path& file) : path_(file.string() + ".XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr)
      throw IoError(path_ + ": cannot be created (" + std::strerror(errno) + ")");
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const char* name) const {
    return std::filesystem::absolute(path_) / name;
  }

 private:
  std::string path_;
};

/// Name of the installed browser; empty if there is none.
std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (!detail::found_on_path(name).empty()) return name;
  return "";
}

/// The address of a local file: names may contain characters that have a meaning in addresses.
std::string address_of(const std::filesystem::path& file) {
  std::string address = "file://";
  for (const char letter : file.string()) {
    const auto byte = static_cast<unsigned char>(letter);
    constexpr std::string_view digits = "0123456789ABCDEF";
    if (std::isalnum(byte) || std::strchr("/._-", letter) != nullptr) {
      address += letter;
    } else {
      address += '%';
      address += digits[byte >> 4];
      address += digits[byte & 15];
    }
  }
  return address;
}

}  // namespace

void require_report_pdf(const std::filesystem::path& pdf, const WriteOptions& options) {
  require_report(pdf, options);
  if (browser().empty())
    throw InvalidInput(pdf.string(),
                       "needs Chromium, and PATH has no chromium, chromium-browser or "
                       "google-chrome; install one of them (Debian package chromium), or print the "
                       "HTML page from another browser");
}

void write_report_pdf(const std::filesystem::path& results, const std::filesystem::path& pdf,
                      const ReportOptions& options) {
  require_report_pdf(pdf, options.write);
  const Scratch scratch(pdf);
  ReportOptions of_page = options;
  of_page.write = {};
  write_report(results, scratch / "page.html", of_page);
  std::vector<std::string> words{browser(),
                                 "--headless",
                                 "--disable-gpu",
                                 "--disable-dev-shm-usage",
                                 "--no-first-run",
                                 "--no-pdf-header-footer",
                                 "--virtual-time-budget=10000",
                                 "--user-data-dir=" + (scratch / "profile").string(),
                                 "--print-to-pdf=" + (scratch / "page.pdf").string(),
                                 address_of(scratch / "page.html")};
  // Chromium refuses to run for the administrator with its sandbox, as in a container.
  if (geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");
  const detail::ChildRun run = detail::run_child(
      words, "", {.time = std::chrono::seconds(120), .memory = ~std::uint64_t{0}});
  std::ifstream file(scratch / "page.pdf", std::ios::binary);
  const std::string printed{std::istreambuf_iterator<char>(file), {}};
  if (!printed.starts_with("%PDF") ||
      printed.find("%%EOF", printed.size() - std::min<std::size_t>(printed.size(), 32)) ==
          printed.npos) {
    const std::string reason = run.start_error != 0 ? std::strerror(run.start_error)
                               : run.late
                                   ? "it took longer than two minutes"
                                   : run.errors.substr(0, run.errors.find('\n')).substr(0, 200);
    throw IoError(pdf.string() + ": " + words.front() + " did not print the page (" + reason +
                  "); no file was written");
  }
  write_text_file(pdf, printed, options.write);
}

}  // namespace salebra
