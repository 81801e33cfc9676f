// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// What read_surface() and write_surface() do with a format of surface files. The texts are the
/// columns of the table in docs/formats.md.
struct SurfaceFormat {
  std::string_view title;
  /// With the dot; write_surface() chooses the format by them.
  std::vector<std::string_view> extensions;
  std::string_view read;     ///< describes what is read; empty: not read
  std::string_view written;  ///< describes what is written; empty: not written
  /// Whether heights, size and so on survive writing and reading; empty if the format is not
  /// written.
  std::string_view heights, size, undefined_points, periodic, provenance;
};

/// All formats, as the table of docs/formats.md lists them.
std::vector<SurfaceFormat> surface_formats();

/// The first extension of each format that can be read, or written, as in ".h5 .npy …"; for help
/// and messages.
std::string read_extensions();
std::string written_extensions();

}  // namespace salebra
