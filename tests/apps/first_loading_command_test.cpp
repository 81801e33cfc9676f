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

TEST_CASE("The residual surface of a contact carries the load by elasticity alone",
          "[first_loading]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = " --pressure 20MPa" + material;
  const json plastic = test.answer("contact rough.h5 --hardness 150MPa --residual flat.h5" + press);
  CHECK(plastic["max_pressure"] == 1.5e8);
  CHECK(plastic["pressure"] == Approx(2e7).epsilon(1e-10));
  CHECK(plastic["indentation"] > test.answer("contact rough.h5" + press)["indentation"]);
  CHECK(number(plastic, "first_loading", "yielded_area_fraction") > 0.01);
  CHECK(number(plastic, "first_loading", "max_plastic_depth") > 0);
  CHECK(number(plastic, "first_loading", "first_loading_pressure") == Approx(2e7));
  const json elastic = test.answer("contact flat.h5" + press);
  // The solver's tolerance of 1e-10 holds for gaps, its root for pressures.
  CHECK(elastic["mean_gap"] == Approx(plastic["mean_gap"]).epsilon(1e-6));
  CHECK(elastic["max_pressure"] == Approx(1.5e8).epsilon(1e-3));
  CHECK(elastic["contact_area_fraction"] == Approx(plastic["contact_area_fraction"]).epsilon(1e-2));
}

TEST_CASE("A force curve with a hardness is the elastic one of the residual surface",
          "[first_loading]") {
  const ProgramTest test;
  make_rough(test);
  const std::string loads = " --pressure 0.5MPa,5MPa,20MPa --stiffness" + material;
  test.done("contact rough.h5 --hardness 150MPa --residual flat.h5 --pressure 20MPa" + material);
  const json unloading = test.answer("contact rough.h5 --hardness 150MPa" + loads);
  CHECK(unloading["curve"] == test.answer("contact flat.h5 --detrend none" + loads)["curve"]);
  CHECK(number(unloading, "first_loading", "yielded_area_fraction") > 0.01);
  // A hardness that no pressure reaches changes no bit.
  const json elastic = test.answer("contact rough.h5" + loads);
  const json hard = test.answer("contact rough.h5 --hardness 1TPa" + loads);
  CHECK(hard["curve"] == elastic["curve"]);
  CHECK(number(hard, "first_loading", "yielded_area_fraction") == 0);
  CHECK(unloading["curve"] != elastic["curve"]);
}

TEST_CASE("Every command that presses a surface takes the hardness", "[first_loading]") {
  const ProgramTest test;
  make_rough(test);
  const std::string motion = "--normal-amplitude 0.1nm --frequency 20kHz ";
  for (const std::string command :
       {"damping --surface rough.h5 --drag-velocity 1um/s ", "damping --surface rough.h5 ",
        "sliding --surface rough.h5 --friction-coefficient 0.3 --velocities 1um/s ",
        "joint --surface rough.h5 --friction-coefficient 0.3 --tangential-amplitudes 0.1nm ",
        "oscillate --surface rough.h5 --mode drag --drag-velocity 1um/s --method levels --levels "
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
    const json& premise = flowed["premises"]["plasticity"];
    CHECK(premise["verdict"] == "holds");
    CHECK(premise["value"] < 1);
    CHECK(premise["value"] > 0.9);
    CHECK(plain["premises"]["plasticity"]["verdict"] == "unknown");
    for (json* answer : {&same, &plain, &flowed}) {
      for (const char* key : {"first_loading", "premises", "conditions", "validity"})
        answer->erase(key);
    }
    CHECK(same == plain);
    CHECK(flowed != plain);
  }
}

TEST_CASE("A shape flows too, but on the cells that it has", "[first_loading]") {
  const ProgramTest test;
  const std::string shape =
      "oscillate --shape paraboloid --points 32 --method levels --levels 8" + material;
  const json elastic = test.answer(shape);
  const json flowed = test.answer(shape + "--hardness 200MPa");
  CHECK(number(flowed, "first_loading", "yielded_area_fraction") > 0);
  // Both have the load of the first loading to the indentation of the shape.
  CHECK(flowed["force"].get<double>() < elastic["force"].get<double>());
  CHECK(flowed["indentation"].get<double>() < elastic["indentation"].get<double>());
}

TEST_CASE("A study with a hardness is that of the surface that its largest load leaves",
          "[first_loading][study]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3]"));
  const std::string study = "study study.toml --no-stick --no-report ";
  const json elastic = test.answer(study);
  const json hard = test.answer(study + "--hardness 1TPa");
  CHECK(hard["damping"] == elastic["damping"]);
  CHECK(hard["decay_length"] == elastic["decay_length"]);
  CHECK(number(hard["first_loading"], "yielded_area_fraction", "mean") == 0);
  const double largest = elastic["damping"]["pressure"].back();
  const std::string hardness = "--hardness " + std::to_string(2 * largest) + " ";
  const json soft = test.answer(study + hardness);
  CHECK(number(soft["first_loading"], "first_loading_pressure", "mean") > largest);
  CHECK(number(soft["first_loading"], "yielded_area_fraction", "mean") > 0.1);
  CHECK(soft["damping"]["damping_constant"] != elastic["damping"]["damping_constant"]);
  const json& premise = soft["premises"]["plasticity"];
  for (const json& verdict : premise["verdict"]) CHECK(verdict == "holds");
  CHECK(premise["value"].back() > 0.9);
  const std::string text =
      std::regex_replace(test.run(study + hardness).out, std::regex("\\s+"), " ");
  CHECK_THAT(text, Contains(", as the first loading left it ") &&
                       Contains("all numbers are of the surface that unloading left"));
  CHECK_THAT(test.run(study + "--hardness 1TPa").out, !Contains("first load"));
  CHECK(keys(soft["flags"]).contains("first_loading"));
  const json compared = test.answer(
      "compare study.toml --no-stick --no-report --models gw_deterministic " + hardness);
  CHECK(compared["first_loading"] == soft["first_loading"]);
  // Parts of another hardness are none of this study's.
  check_refused(test.run(study + "--hardness " + std::to_string(0.9 * largest)), "hardness: ");
}
