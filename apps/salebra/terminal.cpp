// SPDX-License-Identifier: GPL-3.0-or-later
// Colour on terminals.
#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

namespace salebra::cli {

bool in_colour(int descriptor) {
  const char* unwanted = std::getenv("NO_COLOR");
  if (unwanted && *unwanted) return false;
  const char* terminal = std::getenv("TERM");
  return isatty(descriptor) != 0 && terminal && std::string_view(terminal) != "dumb";
}

std::string emphasised(std::string_view text, Emphasis emphasis, int descriptor) {
  if (!in_colour(descriptor)) return std::string(text);
  const char* code = emphasis == Emphasis::error     ? "1;31"
                     : emphasis == Emphasis::warning ? "1;35"
                                                     : "1";
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

}  // namespace salebra::cli
