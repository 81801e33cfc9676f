// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of `salebra sliding` with a slider on a spring.
#include <catch2/catch.hpp>
#include <string>

#include "run_program.hpp"

namespace {

const std::string contact =
    "sliding --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 ";
const std::string body = "--mass 10g --spring-stiffness 1kN/m ";
const std::string slider = contact + body + "--friction-coefficient 0.3 --velocities 50um/s ";

}  // namespace

TEST_CASE("A slider sticks and slips without an oscillation, and slides with one", "[slider]") {
  const ProgramTest test;
  const auto jerks = test.run(slider + "--falling-slope 1 --json").json();
  CHECK(jerks["state"] == "stick_slip");
  CHECK(jerks["averaged"]["state"] == "stick_slip");
  // The closed form of tests/damping/slider_test.cpp, 263.026 nm, of a rigid contact; 1 % of it is
  // elastic.
  CHECK(jerks["averaged"]["slider_amplitude"].get<double>() == Approx(2.63026e-7).epsilon(1e-5));
  CHECK(jerks["slider_amplitude"].get<double>() == Approx(2.63e-7).epsilon(0.02));
  CHECK_FALSE(jerks.contains("threshold_amplitude"));

  const auto slides =
      test.run(slider + "--falling-slope 1 --normal-amplitude 2nm --frequency 20kHz --json").json();
  CHECK(slides["state"] == "steady");
  CHECK(slides["stable"] == true);
  CHECK(keys(slides["premises"]) == keys(jerks["premises"]));
  CHECK(slides["premises"]["amplitude"]["verdict"] == "holds");
  CHECK(slides["slider_period"].is_null());
  const auto& threshold = slides["threshold_amplitude"];
  CHECK(threshold["value"].get<double>() ==
        Approx(threshold["linear_estimate"].get<double>())
            .margin(threshold["linear_estimate_error"].get<double>() + 2e-12));
  // The slope and the mean are those of steady sliding.
  const auto friction =
      test.run(
              "sliding --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 "
              "--friction-coefficient 0.3 --normal-amplitude 2nm --frequency 20kHz --velocities "
              "50um/s --json")
          .json();
  CHECK(slides["sliding_damping"].get<double>() ==
        Approx(friction["sliding_damping"][0].get<double>()).epsilon(1e-10));
  CHECK(slides["mean_tangential_force"].get<double>() ==
        Approx(friction["mean_tangential_force"][0].get<double>()).epsilon(1e-3));
  CHECK(slides["critical_velocity"].get<double>() ==
        Approx(friction["critical_velocity"].get<double>()).epsilon(1e-10));
}

TEST_CASE("The path of a slider is written with its means", "[slider]") {
  const ProgramTest test;
  REQUIRE(test.run(slider + "--falling-slope 1 -o path.csv").status == 0);
  CHECK_THAT(test.read("path.motion.csv"),
             Catch::Contains("slider_offset") && Catch::Contains("slider_velocity"));
  CHECK_THAT(test.read("path.csv"), Catch::Contains("slider_amplitude"));
}

TEST_CASE("Bad input of a slider is refused by its option", "[slider][input]") {
  const ProgramTest test;
  const std::string rest = "--friction-coefficient 0.3 --velocities 50um/s ";
  for (const auto& [command, message] : std::initializer_list<std::pair<std::string, const char*>>{
           {contact + rest + "--falling-slope 1", "--mass, --spring-stiffness"},
           {contact + rest + "--steps 64", "--mass, --spring-stiffness"},
           {contact + body + "--friction-coefficient 0.3", "--velocities"},
           {contact + body + "--friction-coefficient 0.3 --velocities 50um/s,1mm/s",
            "--velocities: 2 are given; a slider takes one"},
           {slider + "--excursions 1nm", "--excursions: 1 map steady sliding"},
           {slider + "--velocity-ratios 0.1", "--velocity-ratios: given"},
           {slider + "--normal-amplitude 1nm", "--frequency"},
           {contact + rest + "--mass 0 --spring-stiffness 1kN/m", "--mass: 0"},
           {contact + rest + "--mass -1g --spring-stiffness 1kN/m", "--mass: -0.001"},
           {contact + body + "--friction-coefficient 0.3 --velocities 0", "--velocities: 0"},
           {contact + body + "--friction-coefficient 0.3 --velocities -1mm/s",
            "--velocities: -0.001"},
           {contact + body + "--friction-coefficient 0 --velocities 1mm/s",
            "--friction-coefficient: 0"},
           {contact + body + "--friction-coefficient inf --velocities 1mm/s",
            "--friction-coefficient"},
           {slider + "--normal-amplitude -1nm --frequency 20kHz", "--normal-amplitude: -1e-09"},
           {slider + "--normal-amplitude 1nm --frequency 50Hz", "must be above 4 times"},
           {slider + "--support-damping -1", "--support-damping: -1"},
           {slider + "--falling-slope 500", "--falling-slope: 500 N s/m makes friction negative"},
           {slider + "--steps 8", "--steps"},
           {slider + "--tolerance 1", "--tolerance: 1"},
           {slider + "-o path.txt", "path.txt"}}) {
    CAPTURE(command);
    check_refused(test.run(command), message);
  }
}
