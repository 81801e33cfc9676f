// SPDX-License-Identifier: GPL-3.0-or-later
// Header of a text with heights: keys of Gwyddion and of instruments, units beside column names.
#include "text_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <utility>
#include <vector>

#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& symbol : result)
    if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
  return result;
}

bool is_digit(char symbol) { return symbol >= '0' && symbol <= '9'; }

/// Of a word; every byte of a letter beyond ASCII.
bool is_letter(char symbol) {
  return (symbol >= 'a' && symbol <= 'z') || (symbol >= 'A' && symbol <= 'Z') ||
         static_cast<unsigned char>(symbol) >= 0x80;
}

bool is_length(std::string_view unit) {
  // "Z in nm" has no inches.
  return !unit.empty() && is_letter(unit.front()) && unit != "in" && metres_in(std::string(unit));
}

/// The length that a header states, where it has a unit: a bare "width = 256" may well count
/// points. A comma is decimal, unless it may separate thousands.
std::optional<double> stated_length(std::string_view text) {
  std::string number(text.substr(0, text.find('/')));  // of "1.1 µm/pixel"
  if (const auto comma = number.find(','); comma != std::string::npos) {
    const auto digits =
        std::find_if_not(number.begin() + std::ptrdiff_t(comma) + 1, number.end(), is_digit) -
        (number.begin() + std::ptrdiff_t(comma) + 1);
    if (digits == 3 || number.find('.') != std::string::npos) return {};
    number[comma] = '.';
  }
  number = trimmed(number);
  double value;
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (status != std::errc{} || end == number.data() + number.size()) return {};
  try {
    return parse_quantity(number, Dimension::length, "length");
  } catch (const InvalidInput&) {
    return {};
  }
}

std::optional<Index> stated_count(std::string_view text) {
  Index count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status != std::errc{} || end != text.data() + text.size()) return {};
  return count;
}

/// The rest of a name without the first of these words that it holds; nothing where it holds none.
std::optional<std::string> without(std::string name, std::initializer_list<const char*> words) {
  for (const std::string_view word : words)
    if (const auto at = name.find(word); at != std::string::npos)
      return name.erase(at, word.size());
  return {};
}

enum class Axes { none, x, y, plane, z, all };

/// The axes that a word names.
Axes axes_of(std::string_view word) {
  constexpr std::pair<std::string_view, Axes> words[]{{"x", Axes::x},
                                                      {"y", Axes::y},
                                                      {"xy", Axes::plane},
                                                      {"lateral", Axes::plane},
                                                      {"horizontal", Axes::plane},
                                                      {"z", Axes::z},
                                                      {"height", Axes::z},
                                                      {"heights", Axes::z},
                                                      {"h\u00f6he", Axes::z},
                                                      {"h\u00f6hen", Axes::z},
                                                      {"hoehe", Axes::z},
                                                      {"value", Axes::z},
                                                      {"values", Axes::z},
                                                      {"data", Axes::z},
                                                      {"wert", Axes::z},
                                                      {"werte", Axes::z},
                                                      {"topography", Axes::z},
                                                      {"topographie", Axes::z},
                                                      {"vertical", Axes::z},
                                                      {"vertikal", Axes::z},
                                                      {"", Axes::all}};
  const auto found = std::ranges::find(words, word, &std::pair<std::string_view, Axes>::first);
  return found == std::end(words) ? Axes::none : found->second;
}

void set_unit(TextHeader& header, Axes axes, const std::string& unit) {
  const bool all = axes == Axes::all, plane = all || axes == Axes::plane;
  if (plane || axes == Axes::x) header.x_unit = unit;
  if (plane || axes == Axes::y) header.y_unit = unit;
  if (all || axes == Axes::z) header.value_unit = unit;
}

void read_height_factor(const std::filesystem::path& file, std::string_view key,
                        std::string_view value, TextHeader& header) {
  double factor;
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), factor);
  if (status != std::errc{} || end != value.data() + value.size() || !std::isfinite(factor) ||
      factor == 0)
    refuse(file, "has the height conversion factor '" + std::string(value) + "'; correct it");
  const auto arrow = key.find("-> "), close = key.find(')');
  if (arrow == std::string::npos || close == std::string::npos || close < arrow + 3)
    refuse(file, "does not say what its height conversion factor converts to; write '(-> m)'");
  header.height_factor =
      factor * metres_per(file, std::string(trimmed(key.substr(arrow + 3, close - arrow - 3))));
}

/// The unit in brackets at the end of a key, "Pixel size [µm]", which loses it; or empty.
std::string unit_of(std::string_view& key) {
  const auto open = key.find_first_of("[(");
  if (open == std::string_view::npos || (!key.ends_with(']') && !key.ends_with(')'))) return "";
  const std::string_view unit = trimmed(key.substr(open + 1, key.size() - open - 2));
  if (!is_length(unit)) return "";
  key = trimmed(key.substr(0, open));
  return std::string(unit);
}

/// Whether something of the entry was used.
bool read_unit(Axes axes, std::string_view value, TextHeader& header) {
  std::string unit(value);
  if (unit.size() > 2 && unit.front() == '[' && unit.back() == ']')
    unit = trimmed(unit.substr(1, unit.size() - 2));
  // A unit of an axis that is no length is refused where the axis is scaled.
  if (axes == Axes::none || (axes == Axes::all && !is_length(unit))) return false;
  set_unit(header, axes, unit);
  return true;
}

bool read_entry(const std::filesystem::path& file, std::string_view key, std::string_view value,
                TextHeader& header) {
  key = trimmed(key);
  value = trimmed(value);
  const std::string unit_of_key = unit_of(key);
  const std::string name = lower(key);
  const auto length = [&](auto... targets) {
    const std::optional<double> stated = stated_length(std::string(value) + unit_of_key);
    if (stated) ((*targets = stated), ...);
    return stated.has_value();
  };
  const auto count = [&](std::optional<Index>& target) {
    target = stated_count(value);
    return target.has_value();
  };
  if (name == "width" || name == "breite") return length(&header.width);
  if (name == "height" || name == "h\u00f6he") return length(&header.height);
  if (name == "w") return count(header.columns);
  if (name == "h") return count(header.rows);
  if (name == "points") return count(header.points);
  if (name.starts_with("height conversion factor")) {
    read_height_factor(file, key, value, header);
    return true;
  }
  std::string letters;
  std::ranges::copy_if(name, std::back_inserter(letters), is_letter);
  if (const auto rest = without(letters, {"units", "unit", "einheiten", "einheit"}))
    return read_unit(axes_of(*rest), value, header);
  if (const auto of_pixel = without(letters, {"pixel"})) {
    const auto rest = without(
        *of_pixel, {"size", "gr\u00f6\u00dfe", "groesse", "spacing", "abstand", "pitch", "weite"});
    const Axes axes = rest ? axes_of(*rest) : Axes::none;
    if (axes == Axes::all || axes == Axes::plane) return length(&header.pixel_x, &header.pixel_y);
    if (axes == Axes::x) return length(&header.pixel_x);
    if (axes == Axes::y) return length(&header.pixel_y);
    return false;
  }
  if (const auto rest = without(letters, {"size", "gr\u00f6\u00dfe", "groesse", "length",
                                          "l\u00e4nge", "laenge", "range"})) {
    const Axes axes = axes_of(*rest);
    if (axes == Axes::x) return length(&header.width);
    if (axes == Axes::y) return length(&header.height);
  }
  return false;
}

/// "Key: value", "key=value", several "key=value" separated by blanks, or "Key;value".
bool read_entries(const std::filesystem::path& file, std::string_view text, TextHeader& header) {
  auto separator = text.find_first_of(":=");
  if (separator == std::string_view::npos) {
    separator = text.find_first_of(";\t");
    if (separator == std::string_view::npos ||
        trimmed(text.substr(separator + 1)).find_first_of(";\t") != std::string_view::npos)
      return false;
  }
  const auto second = text.find('=', separator + 1);
  if (text[separator] != '=' || second == std::string_view::npos)
    return read_entry(file, text.substr(0, separator), text.substr(separator + 1), header);
  bool used = false;
  while (!text.empty()) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    if (const auto equals = word.find('='); equals != std::string_view::npos)
      used = read_entry(file, word.substr(0, equals), word.substr(equals + 1), header) || used;
  }
  return used;
}

/// A piece of a line: a word, a word or a unit in brackets, a word after a slash or underscore, or
/// a separator of columns.
struct Piece {
  enum class Kind { word, bracket, slash, separator } kind;
  std::string_view text;
  std::string_view behind = {};  ///< it, of a word
};

std::vector<Piece> pieces_of(std::string_view line) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < line.size();) {
    const char symbol = line[i];
    const auto closing = symbol == '[' ? ']' : symbol == '(' ? ')' : '\0';
    const auto close = closing ? line.find(closing, i) : std::string_view::npos;
    if (close != std::string_view::npos) {
      std::string_view inner = trimmed(line.substr(i + 1, close - i - 1));
      if (inner.starts_with("in ")) inner = trimmed(inner.substr(3));
      pieces.push_back({Piece::Kind::bracket, inner});
      i = close + 1;
    } else if (is_letter(symbol) || is_digit(symbol)) {
      std::size_t end = i;
      while (end < line.size() && (is_letter(line[end]) || is_digit(line[end]))) ++end;
      const bool behind = i > 0 && (line[i - 1] == '/' || line[i - 1] == '_');
      pieces.push_back({behind ? Piece::Kind::slash : Piece::Kind::word, line.substr(i, end - i),
                        line.substr(end)});
      i = end;
    } else {
      if (symbol == '\t' || symbol == ',' || symbol == ';')
        pieces.push_back({Piece::Kind::separator, line.substr(i, 1)});
      ++i;
    }
  }
  return pieces;
}

/// "X [µm]  Y [µm]  Z [nm]", or a line of units alone for x, y and z or for z. Whether it was one.
bool read_column_units(const std::vector<Piece>& pieces, TextHeader& header) {
  bool used = false;
  Axes axis = Axes::none;
  bool beside = false;  // nothing but "in" has come since its name
  std::vector<std::string> units;
  bool units_alone = true;
  for (const auto& [kind, text, behind] : pieces) {
    if (kind == Piece::Kind::separator) {
      axis = Axes::none;
      continue;
    }
    const bool unit = is_length(text);
    if (unit) units.emplace_back(text);
    units_alone = units_alone && unit;
    const Axes named = axes_of(lower(text));
    if (unit && axis != Axes::none && (beside || kind == Piece::Kind::bracket)) {
      set_unit(header, axis, std::string(text));
      used = true;
      axis = Axes::none;
    } else if (kind != Piece::Kind::bracket && named != Axes::none && named != Axes::plane) {
      axis = named;
      beside = true;
    } else if (lower(text) != "in") {
      beside = false;
    }
  }
  if (!units_alone || used || (units.size() != 1 && units.size() != 3)) return used;
  if (units.size() == 3) {
    header.x_unit = units[0];
    header.y_unit = units[1];
  }
  header.value_unit = units.back();
  return true;
}

/// Whether the pieces name a length: a unit behind a number, in brackets or unmistakable alone.
bool name_length(const std::vector<Piece>& pieces, bool in_bracket = false) {
  bool behind_number = false;
  for (const auto& [kind, text, behind] : pieces) {
    if (kind == Piece::Kind::bracket && !in_bracket && name_length(pieces_of(text), true))
      return true;
    const auto letters = text.substr(std::min(text.find_first_not_of("0123456789"), text.size()));
    const bool number = letters.empty() && !text.empty();
    // "um" is a German word, "m" stands for much, "pm" for a time.
    const bool alone = letters.size() > 1 && letters != "um";
    const bool rate = behind.starts_with("/s") || behind.starts_with("/min");
    if (is_length(letters) && letters != "pm" && !rate &&
        (behind_number || letters.size() < text.size() || kind == Piece::Kind::bracket || alone))
      return true;
    behind_number = number;
  }
  return false;
}

}  // namespace

std::string TextHeader::remark() const {
  if (unused == 0) return "";
  constexpr std::size_t most_quoted = 60;
  std::string text = unused_line;
  if (text.size() > most_quoted) {
    std::size_t end = most_quoted;
    while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not within a letter
    text = text.substr(0, end) + "\u2026";
  }
  const std::string are = unused == 1
                              ? " names a length and is"
                              : fmt::format(" and {} more name lengths and are", unused - 1);
  return fmt::format(
      "line {}, '{}',{} not used; `size_x`, `size_y` and `height_unit` take what it says",
      first_unused, text, are);
}

void read_header_line(const std::filesystem::path& file, std::string_view line, int number,
                      TextHeader& header) {
  const std::string decoded = utf8(line);
  std::string_view text = trimmed(decoded);
  while (!text.empty() && (text.front() == '#' || text.front() == '%')) text.remove_prefix(1);
  text = trimmed(text);
  if (read_entries(file, text, header)) return;
  // A longer line is no title of columns.
  constexpr std::size_t most_looked_at = 1000;
  const std::vector<Piece> pieces = pieces_of(text.substr(0, most_looked_at));
  if (read_column_units(pieces, header)) return;
  if (!name_length(pieces) || header.unused++ > 0) return;
  header.first_unused = number;
  header.unused_line = text;
}

}  // namespace salebra::detail
