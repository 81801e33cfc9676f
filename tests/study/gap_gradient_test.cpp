// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/gap_gradient.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/generators/filtered_noise.hpp>
#include <vector>

using namespace salebra;
using detail::GapGradient;

namespace {

const Material material = Material::of_contact_modulus(3e9, 0.3);
const NormalContactOptions exact{.tolerance = 1e-14};

Surface rough_surface(std::uint64_t seed) {
  const double side = 64e-6;
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 16e-6, .short_cutoff = 4e-6, .rms_height = 100e-9});
  return filtered_noise({64, 64, side, side}, spectrum, seed);
}

std::vector<double> gaps_of(const Surface& surface, double modulus,
                            const std::vector<double>& pressures) {
  std::vector<double> gaps;
  for (const double pressure : pressures)
    gaps.push_back(press(surface, modulus, at_pressure(pressure), exact).mean_gap);
  return gaps;
}

}  // namespace

TEST_CASE("The response of the mean gap to a change of heights is that of two contacts",
          "[gap_gradient]") {
  const Surface surface = rough_surface(3), other = rough_surface(4);
  const std::vector<double> pressures{4e6, 8e6, 16e6};
  GapGradient gradient;
  gradient.solve(surface, material, pressures, exact);
  REQUIRE(gradient.contacts().size() == 3);
  // The mean of the heights plays no part.
  const std::vector<double> response = gradient.response(other.heights + 1e-6);
  // Steps at which no cell enters; the rest is round-off and the tolerance over the step.
  const double step = 5e-6;
  Surface above = surface, below = surface;
  above.heights += step * other.heights;
  below.heights -= step * other.heights;
  const auto high = gaps_of(above, 3e9, pressures), low = gaps_of(below, 3e9, pressures);
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    CAPTURE(k);
    const auto set = [&](const Surface& pressed) {
      return contact_set(press(pressed, 3e9, at_pressure(pressures[k]), exact));
    };
    CHECK((set(above) == set(below)).all());
    CHECK(response[k] == Approx((high[k] - low[k]) / (2 * step)).epsilon(1e-6));
  }
}

TEST_CASE("The response of the mean gap obeys the laws of similarity", "[gap_gradient]") {
  const double s = 1.7;
  const Surface surface = rough_surface(5);
  const auto response_of = [&](const Surface& pressed, double modulus, double pressure) {
    GapGradient gradient;
    gradient.solve(pressed, Material::of_contact_modulus(modulus, 0.3), {pressure}, exact);
    // The waves of half the heights at every second column are some change or other.
    Field change = pressed.heights;
    for (Index j = 0; j < change.cols(); j += 2) change.col(j) /= 2;
    return std::pair{gradient.response(change).at(0),
                     gradient.contacts().at(0).sample.normal_stiffness};
  };
  const auto [response, stiffness] = response_of(surface, 3e9, 8e6);
  Surface high = surface, wide = surface;
  high.heights *= s;
  wide.grid.lx *= s;
  wide.grid.ly *= s;
  const auto [of_high, stiffness_of_high] = response_of(high, 3e9, 8e6 * s);
  const auto [of_wide, stiffness_of_wide] = response_of(wide, 3e9, 8e6 / s);
  const auto [of_stiff, stiffness_of_stiff] = response_of(surface, 3e9 * s, 8e6 * s);
  CHECK(of_high == Approx(s * response).epsilon(1e-9));
  CHECK(of_wide == Approx(response).epsilon(1e-9));
  CHECK(of_stiff == Approx(response).epsilon(1e-9));
  CHECK(stiffness_of_high == Approx(stiffness).epsilon(1e-9));
  CHECK(stiffness_of_wide == Approx(s * stiffness).epsilon(1e-9));
  CHECK(stiffness_of_stiff == Approx(s * stiffness).epsilon(1e-9));
}

TEST_CASE("Loads of a response may be solved in any order", "[gap_gradient]") {
  const Surface surface = rough_surface(6);
  GapGradient once, twice;
  once.solve(surface, material, {2e6, 4e6, 8e6}, {});
  twice.solve(surface, material, {4e6}, {});
  twice.solve(surface, material, {2e6, 8e6}, {});
  CHECK(once.response(surface.heights) == twice.response(surface.heights));
  const auto response = once.response(surface.heights);
  for (std::size_t k = 0; k < 3; ++k) {
    const ForceSample& sample = once.contacts()[k].sample;
    // ū(sh, sF) = s ū(h, F), so the response to all heights is ū − F dū/dF = ū + F/K.
    CHECK(response[k] ==
          Approx(sample.mean_gap + sample.force / sample.normal_stiffness).epsilon(1e-6));
  }
}
