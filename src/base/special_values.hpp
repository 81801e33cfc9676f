// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace salebra::detail {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace salebra::detail
