// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "session.hpp"

namespace salebra::cli {

/// Lays out a JSON answer as text: lines "name  value unit"; lists of equal length as columns of
/// one table; a list of objects as a table; objects indented. Units and SI prefixes follow from
/// quantity_of().
std::string to_text(const Json& object);

/// Pads the cells of each column to the widest one. The first row is the heading. names_first:
/// whether the first column contains text. A table wider than text_width() is divided into parts,
/// each of which begins with the first column.
std::string to_table(const std::vector<std::vector<std::string>>& rows, int indent = 2,
                     bool names_first = false);

}  // namespace salebra::cli
