// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/powers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

TEST_CASE("Vectorised powers are those of the standard library", "[powers]") {
  std::vector<double> values;
  for (int k = -2000; k <= 2000; ++k) values.push_back(std::exp(0.0173 * k));
  values.push_back(1.0);
  values.push_back(std::nextafter(1.0, 0.0));
  for (const double exponent : {-1.8, -0.9, 0.5, 1.0, 3.25, -8.0}) {
    std::vector<double> powers = values;
    salebra::raise_to_power(powers, exponent);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const long double exact = powl(values[k], exponent);
      const double bound = 4e-16 * (1 + std::abs(exponent * std::log(values[k])));
      REQUIRE(std::abs(double(powers[k] / exact - 1)) < bound);
    }
    CHECK(powers[4001] == 1.0);
  }
}
