// SPDX-License-Identifier: GPL-3.0-or-later
// Colour on terminals.
#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/error.hpp>

namespace salebra::cli {
namespace {

/// Bytes of the UTF-8 character that the text begins with; 0 where it begins with none, or with a control character.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return lead >= ' ' && lead != 0x7f;
  const std::size_t length = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (length == 0 || length > text.size()) return 0;
  const auto continues = [](char byte) { return (byte & 0xc0) == 0x80; };
  if (!std::ranges::all_of(text.substr(1, length - 1), continues)) return 0;
  const bool control = lead == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;
  return control ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const bool layout = text.front() == '\n' || text.front() == '\t';
    const std::size_t length = layout ? 1 : character_length(text);
    if (length > 0)
      result += text.substr(0, length);
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

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
