// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra::cli {

/// What a word on a terminal stands out as. Red and magenta are legible on dark and on light
/// ground, which yellow and blue are not.
enum class Emphasis { error, warning, heading };

/// Whether text on this file descriptor may be coloured: a terminal that knows how, and no NO_COLOR
/// in the environment (https://no-color.org).
bool in_colour(int descriptor);

/// The text in the colour of its kind where the descriptor may have colours; elsewhere as it is.
std::string emphasised(std::string_view text, Emphasis emphasis, int descriptor);

/// Columns of standard output: COLUMNS of the environment, the width of the terminal, or 80; at
/// least 40.
std::size_t text_width();

/// The text with no line beyond the width: what does not fit goes on below the place where a line's
/// description begins, and command
/// lines, "  salebra …", with a backslash.
std::string wrapped(std::string_view text, std::size_t width);

/// Characters, not bytes: "µ" takes two bytes and one column.
std::size_t columns_of(std::string_view text);

/// The name by which messages call this program: salebra, unless it was given another.
void name_program(std::string_view name);
std::string_view program_name();

/// Prints an answer on standard output. Throws IoError where it does not arrive there.
void print_answer(std::string_view text);

/// Prints a warning on standard error. Where that fails there is nowhere to say so, and the work
/// goes on.
void print_to_stderr(std::string_view text) noexcept;

}  // namespace salebra::cli
