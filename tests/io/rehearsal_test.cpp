// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../src/io/rehearsal.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <salebra/base/error.hpp>
#include <stdexcept>

using namespace salebra;
using Catch::Contains;

TEST_CASE("Work that would end the program is refused, and nothing of it stays", "[rehearsal]") {
  int value = 1;
  const auto rehearsed = [&](const std::function<void()>& work) {
    detail::rehearse("a.h5", work, 1);
  };
  CHECK_NOTHROW(rehearsed([&] { value = 2; }));
  CHECK(value == 1);
  CHECK_NOTHROW(rehearsed([] { throw std::runtime_error("the caller will see it"); }));
  for (const int sign : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE})
    CHECK_THROWS_WITH(rehearsed([=] { std::raise(sign); }), Contains("a.h5") && Contains("crash"));
  // Heap corruption that the C library notices is reported on standard error, which the child has not.
  CHECK_THROWS_AS(rehearsed([] {
                    std::fputs("never seen", stderr);
                    std::abort();
                  }),
                  InvalidInput);
  volatile bool endless = true;
  CHECK_THROWS_WITH(rehearsed([&] {
                      while (endless) {
                      }
                    }),
                    Contains("without end"));
}
