// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
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
  /// Part of the bytes of the file that the lines so far hold; 1 for a text in memory.
  double share() const;

 private:
  bool read_on();

  const InputFile* input_;
  std::uint64_t index_ = 0;  ///< in the file, behind the piece
  std::string piece_;
  std::string_view rest_;
  char end_;
  int number_ = 0;
};

std::string_view trimmed(std::string_view text);
/// Without spaces at its ends; tabs stay.
std::string_view without_spaces(std::string_view text);

/// The content without a byte order mark. Throws InvalidInput for text with NUL bytes.
std::string_view require_text(const std::filesystem::path& file, std::string_view content);

/// Text that is not UTF-8 is taken for Latin-1, in which older programs write "µm" and "Höhe".
std::string utf8(std::string_view text);

/// Whether the first value of the line is a number or "nan", or empty or a mark of an undefined
/// point in a line of nothing but numbers and such marks. A rule of dashes is no line of numbers.
bool starts_with_number(std::string_view line);

/// Values of the lines of one text. How they are separated and written is what the lines so far
/// have shown: whole numbers leave open whether commas are decimal.
class NumberReader {
 public:
  /// tabs   each separates two values, of which one may be empty; else any blanks do
  explicit NumberReader(std::filesystem::path file, bool tabs = false);

  /// Appends the values of a line; an empty field is NaN, a separator at the end of the line none.
  /// The marks of undefined points are NaN: "***" and "---" of two characters or more, "NA", "N/A",
  /// "BAD", "No Data", "null", "1.#IND" and the like. Values may be in quotation marks, and have
  /// the exponents of Fortran, "1.0D-03". Marks of thousands are read where they can be nothing
  /// else: "1,234.5" between semicolons or tabs, "1'234.5".
  /// throws   InvalidInput naming the line and what was found in it; where the line can be read in
  ///          two ways; and where it contradicts the lines before
  /// Cost: one pass, no allocation but values'.
  void append(std::string_view line, int number, std::vector<double>& values);

  /// Whether a line has been read.
  bool started() const { return started_; }
  /// Between values that may be empty; nothing where blanks separate them.
  std::optional<char> symbol() const;
  /// Whether the lines so far have shown which mark is decimal.
  bool has_decimal_points() const { return has_decimal_point_; }
  bool has_decimal_commas() const { return style_.decimal_comma; }
  /// Whether the line ends with such a separator: a value that is empty, or nothing.
  bool ends_with_separator(std::string_view line) const;

 private:
  enum class Separator { blank, comma, semicolon };
  struct Style {
    Separator separator = Separator::blank;
    bool decimal_comma = false;
  };
  /// A value with its text.
  struct Repeated {
    std::array<char, 24> text;
    std::size_t size = 0;
    double value = 0;
  };

  std::string_view content_of(std::string_view line) const;
  std::optional<std::string> without_thousands(std::string_view line, int number);
  void append_plain(std::string_view line, int number, std::vector<double>& values);
  Style style_of(std::string_view line, int number) const;
  void settle(std::string_view line, int number);
  const char* read(const char* at, const char* end, int number, std::size_t column, double& value);
  [[noreturn]] void refuse_line(int number, const std::string& what) const;

  std::filesystem::path file_;
  bool tabs_;
  bool started_ = false;
  Style style_;
  std::string thousands_;  ///< the mark between them, where a line has shown one
  bool has_separator_ = false, has_decimal_point_ = false;  ///< in a line so far
  /// Points of a grid repeat one of their coordinates from line to line.
  std::array<Repeated, 2> repeated_;
};

}  // namespace salebra::detail
