// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace salebra::detail {

/// Whether plain_content() would unwrap the content, as its first bytes show.
bool is_wrapped(std::string_view content);

/// Unwraps the content of a file: unpacks gzip with one or several members, or converts UTF-16 text
/// with a byte order mark to UTF-8. Returns nothing for content that is not wrapped. Throws
/// InvalidInput for gzip that is damaged or truncated; for gzip that unpacks to more than 64 times
/// the file and 256 MB, or to more than 8 heights for each byte of the file and 8 million; and for
/// UTF-16 that is truncated or has an unpaired surrogate. Cost: one pass; memory: that of the
/// result.
std::optional<std::string> plain_content(const std::filesystem::path& file,
                                         std::string_view content);

}  // namespace salebra::detail
