// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Words in headers of text files, in the languages that instruments write.
namespace salebra::detail {

/// A set of meanings, one bit for each. A word can have several meanings; a phrase has all meanings
/// of its words.
using Meaning = std::uint32_t;

namespace meaning {
constexpr Meaning x = 1, y = 1 << 1, plane = 1 << 2,  ///< axes; plane: x and y together
    z = 1 << 3,                                       ///< the axis of the heights
    height = 1 << 4,                                  ///< heights, or the size of an image along y
    /// Heights named like the vertical axis of a curve: amplitude, profile, depth.
    ordinate = 1 << 5,
                  values = 1 << 6,  ///< the numbers of the file
    position = 1 << 7,              ///< the distance along a profile
    width = 1 << 8,                 ///< size along x
    size = 1 << 9,                  ///< size along the axis that the phrase names
    length = 1 << 10,               ///< length of a profile
    pixel = 1 << 11,                ///< a point of the grid
    step = 1 << 12,                 ///< distance of neighbouring points
    unit = 1 << 13,                 ///<
    count = 1 << 14,                ///<
    columns = 1 << 15, rows = 1 << 16, points = 1 << 17,
                  factor = 1 << 18,  ///< multiplies the heights
    alters = 1 << 19,                ///< changes the heights in another way: offset, inverted
    missing = 1 << 20,               ///< marks undefined points
    mask = 1 << 21,                  ///< marks points as valid or not
    index = 1 << 22,                 ///< is the number of a line
    resolution = 1 << 23,
                  result = 1 << 24,  ///< a statistic of the heights
    harmless = 1 << 25,              ///< irrelevant to the numbers: dates, instruments, conditions
    neutral = 1 << 26,               ///< has no meaning by itself
    other = 1 << 27,                 ///< a quantity that is not a height
    no = 1 << 28,                    ///< negates the words after it
    unknown = 1 << 29,               ///< in no table
    conversion = 1 << 30;            ///< a factor that turns stored heights into lengths

/// Meanings that describe the numbers of the file.
constexpr Meaning carrying = x | y | plane | z | height | values | width | size | length | pixel |
                             step | unit | columns | rows | points | factor | alters | missing |
                             mask | resolution;
}  // namespace meaning

/// Converts a word to lower-case ASCII letters: "Höhe" becomes "hoehe".
std::string plain_word(std::string_view word);

/// The meanings of one word. A word that is not in the table may be a compound of words of the
/// table, such as "Pixelgröße" or "ScanSizeX".
Meaning meaning_of(std::string_view word);

/// Whether an entry of a file, such as "z_scale = 2", says something about the numbers of the file:
/// their unit, scale, spacing or mask. An entry whose key has unknown words counts if its value
/// contains a number or a unit.
bool is_about_numbers(std::string_view key, std::string_view value);

}  // namespace salebra::detail
