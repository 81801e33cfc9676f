// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

const std::string recipe =
    "generate --points 64,48 --size-x 4um --size-y 3um --hurst 0.8 --rolloff 2um --short-cutoff "
    "0.5um "
    "--rms-height 10nm ";

}  // namespace

TEST_CASE("A generated surface is described by the agreed keys", "[generate]") {
  const ProgramTest test;
  const auto result = test.run(recipe + "--seed 3 --method random-phase --json -o rough.h5");
  REQUIRE(result.status == 0);
  const auto answer = result.json();
  CHECK(keys(answer) == std::set<std::string>{"nx", "ny", "size_x", "size_y", "seed", "method",
                                              "target", "lattice", "realised"});
  CHECK(keys(answer["target"]) == std::set<std::string>{"rms_height", "rms_slope"});
  CHECK(keys(answer["realised"]) ==
        std::set<std::string>{"rms_height", "rms_slope", "moment0", "moment2", "moment4", "nayak"});
  CHECK(answer["nx"] == 64);
  CHECK(answer["ny"] == 48);
  CHECK(answer["size_x"] == 4e-6);
  CHECK(answer["target"]["rms_height"] == Approx(1e-8).epsilon(1e-12));
  // Random phases leave the power of no mode to chance.
  CHECK(answer["realised"]["rms_height"].get<double>() ==
        Approx(answer["lattice"]["rms_height"].get<double>()).epsilon(1e-10));
  CHECK(test.files() == std::set<std::string>{"rough.h5"});
}

TEST_CASE("A surface that was written is read back as it was made", "[generate]") {
  const ProgramTest test;
  const auto made = test.run(recipe + "--seed 3 --json -o rough.h5").json();
  const auto seen = test.run("info rough.h5 --json").json();
  CHECK(keys(seen) == std::set<std::string>{"nx", "ny", "size_x", "size_y", "undefined_points",
                                            "mean", "rms_height", "rms_slope", "skewness",
                                            "kurtosis", "moment0", "moment2", "moment4", "nayak",
                                            "hurst", "summits"});
  CHECK(keys(seen["hurst"]) == std::set<std::string>{"value", "low", "high"});
  CHECK(keys(seen["summits"]) ==
        std::set<std::string>{"density", "mean_height", "rms_height", "mean_radius"});
  for (const char* key : {"rms_height", "rms_slope", "moment0", "moment2", "moment4", "nayak"}) {
    INFO(key);
    // The mean, of the size of round-off, is subtracted on reading.
    CHECK(seen[key].get<double>() == Approx(made["realised"][key].get<double>()).epsilon(1e-12));
  }
}

TEST_CASE("A generated surface is the same in every bit for one and two threads", "[generate]") {
  const ProgramTest test;
  // As NPY, which has no date in it.
  REQUIRE(test.run(recipe + "--threads 1 -o one.npy").status == 0);
  REQUIRE(test.run(recipe + "--threads 2 -o two.npy").status == 0);
  CHECK(test.read("one.npy").size() > 64 * 48 * 8);
  CHECK(test.read("one.npy") == test.read("two.npy"));
}

TEST_CASE("A converted surface has the same statistics", "[convert]") {
  const ProgramTest test;
  REQUIRE(test.run(recipe + "-o rough.h5").status == 0);
  REQUIRE(test.run("convert rough.h5 rough.npy").status == 0);
  const auto before = test.run("info rough.h5 --json").json();
  const auto after =
      test.run("info rough.npy --size-x 4um --size-y 3um --detrend mean --json").json();
  CHECK(after["rms_height"].get<double>() ==
        Approx(before["rms_height"].get<double>()).epsilon(1e-12));
  check_refused(test.run("convert rough.h5 rough.npy"), "rough.npy");
}
