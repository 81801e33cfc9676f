// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace salebra::detail {

/// A piece (token) of a line of a header.
struct HeaderToken {
  enum class Kind {
    word,    ///< letters, and digits after them
    number,  ///< as written, "1,1" or "-9999"
    date,    ///< a date, a time or a version number
    length,  ///< a unit of length: in brackets, or after a number, a slash or an underscore
    /// A unit of another quantity, in brackets, or after a number, a slash or an underscore.
    other,
    ratio,      ///< a length per something else than a time, such as "nm/V"
    separator,  ///< between columns: tab, comma or semicolon
    assign,     ///< colon or equals sign
    times       ///< between two numbers: "10 x 10"
  };
  Kind kind;
  std::string text;
  bool bracket = false;    ///< the token is in brackets
  bool per_pixel = false;  ///< the token is a length per pixel, such as "µm/pixel"
  bool apart = false;      ///< two or more blanks precede the token
};

/// Splits a UTF-8 line into its pieces.
std::vector<HeaderToken> header_tokens(std::string_view line);

/// Whether a text is a unit of length by itself.
bool is_length_unit(std::string_view text);

/// Whether a text is a unit of another quantity: V, °C, mm/s.
bool is_other_unit(std::string_view text);

}  // namespace salebra::detail
