// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/result_file.hpp>

#include "io/json.hpp"

namespace salebra::detail {

/// The data of a report page, read from a results file: numbers in SI units with seven digits, null
/// for unknown values. Keys without data in the file are left out. The scripts in report/src read
/// the keys. Throws InvalidInput for a file without a study.
Json report_payload(const ResultReader& results);

/// Adds a result of `salebra oscillate` to the damping data of a payload: the loss per cycle, and
/// the force at the mean indentation. Throws InvalidInput for a file without such a result, for
/// another normal amplitude than that of the payload, and unless the payload has exactly one point
/// of the parameter grid with damping.
void add_direct(Json& payload, const ResultReader& oscillation);

}  // namespace salebra::detail
