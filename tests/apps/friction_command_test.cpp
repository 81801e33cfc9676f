// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "run_program.hpp"

namespace {

const std::string law =
    "friction --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 ";
const std::string motion =
    "--friction-coefficient 0.3 --normal-amplitude 30nm --angular-frequency 1e5 ";

}  // namespace

TEST_CASE("friction gives the friction of a sliding contact over velocity", "[sliding]") {
  const ProgramTest test;
  const auto answer = test.run(law + motion + "--velocities 1nm/s,1mm/s,1m/s --json").json();
  CHECK(keys(answer) == std::set<std::string>{"premises", "largest_motion", "mean_force",
                                              "critical_velocity", "static_friction_coefficient",
                                              "low_speed_damping", "relaxation_damping", "velocity",
                                              "mean_tangential_force", "friction_coefficient",
                                              "sliding_damping", "relaxation_work", "slip_work"});
  // ⟨F⟩ = F I_0(u_z/l), v_c = (μE*/G*)u_z ω, G*/E* = 2(1 − ν)/(2 − ν), F(δ_min) = F exp(−u_z/l).
  const double mean = 2 * std::cyl_bessel_i(0., 0.3);
  CHECK(answer["mean_force"].get<double>() == Approx(mean).epsilon(1e-10));
  CHECK(answer["critical_velocity"].get<double>() ==
        Approx(0.3 / (1.4 / 1.7) * 3e-8 * 1e5).epsilon(1e-12));
  const double least = 0.3 * 2 * std::exp(-0.3) / mean;
  CHECK(answer["static_friction_coefficient"].get<double>() == Approx(least).epsilon(1e-10));
  // At 1e-6 v_c what moves adds 1e-6 of it; from v_c on Coulomb's law is back.
  CHECK(answer["friction_coefficient"][0].get<double>() == Approx(least).epsilon(1e-4));
  CHECK(answer["friction_coefficient"][2].get<double>() == Approx(0.3).epsilon(1e-12));
  for (int k = 0; k < 3; ++k)
    CHECK(answer["relaxation_work"][k].get<double>() + answer["slip_work"][k].get<double>() ==
          Approx(answer["mean_tangential_force"][k].get<double>() *
                 answer["velocity"][k].get<double>() * 2 * std::numbers::pi / 1e5)
              .epsilon(1e-10));
  // γ is what `damping` says.
  const auto stuck = test.run(
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--normal-amplitude 30nm --angular-frequency 1e5 --drag-velocity 1um/s --json");
  CHECK(answer["relaxation_damping"].get<double>() ==
        Approx(stuck.json()["damping_constant"].get<double>()).epsilon(1e-10));
}

TEST_CASE("Bad input of friction is refused by its option", "[sliding][input]") {
  const ProgramTest test;
  for (const auto& [command, message] : std::initializer_list<std::pair<std::string, const char*>>{
           {law + motion + "--velocities 0", "--velocities: 0"},
           {law + motion + "--velocities -1:1mm/s:5", "--velocities: '-1:1mm/s:5'"},
           {law + "--velocities 1mm/s", "--friction-coefficient, --normal-amplitude, --frequency"},
           {law + motion + "--velocities 1mm/s --frequency 1kHz",
            "--angular-frequency: given beside --frequency"},
           {law + "--friction-coefficient 0 --normal-amplitude 1nm --frequency 1kHz --velocities "
                  "1mm/s",
            "--friction-coefficient: 0"},
           {law + "--friction-coefficient 0.3 --normal-amplitude -1nm --frequency 1kHz "
                  "--velocities 1mm/s",
            "--normal-amplitude: -1e-09"}}) {
    CAPTURE(command);
    check_refused(test.run(command), message);
  }
}
