// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input_file.hpp"

/// Numbers in lines of text, as programs of many countries write them.
namespace salebra::detail {

/// A text in memory or in a file, of which then only pieces are in memory.
struct Text {
  std::string_view content = {};     ///< without a byte order mark
  const InputFile* input = nullptr;  ///< in place of the content

  bool holds(char symbol) const;
};

/// Lines of a text with their numbers (from 1); ends with LF, CR LF or, where there is no LF at
/// all, CR.
class Lines {
 public:
  explicit Lines(const Text& text);
  explicit Lines(std::string_view content) : Lines(Text{content}) {}
  /// False at the end of the text; line is without its end, and lasts until the next call.
  /// throws   InvalidInput for NUL bytes in a file, and for a line that does not fit into the memory
  bool next(std::string_view& line);
  int number() const { return number_; }

 private:
  bool read_on();

  const InputFile* input_;
  std::uint64_t place_ = 0;  ///< in the file, behind the piece
  std::string piece_;
  std::string_view rest_;
  char end_;
  int number_ = 0;
};

std::string_view trimmed(std::string_view text);
/// Without spaces at its ends; tabs stay.
std::string_view without_spaces(std::string_view text);

/// What separates the values of a line.
enum class Separator { blank, comma, semicolon };

struct NumberFormat {
  Separator separator = Separator::blank;
  bool decimal_comma = false;
  bool has_separator = false;      ///< in a line so far
  bool has_decimal_point = false;  ///< in a line so far
  bool tabs = false;  ///< of blanks, one tab separates two values: between two tabs is none

  /// Between values that may be empty; nothing where blanks separate them.
  std::optional<char> symbol() const;
};

/// The content without a byte order mark. Throws InvalidInput for text with NUL bytes.
std::string_view require_text(const std::filesystem::path& file, std::string_view content);

/// Text that is not UTF-8 is taken for Latin-1, in which older programs write "µm" and "Höhe".
std::string utf8(std::string_view text);

/// Whether the first value of the line is a number or "nan", or empty or a mark of an undefined
/// point in a line of nothing but numbers and such marks. A rule of dashes is no line of numbers.
bool starts_with_number(std::string_view line);

/// Whether the line ends with a separator that is no blank: a value that is empty, or nothing.
bool ends_with_separator(std::string_view line, const NumberFormat& format);

/// How the values of a line of numbers are separated and written. Lines before it have the say, if
/// `format` holds a value; a line of whole numbers leaves open whether commas are decimal. Throws
/// InvalidInput where the line can be read in two ways, and where it contradicts the lines before.
void settle_format(const std::filesystem::path& file, std::string_view line, int number,
                   std::optional<NumberFormat>& format);

/// Appends the values of a line; an empty field is NaN, a separator at the end of the line none.
/// The marks of undefined points are NaN: "***" and "---" of two characters or more, "NA", "N/A",
/// "BAD" and "No Data".
/// Throws InvalidInput naming the line and what was found in it. Cost: one pass, no allocation but
/// values'.
void append_numbers(const std::filesystem::path& file, std::string_view line, int number,
                    const NumberFormat& format, std::vector<double>& values);

}  // namespace salebra::detail
