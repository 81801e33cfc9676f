// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/progress.hpp>
#include <string>
#include <vector>

namespace salebra {

/// One number computed by this installation, with its analytical value.
struct Check {
  std::string name;
  double value = 0;
  double expected = 0;
  double tolerance = 0;  ///< relative to expected; absolute if expected is 0
  bool passed() const;
};

constexpr void describe(auto&& visit, std::type_identity<Check>) {
  using enum Dimension;
  using S = Check;
  visit(&S::name, Quantity{"name", dimensionless, "what is computed"});
  visit(&S::value, Quantity{"value", dimensionless, "what this installation computes"});
  visit(&S::expected, Quantity{"expected", dimensionless, "what analysis says"});
  visit(&S::tolerance,
        Quantity{"tolerance", dimensionless, "relative to expected, absolute where that is 0"});
  visit(&S::passed, Quantity{"passed", dimensionless, "whether they agree"});
}

/// Runs the solvers on problems with known solutions: Hertz's sphere, Westergaard's full contact,
/// Greenwood–Williamson with exponential heights, the integrals J(k) of
/// closed_form::drag_integral_scaled(), relaxation_damping() against the closed forms, and the
/// moments of a generated surface.
///
///     bool works = std::ranges::all_of(verify_installation(), &Check::passed);
///
/// Cost: a few seconds. Throws Interrupted if progress says stop.
std::vector<Check> verify_installation(const Progress& progress = {});

}  // namespace salebra
