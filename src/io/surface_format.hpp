// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string_view>
#include <vector>

#include "loaded_surface.hpp"
#include "surface_formats.hpp"

namespace salebra::detail {

/// An entry of the table of surface formats. Readers and writers are chosen by this table. The
/// help, the documentation and the fuzz tests list its formats.
struct SurfaceFormatEntry {
  using Read = LoadedSurface(const std::filesystem::path& file, std::string_view content,
                             const std::string& channel);
  using Write = void(const std::filesystem::path& file, const Surface& surface,
                     const Provenance& provenance, const WriteOptions& options);

  std::string_view keyword;  ///< name of the folder in tests/fuzz/corpus for this format
  /// Possible first bytes of a file; none: any content is accepted.
  std::vector<std::string_view> heads;
  Read* read;    ///< null for HDF5, and if another entry reads this format
  Write* write;  ///< null: the format is not written
  SurfaceFormat facts;
};

/// All entries. Formats with heads come before text, which accepts any content.
const std::vector<SurfaceFormatEntry>& surface_format_table();

}  // namespace salebra::detail
