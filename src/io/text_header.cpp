// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of the lines around the numbers of a text: keys with values, titles of columns, units.
#include "text_header.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <span>
#include <utility>

#include "header_tokens.hpp"
#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {
namespace {

using Kind = HeaderToken::Kind;
using Tokens = std::span<const HeaderToken>;

bool is_unit(const HeaderToken& token) {
  return token.kind == Kind::length || token.kind == Kind::other || token.kind == Kind::ratio;
}

bool has(Tokens tokens, Kind kind) {
  return std::ranges::find(tokens, kind, &HeaderToken::kind) != tokens.end();
}

/// Whether a word is a unit of length wherever it stands. Excluded are "um", which is also a German
/// word, "m", which has many meanings, "pm" and "am", which follow times, and "in".
bool is_plain_unit(const HeaderToken& token) {
  const std::string word = plain_word(token.text);
  return token.kind == Kind::word && token.text.size() > 1 && word != "um" && word != "pm" &&
         word != "am" && word != "in" && is_length_unit(token.text);
}

bool names_length(Tokens tokens) {
  return std::ranges::any_of(tokens, [](const HeaderToken& token) {
    return token.kind == Kind::length || token.kind == Kind::ratio || is_plain_unit(token);
  });
}

Meaning meaning_of(Tokens tokens) {
  Meaning meaning = 0;
  for (const HeaderToken& token : tokens)
    if (token.kind == Kind::word) meaning |= detail::meaning_of(token.text);
  return meaning;
}

struct WrittenNumber {
  double value;
  double half_digit;
};

/// Parses a number of a header. Nothing if its points or commas can be read in two ways: three
/// digits after a mark may be thousands, unless the numbers of the file show which mark is decimal.
std::optional<WrittenNumber> parsed(std::string text, const NumberLayout& layout) {
  std::erase(text, '\'');
  const auto comma = text.find(','), point = text.find('.');
  if (comma != text.npos && point != text.npos) {
    const char decimal = text.rfind(',') > text.rfind('.') ? ',' : '.';
    if (decimal == ',' ? layout.decimal_points : layout.decimal_commas) return {};
    std::erase(text, decimal == ',' ? '.' : ',');
  } else if (comma != text.npos || point != text.npos) {
    const char mark = comma != text.npos ? ',' : '.';
    const auto at = std::min(comma, point);
    if (text.find(mark, at + 1) != text.npos) return {};
    std::size_t digits = 0;
    while (at + 1 + digits < text.size() && text[at + 1 + digits] >= '0' &&
           text[at + 1 + digits] <= '9')
      ++digits;
    const auto first = text.find_first_of("0123456789");
    const bool thousands =
        digits == 3 && at + 4 == text.size() && at > first && at - first <= 3 && text[first] != '0';
    const bool known = mark == ',' ? layout.decimal_commas : layout.decimal_points;
    const bool refuted =
        mark == ',' ? layout.decimal_points || layout.comma_separates : layout.decimal_commas;
    // If the numbers of the file have decimal commas, its header may still have decimal points, but
    // not the reverse.
    if (!known && (refuted ? mark == ',' || thousands : thousands && mark == ',')) return {};
  }
  std::ranges::replace(text, ',', '.');
  for (char& symbol : text)
    if (symbol == 'd' || symbol == 'D') symbol = 'e';
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value;
  const auto [end, status] = std::from_chars(begin, text.data() + text.size(), value);
  if (status != std::errc{} || !std::isfinite(value)) return {};
  if (end != text.data() + text.size() && !(*end == '.' && end + 1 == text.data() + text.size()))
    return {};
  const auto exponent = std::min(text.find_first_of("eE"), text.size());
  const auto mark = text.find('.');
  const double digits =
      mark < exponent ? static_cast<double>(exponent) - static_cast<double>(mark) - 1 : 0;
  double power = 0;
  if (exponent < text.size()) {
    const char* from = text.data() + exponent + 1 + (text[exponent + 1] == '+' ? 1 : 0);
    std::from_chars(from, text.data() + text.size(), power);
  }
  return WrittenNumber{value, 0.5 * std::pow(10., power - digits)};
}

/// Parses a number of points, which may have thousands separators, unlike a length.
std::optional<Index> parsed_count(std::string text) {
  const auto first = text.find_first_not_of("+0123456789.,'");
  if (first != text.npos) return {};
  std::string digits;
  std::ranges::copy_if(text, std::back_inserter(digits),
                       [](char symbol) { return symbol >= '0' && symbol <= '9'; });
  const auto mark = text.find_first_of(".,'");
  if (mark != text.npos) {
    // "64.0" is a number of points too.
    if (text.find_first_not_of("0", mark + 1) == text.npos)
      digits = text.substr(0, mark);
    else if ((text.size() - mark) % 4 != 0)
      return {};
  }
  Index count = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (status != std::errc{} || end != digits.data() + digits.size()) return {};
  return count;
}

/// A number in the value of an entry, and the unit after it.
struct Quantity {
  std::string text;
  const HeaderToken* unit = nullptr;
};

/// The titles of columns in a line; empty if the line does not consist of titles. columns: number
/// of columns in the file.
std::vector<HeaderTitle> titles_of(Tokens tokens, Index columns);

class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& file, const NumberLayout& layout)
      : file_(file), layout_(layout) {}

  void read(const HeaderLine& line) {
    // Only this number of bytes of a line is read, since no line of a header is longer.
    constexpr std::size_t max_looked_at = 2000;
    const std::string decoded = utf8(line.text);
    std::string_view text = without_spaces(decoded);
    while (!text.empty() && (std::string_view("#%!*/'\" ").find(text.front()) != text.npos ||
                             text.starts_with("; ")))
      text.remove_prefix(1);
    line_ = trimmed(text);
    number_ = line.number;
    const std::vector<HeaderToken> tokens = header_tokens(text.substr(0, max_looked_at));
    if (tokens.empty()) return;
    if (!read_line(tokens) || (text.size() > max_looked_at && names_length(tokens))) refuse_line();
  }

  TextHeader take() {
    if (!header_.titles.empty()) header_.titles_quote = titles_quote_;
    return std::move(header_);
  }

 private:
  std::string quoted() const {
    constexpr std::size_t max_quoted = 60;
    std::string text(line_);
    if (text.size() > max_quoted) {
      std::size_t end = max_quoted;
      // Does not cut a UTF-8 letter.
      while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
      text = text.substr(0, end) + "\u2026";
    }
    return "line " + std::to_string(number_) + ", '" + text + "'";
  }

  void refuse_line() { header_.unaccounted.push_back(quoted()); }

  /// Reads a line. Returns whether all its tokens were understood.
  bool read_line(Tokens tokens) {
    if (!has(tokens, Kind::assign)) return read_words(tokens);
    while (tokens.front().kind == Kind::separator) tokens = tokens.subspan(1);
    // The words before a colon or an equals sign are the key.
    std::size_t begin = 0;
    bool all = true;
    while (begin < tokens.size()) {
      std::size_t assign = begin;
      while (assign < tokens.size() && tokens[assign].kind != Kind::assign) ++assign;
      const Tokens key = tokens.subspan(begin, assign - begin);
      std::size_t end = std::min(assign + 1, tokens.size());
      std::size_t next = end;
      while (next < tokens.size() && tokens[next].kind != Kind::assign) ++next;
      if (next == tokens.size()) {
        end = next;
      } else {
        // The next key begins after the last number, date, separator or unit (without brackets)
        // before the next colon or equals sign.
        end = next;
        while (end > assign + 1 && (tokens[end - 1].kind == Kind::word || tokens[end - 1].bracket))
          --end;
        // If no word precedes that colon or equals sign, it does not begin an entry: it is part of
        // a text or follows a value. The value then reaches to the end of the line.
        if (end == assign + 1 || end == next) end = tokens.size();
      }
      all = read_entry(
                key, tokens.subspan(std::min(assign + 1, end), end - std::min(assign + 1, end))) &&
            all;
      begin = end;
    }
    return all;
  }

  /// Reads a line without colon or equals sign: titles of columns, units, a key with its value, or
  /// text. Returns whether it was understood.
  bool read_words(Tokens tokens) {
    const auto number = std::ranges::find(tokens, Kind::number, &HeaderToken::kind);
    const auto columns = layout_.titled_columns;
    const bool titles_apart =
        std::ranges::count(tokens, Kind::separator, &HeaderToken::kind) + 1 == columns ||
        std::ranges::count_if(tokens.subspan(1), &HeaderToken::apart) + 1 == columns;
    const bool free_number = std::ranges::any_of(tokens, [](const HeaderToken& token) {
      return token.kind == Kind::number && !token.bracket;
    });
    if ((!free_number || (titles_apart && numbers_names(tokens))) && !has(tokens, Kind::date)) {
      if (read_titles(tokens)) return true;
      if (read_unit_line(tokens)) return true;
      // Otherwise the line may name columns, but fewer or more than the file has.
      constexpr Index max_titled = 8;
      const Meaning axes = meaning::x | meaning::y | meaning::plane | meaning::z | meaning::height |
                           meaning::ordinate | meaning::position;
      if (layout_.titled_columns > 1 && layout_.titled_columns <= max_titled &&
          std::ranges::count_if(tokens, [&](const HeaderToken& token) {
            return token.kind == Kind::word && (detail::meaning_of(token.text) & axes);
          }) > 1)
        return false;
    }
    if (number != tokens.end()) {
      const auto before = static_cast<std::size_t>(number - tokens.begin());
      return read_entry(tokens.first(before), tokens.subspan(before));
    }
    // A key and its unit, such as "Einheit Höhe;µm".
    if (tokens.size() > 1 && (meaning_of(tokens.first(tokens.size() - 1)) & meaning::unit))
      return read_entry(tokens.first(tokens.size() - 1), tokens.last(1));
    return !names_length(tokens);
  }

  /// Whether the numbers in a line distinguish columns, as in "x;Profile 1;Profile 2".
  bool numbers_names(Tokens tokens) const {
    if (layout_.titled_columns < 3) return false;
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (tokens[i].kind == Kind::number &&
          (tokens[i].text.size() > 1 || i < 2 || tokens[i - 1].kind != Kind::word))
        return false;
    return true;
  }

  bool read_titles(Tokens tokens) {
    const std::vector<HeaderTitle> titles = titles_of(tokens, layout_.titled_columns);
    if (titles.empty()) return false;
    const bool units_alone = std::ranges::all_of(titles, [](const HeaderTitle& title) {
      return title.meaning == 0 && (title.text.empty() || !title.unit.empty());
    });
    const auto columns = static_cast<std::size_t>(layout_.titled_columns);
    if (titles.size() == columns || titles.size() + 1 == columns) {
      if (units_alone && header_.titles.size() == titles.size()) {
        for (std::size_t i = 0; i < titles.size(); ++i) {
          if (titles[i].unit.empty()) continue;
          if (!header_.titles[i].unit.empty()) return header_.titles[i].unit == titles[i].unit;
          header_.titles[i].unit = titles[i].unit;
        }
        return true;
      }
      if (units_alone && titles.size() != columns) return false;
      if (!header_.titles.empty() && std::ranges::any_of(header_.titles, [](const auto& title) {
            return !title.unit.empty();
          }))
        return false;
      header_.titles = titles;
      titles_quote_ = quoted();
      return true;
    }
    // Otherwise the line may state the units of the axes of a matrix.
    constexpr Index max_titled = 3;
    if (layout_.titled_columns <= max_titled && layout_.titled_columns > 1 && titles.size() > 1)
      return false;
    const Meaning axes = meaning::x | meaning::y | meaning::z | meaning::height |
                         meaning::ordinate | meaning::values;
    const bool named = std::ranges::all_of(titles, [&](const HeaderTitle& title) {
      return (title.meaning & axes) && !(title.meaning & (meaning::unknown | meaning::other));
    });
    const bool units =
        std::ranges::any_of(titles, [](const auto& title) { return !title.unit.empty(); });
    if (!named || !units) return false;
    for (const HeaderTitle& title : titles) {
      if (title.unit.empty()) continue;
      if (title.meaning & meaning::x)
        set_unit(header_.x_unit, title.unit);
      else if (title.meaning & meaning::y)
        set_unit(header_.y_unit, title.unit);
      else
        set_unit(header_.value_unit, title.unit);
    }
    return true;
  }

  /// Reads a line that contains only the unit of the heights. Returns whether it does.
  bool read_unit_line(Tokens tokens) {
    if (tokens.size() != 1 || !(is_unit(tokens[0]) || is_length_unit(tokens[0].text))) return false;
    if (layout_.titled_columns == 2 || layout_.titled_columns == 3) return false;
    set_unit(header_.value_unit, tokens[0].text);
    return true;
  }

  void set_unit(std::string& target, const std::string& unit) {
    if (!target.empty() && target != unit &&
        metres_in(target).value_or(-1) != metres_in(unit).value_or(-2))
      refuse(file_,
             quoted() + ", contradicts the unit '" + target + "' of an earlier line; correct one");
    target = unit;
  }

  void set(std::optional<StatedLength>& target, const StatedLength& length) {
    if (target && !same(*target, length))
      refuse(file_, length.quote + ", contradicts " + target->quote + "; correct one");
    const auto precision = [](const StatedLength& stated) {
      return stated.half_digit / std::abs(stated.number);
    };
    if (!target || precision(length) < precision(*target)) target = length;
  }

  static bool same(const StatedLength& a, const StatedLength& b) {
    if (a.metres.has_value() != b.metres.has_value()) return false;
    const double unit_a = a.metres ? *a.metres / a.number : 1,
                 unit_b = b.metres ? *b.metres / b.number : 1;
    // Two lengths agree within half their last digits, but at most within 1 %: a number with one
    // digit is usually exact, so half a digit would be too much.
    constexpr double most = 0.01;
    const double tolerance =
        std::min(a.half_digit * std::abs(unit_a) + b.half_digit * std::abs(unit_b),
                 most * std::abs(a.number * unit_a));
    return std::abs(a.metres.value_or(a.number) - b.metres.value_or(b.number)) <=
           tolerance * (1 + 1e-9);
  }

  bool read_entry(Tokens key, Tokens value) {
    if (key.empty()) return value.empty() || (!has(value, Kind::number) && !names_length(value));
    if (value.empty()) return read_words(key);
    while (!value.empty() && value.back().kind == Kind::separator)
      value = value.first(value.size() - 1);
    while (!value.empty() && value.front().kind == Kind::separator) value = value.subspan(1);
    while (key.back().kind == Kind::separator && key.size() > 1) key = key.first(key.size() - 1);
    Meaning meaning = meaning_of(key);
    // In "no data", which marks undefined points, "no" does not negate.
    std::string joined;
    for (const HeaderToken& token : key) joined += plain_word(token.text);
    if (joined.find("nodata") != joined.npos) meaning = meaning::missing;
    if (has(key, Kind::number) || has(key, Kind::ratio)) return false;
    if (has(value, Kind::number)) return read_numbers(key, meaning, value);
    if (has(value, Kind::date)) return true;
    return read_text(key, meaning, value);
  }

  /// Reads an entry whose value has no numbers. Returns whether it was understood.
  bool read_text(Tokens key, Meaning meaning, Tokens value) {
    using namespace meaning;
    const bool one = value.size() == 1 && !has(key, Kind::length);
    const bool is_length = one && (value[0].kind == Kind::length || is_length_unit(value[0].text));
    const bool is_other = one && (value[0].kind == Kind::other || is_other_unit(value[0].text));
    if ((meaning & unit) && !one && !(meaning & (unknown | harmless | other))) return false;
    if ((meaning & unit) && one) {
      const bool known =
          !(meaning & (unknown | harmless | other | index | points | columns | rows));
      if (!known) return !is_length;
      std::string name = value[0].text;
      if (meaning & (z | height | ordinate | values)) {
        if (meaning & (x | y | plane)) return false;
        set_unit(header_.value_unit, name);
      } else if (meaning & (x | y | plane | position | length | width | size | pixel | step)) {
        if (!is_length) return false;
        if (!(meaning & y) || (meaning & x)) set_unit(header_.x_unit, name);
        if (!(meaning & x) || (meaning & y)) set_unit(header_.y_unit, name);
      } else {
        if (!is_length) return false;
        set_unit(header_.common_unit, name);
      }
      return true;
    }
    if (is_length || (is_other && (meaning & (z | height)))) {
      // The value is a unit, as in "Z: nm".
      if (meaning & (unknown | harmless | size | pixel | step | factor | alters)) return false;
      if (meaning & (z | height | ordinate | values))
        set_unit(header_.value_unit, value[0].text);
      else if (meaning & (x | plane))
        set_unit(header_.x_unit, value[0].text);
      else if (!(meaning & y))
        return false;
      if (meaning & (y | plane)) set_unit(header_.y_unit, value[0].text);
      return true;
    }
    if (meaning & (alters | mask)) {
      const Meaning said = meaning_of(value);
      return (said & no) && !(said & unknown);
    }
    if ((has(value, Kind::length) || has(value, Kind::other)) && read_titles(value)) return true;
    // An entry that names the channel of the file, and this channel is not the heights.
    const Meaning said = meaning_of(value);
    const bool channel = std::ranges::any_of(key, [](const HeaderToken& token) {
      const std::string word = plain_word(token.text);
      return word == "channel" || word == "kanal" || word == "canal" || word == "chaneru";
    });
    if (channel && (said & (other | mask)) && !(said & (z | height))) return false;
    return !names_length(value) && !names_length(key);
  }

  /// Reads an entry whose value has numbers. Returns whether it was understood.
  bool read_numbers(Tokens key, Meaning meaning, Tokens value) {
    using namespace meaning;
    const auto unit_of_key = std::ranges::find(key, Kind::length, &HeaderToken::kind);
    const bool other_key = has(key, Kind::other);
    std::vector<Quantity> quantities;
    Meaning said = 0;
    bool per_pixel = unit_of_key != key.end() && unit_of_key->per_pixel;
    for (const HeaderToken& token : value) {
      if (token.kind == Kind::number) {
        quantities.push_back({token.text});
      } else if (is_unit(token) ||
                 (!quantities.empty() && !quantities.back().unit && is_plain_unit(token))) {
        if (quantities.empty() || quantities.back().unit) return false;
        quantities.back().unit = &token;
        per_pixel = per_pixel || token.per_pixel;
      } else if (token.kind == Kind::word) {
        said |= detail::meaning_of(token.text);
      }
    }
    const auto kind_of = [&](const Quantity& quantity) {
      if (quantity.unit)
        return quantity.unit->kind == Kind::word ? Kind::length : quantity.unit->kind;
      return unit_of_key != key.end() ? Kind::length : other_key ? Kind::other : Kind::number;
    };
    const auto all_are = [&](auto... kinds) {
      return std::ranges::all_of(quantities, [&](const Quantity& quantity) {
        return ((kind_of(quantity) == kinds) || ...);
      });
    };
    if (states_height_factor(meaning, quantities,
                             unit_of_key != key.end() ? &*unit_of_key : nullptr))
      return true;
    if (!all_are(Kind::number, Kind::length, Kind::other)) return false;
    const bool lengths = all_are(Kind::length), numbers = all_are(Kind::number);

    if (line_.find("->") != line_.npos && (meaning & factor))
      return !(meaning & (x | y | plane)) && read_height_factor(quantities);
    if (meaning & missing) {
      if (meaning & (points | count | pixel)) return numbers && !(meaning & unknown);
      if (quantities.size() != 1 || !numbers || said) return false;
      const auto mark = parsed(quantities[0].text, layout_);
      if (mark) header_.missing.push_back(mark->value);
      return mark.has_value();
    }
    const Meaning heights = z | height | ordinate | values;
    if (meaning & harmless) {
      if (said & (carrying & ~(x | y | points | factor | values))) return false;
      if (all_are(Kind::other)) return !(meaning & (heights | factor));
      if (per_pixel) return false;
      return !(meaning & carrying & ~points);
    }
    if (all_are(Kind::other)) return !(meaning & ((carrying & ~size) | ordinate));
    // A number that only counts, as in "Licence no.: 99812".
    if ((meaning & index) && numbers && quantities.size() == 1 && said == 0)
      return !(meaning & (carrying | ordinate | missing | mask));
    if (has_other(quantities, kind_of)) return false;
    if (meaning & (unknown | mask | no)) return false;
    const bool about_plane = meaning & (x | y | plane | pixel | width | columns | rows | step);
    if ((meaning & (result)) && !about_plane && !(meaning & (unit | factor | points)) &&
        (!(meaning & size) || (meaning & heights)))
      return said == 0;
    if ((meaning & (z | height | ordinate)) && (meaning & resolution) && !about_plane)
      return said == 0;
    if ((meaning & z) && (meaning & (size | length)) && !about_plane) return said == 0;
    if (meaning & factor) {
      const auto one = quantities.size() == 1 ? parsed(quantities[0].text, layout_) : std::nullopt;
      return numbers && one && one->value == 1;
    }
    if (meaning & alters) {
      if ((meaning & (x | y | plane)) && !(meaning & heights)) return true;
      return std::ranges::all_of(quantities, [&](const Quantity& quantity) {
        const auto number = parsed(quantity.text, layout_);
        return number && number->value == 0;
      });
    }
    if (meaning & (unit | index | values | ordinate | z)) return false;
    if (said & ~(neutral | points | pixel | columns | rows | x | y | position)) return false;
    if (numbers && read_counts(meaning, quantities, key)) return true;
    if (said & (x | y | position)) return false;
    if (numbers && (said & (points | pixel | columns | rows))) return false;
    if (!lengths && !numbers) {
      // Two sizes of which only the second has a unit, as in "10 x 10 µm": the unit belongs to
      // both.
      if (quantities.size() != 2 || !quantities[1].unit) return false;
      quantities[0].unit = quantities[1].unit;
    }
    return read_lengths(meaning, quantities, unit_of_key != key.end() ? &*unit_of_key : nullptr,
                        per_pixel);
  }

  template <typename KindOf>
  static bool has_other(const std::vector<Quantity>& quantities, const KindOf& kind_of) {
    return std::ranges::any_of(
        quantities, [&](const Quantity& quantity) { return kind_of(quantity) == Kind::other; });
  }

  /// Reads a factor of the heights, such as "Z conversion factor: 1e-9 m" or "Height factor: 0.3
  /// nm/digit". Returns false for a "Z scale" that is a length, since it may be the colour scale of
  /// a picture.
  bool states_height_factor(Meaning meaning, const std::vector<Quantity>& quantities,
                            const HeaderToken* unit_of_key) {
    using namespace meaning;
    if (!(meaning & factor) || !(meaning & (z | height | values)) || quantities.size() != 1 ||
        (meaning & (carrying & ~(z | height | values | factor))) ||
        (meaning & (harmless | unknown)))
      return false;
    const HeaderToken* unit = quantities[0].unit ? quantities[0].unit : unit_of_key;
    const auto number = parsed(quantities[0].text, layout_);
    if (!unit || !number || number->value == 0) return false;
    const auto slash = std::min(unit->text.find('/'), unit->text.size());
    const std::string_view per =
        std::string_view(unit->text).substr(std::min(slash + 1, unit->text.size()));
    const bool per_value =
        per.empty() ? (meaning & conversion) != 0
                    : per == "bit" || (detail::meaning_of(per) & (factor | count | values));
    const auto metres = metres_in(unit->text.substr(0, slash));
    if (!per_value || !metres) return false;
    header_.height_factor = number->value * *metres;
    return true;
  }

  bool read_height_factor(const std::vector<Quantity>& quantities) {
    const auto arrow = line_.find("->"), close = line_.find(')');
    const auto number = quantities.size() == 1 && !quantities[0].unit
                            ? parsed(quantities[0].text, layout_)
                            : std::nullopt;
    if (!number || number->value == 0)
      refuse(file_, quoted() + ", does not state a height conversion factor; correct it");
    if (close == line_.npos || close < arrow + 2)
      refuse(file_, quoted() +
                        ", does not say what its height conversion factor converts to; write "
                        "'(-> m)'");
    header_.height_factor =
        number->value *
        metres_per(file_, std::string(trimmed(line_.substr(arrow + 2, close - arrow - 2))));
    return true;
  }

  /// Reads an entry that states numbers of points. Returns whether it does.
  bool read_counts(Meaning meaning, const std::vector<Quantity>& quantities, Tokens key) {
    using namespace meaning;
    const Meaning counting = columns | rows | points | count | pixel | resolution;
    if (meaning & (step | length | height)) return false;
    if (!(meaning & (counting | width | size | x | y))) return false;
    std::vector<StatedCount> counts;
    for (const Quantity& quantity : quantities) {
      const auto number = parsed_count(quantity.text);
      if (!number) return false;
      counts.push_back({*number, quoted()});
    }
    if (counts.size() == 2) {
      if (meaning & (x | y | width)) return false;
      const bool certain = meaning & counting && !(meaning & (pixel | size) && !(meaning & count));
      const bool fits = counts[0].count == layout_.columns && counts[1].count == layout_.rows;
      if (!certain && !fits) return false;
      header_.columns.push_back(counts[0]);
      header_.rows.push_back(counts[1]);
      return true;
    }
    if (counts.size() != 1) return false;
    const bool per_line = (meaning & points) && (meaning & rows) &&
                          std::ranges::any_of(key, [](const HeaderToken& token) {
                            const std::string word = plain_word(token.text);
                            return word == "per" || word == "pro" || word == "par";
                          });
    const bool along_x = (meaning & (columns | x | width)) || per_line,
               along_y = !per_line && (meaning & (rows | y));
    if (along_x && along_y) return false;
    // After "Width" a number without unit is a number of points if the file has as many columns.
    const bool certain =
        (meaning & (columns | rows | points | count | resolution)) && !(meaning & (size | width));
    const Index found = along_x ? layout_.columns : along_y ? layout_.rows : -1;
    if (!certain && (counts[0].count != found || (meaning & pixel && meaning & size))) return false;
    auto& target = along_x ? header_.columns : along_y ? header_.rows : header_.points;
    target.push_back(counts[0]);
    return true;
  }

  bool read_lengths(Meaning meaning, const std::vector<Quantity>& quantities,
                    const HeaderToken* unit_of_key, bool per_pixel) {
    using namespace meaning;
    if (quantities.empty() || quantities.size() > 2) return false;
    std::vector<StatedLength> lengths;
    for (const Quantity& quantity : quantities) {
      const auto number = parsed(quantity.text, layout_);
      if (!number) return false;
      StatedLength& length =
          lengths.emplace_back(StatedLength{number->value, number->half_digit, {}, quoted()});
      const HeaderToken* unit = quantity.unit ? quantity.unit : unit_of_key;
      if (unit) length.metres = metres_of(quantity.text, number->value, unit->text);
    }
    const bool distances = (meaning & (pixel | step)) || ((meaning & resolution) && per_pixel);
    if (per_pixel && !distances) return false;
    if ((meaning & resolution) && !distances) return false;
    const Meaning counted = columns | rows | points | count;
    if ((meaning & counted) && !(meaning & step)) return false;
    if ((meaning & count) ||
        ((meaning & height) && (meaning & (step | size)) && !(meaning & pixel)))
      return false;
    if (!(meaning & (pixel | step | width | height | size | length))) return false;
    if (distances && (meaning & pixel) == 0 && (meaning & (width | height | length))) return false;
    if (distances && !(meaning & step) &&
        !(meaning & (size | width | height | length | resolution)) && !per_pixel &&
        !(meaning & (x | y | plane)))
      return false;  // an entry such as "Pixel: 1.1 mm" has more than one meaning
    const bool along_x = meaning & (x | width | columns), along_y = meaning & (y | height | rows);
    if (along_x && along_y) return false;
    auto& first = distances ? header_.pixel_x : header_.width;
    auto& second = distances ? header_.pixel_y : header_.height;
    if (lengths.size() == 2) {
      if (along_x || along_y || (meaning & length)) return false;
      set(first, lengths[0]);
      set(second, lengths[1]);
      return true;
    }
    if ((meaning & length) && !along_x && !along_y && !distances) {
      set(header_.length, lengths[0]);
      return true;
    }
    // A single size belongs to both axes, if the file has as many columns as rows or the key says
    // so.
    if (!along_x && !along_y && !distances && !(meaning & plane) && layout_.columns != layout_.rows)
      return false;
    if (!along_y) set(first, lengths[0]);
    if (!along_x) set(second, lengths[0]);
    return true;
  }

  /// Length in metres of the number `text`. parse_quantity() rounds correctly, since it divides by
  /// exact powers of ten; `number` times the unit would not.
  static double metres_of(const std::string& text, double number, const std::string& unit) {
    try {
      return parse_quantity(text + " " + unit, Dimension::length, "length");
    } catch (const InvalidInput&) {
      return number * metres_in(unit).value_or(0);
    }
  }

  const std::filesystem::path& file_;
  const NumberLayout& layout_;
  TextHeader header_;
  std::string_view line_;
  int number_ = 0;
  std::string titles_quote_;
};

/// Makes the title of one column from its words.
HeaderTitle title_of(Tokens tokens) {
  HeaderTitle title;
  for (const HeaderToken& token : tokens) {
    if (!title.text.empty()) title.text += ' ';
    title.text += token.text;
    const bool behind_name =
        title.meaning != 0 && &token == &tokens.back() &&
        (is_length_unit(token.text) ||
         (is_other_unit(token.text) && detail::meaning_of(token.text) == meaning::unknown));
    if (is_unit(token) || (token.kind == Kind::word && behind_name)) {
      // A column with two units is not understood.
      if (!title.unit.empty()) title.meaning |= meaning::unknown;
      title.unit = token.text;
    } else if (token.kind == Kind::word) {
      title.meaning |= detail::meaning_of(token.text);
    }
  }
  if (tokens.size() == 1 && title.unit.empty() && tokens[0].kind == Kind::word &&
      (is_length_unit(tokens[0].text) || is_other_unit(tokens[0].text)) &&
      !(title.meaning & ~meaning::unknown))
    title = {0, tokens[0].text, tokens[0].text};
  return title;
}

constexpr Meaning naming = meaning::x | meaning::y | meaning::plane | meaning::z | meaning::height |
                           meaning::ordinate | meaning::values | meaning::position |
                           meaning::index | meaning::other | meaning::mask | meaning::width |
                           meaning::length | meaning::step | meaning::harmless | meaning::unknown |
                           meaning::rows | meaning::points;

/// Splits words without separators into titles of columns. A unit ends a title. A name begins a new
/// title, unless it completes the name before it, as in "Position X" and "Z height".
std::vector<std::vector<HeaderToken>> groups_of(Tokens tokens, Index columns) {
  std::vector<std::vector<HeaderToken>> groups(1);
  const auto units = std::ranges::count_if(tokens, is_unit);
  const bool by_units = units == columns && is_unit(tokens.back());
  Meaning meaning = 0;
  bool closed = false;
  for (const HeaderToken& token : tokens) {
    const bool unit = is_unit(token) || (token.kind == Kind::word && meaning != 0 && !closed &&
                                         !by_units && is_plain_unit(token));
    if (closed) {
      groups.emplace_back();
      meaning = 0;
      closed = false;
    }
    if (unit) {
      groups.back().push_back(token);
      closed = true;
      continue;
    }
    const Meaning here = detail::meaning_of(token.text) & naming;
    const Meaning axes = meaning::x | meaning::y | meaning::plane;
    const Meaning heights = meaning::z | meaning::height | meaning::ordinate | meaning::values;
    // A word that only describes the instrument does not begin a title: "Stylus position" is a
    // position.
    const bool condition = meaning == meaning::harmless && here != meaning::harmless;
    const bool axis_alone = (meaning & ~(axes | meaning::z)) == 0 && meaning != 0;
    const bool more =
        condition || (axis_alone && here == meaning::position) ||
        (here & meaning & meaning::index) ||
        ((here & meaning & heights) == 0 &&
         (((here & ~heights) == 0 && (meaning & ~heights) == 0) ||
          ((meaning & meaning::position) && !(meaning & axes) && (here & (axes | meaning::z)))));
    if (!by_units && here && meaning && !more) {
      groups.emplace_back();
      meaning = 0;
    }
    groups.back().push_back(token);
    meaning |= here;
  }
  if (groups.back().empty()) groups.pop_back();
  return groups;
}

/// expand: whether a name for both x and y makes two titles.
std::vector<HeaderTitle> titles_of(Tokens tokens, Index columns, bool expand) {
  std::vector<HeaderTitle> titles;
  const auto add = [&](Tokens group) {
    HeaderTitle title = title_of(group);
    if (expand && (title.meaning & meaning::plane) &&
        !(title.meaning & (meaning::x | meaning::y))) {
      title.meaning = (title.meaning & ~meaning::plane) | meaning::x;
      titles.push_back(title);
      title.meaning = (title.meaning & ~meaning::x) | meaning::y;
    }
    titles.push_back(std::move(title));
  };
  if (has(tokens, Kind::separator)) {
    std::size_t begin = 0;
    while (begin <= tokens.size()) {
      std::size_t end = begin;
      while (end < tokens.size() && tokens[end].kind != Kind::separator) ++end;
      add(tokens.subspan(begin, end - begin));
      begin = end + 1;
    }
    while (titles.size() > static_cast<std::size_t>(columns) && titles.back().text.empty())
      titles.pop_back();
    if (titles.size() == static_cast<std::size_t>(columns) + 1 && titles.front().text.empty())
      titles.erase(titles.begin());
    return titles;
  }
  const auto apart = std::ranges::count_if(tokens.subspan(1), &HeaderToken::apart);
  if (apart > 0 && (apart + 1 == columns || apart + 2 == columns)) {
    std::size_t begin = 0;
    for (std::size_t end = 1; end <= tokens.size(); ++end)
      if (end == tokens.size() || tokens[end].apart) {
        add(tokens.subspan(begin, end - begin));
        begin = end;
      }
    return titles;
  }
  for (const auto& group : groups_of(tokens, columns)) add(group);
  // If a word names no column, the line is text, unless it has as many titles as the file has
  // columns.
  if (titles.size() != static_cast<std::size_t>(columns) &&
      std::ranges::any_of(titles, [](const HeaderTitle& title) {
        const bool named = (title.meaning & naming & ~(meaning::unknown | meaning::harmless)) != 0;
        return !named && title.unit.empty();
      }))
    return {};
  return titles;
}

std::vector<HeaderTitle> titles_of(Tokens tokens, Index columns) {
  std::vector<HeaderTitle> titles = titles_of(tokens, columns, false);
  const auto count = static_cast<std::size_t>(columns);
  if (titles.size() == count || titles.size() + 1 == count) {
    const bool plane = std::ranges::any_of(
        titles, [](const auto& title) { return title.meaning & meaning::plane; });
    if (titles.size() == count || !plane) return titles;
  }
  return titles_of(tokens, columns, true);
}

}  // namespace

TextHeader read_header(const std::filesystem::path& file, const std::vector<HeaderLine>& lines,
                       const NumberLayout& layout) {
  HeaderReader reader(file, layout);
  for (const HeaderLine& line : lines) reader.read(line);
  return reader.take();
}

}  // namespace salebra::detail
