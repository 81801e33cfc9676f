// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

#include "session.hpp"

namespace salebra::cli {

/// Writes an answer to --output, if that was given: an HDF5 group of that name with a scalar for
/// each number, a dataset over `sample` for each array, a group for each object, an attribute for
/// each text. For commands whose answer is their whole result.
void write_answer(const Session& session, const std::string& group, const Json& object);

/// The quantity of a member of an answer. Members of an object that is itself a quantity share it:
/// "decay_length_by_weights" holds lengths, one of which is called "force". object: name of the
/// object; empty: the answer.
Quantity quantity_of(const std::string& name, const std::string& object);

/// A number, 1 or 0 of a truth, NaN of null.
double number_of(const Json& value);

/// Writes the answer into a file that holds more.
void write_answer(ResultFile& file, const std::string& group, const Json& object);

}  // namespace salebra::cli
