// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/result_file.hpp>

#include "io/json.hpp"

namespace salebra::detail {

/// What the page draws, out of a results file: SI units, seven digits, null where a value is
/// unknown, keys left out where the file does not hold what they stand for. report/report.js names
/// the keys. Throws InvalidInput for a file without a study.
Json report_payload(const ResultReader& results);

/// Adds what `oscillate` wrote to the damping of a payload: its work per cycle at the force of its
/// mean indentation. Throws InvalidInput for a file without such results, of another normal
/// amplitude, or where the payload has no single damping.
void add_direct(Json& payload, const ResultReader& oscillation);

}  // namespace salebra::detail
