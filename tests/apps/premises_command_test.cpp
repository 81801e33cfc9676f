// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that every damping constant is printed with its premises, and that their limits are those
// of a simulation with friction.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <salebra/io/result_file.hpp>
#include <sstream>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;

using nlohmann::json;

namespace {

const Names premises = words(
    "slip_of_opening_levels slip_of_closed_levels slow_motion amplitude plasticity inertia "
    "coupling");

/// Any damping constant or loss per cycle in it, by the name of its key.
bool has_loss(const json& answer) {
  if (answer.is_array()) return std::ranges::any_of(answer, has_loss);
  if (!answer.is_object()) return false;
  for (const auto& [key, value] : answer.items())
    if (key.find("damping_constant") != std::string::npos || key == "relaxation_damping" ||
        key == "contact_power" || key.find("work_per_cycle") != std::string::npos ||
        has_loss(value))
      return true;
  return false;
}

void check_premises(const json& object) {
  REQUIRE(object.contains("premises"));
  CHECK(keys(object["premises"]) == std::set<std::string>(premises));
  for (const json& premise : object["premises"]) {
    CHECK(keys(premise) == "value limit_5_percent limit_20_percent onset verdict needs");
    const json verdicts =
        premise["verdict"].is_array() ? premise["verdict"] : json::array({premise["verdict"]});
    for (const json& verdict : verdicts)
      CHECK(std::set<std::string>{"holds", "doubtful", "broken", "unknown"}.contains(verdict));
    CHECK(premise["value"].is_array() == premise["verdict"].is_array());
  }
}

}  // namespace

TEST_CASE("The limit of slip that a command prints is where the loss with slip finds it",
          "[premises]") {
  const ProgramTest test;
  const std::string body = " --contact-modulus 1GPa --poisson 0.3 ";
  const std::string shear = " --mode equal-frequency --normal-amplitude ";
  struct Case {
    std::string indenter, motion;
    double friction;
  };
  const Case sheared[] = {
      {"--law paraboloid --radius 10mm --indentation 1um", shear + "300nm --phase 90deg", 0.3},
      {"--law cone --angle 5deg --indentation 1um", shear + "100nm --phase 45deg", 0.1},
      {"--law sphere --radius 1mm --indentation 2um", shear + "1um --phase 135deg", 0.8}};
  for (const Case& one : sheared) {
    const std::string command = "damping " + one.indenter + body + one.motion;
    const auto run = test.answer(fmt::format(
        "{} --tangential-amplitude 10nm --friction-coefficient {}", command, one.friction));
    const double limit = run["premises"]["slip_of_closed_levels"]["limit_5_percent"];
    const auto change = [&](double amplitude) {
      const auto loss =
          test.answer(fmt::format("{} --tangential-amplitude {} --friction-coefficient {}", command,
                                  amplitude, one.friction));
      return std::abs(
          number(loss, "/work_per_cycle") / number(loss, "/work_per_cycle_without_slip") - 1);
    };
    CHECK(change(0.98 * limit) < 0.05);
    CHECK(change(1.02 * limit) > 0.05);
  }
  const std::string drag = " --normal-amplitude 200nm --frequency 1kHz ";
  const Case dragged[] = {
      {"--law power --exponent 4 --coefficient 1e9 --indentation 1um", drag, 0.2},
      {"--law paraboloid --radius 1mm --indentation 500nm", drag, 0.5}};
  for (const Case& one : dragged) {
    const std::string command = "damping " + one.indenter + body + one.motion;
    const auto answer = test.answer(
        fmt::format("{} --drag-velocity 1um/s --friction-coefficient {}", command, one.friction));
    const double limit = answer["largest_motion"][0]["drag_velocity"];
    const json opening = answer["premises"]["slip_of_opening_levels"];
    CHECK(1e-6 * number(opening, "/value") / number(opening, "/limit_5_percent") == Approx(limit));
    const auto change = [&](double velocity) {
      const auto loss =
          test.answer(fmt::format("{} --drag-velocity {} --friction-coefficient {} --excursion 1m",
                                  command, velocity, one.friction));
      return std::abs(number(loss, "/work_per_cycle") * number(loss, "/relaxation_share") /
                          number(loss, "/work_per_cycle_without_slip") -
                      1);
    };
    CHECK(change(0.98 * limit) < 0.05);
    CHECK(change(1.02 * limit) > 0.05);
  }
}

TEST_CASE("The verdict stands below the answer in one word, its conditions worst first",
          "[premises][validity]") {
  const ProgramTest test;
  const std::string law =
      "--law exponential --normal-force 1 --decay-length 30nm --poisson 0.3 --frequency 20kHz ";
  // μ/g · u_z ω = 46 µm/s.
  const std::string fast =
      "damping --normal-amplitude 1nm --drag-velocity 1mm/s --friction-coefficient 0.3 " + law;
  const std::string text = test.run(fast).out;
  CHECK_THAT(text, Catch::StartsWith("work_per_cycle"));
  CHECK_THAT(text, Catch::Contains("\n\nValidity: not valid\n  no  no slip where it opens and "
                                   "closes: M above "));
  CHECK_THAT(text, Catch::Contains("here M = 0.0458"));
  CHECK_THAT(text, Catch::Contains("--hardness not given"));
  const json answer_of_fast = test.run(fast + "--json").json();
  CHECK(answer_of_fast["validity"] == "not valid");
  CHECK(answer_of_fast["conditions"][0]["name"] == "slip_of_opening_levels");
  CHECK(answer_of_fast["conditions"][0]["verdict"] == "broken");
  // The way of one normal cycle is 50 nm.
  CHECK_THAT(
      test.run("damping --normal-amplitude 1nm --drag-velocity 1mm/s --excursion 10nm " + law).out,
      Catch::Contains("Validity: not valid\n  no  slow: at least "));
  const auto slow = test.run("damping --normal-amplitude 1nm --drag-velocity 1nm/s " + law);
  CHECK_THAT(slow.out, Catch::Contains("Validity: not checked\n"));
  for (const std::string friction : {"(µ = 0.1),", "(µ = 0.3),", "(µ = 1)\n"})
    CHECK_THAT(slow.out, Catch::Contains(friction));
  // A list has a verdict for each.
  const auto list =
      test.run("damping --normal-amplitude 1:50nm:4 --drag-velocity 1nm/s --json " + law);
  const json answer = list.json();
  check_premises(answer);
  CHECK(answer["premises"]["amplitude"]["verdict"] ==
        json({"holds", "doubtful", "doubtful", "broken"}));
}

TEST_CASE("The inertia of a damper over frequencies is that of the highest one", "[premises]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  const std::string body = " --contact-modulus 1GPa --poisson 0.3 ";
  REQUIRE(
      test.run("contact rough.h5 --stiffness --pressure 10kPa:10MPa:8 -o curve.h5" + body).status ==
      0);
  const auto inertia = [&](const std::string& frequencies) {
    const auto run = test.answer(
        "damping --curve curve.h5 --pressure 1MPa --normal-amplitude 1nm --density 7800 "
        "--frequency " +
        frequencies + body);
    return run["premises"]["inertia"]["value"];
  };
  const json highest = inertia("20kHz");
  CHECK(highest.get<double>() > 0);
  CHECK(inertia("10kHz,20kHz") == highest);
  CHECK(inertia("20kHz,10kHz") == highest);
}

TEST_CASE("Every command that prints a damping constant or a loss prints its premises",
          "[premises]") {
  const ProgramTest test;
  const std::string body = " --contact-modulus 10GPa --poisson 0.3 ";
  const std::string law = " --law exponential --normal-force 1 --decay-length 30nm --poisson 0.3 ";
  const std::string drag = " --normal-amplitude 1nm --frequency 20kHz ";
  test.write("study.toml", study_text("seeds = [3]"));
  // A run of each command of the program; none for those that print no numbers.
  const std::map<std::string, std::string> commands{
      {"generate",
       "--points 32 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um --rms-height 10nm "
       "-o rough.h5"},
      {"convert", "rough.h5 rough.npy"},
      {"statistics", "rough.h5"},
      {"contact", "rough.h5 --pressure 2:60MPa:6 -o curve.h5" + body},
      {"fit", "curve.h5"},
      {"damping", law + drag + "--drag-velocity 1um/s"},
      {"sliding", law + drag + "--friction-coefficient 0.3 --velocities 1um/s"},
      {"joint", law + "--friction-coefficient 0.3 --tangential-amplitudes 5nm"},
      {"viscoelastic",
       "--law paraboloid --radius 1mm --indentation 100nm --drag-velocity 1um/s --prony 3GPa:1ms" +
           body + drag},
      {"oscillate", "--shape paraboloid --points 32 --method levels" + body},
      {"study", "study.toml --no-stick --no-report -o study.h5"},
      {"compare", "study.toml --no-stick --no-report --models gw_moments"},
      {"verify", ""},
      {"report", ""},
      {"init", ""},
      {"twin", ""},
      {"export", ""},
      {"completion", ""}};
  const std::string help = test.run("--help").out;
  int with_loss = 0;
  for (const std::string name :
       {"generate", "convert", "statistics", "contact", "fit", "damping", "sliding", "joint",
        "viscoelastic", "oscillate", "study", "compare", "verify"}) {
    INFO(name);
    const auto run = test.done(name + " " + commands.at(name) + " --json");
    const json answer = run.json();
    if (!has_loss(answer)) continue;
    ++with_loss;
    check_premises(answer);
  }
  CHECK(with_loss == 7);
  // A command that is new has to be listed above.
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    std::string first;
    // Behind the column of headings.
    if (line.size() > 9 && std::istringstream(line.substr(9)) >> first &&
        test.run(first + " --help").status == 0) {
      INFO(first);
      CHECK(commands.contains(first));
    }
  }
}

TEST_CASE(
    "No verdict contradicts the limits beside it, and a joint has no amplitude that nobody gave",
    "[premises]") {
  const ProgramTest test;
  const std::string law =
      " --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
      "--friction-coefficient 0.3 ";
  const std::string drag = "--normal-amplitude 80nm --frequency 20kHz ";
  for (const std::string command :
       {"joint" + law + "--tangential-amplitudes 5nm",
        "joint" + law + "--tangential-amplitudes 5nm --normal-amplitude 80nm --phase 45deg",
        "sliding" + law + drag + "--velocities 10mm/s",
        "sliding" + law + drag +
            "--mass 1kg --spring-stiffness 1MN/m --velocities 1mm/s --support-damping 300",
        "damping" + law + drag + "--drag-velocity 10mm/s"}) {
    INFO(command);
    const auto run = test.answer(command);
    const json judged = run["premises"];
    for (const auto& [name, premise] : judged.items()) {
      INFO(name << ' ' << premise.dump());
      if (premise["value"].is_null() || premise["limit_5_percent"].is_null()) continue;
      const bool large_is_good = name == "slip_of_opening_levels" || name == "slow_motion";
      const double value = premise["value"], limit = premise["limit_5_percent"];
      CHECK((premise["verdict"] == "holds") == (large_is_good ? value >= limit : value <= limit));
    }
    if (command.starts_with("damping")) continue;
    for (const char* name : {"slip_of_opening_levels", "slip_of_closed_levels", "amplitude"}) {
      CHECK(judged[name]["verdict"] == "holds");
      CHECK(judged[name]["value"].is_null());
    }
  }
}

TEST_CASE(
    "Plasticity has an onset, not limits of the loss, and a viscoelastic loss says whose its "
    "premises are",
    "[premises]") {
  const ProgramTest test;
  const std::string sphere =
      " --law paraboloid --radius 1mm --indentation 100nm --drag-velocity 1um/s --contact-modulus "
      "100GPa --poisson 0.3 --normal-amplitude 1nm --frequency 20kHz ";
  const std::string hardness = "--hardness 700MPa ";
  const json flow = test.answer("damping" + sphere + hardness)["premises"]["plasticity"];
  CHECK(flow["onset"] == 0.6);
  CHECK(flow["limit_5_percent"].is_null());
  CHECK(flow["limit_20_percent"].is_null());
  CHECK_THAT(test.run("damping" + sphere + hardness).out,
             Catch::Contains("elastic: pressure on spots below 0.6 of the hardness"));
  const std::string viscoelastic = "viscoelastic" + sphere + "--prony 3GPa:1ms ";
  CHECK_THAT(test.run(viscoelastic).out,
             Catch::Contains("The conditions are those of the relaxed elastic body"));
  CHECK(test.run(viscoelastic + "--json").json()["premises_of"] == "relaxed elastic body");
  CHECK(!test.run("damping" + sphere + "--json").json().contains("premises_of"));
}

TEST_CASE("A study prints the loss with slip, and refuses a hardness below its pressures",
          "[premises][study]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3]"));
  const std::string study = "study study.toml --no-stick --no-report ";
  const auto plain = test.run(study + "--json").json();
  for (const char* share : {"relaxation_share", "slip_share"})
    for (const json& one : plain["damping"][share]) CHECK(one.is_null());
  CHECK(plain["largest_motion"].size() == 3);
  const auto run =
      test.done(study + "--friction-coefficient 0.3 --hardness 1TPa --density 7800 --json -o s.h5");
  const json answer = run.json();
  const std::size_t loads = answer["damping"]["pressure"].size();
  CHECK(answer["premises"]["plasticity"]["verdict"] ==
        json(std::vector<std::string>(loads, "holds")));
  // With friction the loss depends on an excursion, which nobody gave.
  for (const json& one : answer["damping"]["damping_constant"]["mean"]) CHECK(one.is_null());
  CHECK_THAT(test.run(study + "--friction-coefficient 0.3").out,
             Catch::Contains("with friction it depends on the --excursion; give it"));
  const salebra::ResultReader reader(test.folder() / "s.h5");
  CHECK(reader.numbers("premises/slip_of_opening_levels_limit_5_percent").size() == loads);
  CHECK(reader.text_attribute("answer", "validity") == answer["validity"].get<std::string>());
  // With much friction nothing slips: the answer is the damping constant without slip, although the
  // curve that gives the ratio of losses is interpolated between pressures, by up to 20 %. The 360
  // straight steps of the springs lose 1 %.
  const json stuck =
      test.run(study + "--friction-coefficient 1e9 --excursion 20um --json").json()["damping"];
  int stated = 0;
  for (std::size_t k = 0; k < loads; ++k) {
    const json& with_slip = stuck["damping_constant"]["mean"][k];
    const json& without = stuck["damping_constant_without_slip"]["mean"][k];
    CHECK(with_slip.is_null() == without.is_null());
    if (without.is_null()) continue;
    ++stated;
    CHECK(with_slip.get<double>() == Approx(without.get<double>()).epsilon(0.015));
    CHECK(stuck["relaxation_share"][k].get<double>() > 0.98);
    // γ of the work: P/v².
    CHECK(stuck["work_per_cycle"]["mean"][k].get<double>() > 0);
  }
  CHECK(stated > 1);
  // Where the case lies: on a way of 1 mm everything slides; no excursion, no regime.
  const std::string slides = study + "--friction-coefficient 0.3 --excursion 1mm ";
  const json answered = test.run(slides + "--json -o slides.h5").json(),
             sliding = answered["damping"];
  CHECK(answered["regime"] == json(std::vector<std::string>(loads, "sliding")));
  CHECK(!sliding.contains("regime"));
  for (std::size_t k = 0; k < loads; ++k) {
    if (sliding["slip_share"][k].is_null()) continue;
    CHECK(sliding["slip_share"][k] > 0.5);
    const json& without = sliding["damping_constant_without_slip"]["mean"][k];
    if (without.is_null()) continue;
    // The constant under this name is the one with slip, not the column of the same name without.
    CHECK(sliding["damping_constant"]["mean"][k] > 2 * without.get<double>());
  }
  CHECK(answer["regime"] == json(std::vector<json>(loads)));
  CHECK(salebra::ResultReader(test.folder() / "slides.h5").numbers("answer/regime") ==
        std::vector<double>(loads, 2));
  for (const std::string loads_given : {"10MPa", "10MPa,20MPa,30MPa"})
    check_refused(
        test.run(study + "--pressures " + loads_given + " -o t.h5"),
        "values are too few; at least 4 make a curve. For one load: salebra damping --surface");
  check_refused(test.run(study + "--hardness 1kPa -o t.h5"),
                "hardness: 1 kPa is below the largest of the loads");
  CHECK(!test.files().contains("t.h5"));
  std::string facts = study_text("seeds = [3]");
  facts.replace(facts.find("[material]\n"), 11, "[material]\nhardness = \"0Pa\"\n");
  test.write("facts.toml", facts);
  check_refused(test.run("study facts.toml"), "material.hardness: ");
}
