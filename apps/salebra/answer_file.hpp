// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/result_file.hpp>
#include <string>

#include "session.hpp"

namespace salebra::cli {

/// Writes an answer to --output, if that was given: an HDF5 group of that name with a scalar for each number, a dataset over
/// `sample` for each array, a group for each object, an attribute for each text. For commands whose answer is their whole result.
void write_answer(const Session& session, const std::string& group, const Json& object);

/// SI unit of a name in an answer. A curvature has none in Dimension, since no option takes one.
std::string unit_of(const std::string& name);

/// The same into a file that holds more.
void write_answer(ResultFile& file, const std::string& group, const Json& object);

}  // namespace salebra::cli
