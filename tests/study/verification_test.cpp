// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/study/verification.hpp>

using namespace salebra;

TEST_CASE("A check passes within its tolerance, relative or, around zero, absolute",
          "[verification]") {
  CHECK(Check{"a", 1.0009, 1, 1e-3}.passed());
  CHECK_FALSE(Check{"a", 1.0011, 1, 1e-3}.passed());
  CHECK(Check{"a", -2.001, -2, 1e-3}.passed());
  CHECK(Check{"a", 1e-4, 0, 1e-3}.passed());
  CHECK_FALSE(Check{"a", 1e-2, 0, 1e-3}.passed());
  CHECK_FALSE(Check{"a", std::nan(""), 1, 1e9}.passed());
}

TEST_CASE("Verification can be stopped", "[verification]") {
  CHECK_THROWS_AS(verify_installation([](const ProgressReport&) { return false; }), Interrupted);
}
