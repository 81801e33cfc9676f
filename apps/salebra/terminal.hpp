// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra::cli {

/// What a word on a terminal stands out as. Red and magenta are legible on dark and on light ground, which yellow and blue are not.
enum class Emphasis { error, warning, heading };

/// Whether text on this file descriptor may be coloured: a terminal that knows how, and no NO_COLOR in the environment
/// (https://no-color.org).
bool in_colour(int descriptor);

/// The text in the colour of its kind where the descriptor may have colours; elsewhere as it is.
std::string emphasised(std::string_view text, Emphasis emphasis, int descriptor);

}  // namespace salebra::cli
