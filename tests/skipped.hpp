// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iostream>
#include <string_view>

namespace salebra::testing {

/// Whether a test cannot do its work here, which it then says: ctest counts it as skipped, not as
/// passed (tests/CMakeLists.txt).
inline bool skipped(bool impossible, std::string_view why) {
  if (impossible) std::cout << "SKIPPED: " << why << std::endl;
  return impossible;
}

}  // namespace salebra::testing
