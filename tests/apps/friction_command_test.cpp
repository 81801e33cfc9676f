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
        "validity conditions premises largest_motion mean_force critical_velocity "
        "static_friction_coefficient "
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

TEST_CASE("Sliding and dampers of a surface have errors, and what has none is said", "[sliding]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 10um --hurst 0.8 --rolloff 5um --short-cutoff 1.67um "
      "--rms-slope 0.1 --seed 3 -o rough.h5");
  const std::string contact =
      "--surface rough.h5 --pressure 5MPa --contact-modulus 1GPa --poisson 0.3 --normal-amplitude "
      "2nm --frequency 20kHz --quiet ";
  const auto slides =
      test.answer("sliding --friction-coefficient 0.3 --velocities 1um/s,10um/s " + contact);
  for (const std::string name : {"mean_force", "critical_velocity", "static_friction_coefficient",
                                 "low_speed_damping", "relaxation_damping"})
    CHECK(slides[name + "_error"] < slides[name]);
  for (const std::string name : {"mean_tangential_force", "friction_coefficient", "sliding_damping",
                                 "relaxation_work", "slip_work"})
    for (const std::size_t i : {0, 1}) CHECK(slides[name + "_error"][i] < slides[name][i]);
  // Forces and losses come from one law.
  CHECK(slides["relaxation_work"][0].get<double>() + slides["slip_work"][0].get<double>() ==
        Approx(slides["mean_tangential_force"][0].get<double>() * 1e-6 / 20e3));

  // γ of a damper and of slow sliding is that of `damping`, with its error.
  const auto stuck = test.answer("damping --drag-velocity 1um/s " + contact);
  const auto damper =
      test.answer("damping --mass 1g --spring-stiffness 1kN/m --falling-slope 0.001 " + contact);
  for (const auto& answer : {damper["damping_constant"], slides["relaxation_damping"]})
    CHECK(answer == Approx(stuck["damping_constant"].get<double>()).epsilon(1e-3));
  CHECK(damper["damping_constant_error"] ==
        Approx(stuck["damping_constant_error"].get<double>()).epsilon(0.01));
  // ζ = γ/(2mω0).
  const auto &decay = damper["decay"], &off = damper["decay_error"];
  const double relative =
      damper["damping_constant_error"].get<double>() / damper["damping_constant"].get<double>();
  CHECK(off["damping_ratio"] == Approx(decay["damping_ratio"].get<double>() * relative));
  CHECK(off["natural_frequency"].is_null());
  CHECK(damper["stabilising_amplitude_error"] < damper["stabilising_amplitude"]);
  const auto map = test.answer(
      "damping --surface rough.h5 --pressure 5MPa --contact-modulus 1GPa --poisson 0.3 --quiet "
      "--normal-amplitude 1nm,2nm --frequency 20kHz,40kHz -o map.h5");
  CHECK(map["damping_constant_error"][1][0] ==
        Approx(damper["damping_constant_error"].get<double>()));
  CHECK(map["damping_constant_error"][1][1] ==
        Approx(damper["damping_constant_error"].get<double>() / 2));
  const auto slider = test.done(
      "sliding --friction-coefficient 0.3 --velocities 1um/s --mass 1g --spring-stiffness 1kN/m "
      "--surface rough.h5 --pressure 5MPa --contact-modulus 1GPa --poisson 0.3");
  CHECK_THAT(slider.err, Catch::Contains("n/a: the error of the motion"));
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
      path += fmt::format(
          "{} {} {}\n", k,
          1e-6 - 1e-7 * std::cos(2 * std::numbers::pi * ((k + steps / 4) % steps) / steps),
          way * std::min(turns, 2 * cycles - turns));
    }
    test.write("path.txt", path);
    const std::string damping =
        "damping --law paraboloid --radius 10mm --contact-modulus 1GPa --poisson 0.3 "
        "--trajectory path.txt ";
    const auto rough = test.answer(damping + "--friction-coefficient 0.3");
    const auto stuck = test.answer(fmt::format(
        "damping --law paraboloid --radius 10mm --indentation 1um --contact-modulus 1GPa "
        "--poisson 0.3 --normal-amplitude 100nm --angular-frequency 1e5 --drag-velocity {}",
        velocity));
    const std::string case_of_it =
        fmt::format("--velocities {} --excursions {} ", velocity, cycles * way);
    const auto map = test.answer("sliding --law paraboloid --radius 10mm " + contact + case_of_it +
                                 "-o map.h5 --overwrite")["regime_map"];
    CHECK(map["regime"] == nlohmann::json({regimes[i]}));
    // A quarter of a cycle after the least indentation turning points cost about their mean.
    CHECK(map["loss_ratio"][0] ==
          Approx(number(rough, "/work_per_cycle") / number(stuck, "/work_per_cycle") / (2 * cycles))
              .epsilon(0.01));
    // One motion is run alone.
    const auto alone = test.answer(
        fmt::format("damping --law paraboloid --radius 10mm {}--drag-velocity {} --excursion {}",
                    contact, velocity, cycles * way));
    CHECK(alone["regime"] == regimes[i]);
    const salebra::ResultReader reader(test.folder() / "map.h5");
    CHECK(reader.numbers("regime_map/regime") == std::vector<double>{double(i)});
  }
}
