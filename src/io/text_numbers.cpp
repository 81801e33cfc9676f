// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in lines of text: separators, decimal commas, line ends and encodings.
#include "text_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <utility>

#include "base/memory.hpp"
#include "loaded_surface.hpp"
#include "surface_formats.hpp"
#include "surface_importer.hpp"

namespace salebra::detail {
namespace {

bool is_blank(char symbol) { return symbol == ' ' || symbol == '\t'; }

constexpr std::size_t piece_size = std::size_t{1} << 20;

[[noreturn]] void refuse_bytes(const std::filesystem::path& file) {
  refuse_unknown(
      file,
      "is not text (it holds NUL bytes) and not in another readable format; convert it to one of " +
          read_extensions());
}

std::string_view without_mark(std::string_view content) {
  if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);
  return content;
}

// Throws InvalidInput if `full` values cannot grow further: a full vector is copied to a new one of
// twice the size, and for a moment both are in memory.
void require_memory(const std::filesystem::path& file, std::size_t full) {
  const double bytes = 2. * sizeof(double) * static_cast<double>(full);
  if (!fits_into_memory(bytes))
    refuse(file, "holds more than " + std::to_string(full) + " values, which need " +
                     memory_text(bytes) + " of memory, and " +
                     memory_text(static_cast<double>(available_memory())) +
                     " are available; crop it or use fewer points");
}

/// A short printable piece of a line for messages. It ends before one of the characters `stops`.
std::string excerpt(const char* at, const char* end, std::string_view stops = "") {
  std::string text;
  for (; at != end && text.size() < 16 && stops.find(*at) == stops.npos; ++at)
    text += *at >= ' ' && *at < '\x7f' ? *at : '?';
  return text;
}

/// The end of a Fortran exponent such as "D-03" that begins at `at`; nullptr if there is none.
const char* fortran_exponent(const char* at, const char* end) {
  if (at == end || (*at != 'D' && *at != 'd')) return nullptr;
  if (++at != end && (*at == '+' || *at == '-')) ++at;
  const char* const digits = at;
  while (at != end && *at >= '0' && *at <= '9') ++at;
  return at == digits ? nullptr : at;
}

/// Parses a number as std::from_chars() does, but also accepts a plus sign, numbers below the
/// smallest double and Fortran exponents. Returns the end of the number; nullptr if there is none.
const char* parse_number(const char* at, const char* end, double& value) {
  if (at != end && *at == '+' && end - at > 1 && at[1] != '-') ++at;
  const auto [stop, status] = std::from_chars(at, end, value);
  if (status == std::errc{}) {
    const char* const exponent = fortran_exponent(stop, end);
    if (!exponent) return stop;
    std::string digits(at, exponent);
    digits[static_cast<std::size_t>(stop - at)] = 'e';
    value = std::strtod(digits.c_str(), nullptr);
    return exponent;
  }
  if (status != std::errc::result_out_of_range) return nullptr;
  const std::string digits(at, stop);
  value = std::strtod(digits.c_str(), nullptr);
  return stop;
}

/// Parses a number with a decimal comma, otherwise as parse_number().
const char* parse_comma_number(const char* at, const char* end, double& value) {
  std::array<char, 64> buffer;
  std::size_t length = 0;
  for (const char* from = at; from != end && length < buffer.size(); ++from) {
    if (is_blank(*from) || *from == ';') break;
    if (*from == '.') return nullptr;
    buffer[length++] = *from == ',' ? '.' : *from;
  }
  const char* stop = parse_number(buffer.data(), buffer.data() + length, value);
  return stop ? at + (stop - buffer.data()) : nullptr;
}

/// Whether the line contains a or b. Two searches for one symbol each are faster than one search
/// for both.
bool has_one_of(std::string_view line, char a, char b) {
  return line.find(a) != line.npos || line.find(b) != line.npos;
}

bool is_separator(char symbol) { return is_blank(symbol) || symbol == ',' || symbol == ';'; }

/// The end of a mark, such as "***", by which an instrument marks an undefined point; nullptr if
/// there is none at `at`.
const char* parse_mark(const char* at, const char* end) {
  const auto closed = [&](const char* stop) { return stop == end || is_separator(*stop); };
  for (const char symbol : {'*', '-'}) {
    const char* stop = at;
    while (stop != end && *stop == symbol) ++stop;
    if (stop - at >= 2 && closed(stop)) return stop;
  }
  // Microsoft's C library prints NaN in these forms. Its infinity does not mark an undefined point.
  const char* const digits = at != end && *at == '-' ? at + 1 : at;
  for (const std::string_view kind : {"1.#IND", "1.#QNAN", "1.#SNAN", "1.#NAN"})
    if (std::string_view(digits, static_cast<std::size_t>(end - digits)).starts_with(kind)) {
      const char* stop = digits + kind.size();
      while (stop != end && *stop == '0') ++stop;
      if (closed(stop)) return stop;
    }
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  for (const std::string_view word :
       {"no data", "nodata", "bad", "n/a", "#n/a", "na", "null", "none", "invalid", "masked", "#nv",
        "nan(ind)", "-nan(ind)"}) {
    const auto size = static_cast<std::ptrdiff_t>(word.size());
    if (end - at >= size &&
        std::equal(word.begin(), word.end(), at, [&](char b, char a) { return same(a, b); }) &&
        closed(at + size))
      return at + size;
  }
  return nullptr;
}

/// Whether the line has several values that are all numbers or marks of undefined points, but not
/// only dashes. Commas count as separators here: if they are decimal, the parts on both sides of
/// each still look like numbers.
bool is_row(std::string_view line) {
  const char* at = line.data();
  const char* const end = at + line.size();
  int values = 0, dashes = 0;
  while (at != end) {
    if (is_separator(*at)) {
      ++at;
      continue;
    }
    double value;
    const char* mark = parse_mark(at, end);
    const char* stop = mark ? mark : parse_number(at, end, value);
    if (!stop || (stop != end && !is_separator(*stop))) return false;
    ++values;
    if (mark && *at == '-') ++dashes;
    at = stop;
  }
  return values > 1 && dashes < values;
}

bool is_digit(char symbol) { return symbol >= '0' && symbol <= '9'; }

/// Thousands separators other than points and commas: apostrophes, blanks, non-breaking spaces.
constexpr std::string_view other_thousands_marks[]{
    "'", " ", "\xc2\xa0", "\xe2\x80\xaf", "\xe2\x80\x99", "\xa0"};

// Stands for the separator between quoted values; it is ASCII's unit separator, which no text
// contains.
constexpr char between_quotes = '\x1f';

/// Whether a number in the line has a decimal point. The point in the mark "-1.#IND" does not
/// count.
bool has_point(std::string_view line) {
  auto at = line.find('.');
  while (at != line.npos && at + 1 < line.size() && line[at + 1] == '#')
    at = line.find('.', at + 1);
  return at != line.npos;
}

/// The thousands separator of a number, if it certainly is one: another mark is decimal, or the
/// separator occurs twice, or it cannot be decimal. Otherwise empty.
/// known  the thousands separator of earlier lines: if the number has it, three digits after it
///        suffice
std::string_view thousands_mark(std::string_view number, std::string_view known) {
  number = trimmed(number);
  if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
  const auto digits = [](std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
  };
  const std::size_t first = digits(number);
  if (first == 0 || first > 3 || number.front() == '0') return {};
  const std::string_view tail = number.substr(first);
  std::string_view mark = tail.substr(0, tail.starts_with(',') || tail.starts_with('.') ? 1 : 0);
  for (const std::string_view other : other_thousands_marks)
    if (tail.starts_with(other)) mark = tail.substr(0, other.size());
  if (mark.empty()) return {};
  std::size_t groups = 0;
  std::string_view rest = tail;
  while (rest.starts_with(mark) && digits(rest.substr(mark.size())) == 3) {
    rest.remove_prefix(mark.size() + 3);
    ++groups;
  }
  const bool decimal = rest.starts_with(',') || rest.starts_with('.');
  if (groups == 0 || (decimal && rest.starts_with(mark))) return {};
  const std::size_t fraction = decimal ? digits(rest.substr(1)) + 1 : 0;
  if (rest.size() > fraction) return {};
  const bool certain = decimal || groups > 1 || mark == known || (mark != "," && mark != ".");
  return certain ? mark : std::string_view();
}

/// Splits a line at semicolons or tabs, to look for thousands separators. In a line whose values
/// are separated by blanks only apostrophes can be thousands separators; the result is empty if it
/// has none.
std::vector<std::string_view> fields_of(std::string_view line) {
  const char between = line.find(';') != line.npos    ? ';'
                       : line.find('\t') != line.npos ? '\t'
                                                      : ' ';
  if (between == ' ' && line.find_first_of("'\xe2") == line.npos) return {};
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(between, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return fields;
}

/// Removes the quotation marks around the values of a line. If commas within the quotation marks
/// are decimal, the commas between the values become semicolons.
std::string without_quotes(std::string_view line) {
  std::string result;
  bool decimal = false, quoted = false;
  const bool tabs = line.find('\t') != line.npos;
  for (std::size_t begin = 0; begin <= line.size(); quoted = !quoted) {
    const std::size_t end = std::min(line.find('"', begin), line.size());
    std::string part(line.substr(begin, end - begin));
    if (const std::string mark(thousands_mark(quoted ? part : "", {})); !mark.empty())
      for (auto at = part.find(mark); at != part.npos; at = part.find(mark))
        part.erase(at, mark.size());
    if (quoted) decimal = decimal || part.find(',') != part.npos;
    if (!quoted && !tabs) std::ranges::replace(part, ',', between_quotes);
    result += part;
    begin = end + 1;
  }
  std::ranges::replace(result, between_quotes, decimal ? ';' : ',');
  return result;
}

/// Whether the line begins with a number, and some number in it certainly has a thousands
/// separator.
bool has_thousands(std::string_view line) {
  return is_digit(line[line.size() > 1 && line.front() == '-']) &&
         std::ranges::any_of(fields_of(line), [](std::string_view field) {
           return !thousands_mark(field, {}).empty();
         });
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80   ? 1
                               : byte < 0xc2 ? 0
                               : byte < 0xe0 ? 2
                               : byte < 0xf0 ? 3
                                             : 4;
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return false;
    i += length;
  }
  return true;
}

/// Whether the blank at this index is the blank in "No Data".
bool within_mark(std::string_view line, std::size_t blank) {
  if (blank < 2) return false;
  const char* mark = parse_mark(line.data() + blank - 2, line.data() + line.size());
  return mark && mark > line.data() + blank;
}

}  // namespace

bool Text::holds(char symbol) const {
  if (!input) return content.find(symbol) != std::string_view::npos;
  std::string piece;
  for (std::uint64_t index = 0; index < input->size(); index += piece.size()) {
    piece.resize(std::min<std::uint64_t>(piece_size, input->size() - index));
    input->read(index, std::as_writable_bytes(std::span(piece)));
    if (piece.find(symbol) != std::string::npos) return true;
  }
  return false;
}

Lines::Lines(const Text& text)
    : input_(text.input), rest_(text.content), end_(text.holds('\n') ? '\n' : '\r') {}

bool Lines::next(std::string_view& line) {
  auto stop = rest_.find(end_);
  while (stop == std::string_view::npos && read_on()) stop = rest_.find(end_);
  if (rest_.empty()) return false;
  line = rest_.substr(0, stop);
  rest_ = stop == std::string_view::npos ? std::string_view() : rest_.substr(stop + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++number_;
  return true;
}

double Lines::share() const {
  if (!input_) return 1;
  return static_cast<double>(index_ - rest_.size()) / static_cast<double>(input_->size());
}

/// Appends the next piece of the file to the unread rest of the present piece. Returns false at the
/// end of the file.
bool Lines::read_on() {
  if (!input_ || index_ == input_->size()) return false;
  piece_.erase(0, piece_.size() - rest_.size());
  // Reads at least as many bytes as the line already has, so that a long line is searched at most
  // twice.
  const std::size_t left = piece_.size(), wanted = std::max(piece_size, left);
  const auto count =
      static_cast<std::size_t>(std::min<std::uint64_t>(wanted, input_->size() - index_));
  if (left > 0 && !fits_into_memory(2. * static_cast<double>(left + count)))
    refuse(input_->path(), "has a line of more than " + std::to_string(left) +
                               " bytes, which does not fit into the memory that is free");
  piece_.resize(left + count);
  input_->read(index_, std::as_writable_bytes(std::span(piece_).subspan(left)));
  rest_ = piece_;
  if (rest_.find('\0', left) != std::string_view::npos) refuse_bytes(input_->path());
  if (index_ == 0) rest_ = without_mark(rest_);
  index_ += count;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_spaces(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

std::string_view require_text(const std::filesystem::path& file, std::string_view content) {
  if (content.find('\0') != std::string_view::npos) refuse_bytes(file);
  return without_mark(content);
}

std::string utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string result;
  for (const char symbol : text) {
    const auto byte = static_cast<unsigned char>(symbol);
    if (byte < 0x80) {
      result += symbol;
    } else {
      result += static_cast<char>(0xc0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return result;
}

bool starts_with_number(std::string_view line) {
  line = trimmed(line);
  if (line.empty()) return false;
  if (line.front() == '"') {
    const std::string plain = without_quotes(line);
    return is_row(plain) ||
           (plain.find_first_of(" \t;,") == plain.npos && starts_with_number(plain)) ||
           has_thousands(plain);
  }
  if (has_thousands(line)) return true;
  double value;
  const char *at = line.data(), *end = at + line.size();
  if (const char* mark = parse_mark(at, end);
      mark && !std::string_view(at, mark).starts_with("--") && *at != '*')
    return is_row(line);
  if (const char* stop = parse_number(at, end, value)) return stop == end || is_separator(*stop);
  const bool empty = *at == ',' || *at == ';';
  return (empty || parse_mark(at, end)) && is_row(line);
}

NumberReader::NumberReader(std::filesystem::path file, bool tabs)
    : file_(std::move(file)), tabs_(tabs) {}

void NumberReader::refuse_line(int number, const std::string& what) const {
  refuse(file_, "line " + std::to_string(number) + " " + what);
}

std::optional<char> NumberReader::symbol() const {
  if (style_.separator == Separator::comma) return ',';
  if (style_.separator == Separator::semicolon) return ';';
  return tabs_ ? std::optional('\t') : std::nullopt;
}

bool NumberReader::ends_with_separator(std::string_view line) const {
  const std::optional<char> between = symbol();
  return between && content_of(line).ends_with(*between);
}

/// The line without blanks at its beginning and end; tabs stay if they separate values.
std::string_view NumberReader::content_of(std::string_view line) const {
  return tabs_ ? without_spaces(line) : trimmed(line);
}

/// The line without thousands separators; nothing if it has none. The separator that is found
/// applies to all later lines.
std::optional<std::string> NumberReader::without_thousands(std::string_view line, int number) {
  std::string mark = thousands_;
  bool found = false;
  const std::vector<std::string_view> fields = fields_of(line);
  for (const std::string_view field : fields)
    if (const std::string_view own = thousands_mark(field, thousands_); !own.empty()) {
      if (!mark.empty() && own != mark)
        refuse_line(number, "holds '" + excerpt(field.data(), field.data() + field.size()) +
                                "' together with numbers that use another thousands separator; "
                                "write the numbers without separators");
      mark = own;
      found = true;
    }
  if (!found) return {};
  if ((mark == "," && style_.decimal_comma) || (mark == "." && has_decimal_point_))
    refuse_line(number, "has a thousands separator, '" + mark +
                            "', which is the decimal mark in earlier lines; write the numbers "
                            "without thousands separators");
  thousands_ = mark;
  std::string plain;
  for (const std::string_view& field : fields) {
    const bool marked = !thousands_mark(field, mark).empty();
    for (std::size_t i = 0; i < field.size();) {
      const bool here =
          marked && i > 0 && is_digit(field[i - 1]) && field.substr(i).starts_with(mark);
      if (!here) plain += field[i];
      i += here ? mark.size() : 1;
    }
    if (&field != &fields.back()) plain += field.data()[field.size()];
  }
  return plain;
}

/// Separator and decimal mark of one line, from this line alone.
NumberReader::Style NumberReader::style_of(std::string_view line, int number) const {
  const bool semicolon = line.find(';') != std::string_view::npos;
  if (line.find(',') == std::string_view::npos)
    return {semicolon ? Separator::semicolon : Separator::blank, false};

  const bool point = has_point(line);
  std::ptrdiff_t commas = 0, commas_before_blank = 0, blanks_after_digit = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool at_end = i + 1 == line.size();
    if (line[i] == ',') {
      ++commas;
      if (at_end || is_blank(line[i + 1])) ++commas_before_blank;
    } else if (is_blank(line[i]) && i > 0 && line[i - 1] != ',' && !is_blank(line[i - 1]) &&
               !at_end && line[i + 1] != ',' && !within_mark(line, i)) {
      ++blanks_after_digit;
    }
  }
  if (semicolon || blanks_after_digit > 0) {
    if (point)
      refuse_line(number, "mixes decimal points with commas, '" +
                              excerpt(line.data(), line.data() + line.size()) +
                              "'; write one separator and points");
    if (commas_before_blank > 0 && !semicolon)
      refuse_line(number, "mixes blanks and commas as separators; use one of them");
    return {semicolon ? Separator::semicolon : Separator::blank, true};
  }
  // The line only has commas. They separate values, unless it can also be read with decimal commas
  // ("1,5" or "1,5e-7,…"), which is refused.
  const bool exponent = line.find_first_of("eE") != std::string_view::npos;
  if (!point && commas_before_blank == 0 && (commas == 1 || exponent))
    refuse_line(number, "can be read with commas as separators or as decimal commas, '" +
                            excerpt(line.data(), line.data() + line.size()) +
                            "'; write decimal points");
  return {Separator::comma, false};
}

void NumberReader::settle(std::string_view line, int number) {
  const bool point = has_decimal_point_ || has_point(line);
  const bool open = !started_ || (!style_.decimal_comma && style_.separator != Separator::comma &&
                                  has_one_of(line, ',', ';'));
  if (open) {
    const Style found = style_of(line, number);
    if (has_decimal_point_ && found.decimal_comma)
      refuse_line(number, "has decimal commas after decimal points; write points");
    if (has_separator_ && found.separator != style_.separator)
      refuse_line(number, "separates its values differently than earlier lines");
    style_ = found;
    has_separator_ = found.separator != Separator::blank || has_one_of(line, ' ', '\t');
    started_ = true;
  }
  has_decimal_point_ = point;
}

/// Reads the value that begins at `at`. Returns its end; nullptr if there is no value.
const char* NumberReader::read(const char* at, const char* end, int number, std::size_t column,
                               double& value) {
  Repeated* const last = column < repeated_.size() ? &repeated_[column] : nullptr;
  if (last && last->size > 0 && end - at > static_cast<std::ptrdiff_t>(last->size) &&
      (is_blank(at[last->size]) || at[last->size] == symbol()) &&
      std::equal(last->text.begin(), last->text.begin() + last->size, at)) {
    value = last->value;
    return at + last->size;
  }
  const char* stop =
      style_.decimal_comma ? parse_comma_number(at, end, value) : parse_number(at, end, value);
  if (stop && stop != end && *stop == '#') {
    if (std::string_view(stop, static_cast<std::size_t>(end - stop)).starts_with("#INF"))
      refuse_line(number, "holds an infinite value; correct it");
    stop = nullptr;
  }
  if (!stop) {
    stop = parse_mark(at, end);
    value = std::numeric_limits<double>::quiet_NaN();
  }
  if (!stop) return nullptr;
  if (std::isinf(value)) refuse_line(number, "holds an infinite value; correct it");
  if (last) {
    const auto size = static_cast<std::size_t>(stop - at);
    last->size = size <= last->text.size() ? size : 0;
    last->value = value;
    std::copy_n(at, last->size, last->text.begin());
  }
  return stop;
}

void NumberReader::append(std::string_view line, int number, std::vector<double>& values) {
  if (line.find('"') != line.npos) {
    append(without_quotes(line), number, values);
    return;
  }
  const bool settled = has_separator_ && has_decimal_point_ && thousands_.empty();
  if (!settled) {
    if (const auto plain = without_thousands(line, number)) {
      append_plain(*plain, number, values);
      return;
    }
  }
  append_plain(line, number, values);
}

void NumberReader::append_plain(std::string_view line, int number, std::vector<double>& values) {
  const bool settled = has_separator_ && has_decimal_point_;
  if (!settled) settle(trimmed(line), number);
  const std::size_t before = values.size();
  const std::string_view content = content_of(line);
  const char* const end = content.data() + content.size();
  const std::optional<char> between = symbol();
  const auto skip = [&](const char* from) {
    while (from != end && is_blank(*from) && *from != between) ++from;
    return from;
  };
  std::size_t column = 0;
  for (const char* at = skip(content.data()); at != end; ++column) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (*at != between) {
      const char* const stop = read(at, end, number, column, value);
      const char* const after = stop ? skip(stop) : nullptr;
      if (!stop || !(after == end || (between ? *after == between : after != stop))) {
        if (const auto plain = without_thousands(line, number)) {
          values.resize(before);
          append_plain(*plain, number, values);
          return;
        }
        // settle() throws for a comma or semicolon that is neither decimal nor a separator in this
        // line.
        if (settled) settle(trimmed(line), number);
        if (!stop)
          refuse_unknown(file_, "line " + std::to_string(number) + " holds '" +
                                    excerpt(at, end, style_.decimal_comma ? " \t;" : " \t;,") +
                                    "', which is not a number; write undefined points as nan");
        refuse_line(number, "holds '" + excerpt(at, end) +
                                "', which is not a number with the separators of the first line");
      }
      at = after;
    }
    if (values.size() == values.capacity()) require_memory(file_, values.capacity());
    values.push_back(value);
    if (at != end && between) at = skip(at + 1);
  }
}

}  // namespace salebra::detail
