// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace salebra::detail {

/// Whether plain_content() has anything to do, by the first bytes.
bool is_wrapped(std::string_view content);

/// The content without what is wrapped around it, whatever its format: gzip, whose members follow
/// each other, and UTF-16 text with a byte order mark, which becomes UTF-8. Nothing for content that
/// is not wrapped.
/// Throws InvalidInput where the gzip is damaged or cut, or unpacks to more than 64 times the file
/// and 256 MB, or to more than 8 heights for each byte of the file and 8 million, and for UTF-16 that is cut or not paired. Cost: one pass; memory: what comes out.
std::optional<std::string> plain_content(const std::filesystem::path& file,
                                         std::string_view content);

}  // namespace salebra::detail
