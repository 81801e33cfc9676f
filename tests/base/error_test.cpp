// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>
#include <type_traits>

#include "base/printable.hpp"

using namespace salebra;

namespace {

template <class Action>
InvalidInput refusal(Action action) {
  try {
    action();
  } catch (const InvalidInput& refused) {
    return refused;
  }
  throw std::logic_error("nothing was refused");
}

}  // namespace

TEST_CASE("A refusal is one line, and has its parts", "[error]") {
  const InvalidInput whole = refusal(
      [] { require(false, "hurst", 1.5, "must be below 1; check that it is not a dimension"); });
  CHECK(whole.what() ==
        std::string("hurst: 1.5 must be below 1; check that it is not a dimension"));
  CHECK(whole.field() == "hurst");
  CHECK(whole.value() == "1.5");
  CHECK(whole.constraint() == "must be below 1");
  CHECK(whole.remedy() == "check that it is not a dimension");
  CHECK(whole.statement() == "1.5 must be below 1; check that it is not a dimension");

  // Only the first semicolon ends the constraint, because a remedy may contain another.
  const InvalidInput two = refusal([] { throw InvalidInput("a.h5", "is cut; copy it; or not"); });
  CHECK(two.what() == std::string("a.h5: is cut; copy it; or not"));
  CHECK(two.field() == "a.h5");
  CHECK(two.value().empty());
  CHECK(two.constraint() == "is cut");
  CHECK(two.remedy() == "copy it; or not");

  const InvalidInput bare = refusal([] { require_positive(-0.25, "tolerance"); });
  CHECK(bare.what() == std::string("tolerance: -0.25 must be a finite number > 0"));
  CHECK(bare.constraint() == "must be a finite number > 0");
  CHECK(bare.remedy().empty());
}

TEST_CASE("Of two things exactly one is given", "[error]") {
  CHECK_NOTHROW(require_one(true, "force", false, "indentation"));
  CHECK_NOTHROW(require_one(false, "force", true, "indentation"));
  CHECK(refusal([] { require_one(true, "force", true, "indentation"); }).what() ==
        std::string("force: given together with indentation; give one of them"));
  CHECK(refusal([] { require_one(false, "force", false, "indentation"); }).what() ==
        std::string("force: not given, nor is indentation; give one of them"));
}

// An exception that throws while it is copied ends the program.
static_assert(std::is_nothrow_copy_constructible_v<InvalidInput>);

TEST_CASE("What a refusal quotes is cut in the middle where it is long", "[error]") {
  CHECK(shortened("short", 5) == "short");
  CHECK(shortened("0123456789", 9) == "0123\u202689");
  // Two-byte characters stay whole.
  CHECK(shortened("\u00b5\u00b5\u00b5\u00b5\u00b5\u00b5", 10) == "\u00b5\u00b5\u2026\u00b5");
  const InvalidInput refusal("field", std::string(100'000, '7'), "must be small; give another");
  CHECK(refusal.value().size() <= 255);
  CHECK(refusal.what() == "field: " + refusal.value() + " must be small; give another");
  CHECK(refusal.remedy() == "give another");
}
