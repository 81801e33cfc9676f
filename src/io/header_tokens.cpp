// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a line of a header into words, numbers, units and dates.
#include "header_tokens.hpp"

#include <algorithm>
#include <array>

#include "header_words.hpp"
#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {
namespace {

using Kind = HeaderToken::Kind;

bool is_digit(char symbol) { return symbol >= '0' && symbol <= '9'; }

/// Whether a byte belongs to a word. All bytes of UTF-8 letters beyond ASCII do.
bool is_letter(char symbol) {
  return (symbol >= 'a' && symbol <= 'z') || (symbol >= 'A' && symbol <= 'Z') ||
         static_cast<unsigned char>(symbol) >= 0x80;
}

bool is_blank(char symbol) { return symbol == ' ' || symbol == '\t'; }

std::string_view without(std::string_view text, std::string_view head) {
  return text.starts_with(head) ? text.substr(head.size()) : text;
}

class Tokenizer {
 public:
  explicit Tokenizer(std::string_view line) : line_(line) {}

  std::vector<HeaderToken> all() {
    while (at_ < line_.size()) {
      const std::size_t before = tokens_.size();
      const bool apart = at_ > 1 && line_[at_ - 1] == ' ' && line_[at_ - 2] == ' ';
      next();
      if (apart && tokens_.size() > before) tokens_[before].apart = true;
    }
    return std::move(tokens_);
  }

 private:
  char at(std::size_t index) const { return index < line_.size() ? line_[index] : '\0'; }

  void add(Kind kind, std::string_view text) {
    tokens_.push_back({kind, std::string(text), false, false});
  }

  bool behind_number() const {
    return !tokens_.empty() && tokens_.back().kind == Kind::number && at_ == number_end_;
  }

  void next() {
    const char symbol = line_[at_];
    // UTF-8 characters that are no letters: non-breaking space, multiplication sign, degree,
    // dashes.
    if (line_.substr(at_).starts_with("\xc2\xa0")) {
      skip(2);
    } else if (line_.substr(at_).starts_with("\xc3\x97")) {
      add(Kind::times, "x");
      skip(2);
    } else if (symbol == '\t' || symbol == ',' || symbol == ';') {
      add(Kind::separator, line_.substr(at_, 1));
      skip(1);
    } else if (symbol == ':' || symbol == '=') {
      add(Kind::assign, line_.substr(at_, 1));
      skip(1);
    } else if (symbol == '[' || symbol == '(' || symbol == '{' || symbol == '<') {
      bracket();
    } else if (begins_number()) {
      number();
    } else if (is_letter(symbol) || symbol == '%') {
      word();
    } else if (symbol == '*' && !tokens_.empty()) {
      add(Kind::times, "*");
      skip(1);
    } else {
      skip(1);
    }
  }

  /// Skips bytes. If they are only blanks, a unit that follows still belongs to the number before
  /// them.
  void skip(std::size_t bytes) {
    const bool blank = is_blank(line_[at_]) && line_[at_] != '\t';
    const bool was = at_ == number_end_;
    at_ += bytes;
    if ((blank || bytes == 2) && was) number_end_ = at_;
  }

  void bracket() {
    constexpr std::string_view open = "[({<", close = "])}>";
    const char closing = close[open.find(line_[at_])];
    const auto end = line_.find(closing, at_ + 1);
    if (end == std::string_view::npos) {
      skip(1);
      return;
    }
    const std::string_view inner =
        trimmed(without(trimmed(line_.substr(at_ + 1, end - at_ - 1)), "in "));
    at_ = end + 1;
    if (unit_of(inner, true)) return;
    for (HeaderToken& token : Tokenizer(inner).all()) {
      token.bracket = true;
      tokens_.push_back(std::move(token));
    }
  }

  bool begins_number() const {
    const std::size_t sign = line_[at_] == '+' || line_[at_] == '-';
    const char first = at(at_ + sign);
    const bool digits = is_digit(first) || (first == '.' && is_digit(at(at_ + sign + 1)));
    return digits && (at_ == 0 || !is_letter(line_[at_ - 1]) || line_[at_ - 1] == 'x');
  }

  void number() {
    const std::size_t begin = at_;
    if (const std::size_t end = date_end()) {
      add(Kind::date, line_.substr(begin, end - begin));
      at_ = end;
      return;
    }
    ++at_;
    while (is_digit(at(at_)) ||
           ((at(at_) == '.' || at(at_) == ',' || at(at_) == '\'') && is_digit(at(at_ + 1))))
      ++at_;
    if (at(at_) == '.') ++at_;
    const char exponent = at(at_);
    if (exponent == 'e' || exponent == 'E' || exponent == 'd' || exponent == 'D') {
      const std::size_t sign = at(at_ + 1) == '+' || at(at_ + 1) == '-';
      if (is_digit(at(at_ + 1 + sign))) {
        at_ += 1 + sign;
        while (is_digit(at(at_))) ++at_;
      }
    }
    add(Kind::number, line_.substr(begin, at_ - begin));
    number_end_ = at_;
    const char behind = at(at_);
    if ((behind == 'x' || behind == 'X') && (is_digit(at(at_ + 1)))) {
      add(Kind::times, "x");
      ++at_;
    } else if (is_letter(behind)) {
      std::size_t end = at_;
      while (is_letter(at(end)) || is_digit(at(end))) ++end;
      if (unit_of(line_.substr(at_, end - at_), false)) {
        at_ = end;
        rest_of_unit();
        return;
      }
      // A number followed directly by letters, as in "50x" or "3D", is a name.
      tokens_.back() = {Kind::word, std::string(line_.substr(begin, end - begin))};
      at_ = end;
      number_end_ = 0;
    }
  }

  /// The index after the date, time or version number that begins at the current position; 0 if
  /// none does.
  std::size_t date_end() const {
    std::size_t end = at_, groups = 0, longest = 0;
    bool thousands = true;
    char between = '\0';
    for (;;) {
      std::size_t digits = 0;
      while (is_digit(at(end + digits))) ++digits;
      if (digits == 0) return 0;
      if (groups > 0) thousands = thousands && digits == 3;
      longest = std::max(longest, digits);
      end += digits;
      ++groups;
      const char symbol = at(end);
      const bool joins = symbol == '-' || symbol == '/' || symbol == '.' || symbol == ':';
      if (!joins || !is_digit(at(end + 1)) || (between != '\0' && symbol != between)) break;
      between = symbol;
      ++end;
    }
    const bool time = between == ':' && groups >= 2 && longest <= 2;
    const bool date = groups >= 3 && between != ':' && !(between == '.' && thousands);
    if (!time && !date) return 0;
    // Accepts fractions of a second, and the time after a date: "2026-03-17T10:30:00.5Z".
    while (is_digit(at(end)) ||
           ((at(end) == '.' || at(end) == ':' || at(end) == 'T') && is_digit(at(end + 1))))
      ++end;
    if (at(end) == 'Z' || at(end) == 'h') ++end;
    return end;
  }

  void word() {
    std::size_t end = at_;
    if (line_[at_] == '%') ++end;
    if (line_.substr(at_).starts_with("a.u.")) {
      add(Kind::other, "a.u.");
      at_ += 4;
      return;
    }
    while (is_letter(at(end)) || (end > at_ && is_digit(at(end)))) ++end;
    while (end > at_ + 2 && line_.substr(end - 2, 2) == "\xc2\xa0") end -= 2;
    const std::string_view text = line_.substr(at_, end - at_);
    // Here a unit follows a name: "Z/µm", "Z_µm", "Z / µm", "Z - µm".
    const std::string_view before = trimmed(line_.substr(0, at_));
    const bool attached = (before.size() == at_ && before.ends_with('_')) ||
                          before.ends_with('/') || (before.size() < at_ && before.ends_with(" -"));
    // The text is the key of another entry, as `h` in "w=3 h=2".
    const bool is_key = at(std::min(line_.find_first_not_of(' ', end), line_.size())) == '=';
    const bool after_number = behind_number() && !is_key;
    if (after_number && (text == "x" || text == "X" || text == "by" || text == "mal")) {
      add(Kind::times, "x");
      at_ = end;
      return;
    }
    const bool after_unit = !tokens_.empty() && tokens_.back().kind == Kind::length &&
                            (text == "x" || text == "X" || text == "by");
    if (after_unit) {
      add(Kind::times, "x");
      at_ = end;
      return;
    }
    // "in" means inch after a number, but before a unit it is the word "in" ("Z in µm").
    const bool after_in = !tokens_.empty() && tokens_.back().kind == Kind::word &&
                          plain_word(tokens_.back().text) == "in";
    const bool unit_after_in =
        after_in &&
        (is_length_unit(text) || (is_other_unit(text) && meaning_of(text) == meaning::unknown));
    if (unit_after_in) tokens_.pop_back();
    if ((after_number || attached || unit_after_in) && unit_of(text, false)) {
      at_ = end;
      rest_of_unit();
      return;
    }
    add(Kind::word, text);
    at_ = end;
  }

  /// Adds the text as a token if it is a unit; otherwise returns false.
  bool unit_of(std::string_view text, bool in_bracket) {
    if (in_bracket)
      if (const auto slash = text.find('/'); slash != std::string_view::npos) {
        const std::string_view head = trimmed(text.substr(0, slash));
        if (!is_length_unit(head)) return false;
        add(Kind::length, head);
        tokens_.back().bracket = true;
        denominator(trimmed(text.substr(slash + 1)));
        return true;
      }
    const bool length = is_length_unit(text);
    if (!length && !is_other_unit(text)) return false;
    add(length ? Kind::length : Kind::other, text);
    tokens_.back().bracket = in_bracket;
    return true;
  }

  /// Reads what follows a unit without a blank, such as "/s", "/pixel" or "²".
  void rest_of_unit() {
    if (at(at_) == '^' && is_digit(at(at_ + 1))) {
      tokens_.back().kind = Kind::other;
      at_ += 2;
    }
    if (at(at_) != '/') return;
    std::size_t end = at_ + 1;
    while (is_letter(at(end)) || is_digit(at(end))) ++end;
    if (end == at_ + 1) return;
    denominator(line_.substr(at_ + 1, end - at_ - 1));
    at_ = end;
  }

  void denominator(std::string_view text) {
    HeaderToken& unit = tokens_.back();
    if (unit.kind != Kind::length) return;
    const Meaning meaning = meaning_of(text);
    constexpr std::string_view times[]{"s", "sec", "min", "h", "ms"};
    if ((meaning & meaning::pixel) || ((meaning & meaning::points) && text != "ten"))
      unit.per_pixel = true;
    else
      unit.kind = std::ranges::find(times, text) != std::end(times) ? Kind::other : Kind::ratio;
    unit.text += '/';
    unit.text += text;
    if (unit.per_pixel) unit.text.resize(unit.text.size() - text.size() - 1);
  }

  std::string_view line_;
  std::size_t at_ = 0;
  std::size_t number_end_ = 0;  ///< index after the last number and the blanks behind it
  std::vector<HeaderToken> tokens_;
};

}  // namespace

std::vector<HeaderToken> header_tokens(std::string_view line) { return Tokenizer(line).all(); }

bool is_length_unit(std::string_view text) {
  return !text.empty() && is_letter(text.front()) && metres_in(std::string(text)).has_value();
}

bool is_other_unit(std::string_view text) {
  constexpr std::string_view plain[]{
      "%",   "\u00b0", "\u00b0C", "\u00b0F", "\u2103", "C",   "deg", "rad",  "min",
      "h",   "sec",    "dB",      "bit",     "bits",   "fps", "rpm", "a.u.", "au",
      "arb", "counts", "count",   "digit",   "digits", "rel", "px",  "-",    "1"};
  constexpr std::string_view stems[]{"V", "A", "s",  "Hz", "N", "Pa", "W",   "g",
                                     "J", "K", "eV", "lx", "T", "B",  "Ohm", "\u03a9"};
  constexpr std::string_view prefixes[]{"",  "p", "n", "u", "\u00b5", "\u03bc",
                                        "m", "k", "M", "G", "c",      "h"};
  if (std::ranges::find(plain, text) != std::end(plain)) return true;
  for (const std::string_view stem : stems)
    if (text.ends_with(stem) &&
        std::ranges::find(prefixes, text.substr(0, text.size() - stem.size())) !=
            std::end(prefixes))
      return true;
  // Endings that turn a length into an area, a volume or a rate.
  for (const std::string_view power :
       {"2", "3", "^2", "^3", "\u00b2", "\u00b3", "/s", "/min", "/h"})
    if (text.ends_with(power) && is_length_unit(text.substr(0, text.size() - power.size())))
      return true;
  return false;
}

}  // namespace salebra::detail
