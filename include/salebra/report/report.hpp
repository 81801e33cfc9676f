// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <string>
#include <vector>

namespace salebra {

struct ReportOptions {
  WriteOptions write = {};
  std::string title = {};  ///< title of the report; empty: origin of the surface
  /// Result files of the command `oscillate` for the same surface and motion, to be shown as direct
  /// results in the figures of damping.
  std::vector<std::filesystem::path> direct = {};
};

/// Returns true if this build includes plotly.js, which reports need.
bool can_report();

/// Checks that a report can be written, before a long computation: throws IoError if can_report()
/// is false, and InvalidInput wherever require_output does.
void require_report(const std::filesystem::path& html, const WriteOptions& options = {});

/// Writes one HTML file from the results of `study` or `compare`:
///     write_report("study.h5", "study.html");
/// It shows conclusion and warnings first, then the surface, force over mean gap with the fit and
/// its residuals, all models, damping with bands, settings and provenance; every figure includes
/// its numbers as a table and as CSV. The HTML file loads nothing from elsewhere: it contains
/// plotly.js, the data and the maps (at most 256 × 256 points in total), less than 3 MB. If an older
/// results file lacks some data, the report says so. The HTML file appears complete or not at all.
/// throws  InvalidInput for a file that is missing, damaged or contains no study, for direct
///         results of another normal amplitude, for direct results together with several points of
///         a parameter grid, and wherever require_report does
/// cost    reading the data of the report; about 0.1 s
void write_report(const std::filesystem::path& results, const std::filesystem::path& html,
                  const ReportOptions& options = {});

/// Checks that a report can be printed, before a long computation: throws wherever require_report()
/// does, and InvalidInput if the folders of PATH have neither chromium, chromium-browser nor
/// google-chrome.
void require_report_pdf(const std::filesystem::path& pdf, const WriteOptions& options = {});

/// Writes the page of write_report() as PDF, printed by headless Chromium:
///     write_report_pdf("study.h5", "study.pdf");
/// The file appears complete or not at all; a folder beside it, removed at the end, holds the page
/// meanwhile.
/// throws  wherever write_report() and require_report_pdf() do, and IoError if Chromium does not
///         print the page within two minutes
/// cost    a few seconds
void write_report_pdf(const std::filesystem::path& results, const std::filesystem::path& pdf,
                      const ReportOptions& options = {});

}  // namespace salebra
