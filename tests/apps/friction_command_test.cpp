// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/io/result_file.hpp>
#include <string>

#include "run_program.hpp"

namespace {

const std::string law =
    "sliding --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 ";
const std::string motion =
    "--friction-coefficient 0.3 --normal-amplitude 30nm --angular-frequency 1e5 ";

}  // namespace

TEST_CASE("sliding gives the friction of a sliding contact over velocity", "[sliding]") {
  const ProgramTest test;
  const auto answer = test.answer(law + motion + "--velocities 1nm/s,1mm/s,1m/s");
  CHECK(keys(answer) ==
        "premises largest_motion mean_force critical_velocity static_friction_coefficient "
        "low_speed_damping relaxation_damping velocity mean_tangential_force friction_coefficient "
        "sliding_damping relaxation_work slip_work");
  // ⟨F⟩ = F I_0(u_z/l), v_c = (μE*/G*)u_z ω, G*/E* = 2(1 − ν)/(2 − ν), F(δ_min) = F exp(−u_z/l).
  const double mean = 2 * std::cyl_bessel_i(0., 0.3);
  CHECK(answer["mean_force"] == Approx(mean).epsilon(1e-10));
  CHECK(answer["critical_velocity"] == Approx(0.3 / (1.4 / 1.7) * 3e-8 * 1e5).epsilon(1e-12));
  const double least = 0.3 * 2 * std::exp(-0.3) / mean;
  CHECK(answer["static_friction_coefficient"] == Approx(least).epsilon(1e-10));
  // At 1e-6 v_c what moves adds 1e-6 of it; from v_c on Coulomb's law is back.
  CHECK(answer["friction_coefficient"][0] == Approx(least).epsilon(1e-4));
  CHECK(answer["friction_coefficient"][2] == Approx(0.3).epsilon(1e-12));
  for (int k = 0; k < 3; ++k)
    CHECK(answer["relaxation_work"][k].get<double>() + answer["slip_work"][k].get<double>() ==
          Approx(answer["mean_tangential_force"][k].get<double>() *
                 answer["velocity"][k].get<double>() * 2 * std::numbers::pi / 1e5)
              .epsilon(1e-10));
  // γ is what `damping` says.
  const auto stuck = test.answer(
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--normal-amplitude 30nm --angular-frequency 1e5 --drag-velocity 1um/s");
  CHECK(answer["relaxation_damping"] == Approx(stuck["damping_constant"]).epsilon(1e-10));
}

TEST_CASE("sliding maps amplitudes and ratios of velocities", "[sliding]") {
  const ProgramTest test;
  const std::string several = law + "--friction-coefficient 0.3 --angular-frequency 1e5 ";
  const auto answer = test.answer(
      several +
      "--normal-amplitude 10nm,30nm --velocity-ratios 0.1,0.5,2 -o map.csv --plot map.svg");
  const auto single = test.answer(law + motion + "--velocity-ratios 0.1,0.5,2");
  CHECK(answer["normal_amplitude"] == nlohmann::json({1e-8, 1e-8, 1e-8, 3e-8, 3e-8, 3e-8}));
  for (std::size_t i = 0; i < 3; ++i) {
    const double critical = single["critical_velocity"];
    CHECK(single["velocity"][i] ==
          Approx(single["velocity_ratio"][i].get<double>() * critical).epsilon(1e-14));
    CHECK(answer["critical_velocity"][3 + i] == single["critical_velocity"]);
    for (const char* name : {"velocity", "velocity_ratio", "friction_coefficient", "slip_work"})
      CHECK(answer[name][3 + i] == single[name][i]);
  }
  CHECK(answer["premises"]["amplitude"]["verdict"].size() == 2);
  CHECK(test.files() == "map.csv map.sliding.csv map.svg");
}

TEST_CASE("sliding says in which regime a slow motion is, as damping with friction does",
          "[sliding][regimes]") {
  const ProgramTest test;
  const std::string contact =
      "--indentation 1um --contact-modulus 1GPa --poisson 0.3 --friction-coefficient 0.3 "
      "--normal-amplitude 100nm --angular-frequency 1e5 ";
  const double limit = 0.3 / (1.4 / 1.7), critical = limit * 1e-7 * 1e5;
  constexpr int cycles = 10, steps = 200;
  const char* const regimes[] = {"no slip", "partial slip", "sliding"};
  for (int i = 0; i < 3; ++i) {
    CAPTURE(regimes[i]);
    const double velocity = critical * std::array{1e-4, 0.1, 1.5}[std::size_t(i)];
    const double way = 2 * std::numbers::pi * velocity / 1e5;
    std::string path;
    for (int k = 0; k <= 2 * cycles * steps; ++k) {
      const double turns = double(k) / steps;
      path += fmt::format("{} {} {}\n", k,
                          1e-6 - 1e-7 * std::cos(2 * std::numbers::pi * (k % steps) / steps),
                          way * std::min(turns, 2 * cycles - turns));
    }
    test.write("path.txt", path);
    const std::string damping =
        "damping --law paraboloid --radius 10mm --contact-modulus 1GPa --poisson 0.3 "
        "--trajectory path.txt ";
    const auto rough = test.answer(damping + "--friction-coefficient 0.3"),
               stuck = test.answer(damping);
    const std::string case_of_it =
        fmt::format("--velocities {} --excursions {} ", velocity, cycles * way);
    const auto map = test.answer("sliding --law paraboloid --radius 10mm " + contact + case_of_it +
                                 "-o map.h5 --overwrite")["regime_map"];
    CHECK(map["regime"] == nlohmann::json({regimes[i]}));
    // Turning points take a part of a cycle each, of ten.
    CHECK(map["loss_ratio"][0] ==
          Approx(rough["work_per_cycle"].get<double>() / stuck["work_per_cycle"].get<double>())
              .epsilon(0.03));
    // One motion is run alone.
    const auto alone = test.answer(
        fmt::format("damping --law paraboloid --radius 10mm {}--drag-velocity {} --excursion {}",
                    contact, velocity, cycles * way));
    CHECK(alone["regime"] == regimes[i]);
    const salebra::ResultReader reader(test.folder() / "map.h5");
    CHECK(reader.numbers("regime_map/regime") == std::vector<double>{double(i)});
  }
}
