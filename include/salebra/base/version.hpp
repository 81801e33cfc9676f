// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace salebra {

/// The version of this library, "major.minor.patch": the one of CMake's project().
std::string_view version();

}  // namespace salebra
