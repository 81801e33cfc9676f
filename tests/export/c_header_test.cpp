// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/c_header.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/damping/contact_element.hpp>
#include <string>

#include "io/scratch.hpp"

using namespace salebra;

namespace {

// Reads δ x y from one file, and writes F, F_x, F_y and the derivatives to another. It tries each
// step before it takes it.
constexpr const char* driver = R"(
#include "bolt.h"
#include <stdio.h>
int main(void) {
  bolt_state state;
  double at[3];
  FILE *path = fopen("path.txt", "r"), *out = fopen("forces.txt", "w");
  bolt_start(&state, 0, 0, 0);
  while (fscanf(path, "%lf %lf %lf", at, at + 1, at + 2) == 3) {
    bolt_forces tried = bolt_step(&state, NULL, at[0], at[1], at[2]);
    bolt_forces taken = bolt_step(&state, &state, at[0], at[1], at[2]);
    int i, j;
    if (tried.tangential_force[0] != taken.tangential_force[0]) return 1;
    fprintf(out, "%.17g %.17g %.17g", taken.normal_force, taken.tangential_force[0], taken.tangential_force[1]);
    for (i = 0; i < 3; ++i)
      for (j = 0; j < 3; ++j) fprintf(out, " %.17g", taken.stiffness[i][j]);
    fprintf(out, "\n");
  }
  return fclose(out);
}
)";

/// Compares both on a random path from `farthest` to `highest`. Returns the number of its steps at
/// which the surfaces are apart.
int compare(const ContactLaw& law, double lowest, double highest, double friction,
            double farthest) {
  const auto springs = std::make_shared<const LawSprings>(
      law, lowest, highest, LawSpringsOptions{.friction_coefficient = friction, .springs = 40});
  // Millimetres and kilonewtons, so the comparison with SI checks the units too.
  const CHeaderOptions options{
      .name = "bolt", .comment = {"one", "two"}, .length_unit = 1e-3, .force_unit = 1e3};
  const Scratch scratch;
  scratch.file("bolt.h", c_header(*springs, options));
  scratch.file("driver.c", driver);
  std::mt19937_64 bits(5);
  const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  std::vector<std::array<double, 3>> path;
  std::ofstream file(scratch / "path.txt");
  file.precision(17);
  for (int i = 0; i < 2000; ++i) {
    path.push_back({std::lerp(farthest, highest, uniform()), 4e-8 * (2 * uniform() - 1),
                    4e-8 * (2 * uniform() - 1)});
    for (const double one : path.back()) file << one * 1e3 << ' ';
    file << '\n';
  }
  file.close();
  const std::string there = "cd '" + scratch.folder().string() + "' && ";
  REQUIRE(std::system((there + SALEBRA_COMPILER +
                       " -x c -std=c99 -pedantic -Wall -Wextra -Werror driver.c -o driver -lm")
                          .c_str()) == 0);
  REQUIRE(std::system((there + "./driver").c_str()) == 0);
  // Tolerance: round-off of sums of forty levels, relative to the largest number of each kind.
  const double force = law.force(highest), stiffness = law.normal_stiffness(highest);
  ContactElement element(springs);
  element.start(0, 0, 0);
  std::ifstream forces(scratch / "forces.txt");
  double worst_force = 0, worst_stiffness = 0;
  int apart = 0;
  for (const auto& [indentation, x, y] : path) {
    const ElementForces here = element.move_to(indentation, x, y);
    std::array<double, 3> found{};
    for (double& one : found) forces >> one;
    for (std::size_t i = 0; i < 3; ++i) {
      const double expected = i == 0 ? here.normal_force : here.tangential_force[i - 1];
      worst_force = std::max(worst_force, std::abs(found[i] * 1e3 - expected) / force);
    }
    REQUIRE(found[0] >= 0);
    if (std::isfinite(friction))
      REQUIRE(std::hypot(found[1], found[2]) <= friction * found[0] * (1 + 1e-12) + 1e-17 * force);
    if (indentation <= law.first_touch()) {
      ++apart;
      REQUIRE(found == std::array<double, 3>{});
      REQUIRE(here.normal_force == 0);
    }
    for (const auto& row : here.stiffness)
      for (const double expected : row) {
        double found = std::numeric_limits<double>::quiet_NaN();
        forces >> found;
        worst_stiffness = std::max(worst_stiffness, std::abs(found * 1e6 - expected) / stiffness);
      }
  }
  CHECK(forces.good());
  CHECK(worst_force < 1e-13);
  CHECK(worst_stiffness < 1e-11);
  return apart;
}

}  // namespace

TEST_CASE("A C header takes the steps of a contact element") {
  constexpr double ratio = 0.8;
  for (const double friction : {0.3, std::numeric_limits<double>::infinity()}) {
    compare(ExponentialLaw(10, 1e-7, ratio), -5e-8, 5e-8, friction, -7e-8);
    CHECK(compare(PowerLaw(1e9, 1.5, ratio), 1e-8, 9e-8, friction, -1e-8) > 100);
    // A table with its own K_t, in which K and K_t scatter.
    ForceCurve curve{.model = "measured", .nominal_area = 1, .samples = {}};
    for (int i = 0; i < 60; ++i) {
      const double force = 1e-3 * std::pow(1e5, i / 59.0), scatter = 0.05 * std::sin(7.0 * i);
      curve.samples.push_back({.indentation = 1e-7 * std::log(force / 10),
                               .force = force,
                               .normal_stiffness = force / 1e-7 * (1 - scatter),
                               .tangential_stiffness = ratio * force / 1e-7 * (1 + scatter)});
    }
    const TabulatedLaw law(curve, ratio);
    compare(law, -5e-8, 5e-8, friction, -7e-8);
    // Apart in a tenth of the steps, and between first touch and the lowest load in others.
    CHECK(compare(law, -5e-8, 5e-8, friction, law.first_touch() - 1e-7) > 100);
    CHECK(compare(law, law.first_touch(), 5e-8, friction, law.first_touch() - 1e-7) > 100);
  }
}

TEST_CASE("A C header has a name of C") {
  const LawSprings springs(ExponentialLaw(10, 1e-7, 0.8), -5e-8, 5e-8);
  for (const char* name : {"", "2nd", "a-b"})
    CHECK_THROWS_WITH(c_header(springs, {.name = name}), Catch::Contains("must be a name of C"));
}
