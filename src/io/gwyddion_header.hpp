// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

/// What Gwyddion's simple formats GSF and GXYZF share: a line that names the format, lines "Key =
/// value", and NUL bytes up to a multiple of `alignment`, at least one, before the data.
namespace salebra::detail {

using HeaderEntry = std::function<void(std::string_view key, std::string_view value)>;

/// Calls `entry` for each line and returns where the data begin. Throws InvalidInput if the header
/// does not end.
std::size_t read_gwyddion_header(const std::filesystem::path& file, std::string_view content,
                                 std::size_t alignment, const HeaderEntry& entry);

/// The value of an entry that must be a number > 0.
template <class Number>
Number positive_entry(const std::filesystem::path& file, std::string_view key,
                      std::string_view value);

}  // namespace salebra::detail
