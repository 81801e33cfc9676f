// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "run_program.hpp"

using Catch::Contains;

namespace {

const std::string recipe =
    "generate --points 64,48 --size-x 4um --size-y 3um --hurst 0.8 --rolloff 2um --short-cutoff "
    "0.5um --rms-height 10nm ";

}  // namespace

TEST_CASE("A generated surface is described by the agreed keys", "[generate]") {
  const ProgramTest test;
  const auto answer = test.answer(recipe + "--seed 3 --method random-phase -o rough.h5");
  CHECK(keys(answer) == "nx ny size_x size_y seed method target lattice realised");
  CHECK(keys(answer["target"]) == "rms_height rms_slope");
  CHECK(keys(answer["realised"]) == "rms_height rms_slope moment0 moment2 moment4 nayak");
  CHECK(answer["nx"] == 64);
  CHECK(answer["ny"] == 48);
  CHECK(answer["size_x"] == 4e-6);
  CHECK(answer["target"]["rms_height"] == Approx(1e-8).epsilon(1e-12));
  // Random phases leave the power of no mode to chance.
  CHECK(answer["realised"]["rms_height"] == Approx(answer["lattice"]["rms_height"]).epsilon(1e-10));
  CHECK(test.files() == "rough.h5");
}

TEST_CASE("A surface that was written is read back as it was made", "[generate]") {
  const ProgramTest test;
  const auto made = test.answer(recipe + "--seed 3 -o rough.h5");
  const auto seen = test.answer("statistics rough.h5");
  CHECK(keys(seen["hurst"]) == "value low high");
  CHECK(keys(seen["summits"]) == "summit_density mean_height summit_rms mean_radius");
  for (const char* key : {"rms_height", "rms_slope", "moment0", "moment2", "moment4", "nayak"}) {
    INFO(key);
    // The mean, of the size of round-off, is subtracted on reading.
    CHECK(seen[key] == Approx(made["realised"][key]).epsilon(1e-12));
  }
}

TEST_CASE("Without roll-off and limit the power law begins at the longer side", "[generate]") {
  const ProgramTest test;
  const std::string bare =
      "generate --points 64,48 --size-x 4um --size-y 3um --hurst 0.8 --short-cutoff 0.5um "
      "--rms-slope 0.1 --json -o ";
  test.done(bare + "bare.npy");
  test.done(bare + "limited.npy --long-cutoff 4um");
  CHECK(test.read("bare.npy") == test.read("limited.npy"));
  test.done(bare + "plateau.npy --rolloff 3um");
  CHECK(test.read("bare.npy") != test.read("plateau.npy"));
  test.done(
      "generate --profile --points 64 --size-x 4um --hurst 0.8 --short-cutoff 0.5um --rms-slope "
      "0.1");
}

TEST_CASE("A generated surface is the same in every bit for one and two threads", "[generate]") {
  const ProgramTest test;
  // As NPY, which has no date in it.
  test.done(recipe + "--threads 1 -o one.npy");
  test.done(recipe + "--threads 2 -o two.npy");
  CHECK(test.read("one.npy").size() > 64 * 48 * 8);
  CHECK(test.read("one.npy") == test.read("two.npy"));
}

TEST_CASE("A converted surface has the same statistics", "[convert]") {
  const ProgramTest test;
  test.done(recipe + "-o rough.h5");
  test.done("convert rough.h5 rough.npy");
  const auto before = test.answer("statistics rough.h5");
  const auto after = test.answer("statistics rough.npy --size-x 4um --size-y 3um --detrend mean");
  CHECK(after["rms_height"] == Approx(before["rms_height"]).epsilon(1e-12));
}

TEST_CASE("exact-rms has exactly the rms height or slope asked", "[generate]") {
  const ProgramTest test;
  const auto height = test.answer(recipe + "--method exact-rms");
  CHECK(height["realised"]["rms_height"] == Approx(1e-8).epsilon(1e-12));
  // This cell holds few of the long waves: the modes alone would be off.
  CHECK(std::abs(height["lattice"]["rms_height"].get<double>() / 1e-8 - 1) > 1e-3);
  const auto slope = test.answer(
      "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
      "--rms-slope 0.1 --method exact-rms");
  CHECK(slope["realised"]["rms_slope"] == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("A spectrum from a table is the spectrum that wrote it, in any convention",
          "[generate]") {
  const ProgramTest test;
  // C = 1e-30 m⁴ from 2 to 16 waves on a cell of 1 µm.
  const double q = 2 * std::numbers::pi / 1e-6;
  const auto line = [](double a, double b) {
    char text[64];
    std::snprintf(text, sizeof text, "%.17g %.17g\n", a, b);
    return std::string(text);
  };
  const double turn = std::pow(2 * std::numbers::pi, 2);
  test.write("own.txt", "q C\n" + line(2 * q, 1e-30) + line(16 * q, 1e-30));
  test.write("theirs.txt", line(2 * q, turn * 1e-30) + line(16 * q, turn * 1e-30));
  const std::string grid = "generate --points 64 --size-x 1um --method random-phase ";
  const auto own = test.answer(grid + "--psd-table own.txt");
  const double exact = std::sqrt(1e-30 * std::numbers::pi * (256 - 4) * q * q);
  CHECK(own["target"]["rms_height"] == Approx(exact).epsilon(1e-9));
  const auto theirs = test.answer(grid + "--psd-table theirs.txt --convention surface-topography");
  CHECK(theirs["target"]["rms_height"] == Approx(exact).epsilon(1e-9));
  const auto scaled = test.answer(grid + "--psd-table own.txt --rms-height 3nm");
  CHECK(scaled["target"]["rms_height"] == Approx(3e-9).epsilon(1e-9));
}

TEST_CASE("A stretched surface has a lay of Peklenik's number", "[generate]") {
  const ProgramTest test;
  const auto made = test.answer(
      "generate --points 256 --size-x 1mm --correlation gaussian --correlation-length 40um "
      "--stretch-along 2 --stretch-across 0.5 --lay-angle 90deg --rms-height 1um --method "
      "random-phase -o lay.h5");
  CHECK(made["anisotropy"]["peklenik"] == 4);
  CHECK(made["anisotropy"]["correlation_length_along"] == Approx(80e-6));
  const auto seen = test.answer("statistics lay.h5 --all");
  // The lay runs along y, the waves across it.
  CHECK(seen["areal"]["Str"] == Approx(0.25).epsilon(0.05));
  const double direction = seen["areal"]["Std"];
  CHECK(std::min(direction, std::numbers::pi - direction) < 0.02);
}

TEST_CASE("Heights have the skewness and kurtosis asked, in the order of the random surface",
          "[generate]") {
  const ProgramTest test;
  const auto made = test.answer(recipe + "--skewness -0.8 --kurtosis 4.5");
  CHECK(made["method"] == "non-gaussian");
  CHECK(made["distribution"]["converged"] == true);
  // 3072 points cut the tails.
  CHECK(made["realised"]["skewness"] == Approx(-0.8).margin(0.05));
  CHECK(made["realised"]["kurtosis"] == Approx(4.5).margin(0.3));
  const auto weibull = test.answer(recipe + "--weibull 1.5 -o w.h5");
  // Γ(1 + 3/k) … of Weibull's distribution of shape 1.5.
  CHECK(weibull["realised"]["skewness"] == Approx(1.072).margin(0.05));
  const auto copied = test.answer(recipe + "--heights-from w.h5 --seed 9");
  CHECK(copied["realised"]["skewness"] == Approx(weibull["realised"]["skewness"]).epsilon(0.01));
}

TEST_CASE("Shapes stand off the grid unless told otherwise", "[generate]") {
  const ProgramTest test;
  const auto ball =
      test.answer("generate --shape paraboloid --radius 1mm --points 32 --size-x 32um -o p.npy");
  CHECK(ball["shape"] == "paraboloid");
  // m4 of a paraboloid is 1/R² along either axis.
  CHECK(ball["realised"]["moment4"] == Approx(1e6).epsilon(1e-6));
  const std::string scan = " --size-x 32um --size-y 32um --detrend none --all";
  const auto off = test.answer("statistics p.npy" + scan);
  // The nearest point is (0.31, 0.17) of a cell away: −(0.31² + 0.17²) dx²/(2R).
  const double highest = off["bearing"]["height"][0];
  CHECK(highest == Approx(-(0.31 * 0.31 + 0.17 * 0.17) * 1e-12 / 2e-3).epsilon(1e-6));
  test.done(
      "generate --shape paraboloid --radius 1mm --points 32 --size-x 32um --center middle -o "
      "m.npy");
  CHECK(std::abs(test.answer("statistics m.npy" + scan)["bearing"]["height"][0].get<double>()) <
        1e-20);
  for (const char* shape :
       {"sphere --radius 1um", "cylinder --radius 1um --depth 1um", "ridge --radius 1um",
        "rounded-cylinder --radius 1um --edge-radius 1um", "wedge --angle 0.1",
        "elliptic-paraboloid --radius-x 1um --radius-y 2um",
        "ellipsoid --semi-x 1um --semi-y 2um --semi-z 1um",
        "pyramids --count-x 2 --count-y 3 --angle 20deg",
        "sinusoid --amplitude 1nm --count-x 1 --count-y 2"}) {
    INFO(shape);
    test.done(std::string("generate --points 32 --size-x 4um --shape ") + shape);
  }
}

TEST_CASE("A crop is a part of its surface, and a composite the sum of two", "[generate]") {
  const ProgramTest test;
  test.done(recipe + "--seed 1 -o one.npy");
  const auto crop = test.answer(recipe + "--seed 1 --crop 32,16 -o part.h5");
  CHECK(crop["nx"] == 32);
  CHECK(crop["size_y"] == Approx(1e-6));
  CHECK(crop["periodic"] == false);
  const auto sum = test.answer(recipe + "--seed 1 --composite one.npy");
  const auto single = test.answer(recipe + "--seed 1");
  CHECK(sum["realised"]["rms_height"] ==
        Approx(2 * single["realised"]["rms_height"].get<double>()).epsilon(1e-12));
}

TEST_CASE("A profile is made from its own spectrum", "[generate]") {
  const ProgramTest test;
  const auto answer = test.answer(
      "generate --profile --points 1024 --size-x 1mm --hurst 0.6 --rolloff 0.2mm --short-cutoff "
      "10um --rms-height 1um --method random-phase -o line.csv");
  CHECK(answer["realised"]["rms_height"] == Approx(answer["lattice"]["rms_height"]).epsilon(1e-10));
  CHECK(answer["realised"]["rms_slope"] == Approx(answer["lattice"]["rms_slope"]).epsilon(1e-10));
  CHECK(test.read("line.profile.csv").find("x,heights") != std::string::npos);
}

TEST_CASE("A surface that the grid cannot carry is refused, one that it carries badly is warned of",
          "[generate]") {
  const ProgramTest test;
  const std::string grid = "generate --points 64 --size-x 64um --hurst 0.8 --rms-height 1um ";
  check_refused(test.run(grid + "--rolloff 8um --short-cutoff 1.9um"), "short");
  const auto few = test.run(grid + "--rolloff 8um --short-cutoff 4um");
  CHECK(few.status == 0);
  CHECK(few.err.find("warning: the shortest wavelength has 4 cells") != std::string::npos);
  const auto long_waves = test.run(grid + "--rolloff 32um --short-cutoff 8um");
  CHECK(long_waves.err.find("scatters") != std::string::npos);
  CHECK(few.err.find("memory: ") != std::string::npos);
}

TEST_CASE("A generation that is interrupted leaves no file", "[generate]") {
  const ProgramTest test;
  // A grid that takes seconds: the signal comes while its modes are summed, or while they are
  // transformed.
  const std::string surface =
      "generate --points 8192 --size-x 1mm --hurst 0.8 --rolloff 0.25mm --short-cutoff 1um "
      "--rms-height 1um --threads 1 -o rough.h5";
  for (const std::string more : {"", " --skewness 1 --kurtosis 5"}) {
    const auto result = test.run(surface + more, "(sleep 0.4; kill -INT $$) &");
    INFO(result.err);
    CHECK(result.status == 130);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Contains("interrupted"));
    CHECK(test.files().empty());
  }
}
