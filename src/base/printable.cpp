// SPDX-License-Identifier: GPL-3.0-or-later
// Escapes control characters that a terminal would obey.
#include "printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace salebra {
namespace {

/// Number of bytes of the UTF-8 character at the start of the text; 0 for a control character or an
/// invalid one.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return lead >= ' ' && lead != 0x7f;
  const std::size_t length = lead < 0xc2   ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  const auto continues = [](char byte) { return (byte & 0xc0) == 0x80; };
  if (!std::ranges::all_of(text.substr(1, length - 1), continues)) return 0;
  const bool control = lead == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;
  return control ? 0 : length;
}

std::string escaped(std::string_view text, std::string_view kept) {
  std::string result;
  while (!text.empty()) {
    const bool layout = kept.find(text.front()) != std::string_view::npos;
    const std::size_t length = layout ? 1 : character_length(text);
    if (length > 0)
      result += text.substr(0, length);
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return escaped(text, "\n\t"); }

std::string printable_line(std::string_view text) { return escaped(text, ""); }

std::string shortened(std::string_view text, std::size_t most) {
  constexpr std::string_view gap = "\u2026";
  if (text.size() <= most) return std::string(text);
  const std::size_t kept = most - std::min(most, gap.size());
  // The two places where the text is cut move outwards to the boundary of a character.
  const auto inside = [&](std::size_t at) { return (text[at] & 0xc0) == 0x80; };
  std::size_t end = kept - kept / 3, begin = text.size() - kept / 3;
  while (end > 0 && inside(end)) --end;
  while (begin < text.size() && inside(begin)) ++begin;
  return std::string(text.substr(0, end)) + std::string(gap) + std::string(text.substr(begin));
}

}  // namespace salebra
