// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/io/output.hpp>
#include <string_view>

namespace salebra {

/// Writes a text, such as a table or a JSON document, to a file. Throws as require_output() does,
/// and IoError if a system call fails.
void write_text_file(const std::filesystem::path& file, std::string_view text,
                     const WriteOptions& options = {});

}  // namespace salebra
