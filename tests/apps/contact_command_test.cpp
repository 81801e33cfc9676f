// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/io/result_file.hpp>

#include "run_program.hpp"

using namespace salebra;

namespace {

void make_rough(const ProgramTest& test) {
  REQUIRE(
      test.run("generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
               "--rms-height 10nm --seed 3 -o rough.h5")
          .status == 0);
}

}  // namespace

TEST_CASE("A contact is described by the agreed keys and is the same for one and two threads",
          "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --pressure 20MPa --contact-modulus 10GPa --json ";
  const auto one = test.run(press + "--threads 1");
  REQUIRE(one.status == 0);
  const auto answer = one.json();
  CHECK(keys(answer) == std::set<std::string>{"pressure", "force", "contact_area_fraction",
                                              "mean_gap", "indentation", "max_pressure",
                                              "elastic_energy", "iterations", "fft_count",
                                              "residual", "converged", "seconds"});
  CHECK(answer["converged"] == true);
  CHECK(answer["pressure"].get<double>() == Approx(2e7).epsilon(1e-9));
  CHECK(answer["force"].get<double>() == Approx(2e7 * 16e-12).epsilon(1e-9));
  CHECK(answer["residual"].get<double>() < 1e-10);

  const auto other = test.run(press + "--threads 2 -o two.h5").json();
  REQUIRE(test.run(press + "--threads 1 -o one.h5").status == 0);
  const Field first = ResultReader(test.folder() / "one.h5").field("contact/contact_pressure");
  const Field second = ResultReader(test.folder() / "two.h5").field("contact/contact_pressure");
  CHECK(((first > 0) == (second > 0)).all());
  CHECK((first > 0).count() > 10);
  CHECK(other["contact_area_fraction"] == answer["contact_area_fraction"]);
  for (const char* key : {"mean_gap", "indentation", "max_pressure", "elastic_energy"}) {
    INFO(key);
    CHECK(other[key].get<double>() == Approx(answer[key].get<double>()).epsilon(1e-10));
  }
}

TEST_CASE("The mean gap that a pressure gives leads back to the pressure", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const auto by_pressure =
      test.run("contact rough.h5 --pressure 20MPa --contact-modulus 10GPa --json").json();
  const auto by_gap =
      test.run(fmt::format("contact rough.h5 --mean-gap {} --contact-modulus 10GPa --json",
                           by_pressure["mean_gap"].get<double>()))
          .json();
  // Both to a residual of 1e-10; pressure falls by a factor e over a third of the rms height.
  CHECK(by_gap["pressure"].get<double>() == Approx(2e7).epsilon(1e-8));
  const auto by_force =
      test.run("contact rough.h5 --force-newton 0.32mN --contact-modulus 10GPa --json").json();
  CHECK(by_force["mean_gap"].get<double>() ==
        Approx(by_pressure["mean_gap"].get<double>()).epsilon(1e-8));
}

TEST_CASE("A contact that does not converge is not presented as a result", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const auto result = test.run(
      "contact rough.h5 --pressure 20MPa --contact-modulus 10GPa --tolerance 1e-12 "
      "--max-iterations 2 -o c.h5");
  CHECK(result.status == 1);
  CHECK_THAT(result.err, Catch::Contains("salebra: error: contact: "));
  CHECK(test.files() == std::set<std::string>{"rough.h5"});
}

TEST_CASE("A sweep leads to a curve, its fit and a damping constant", "[sweep][fit]") {
  const ProgramTest test;
  make_rough(test);
  const auto swept = test.run(
      "sweep rough.h5 --pressures 2:60MPa:8 --stiffness --contact-modulus 10GPa --poisson 0.3 "
      "--json -o curve.h5");
  REQUIRE(swept.status == 0);
  const auto curve = swept.json()["curve"];
  CHECK(keys(swept.json()) == std::set<std::string>{"curve"});
  CHECK(keys(curve) == std::set<std::string>{"pressure", "mean_gap", "indentation",
                                             "contact_area_fraction", "normal_stiffness",
                                             "tangential_stiffness", "converged"});
  for (const auto& column : curve) CHECK(column.size() == 8);
  // One elastic body: G*/E* = 2(1 − ν)/(2 − ν).
  CHECK(curve["tangential_stiffness"][3].get<double>() ==
        Approx(1.4 / 1.7 * curve["normal_stiffness"][3].get<double>()).epsilon(1e-12));

  const auto fit = test.run("fit curve.h5 --pressure-window 2MPa,60MPa --json").json();
  CHECK(keys(fit) == std::set<std::string>{"decay_length", "decay_length_low", "decay_length_high",
                                           "reference_pressure", "r_squared", "window",
                                           "decay_length_over_rms_height", "local", "test",
                                           "window_sensitivity"});
  CHECK(keys(fit["window"]) == std::set<std::string>{"pressure_min", "pressure_max", "points"});
  CHECK(fit["window"]["points"] == 8);
  CHECK(fit["decay_length_low"] < fit["decay_length"]);
  CHECK(fit["decay_length"] < fit["decay_length_high"]);

  check_refused(test.run("fit curve.h5 --pressure-window 1MPa,3MPa"), "at least 3");
  check_refused(test.run("fit rough.h5"), "rough.h5");

  const auto damping = test.run(
      "damping --curve curve.h5 --pressure 20MPa --poisson 0.3 --normal-amplitude 0.1nm "
      "--drag-velocity 1mm/s "
      "--frequency 20kHz --json");
  INFO(damping.err);
  REQUIRE(damping.status == 0);
  CHECK(damping.json()["damping_constant"] > 0);
  CHECK(damping.json()["force"].get<double>() == Approx(20e6 * 16e-12).epsilon(1e-9));
}

TEST_CASE("Greenwood-Williamson curves come from a surface or from parameters", "[gw]") {
  const ProgramTest test;
  make_rough(test);
  const std::set<std::string> curve_keys{"separation",
                                         "pressure",
                                         "mean_gap",
                                         "indentation",
                                         "contact_area_fraction",
                                         "normal_stiffness",
                                         "tangential_stiffness",
                                         "converged"};
  for (const std::string summits : {"moments", "deterministic"}) {
    const auto result =
        test.run("gw rough.h5 --summits " + summits +
                 " --pressures 2:60MPa:5 --contact-modulus 10GPa --poisson 0.3 --json");
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto answer = result.json();
    CHECK(keys(answer) == std::set<std::string>{"parameters", "curve"});
    CHECK(keys(answer["curve"]) == curve_keys);
    CHECK(answer["parameters"]["density"] > 0);
    CHECK(answer["curve"]["pressure"][0].get<double>() == Approx(2e6).epsilon(1e-9));
  }
  const auto answer =
      test.run(
              "gw --density 10/um2 --radius 100nm --summit-rms 10nm --distribution exponential "
              "--separations 10nm,30nm --contact-modulus 10GPa --json")
          .json();
  // F ∝ exp(−s/σ), from the lowest force to the highest.
  CHECK(answer["curve"]["pressure"][1].get<double>() /
            answer["curve"]["pressure"][0].get<double>() ==
        Approx(std::exp(2.0)).epsilon(1e-12));
  CHECK(answer["curve"]["tangential_stiffness"][0].is_null());
}
