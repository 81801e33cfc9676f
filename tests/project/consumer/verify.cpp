// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <salebra/study/verification.hpp>

// salebra::study stands on every other library, hence this links all that is installed, and each
// solver runs once.
int main() {
  int failures = 0;
  for (const salebra::Check& check : salebra::verify_installation()) {
    if (check.passed()) continue;
    std::printf("%s: %.10g, expected %.10g\n", check.name.c_str(), check.value, check.expected);
    ++failures;
  }
  return failures == 0 ? 0 : 1;
}
