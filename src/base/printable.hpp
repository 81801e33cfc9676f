// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace salebra {

/// Text that may hold names of files and what they contain, safe for a terminal: control characters
/// other than newline and tab, and bytes that are not UTF-8, appear as hexadecimal escapes.
/// Everything that is printed for people passes through here.
std::string printable(std::string_view text);

/// The same with newline and tab escaped too, for a text that has to stay within its line: a comment
/// of a file that another program obeys, or a field of a table.
std::string printable_line(std::string_view text);

/// The text, or its beginning and end around "…" where it has more bytes. UTF-8 stays whole.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace salebra
