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

/// A row of the table of formats, from which reader and writer are chosen, and which help, docs and
/// fuzzers list.
struct SurfaceFormatEntry {
  using Read = LoadedSurface(const std::filesystem::path& file, std::string_view content,
                             const std::string& channel);
  using Write = void(const std::filesystem::path& file, const Surface& surface,
                     const Provenance& provenance, const WriteOptions& options);

  std::string_view keyword;             ///< its folder in tests/fuzz/corpus
  std::vector<std::string_view> heads;  ///< first bytes, one of these; none: told by no bytes
  Read* read;                           ///< null: not by its content (HDF5), or by another row
  Write* write;                         ///< null: not written
  SurfaceFormat facts;
};

/// Formats with heads come before text, which is what no other format claims.
const std::vector<SurfaceFormatEntry>& surface_format_table();

}  // namespace salebra::detail
