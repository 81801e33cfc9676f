// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <string>
#include <vector>

namespace salebra {

/// One number that this installation computes, beside what analysis says of it.
struct Check {
  std::string name;
  double value = 0;
  double expected = 0;
  double tolerance = 0;  ///< relative to expected, absolute where that is 0
  bool passed() const;
};

/// Runs the solvers on problems with known solutions: Hertz's sphere, Westergaard's full contact,
/// Greenwood–Williamson with exponential heights, the integrals J(k), the theorem against the
/// closed forms, the moments of a generated surface. Cost: a few seconds. Throws Interrupted if
/// progress says stop.
std::vector<Check> verify_installation(const Progress& progress = {});

}  // namespace salebra
