// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <salebra/io/result_file.hpp>
#include <sstream>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;

namespace {

const std::string study = study_text();

}  // namespace

TEST_CASE("A study's answer fits a screen: numbers, validity, accuracy, law and files", "[study]") {
  const ProgramTest test;
  test.write("study.toml", study);
  const std::string known =
      " --friction-coefficient 0.3 --hardness 1TPa --density 7800 --excursion 1nm";
  for (const std::string options : {"", known.c_str()}) {
    INFO(options);
    const auto result = test.done("study study.toml -o result.h5 --overwrite --quiet" + options);
    std::size_t place = 0;
    for (const std::string part : {"Damping constant: slow shear", "γ", "Eq. (16)", "Validity: ",
                                   "Accuracy\n", "Force law: l = ", "results: result.h5"}) {
      INFO(part);
      CHECK(result.out.find(part, place) != std::string::npos);
      place = std::min(result.out.find(part, place), result.out.size());
    }
    std::istringstream lines(result.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      INFO(line);
      // In a letter of several bytes all but the first begin with the bits 10.
      CHECK(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }) <= 80);
    }
    CHECK(count <= 40);
  }
  CHECK_THAT(test.run("study study.toml --quiet --verbose").out,
             Contains("boundary elements") && Contains("GW, summits from spectral moments") &&
                 Contains("l/h_rms"));
  CHECK_THAT(test.run("study study.toml --verbose").err,
             Contains("processor time") && Contains("normal stiffness"));
  CHECK_THAT(test.run("study study.toml --progress always").err, Contains("study"));
  CHECK(test.run("study study.toml --quiet --progress never").err.empty());
}

TEST_CASE("A damping constant of a study has its error, and none is printed that is no larger",
          "[study]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [2]"));
  const auto result = test.done("study study.toml --json --quiet");
  const auto damping = result.json()["damping"];
  CHECK(keys(damping["damping_constant"]) == std::set<std::string>{"mean", "low", "high", "error"});
  CHECK(keys(damping["damping_constant_without_slip"]) ==
        std::set<std::string>{"mean", "low", "high", "error"});
  int stated = 0;
  for (std::size_t k = 0; k < 10; ++k) {
    const auto mean = damping["damping_constant"]["mean"][k],
               error = damping["damping_constant"]["error"][k];
    CHECK(damping["damping_constant"]["low"][k].is_null());
    if (mean.is_null()) continue;
    REQUIRE(error.is_number());
    CHECK(error.get<double>() < mean.get<double>());
    // The parts make the whole.
    double sum = 0;
    for (const char* part :
         {"cell_error", "noise_error", "interval_error", "ratio_error", "solver_error"})
      sum += std::pow(damping[part]["mean"][k].get<double>(), 2);
    CHECK(std::sqrt(sum) ==
          Approx(damping["work_per_cycle"]["error"][k].get<double>()).epsilon(0.01));
    ++stated;
  }
  CHECK(stated >= 5);

  test.write("several.toml", study);
  const auto several =
      test.run("study several.toml --json --quiet").json()["damping"]["damping_constant"];
  CHECK(several["low"][6] < several["mean"][6]);
  CHECK(several["error"][6] > 0);
}

TEST_CASE("More loads change no stated interval by more than its error", "[study]") {
  // Every load of the short list is in the long one. One surface, whose damping has an error, and
  // several, which have intervals too.
  const ProgramTest test;
  for (const char* seeds : {"seeds = [2]", "seeds = [1, 2, 3]"}) {
    test.write("study.toml", study_text(seeds));
    const auto answer = [&](const char* pressures) {
      return test.run(std::string("study study.toml --json --quiet --pressures ") + pressures)
          .json();
    };
    const auto few = answer("10MPa:160MPa:9"), many = answer("10MPa:160MPa:17");
    const auto &before = few["damping"]["damping_constant"],
               &after = many["damping"]["damping_constant"];
    int stated = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      if (before["mean"][k].is_null()) continue;
      for (const char* end : {"mean", "low", "high"}) {
        INFO(seeds << ", load " << k << ", " << end);
        CHECK(before[end][k].is_null() == after[end][2 * k].is_null());
        if (before[end][k].is_null()) continue;
        ++stated;
        CHECK(std::abs(after[end][2 * k].get<double>() - before[end][k].get<double>()) <=
              before["error"][k].get<double>());
      }
    }
    CHECK(stated >= 8);
    const auto &l = few["decay_length"], &longer = many["decay_length"];
    if (l["low"].is_null()) continue;
    const double half = (l["high"].get<double>() - l["low"].get<double>()) / 2;
    for (const char* end : {"mean", "low", "high"})
      CHECK(std::abs(longer[end].get<double>() - l[end].get<double>()) <= half);
  }
}

TEST_CASE("A relative error is met, or the study says what was reached and gives no table",
          "[study]") {
  const ProgramTest test;
  std::string coarse = study_text("seeds = [2]", 4);
  coarse.replace(coarse.find("points = 64"), 11, "points = 32");
  test.write("study.toml", coarse);
  const auto met =
      test.done("study study.toml --relative-error 60% --pressures 10MPa:40MPa:4 --json --quiet");
  const auto constant = met.json()["damping"]["damping_constant"];
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(constant["error"][k].get<double>() <= 0.6 * constant["mean"][k].get<double>());

  // No free boundary has anything to do with a periodic surface: the seam's error stays, whatever
  // the cells.
  const auto missed = test.run(
      "study study.toml --relative-error 0.1% --seam-error free --pressures 10MPa:40MPa:4 -o "
      "result.h5 --quiet");
  CHECK(missed.status == 1);
  CHECK(missed.out.empty());
  CHECK_THAT(missed.err, Contains("relative_error: 0.1 % is not met at 10 MPa ("));
  CHECK(test.files() == std::set<std::string>{"study.toml"});
  for (const std::string bad : {"0", "-5%", "1", "nan", "150%"}) {
    const auto refused = test.run("study study.toml --relative-error " + bad);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains("--relative-error"));
  }
  for (const std::string bad : {"0", "-0.05", "1.0", "nan"}) {
    test.write("bad.toml", study_text("seeds = [2]", 4) + "relative_error = " + bad + "\n");
    const auto refused = test.run("study bad.toml");
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains("damping.relative_error"));
  }
  CHECK(test.run("study study.toml --intervals 7").status == 2);
  CHECK(test.run("study study.toml --seam-error none").status == 2);
}

TEST_CASE("An interrupted study keeps the surfaces that it has finished and says how to go on",
          "[study]") {
  const ProgramTest test;
  std::string many = study;
  many.replace(many.find("seeds = [1, 2, 3]"), 17, "seed_count = 100000");
  test.write("study.toml", many);
  const std::string signal = GENERATE("INT", "TERM", "HUP");
  // The signal goes to the program itself, once something is finished after the first second: the
  // remaining time is told from then on. It spends that second stopped.
  const auto result = test.run("study study.toml -o result.h5 --json",
                               "(while ! ls result.h5.parts/*.realisation >/dev/null 2>&1; do "
                               "sleep 0.1; done; kill -STOP $$; sleep 1; kill -CONT $$; "
                               "n=$(ls result.h5.parts | wc -l); "
                               "while [ $(ls result.h5.parts | wc -l) -lt $((n + 3)) ]; do "
                               "sleep 0.1; done; kill -" +
                                   signal + " $$) &");
  INFO(signal << ": " << result.err);
  CHECK(result.status == 130);
  CHECK(result.out.empty());
  CHECK_THAT(result.err, Contains("study: surface 1 of 100000 (seed ") && Contains("left") &&
                             Contains("interrupted; ") && Contains("kept in result.h5.parts") &&
                             Contains("--resume"));
  CHECK(test.files() == std::set<std::string>{"study.toml", "result.h5.parts"});
  check_refused(test.run("study study.toml -o result.h5"), "--resume");
  check_refused(test.run("study study.toml --resume"), "--output");
}

TEST_CASE("A comparison of chosen models draws every point of the ensemble", "[study]") {
  const ProgramTest test;
  std::string text = study;
  text.replace(text.find("hurst = 0.8\n"), 12, "");
  test.write("study.toml", text + "[ensemble]\nhurst = [0.5, 0.8]\n");
  const std::string command = "compare study.toml --json --no-stick --models gw_moments,persson ";
  const auto result = test.done(command + "--plot all.svg");
  for (const auto& point : result.json()["points"])
    CHECK(keys(point["models"]) == std::set<std::string>{"bem", "gw_moments", "persson"});
  const std::string picture = test.read("all.svg");
  const auto occurrences = [&](const std::string& words) {
    int count = 0;
    for (auto at = picture.find(words); at != std::string::npos; at = picture.find(words, at + 1))
      ++count;
    return count;
  };
  // A column for each point, whose title stands once; the legend is in the first. Two rows have the
  // gap along an axis and the first row lists the models for all.
  CHECK(occurrences("H = 0.5") == 1);
  CHECK(occurrences("H = 0.8") == 1);
  CHECK(occurrences("mean gap") == 4);
  CHECK(occurrences("damping constant") == 2);
  CHECK(occurrences("<title>GW, summits from spectral moments") == 1);
  CHECK(occurrences("exponential law, fitted") >= 1);
  CHECK(occurrences("Bush, Gibson, Thomas") == 2);
  // Whoever asks for one model gets no line of another.
  CHECK(occurrences("interacting") == 0);
  check_refused(test.run("compare study.toml --models gw"), "'gw' is not known");
  check_refused(test.run("compare study.toml --plot all.svg"), "exists");
}

TEST_CASE("Without intervals the loss is that of the curve, and no error is stated", "[study]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3]"));
  const std::string study = "study study.toml --no-stick --intervals 0 ";
  const auto run = test.done(study + "--json -o curve.h5");
  const auto damping = run.json()["damping"];
  int known = 0;
  for (std::size_t k = 0; k < damping["pressure"].size(); ++k) {
    CHECK(damping["damping_constant"]["error"][k].is_null());
    if (damping["work_per_cycle"]["mean"][k].is_null()) continue;
    ++known;
    // The law is read from the file; a force is sought in it to 1e-12.
    const auto alone = test.done(
        "damping --curve curve.h5 --poisson 0.3 --normal-amplitude 0.1nm --drag-velocity 1mm/s "
        "--frequency 20kHz --json --pressure " +
        damping["pressure"][k].dump());
    CHECK(alone.json()["work_per_cycle"] ==
          Approx(damping["work_per_cycle"]["mean"][k]).epsilon(1e-9));
  }
  CHECK(known > 5);
  CHECK(test.run(study + "--dry-run --json").json()["points"][0]["intervals"] == 0);
  const auto compared = test.run("compare study.toml --no-stick --intervals 0 --models gw_moments");
  CHECK(compared.status == 0);
  CHECK_THAT(compared.out, Contains("theorem"));
  check_refused(test.run(study + "--relative-error 5%"), "--intervals: 0 intervals give no error");
  check_refused(test.run(study + "--seam-error window"), "--intervals: 0 intervals give no error");
  std::string text = study_text("seeds = [3]");
  test.write("study.toml", text + "intervals = 0\n");
  CHECK(test.run("study study.toml --no-stick --json").json()["damping"] == damping);
}
