// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace salebra {

/// How a file is put in its place. Every writer works on a temporary file in the same folder, which
/// takes the name only when it is complete and on the disk; whatever fails before leaves the folder
/// as it was.
struct WriteOptions {
  bool overwrite = false;  ///< replace an existing file
};

/// Numbers of a field in a file.
enum class FieldType { float64, float32 };

/// Callers that compute for long before they write ask here first. Throws InvalidInput if the
/// folder does not exist, the name is too long or a link to nothing, the file exists (unless
/// overwrite) or is not a regular file; IoError if the folder is not writable or has no room.
void require_output(const std::filesystem::path& file, const WriteOptions& options = {});

}  // namespace salebra
