// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "run_program.hpp"

TEST_CASE("oscillate reproduces the paper's experiment by the name of a shape", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape parabola --points 40 --steps 24 --contact-modulus 1GPa --poisson 0.3 "
      "--json";
  const auto answer = test.run(command + " --phase 45deg --output cycle.h5").json();
  for (const char* key : {"work_per_cycle", "predicted", "ratio", "predicted_finite",
                          "ratio_finite", "contact_area_min", "contact_area_max", "time", "work",
                          "error_estimate", "released_energy", "converged"})
    CHECK(answer.contains(key));
  CHECK(answer["converged"] == true);
  CHECK(test.files().count("cycle.h5") == 1);
  // A round contact: 1 up to the 20 cells across it and h²/24 = 0.3 % of the steps.
  CHECK(answer["ratio_finite"].get<double>() == Approx(1).epsilon(0.02));
  CHECK(answer["released_energy"].get<double>() ==
        Approx(answer["work_per_cycle"].get<double>()).epsilon(1e-6));
  CHECK(answer["time"].size() == 25);
  CHECK(answer["time"].back() == 1);
  // The loop of equal frequencies closes: all work of the period is lost.
  CHECK(answer["work"].back().get<double>() ==
        Approx(answer["work_per_cycle"].get<double>()).epsilon(1e-9));
  // a² = Rδ, R = 4 mm, from δ = 14 to 26 µm.
  CHECK(answer["contact_area_max"].get<double>() ==
        Approx(std::numbers::pi * 4e-3 * 26e-6).epsilon(0.03));
  const auto levels = test.run(command + " --phase 45deg --method levels").json();
  CHECK(levels["work_per_cycle"].get<double>() ==
        Approx(answer["work_per_cycle"].get<double>()).epsilon(0.02));
  CHECK_FALSE(levels.contains("time"));
}

TEST_CASE("oscillate says what it needs", "[oscillate]") {
  const ProgramTest test;
  const std::string material = " --contact-modulus 1GPa --poisson 0.3";
  check_refused(test.run("oscillate" + material), "--shape");
  check_refused(test.run("oscillate --shape cone --contact-modulus 1GPa"), "--tangential-modulus");
  check_refused(test.run("oscillate --shape cone --points 4" + material), "--points");
  check_refused(test.run("oscillate --shape cone --mode drag --normal-amplitude 1um" + material),
                "--drag-velocity");
  check_refused(test.run("oscillate --shape cone --steps 2 --points 16" + material), "steps");
  check_refused(test.run("oscillate --shape cone --normal-amplitude 1um,2um" + material), "range");
}
