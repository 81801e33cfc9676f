// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "session.hpp"

namespace salebra::cli {

/// A JSON answer for people: "name  value unit" lines, lists of one length side by side as a table, a list of objects as a table of
/// its own, objects indented. Units and prefixes come from quantity_of.
std::string to_text(const Json& object);

/// Columns padded to their widest cell; the first row is the heading. names_first: the first column
/// is text. A table that is wider than text_width() comes in parts, each with the first column.
std::string to_table(const std::vector<std::vector<std::string>>& rows, int indent = 2,
                     bool names_first = false);

}  // namespace salebra::cli
