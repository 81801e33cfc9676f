// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace salebra::detail {

/// Tags before the lists of a NetCDF header (Unidata, "NetCDF Classic Format Specification").
inline constexpr std::uint32_t dimension_tag = 10, variable_tag = 11, attribute_tag = 12;

}  // namespace salebra::detail
