// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <string>
#include <vector>

namespace salebra {

struct ReportOptions {
  WriteOptions write = {};
  std::string title = {};  ///< empty: from where the surface came
  /// What `oscillate` wrote of the same surface and motion: direct results to be drawn beside the
  /// damping curves.
  std::vector<std::filesystem::path> direct = {};
};

/// Whether this build carries plotly.js, without which no report can be drawn.
bool can_report();

/// Throws what write_report would throw before it looks at the results, for callers that compute
/// for long before: IoError where can_report() is false; InvalidInput as require_output.
void require_report(const std::filesystem::path& html, const WriteOptions& options = {});

/// Makes one HTML file of what `study` or `compare` wrote: conclusion and warnings first, then the
/// surface, force over mean gap with the fit and its residuals, the models side by side, damping
/// with bands, settings and provenance; every figure with its numbers as a table and as CSV. The
/// file loads nothing: plotly.js, data and maps (at most 512 × 512 points in all) are in it, a few
/// MB. What an older results file does not hold is named as absent. The file appears complete or
/// not at all.
/// throws  InvalidInput for a file that is not there, damaged or contains no study, for direct
///         results of another normal amplitude or beside several points of a parameter grid, and as
///         require_report
/// cost    reading what the report shows; some 0.1 s
void write_report(const std::filesystem::path& results, const std::filesystem::path& html,
                  const ReportOptions& options = {});

}  // namespace salebra
