// SPDX-License-Identifier: GPL-3.0-or-later
// Colour on terminals.
#include "terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/error.hpp>

namespace salebra::cli {
namespace {

std::string name_of_program = "salebra";

}  // namespace

void name_program(std::string_view name) { name_of_program = name; }

std::string_view program_name() { return name_of_program; }

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

std::size_t columns_of(std::string_view text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::size_t text_width() {
  constexpr std::size_t usual = 80, least = 40;
  std::size_t width = 0;
  if (const char* given = std::getenv("COLUMNS"))
    width = std::size_t(std::max(0L, std::strtol(given, nullptr, 10)));
  winsize window{};
  if (width == 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0) width = window.ws_col;
  return width == 0 ? usual : std::max(width, least);
}

namespace {

/// Column at which the continued lines of a paragraph begin: that of the description, which follows
/// two blanks; without a description, that of the first word.
std::size_t hanging_indent(std::string_view line, std::size_t width) {
  const std::size_t first = line.find_first_not_of(' ');
  if (line.substr(first).starts_with("salebra ")) return first + 4;
  const std::size_t gap = line.find("  ", first);
  const std::size_t column =
      gap == std::string_view::npos ? first : line.find_first_not_of(' ', gap);
  return column == std::string_view::npos || column > width / 2 ? first : column;
}

std::string wrapped_line(std::string_view line, std::size_t width) {
  const std::size_t indent = hanging_indent(line, width);
  const bool command = line.substr(line.find_first_not_of(' ')).starts_with("salebra ");
  const std::size_t line_width = command ? width - 2 : width;
  std::string text, current(line.substr(0, indent));
  bool empty = true;
  std::size_t begin = indent;
  if (command || columns_of(current) < indent) current.clear();
  if (command) begin = 0;
  while (begin < line.size()) {
    const std::size_t start = line.find_first_not_of(' ', begin);
    if (start == std::string_view::npos) break;
    const std::size_t end = std::min(line.find(' ', start), line.size());
    const std::string blanks(empty ? start - begin : 1, ' ');
    const std::string_view word = line.substr(start, end - start);
    if (!empty && columns_of(current) + 1 + columns_of(word) > line_width) {
      text += current + (command ? " \\\n" : "\n");
      current = std::string(indent, ' ') + std::string(word);
    } else {
      current += blanks + std::string(word);
    }
    empty = false;
    begin = end;
  }
  return text + current;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    result += columns_of(line) <= width ? std::string(line) : wrapped_line(line, width);
    if (end < text.size()) result += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

void print_answer(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
    return;
  // A reader of the output, such as `head`, may close the pipe early; that is no error.
  if (errno != EPIPE)
    throw IoError(
        "standard output: cannot be written; check the disk or the program that reads the pipe");
}

void print_to_stderr(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace salebra::cli
