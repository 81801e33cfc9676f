// SPDX-License-Identifier: GPL-3.0-or-later
// Colour on terminals.
#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <salebra/base/error.hpp>

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

void print_answer(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw IoError("standard output: cannot be written; check the disk or the reader of the pipe");
}

void print_remark(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace salebra::cli
