// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "run_program.hpp"

namespace {

const std::string body =
    "viscoelastic --indentation 20um --contact-modulus 4MPa --poisson 0.5 --steps 128 ";
const std::string cone = body + "--law cone --angle 10deg ";
const std::string shear =
    "--mode equal-frequency --normal-amplitude 1um --tangential-amplitude 500nm --phase 90deg ";

}  // namespace

TEST_CASE("viscoelastic tells the losses of material and relaxation apart over frequency",
          "[viscoelastic]") {
  const ProgramTest test;
  const auto answer =
      test.run(cone + shear + "--prony 3MPa:20ms --angular-frequency 5e-3,50,5e6 --json").json();
  CHECK(keys(answer) == std::set<std::string>{"premises",
                                              "premises_of",
                                              "largest_motion",
                                              "regime",
                                              "indentation",
                                              "force",
                                              "normal_stiffness",
                                              "tangential_stiffness",
                                              "relaxed_modulus",
                                              "unrelaxed_modulus",
                                              "angular_frequency",
                                              "storage_modulus",
                                              "loss_modulus",
                                              "work_per_cycle",
                                              "normal_material_work",
                                              "tangential_material_work",
                                              "relaxation_work",
                                              "elastic_work",
                                              "power",
                                              "damping_constant",
                                              "mean_force",
                                              "min_contact_radius",
                                              "max_contact_radius"});
  CHECK(answer["relaxed_modulus"].get<double>() == Approx(1e6));
  CHECK(answer["unrelaxed_modulus"].get<double>() == Approx(4e6));
  CHECK(answer["loss_modulus"][1].get<double>() == Approx(1.5e6));
  const auto at = [&](const char* key, int i) { return answer[key][i].get<double>(); };
  for (int i = 0; i < 3; ++i) {
    CHECK(at("work_per_cycle", i) ==
          Approx(at("normal_material_work", i) + at("tangential_material_work", i) +
                 at("relaxation_work", i)));
    CHECK(at("elastic_work", i) == at("elastic_work", 0));
  }
  // Slow: the relaxed body, first order in ωτ = 1e-4. Fast: G(0)/G∞ times 1 + R/2 of it,
  // docs/theory.md, section 9; 128 steps.
  CHECK(at("relaxation_work", 0) == Approx(at("elastic_work", 0)).epsilon(2e-3));
  CHECK(at("relaxation_work", 2) == Approx(10 * at("elastic_work", 0)).epsilon(2e-3));
  CHECK(at("normal_material_work", 1) > 100 * at("normal_material_work", 0));
  CHECK(at("normal_material_work", 1) > 100 * at("normal_material_work", 2));
  CHECK(answer["premises"]["slip_of_opening_levels"]["value"].size() == 3);
}

TEST_CASE("The table of viscoelastic begins with what varies", "[viscoelastic]") {
  const ProgramTest test;
  const std::string drag = cone + "--normal-amplitude 1um,2um --drag-velocity 1um/s --frequency 5 ";
  REQUIRE(test.run(drag + "--prony 1MPa:1ms,2MPa:0.1s -o v.csv --plot v.svg").status == 0);
  CHECK(test.files() == std::set<std::string>{"v.csv", "v.motions.csv", "v.svg"});
  CHECK_THAT(test.read("v.motions.csv"), Catch::Contains("\nnormal_amplitude,angular_frequency,"));
  REQUIRE(test.run(drag + "--prony 1MPa:1ms -o v.h5").status == 0);
}

TEST_CASE("Bad input of viscoelastic is refused by its option", "[viscoelastic][bad-input]") {
  const ProgramTest test;
  const std::string moves = shear + "--frequency 10 ";
  check_refused(test.run(cone + moves), "--prony");
  check_refused(test.run(cone + shear + "--prony 1MPa:1s"), "--frequency");
  check_refused(test.run(cone + moves + "--prony 1MPa"), "--prony: '1MPa' is not MODULUS:TIME");
  check_refused(test.run(cone + moves + "--prony 1MPa:1s,"), "--prony");
  check_refused(test.run(cone + moves + "--prony 1MPa:1s,-2MPa:1s"),
                "--prony: -2000000 Pa, the modulus of term 2 of the series must be > 0");
  check_refused(test.run(cone + moves + "--prony 1MPa:0s"),
                "--prony: 0 s, the relaxation time of term 1");
  check_refused(test.run(cone + moves + "--prony 1MPa:1m"), "--prony");
  check_refused(test.run("viscoelastic --indentation 20um --young 1MPa,2MPa --poisson 0.5,0.5 "
                         "--law cone --angle 10deg --prony 1MPa:1s " +
                         moves),
                "--young");
  check_refused(test.run(cone + moves + "--prony 1MPa:1s --normal-force 1"), "--indentation");
}
