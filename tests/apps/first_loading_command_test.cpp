// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <string>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;
using nlohmann::json;

namespace {

void make_rough(const ProgramTest& test) {
  test.done(
      "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 1um --short-cutoff 0.5um "
      "--rms-height 10nm --seed 3 -o rough.h5");
}

const std::string material = " --contact-modulus 10GPa --poisson 0.3 ";

double number(const json& answer, const std::string& object, const std::string& name) {
  return answer[object][name].get<double>();
}

}  // namespace

TEST_CASE("Every command that presses a surface takes the hardness", "[first_loading]") {
  const ProgramTest test;
  make_rough(test);
  const std::string motion = "--normal-amplitude 0.1nm --frequency 20kHz ";
  for (const std::string command :
       {"damping --surface rough.h5 --drag-velocity 1um/s ", "damping --surface rough.h5 ",
        "sliding --surface rough.h5 --friction-coefficient 0.3 --velocities 1um/s ",
        "joint --surface rough.h5 --friction-coefficient 0.3 --tangential-amplitudes 0.1nm ",
        "oscillate --surface rough.h5 --mode drag --drag-velocity 1um/s --method intervals "
        "--intervals "
        "8 "}) {
    INFO(command);
    const auto ask = [&](const std::string& hardness) {
      return test.answer(command + motion + "--pressure 20MPa " + hardness + material);
    };
    json same = ask("--hardness 1TPa"), plain = ask(""), flowed = ask("--hardness 150MPa");
    CHECK(number(same, "first_loading", "yielded_area_fraction") == 0);
    CHECK(number(flowed, "first_loading", "yielded_area_fraction") > 0.01);
    // The oscillation belongs to the first loading.
    CHECK(number(flowed, "first_loading", "first_loading_pressure") > 2.001e7);
    const json& assumption = flowed["assumptions"]["plasticity"];
    CHECK(assumption["verdict"] == "holds");
    // Judged at the deepest point, which the first loading has reached.
    CHECK(assumption["value"] <= 1.001);
    CHECK(assumption["value"] > 0.9);
    CHECK(plain["assumptions"]["plasticity"]["verdict"] == "unknown");
    for (json* answer : {&same, &plain, &flowed}) {
      for (const char* key : {"first_loading", "assumptions", "verdicts", "validity"})
        answer->erase(key);
    }
    CHECK(same == plain);
    CHECK(flowed != plain);
  }
}
