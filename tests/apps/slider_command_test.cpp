// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of `salebra sliding` with a slider on a spring.
#include <catch2/catch.hpp>
#include <string>

#include "run_program.hpp"

using Catch::Contains;

namespace {

const std::string contact =
    "sliding --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 ";
const std::string body = "--mass 10g --spring-stiffness 1kN/m ";
const std::string slider = contact + body + "--friction-coefficient 0.3 --velocities 50um/s ";

}  // namespace

TEST_CASE("A slider sticks and slips without an oscillation, and slides with one", "[slider]") {
  const ProgramTest test;
  const auto jerks = test.answer(slider + "--falling-slope 1");
  CHECK(jerks["state"] == "stick_slip");
  CHECK(jerks["averaged"]["state"] == "stick_slip");
  // The closed form of tests/damping/slider_test.cpp, 263.026 nm, of a rigid contact; 1 % of it is
  // elastic.
  CHECK(jerks["averaged"]["slider_amplitude"] == Approx(2.63026e-7).epsilon(1e-5));
  CHECK(jerks["slider_amplitude"] == Approx(2.63e-7).epsilon(0.02));
  CHECK_FALSE(jerks.contains("threshold_amplitude"));

  const auto slides =
      test.answer(slider + "--falling-slope 1 --normal-amplitude 2nm --frequency 20kHz");
  CHECK(slides["state"] == "steady");
  CHECK(slides["stable"] == true);
  CHECK(keys(slides["premises"]) == keys(jerks["premises"]));
  CHECK(slides["premises"]["amplitude"]["verdict"] == "holds");
  CHECK(slides["slider_period"].is_null());
  const auto& threshold = slides["threshold_amplitude"];
  CHECK(threshold["value"] ==
        Approx(threshold["linear_estimate"])
            .margin(threshold["linear_estimate_error"].get<double>() + 2e-12));
  // The slope and the mean are those of steady sliding.
  const auto friction = test.answer(
      "sliding --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 "
      "--friction-coefficient 0.3 --normal-amplitude 2nm --frequency 20kHz --velocities 50um/s");
  CHECK(slides["sliding_damping"] == Approx(friction["sliding_damping"][0]).epsilon(1e-10));
  CHECK(slides["mean_tangential_force"] ==
        Approx(friction["mean_tangential_force"][0]).epsilon(1e-3));
  CHECK(slides["critical_velocity"] == Approx(friction["critical_velocity"]).epsilon(1e-10));
}

TEST_CASE("The path of a slider is written with its means", "[slider]") {
  const ProgramTest test;
  test.done(slider + "--falling-slope 1 -o path.csv");
  CHECK_THAT(test.read("path.motion.csv"),
             Contains("slider_offset") && Contains("slider_velocity"));
  CHECK_THAT(test.read("path.csv"), Contains("slider_amplitude"));
}
