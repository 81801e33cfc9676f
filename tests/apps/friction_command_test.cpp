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
