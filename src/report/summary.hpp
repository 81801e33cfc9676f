// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/json.hpp>
#include <string>

namespace salebra::detail {

/// Decay length, verdict and damping constants of a report's payload as HTML. The page's script
/// puts its sections in their place.
std::string summary_of(const Json& payload);

}  // namespace salebra::detail
