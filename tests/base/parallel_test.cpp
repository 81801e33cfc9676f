// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

using namespace salebra;

TEST_CASE("Slabs cover every row once, and sums have the same bits for every thread count",
          "[parallel]") {
  const Index rows = GENERATE(1, 3, 64, 65, 1000);
  std::vector<int> visits(std::size_t(rows), 0);
  double first_sum = 0;
  for (const int threads : {1, 2, 5}) {
    parallel::set_threads(threads);
    parallel::for_slabs(rows, [&](Index begin, Index end) {
      for (Index row = begin; row < end; ++row) ++visits[std::size_t(row)];
    });
    const double sum = parallel::sum_slabs(rows, [](Index begin, Index end) {
      double part = 0;
      for (Index row = begin; row < end; ++row) part += 1 / std::sqrt(double(row) + 0.1);
      return part;
    });
    if (threads == 1) first_sum = sum;
    CHECK(sum == first_sum);
  }
  parallel::set_threads(0);
  CHECK(visits == std::vector<int>(std::size_t(rows), 3));
}

TEST_CASE("An exception in a slab reaches the caller", "[parallel]") {
  CHECK_THROWS_AS(parallel::for_slabs(10, [](Index, Index) { throw InvalidInput("x"); }),
                  InvalidInput);
}
