// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/sweep.hpp>

#include "normal/rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;

TEST_CASE("A sweep is the curve of its single contacts, whatever the number of loads at once",
          "[sweep]") {
  const Surface surface = rough_surface({64, 64, 1e-3, 1e-3});
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const std::vector<double> pressures{1e5, 1e6, 5e6, 2e7};
  SweepOptions options;
  options.contact.tolerance = 1e-12;
  options.concurrent_loads = GENERATE(1, 3);
  const ForceCurve curve = sweep_pressures(surface, material, pressures, options);
  CHECK(curve.model == "bem");
  CHECK(curve.nominal_area == Approx(1e-6));
  CHECK(curve.rms_height == Approx(rms_height(surface)).epsilon(1e-12));
  REQUIRE(curve.samples.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const ForceSample& sample = curve.samples[k];
    const auto state =
        press(surface, material.contact_modulus, at_pressure(pressures[k]), options.contact);
    CHECK(sample.converged);
    CHECK(sample.mean_gap == state.mean_gap);
    CHECK(sample.force == Approx(pressures[k] * 1e-6).epsilon(1e-12));
    CHECK(sample.normal_stiffness ==
          normal_stiffness(state, surface.grid, material.contact_modulus, options.contact));
    CHECK(sample.tangential_stiffness ==
          Approx(material.modulus_ratio() * sample.normal_stiffness));
    if (k > 0) CHECK(sample.mean_gap < curve.samples[k - 1].mean_gap);
  }
  // dF = −K dū by the trapezoidal rule over one short step.
  const std::vector<double> close{5e6, 5.05e6};
  const ForceCurve step = sweep_pressures(surface, material, close, options);
  const double mean_stiffness =
      0.5 * (step.samples[0].normal_stiffness + step.samples[1].normal_stiffness);
  const double difference = (step.samples[1].force - step.samples[0].force) /
                            (step.samples[0].mean_gap - step.samples[1].mean_gap);
  CHECK(difference == Approx(mean_stiffness).epsilon(5e-3));
}

TEST_CASE("Without a tangential modulus a sweep has no tangential stiffness", "[sweep]") {
  const Surface surface = rough_surface({32, 32, 1e-3, 1e-3});
  const ForceCurve curve = sweep_pressures(surface, Material::of_contact_modulus(1e9), {1e6});
  CHECK(std::isnan(curve.samples[0].tangential_stiffness));
  CHECK(curve.samples[0].normal_stiffness > 0);
}

TEST_CASE("A sweep refuses pressures that do not increase and keeps what was finished when stopped",
          "[sweep]") {
  const Surface surface = rough_surface({32, 32, 1e-3, 1e-3});
  const Material material = Material::of_contact_modulus(1e9);
  CHECK_THROWS_AS(sweep_pressures(surface, material, {}), InvalidInput);
  CHECK_THROWS_AS(sweep_pressures(surface, material, {1e6, 1e6}), InvalidInput);
  CHECK_THROWS_AS(sweep_pressures(surface, material, {-1, 1e6}), InvalidInput);
  SweepOptions options;
  options.concurrent_loads = 1;
  options.contact.on_progress = [](const ProgressReport& report) { return report.step < 2; };
  const ForceCurve curve = sweep_pressures(surface, material, {1e5, 1e6, 2e6, 3e6}, options);
  CHECK(curve.samples.size() == 2);
}
