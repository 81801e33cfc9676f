// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra::detail {

/// A piece of a line of a header.
struct HeaderToken {
  enum class Kind {
    word,       ///< letters, and digits behind them
    number,     ///< as written, "1,1" or "-9999"
    date,       ///< a date, a time or the number of a version
    length,     ///< a unit of length: in brackets, behind a number, a slash or an underscore
    other,      ///< a unit of anything else, there
    ratio,      ///< a length per something that is no time: "nm/V"
    separator,  ///< of columns: tab, comma or semicolon
    assign,     ///< colon or equals sign
    times       ///< between two numbers: "10 x 10"
  };
  Kind kind;
  std::string text;
  bool bracket = false;    ///< in brackets
  bool per_pixel = false;  ///< of a length: "µm/pixel"
  bool apart = false;      ///< behind two blanks or more
};

/// The pieces of a line in UTF-8.
std::vector<HeaderToken> header_tokens(std::string_view line);

/// Whether a text is a unit of length by itself.
bool is_length_unit(std::string_view text);

/// Whether a text is a unit of something else: V, °C, mm/s.
bool is_other_unit(std::string_view text);

}  // namespace salebra::detail
