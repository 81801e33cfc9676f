// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace salebra {

/// Makes text that may contain file names and the contents of files safe for a terminal: control
/// characters other than newline and tab, and bytes that are not UTF-8, become hexadecimal escapes.
/// Every text shown to people must pass through this function.
std::string printable(std::string_view text);

/// Like printable(), but escapes newline and tab too, for text that must stay within its line: a
/// comment in a file that another program executes, or a field of a table.
std::string printable_line(std::string_view text);

/// The text, or its beginning and end around "…" if it exceeds `most` bytes. UTF-8 characters stay
/// whole.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace salebra
