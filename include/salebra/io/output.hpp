// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace salebra {

/// Options for writing a file. Every writer uses a temporary file in the same folder and renames it
/// only when it is complete and on disk; a failure before that leaves the folder unchanged.
struct WriteOptions {
  bool overwrite = false;  ///< true: replaces an existing file
};

/// Number type of a field in a file.
enum class FieldType { float64, float32 };

/// Checks that a file can be written, before a long computation:
///     require_output("result.h5", {.overwrite = true});
/// Throws InvalidInput if the folder does not exist, the name is too long or a broken link, the
/// file exists (unless `overwrite` is set) or is not a regular file; IoError if the folder is not
/// writable or full.
void require_output(const std::filesystem::path& file, const WriteOptions& options = {});

}  // namespace salebra
