// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input_file.hpp"

/// Reads numbers from lines of text in the notations of many countries.
namespace salebra::detail {

/// A text in memory, or in a file that is read piece by piece.
struct Text {
  std::string_view content = {};     ///< the text without byte order mark, if it is in memory
  const InputFile* input = nullptr;  ///< the file, if the text is not in memory

  bool holds(char symbol) const;
};

/// The lines of a text and their numbers, from 1 on. A line ends with LF or CR LF; with CR if the
/// text has no LF at all.
class Lines {
 public:
  explicit Lines(const Text& text);
  explicit Lines(std::string_view content) : Lines(Text{content}) {}
  /// Sets `line` to the next line, without its end. It stays valid until the next call. Returns
  /// false at the end of the text.
  /// throws   InvalidInput for NUL bytes in a file, and for a line that does not fit into memory
  bool next(std::string_view& line);
  int number() const { return number_; }
  /// Fraction of the bytes of the file that the lines so far contain; 1 for a text in memory.
  double share() const;

 private:
  bool read_on();

  const InputFile* input_;
  std::uint64_t index_ = 0;  ///< offset in the file of the end of the piece in memory
  std::string piece_;
  std::string_view rest_;
  char end_;
  int number_ = 0;
};

std::string_view trimmed(std::string_view text);
/// The text without spaces at its beginning and end; tabs stay.
std::string_view without_spaces(std::string_view text);

/// The content without a byte order mark. Throws InvalidInput for text with NUL bytes.
std::string_view require_text(const std::filesystem::path& file, std::string_view content);

/// The text in UTF-8. Text that is not UTF-8 is read as Latin-1, in which older programs write "µm"
/// and "Höhe".
std::string utf8(std::string_view text);

/// Whether a line contains numbers of the surface: its first value is a number or "nan", or the
/// first value is empty or marks an undefined point and all other values are numbers or such marks.
/// A line that only consists of dashes does not count.
bool starts_with_number(std::string_view line);

/// Reads the values in the lines of one text. From the lines read so far it learns how values are
/// separated and whether commas are decimal; a line of whole numbers may leave both open.
class NumberReader {
 public:
  /// tabs   true: every tab separates two values, so a value may be empty; false: any number of
  ///        blanks and tabs separates two values
  explicit NumberReader(std::filesystem::path file, bool tabs = false);

  /// Appends the values of a line to `values`. An empty field is NaN; a separator at the end of the
  /// line adds no value. Marks of undefined points are NaN: "***" and "---" of two characters or
  /// more, "NA", "N/A", "BAD", "No Data", "null", "1.#IND" and the like. Values may be in quotation
  /// marks, and may have Fortran exponents such as "1.0D-03". Thousands separators are only
  /// accepted if they can be nothing else: "1,234.5" between semicolons or tabs, "1'234.5". Cost:
  /// one pass; only `values` allocates.
  /// throws   InvalidInput naming the line and the text found in it, also if the line can be
  ///          read in two ways, or contradicts earlier lines
  void append(std::string_view line, int number, std::vector<double>& values);

  /// Whether a line has been read.
  bool started() const { return started_; }
  /// The separator, if values between two of it may be empty; nothing if blanks separate the
  /// values.
  std::optional<char> symbol() const;
  /// Whether the lines so far contain a number with a decimal point, or with a decimal comma.
  bool has_decimal_points() const { return has_decimal_point_; }
  bool has_decimal_commas() const { return style_.decimal_comma; }
  /// Whether the line ends with symbol(). The line may then end with an empty value or not.
  bool ends_with_separator(std::string_view line) const;

 private:
  enum class Separator { blank, comma, semicolon };
  struct Style {
    Separator separator = Separator::blank;
    bool decimal_comma = false;
  };
  /// A value and the text from which it was parsed.
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
  /// The thousands separator; empty if no line so far has certainly shown one.
  std::string thousands_;
  /// Whether some line so far has a separator, a decimal point.
  bool has_separator_ = false, has_decimal_point_ = false;
  /// The last values of the first two columns. In a list of the points of a grid, one coordinate is
  /// the same in many lines, and is not parsed again.
  std::array<Repeated, 2> repeated_;
};

}  // namespace salebra::detail
