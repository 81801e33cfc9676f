// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::detail {

/// 99 % of the lengths of a vector of two normal variables of unit variance are below this,
/// √(−2 ln 0.01).
inline constexpr double significant_length = 3.035;

}  // namespace salebra::detail
