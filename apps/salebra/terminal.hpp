// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra::cli {

/// Colour of a word on a terminal. Red and magenta are legible on dark and on light backgrounds;
/// yellow and blue are not.
enum class Emphasis { error, warning, heading };

/// Whether text on this file descriptor may be coloured: it must be a terminal with colours, and
/// NO_COLOR must not be in the environment (https://no-color.org).
bool in_colour(int descriptor);

/// The text in the colour of `emphasis` if the descriptor may have colours; otherwise unchanged.
std::string emphasised(std::string_view text, Emphasis emphasis, int descriptor);

/// Width of standard output in columns: the environment variable COLUMNS, the width of the
/// terminal, or 80; at least 40.
std::size_t text_width();

/// Wraps the text at this width. A continued line is indented to the description in its line.
/// Command lines, which begin with "  salebra ", are continued with a backslash.
std::string wrapped(std::string_view text, std::size_t width);

/// Number of characters, each of which takes one column; "µ" has two bytes and takes one column.
std::size_t columns_of(std::string_view text);

/// The name of this program in messages; default salebra.
void name_program(std::string_view name);
std::string_view program_name();

/// Prints an answer on standard output. Throws IoError if that fails.
void print_answer(std::string_view text);

/// Prints a note on standard error. A failure is ignored, because there is nowhere to report it.
void print_to_stderr(std::string_view text) noexcept;

}  // namespace salebra::cli
