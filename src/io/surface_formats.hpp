// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// A format of surface files: what read_surface and write_surface do with it. The texts are the
/// columns of the table in docs/formats.md.
struct SurfaceFormat {
  std::string_view title;
  std::vector<std::string_view> extensions;  ///< by which write_surface chooses it, with the point
  std::string_view read;                     ///< what is read of it; empty: nothing
  std::string_view written;  ///< what is written; empty: nothing, and nothing is kept
  /// What reading gives back of what was written.
  std::string_view heights, size, undefined_points, periodic, provenance;
};

/// All formats, as the table of docs/formats.md lists them.
std::vector<SurfaceFormat> surface_formats();

/// ".h5 .npy …": the first extension of each format that is read, or written, for help and messages.
std::string read_extensions();
std::string written_extensions();

}  // namespace salebra
