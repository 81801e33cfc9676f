// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "run_program.hpp"

using Catch::Contains;

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
      test.answer(cone + shear + "--prony 3MPa:20ms --angular-frequency 5e-3,50,5e6");
  CHECK(keys(answer) ==
        "validity conditions premises premises_of largest_motion regime indentation force "
        "normal_stiffness "
        "tangential_stiffness relaxed_modulus unrelaxed_modulus angular_frequency storage_modulus "
        "loss_modulus work_per_cycle normal_material_work tangential_material_work relaxation_work "
        "elastic_work power damping_constant mean_force min_contact_radius max_contact_radius");
  CHECK(answer["relaxed_modulus"] == Approx(1e6));
  CHECK(answer["unrelaxed_modulus"] == Approx(4e6));
  CHECK(answer["loss_modulus"][1] == Approx(1.5e6));
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

TEST_CASE("Slip under a viscoelastic contact is answered with what there is", "[viscoelastic]") {
  const ProgramTest test;
  // M = 0.01 * 5 nm/(0.8 * 2 um): levels slip, and no loss with slip is computed.
  const auto run = test.run(
      "viscoelastic --law sphere --radius 5mm --indentation 20um --contact-modulus 4MPa --poisson "
      "0.3 --prony 3MPa:20ms --mode equal-frequency --normal-amplitude 5nm --tangential-amplitude "
      "2um --phase 90deg --frequency 1,10 --friction-coefficient 0.01");
  CHECK_THAT(run.out, Contains("a smaller motion; slip is not followed here"));
  CHECK(run.out.find("use the loss with slip") == std::string::npos);
}

TEST_CASE("The table of viscoelastic begins with what varies", "[viscoelastic]") {
  const ProgramTest test;
  const std::string drag = cone + "--normal-amplitude 1um,2um --drag-velocity 1um/s --frequency 5 ";
  test.done(drag + "--prony 1MPa:1ms,2MPa:0.1s -o v.csv --plot v.svg");
  CHECK(test.files() == "v.csv v.motions.csv v.svg");
  CHECK_THAT(test.read("v.motions.csv"), Contains("\nnormal_amplitude,angular_frequency,"));
  test.done(drag + "--prony 1MPa:1ms -o v.h5");
}
