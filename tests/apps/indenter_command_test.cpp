// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "run_program.hpp"

using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;
const std::string body = "--contact-modulus 1GPa --poisson 0.3 ";
const std::string shear =
    "--mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm --phase 60deg ";

}  // namespace

TEST_CASE("A paraboloid has Hertz's contact at rest, and its losses at any amplitude",
          "[indenter]") {
  const ProgramTest test;
  const std::string paraboloid = "damping --law paraboloid --radius 10mm --indentation 1um " + body;
  const auto state = test.answer(paraboloid);
  CHECK(state["contact_radius"] == Approx(1e-4).epsilon(1e-12));
  CHECK(state["force"] == Approx(4.0 / 3 * 1e9 * 0.1 * 1e-9).epsilon(1e-12));
  const auto loss = test.answer(paraboloid + shear);
  CHECK(keys(state) ==
        "contact_radius indentation force normal_stiffness tangential_stiffness force_curvature");
  const double ratio = 1.4 / 1.7;
  CHECK(loss["small_amplitude_work"] ==
        Approx(8.0 / 3 * ratio * 1e11 * 4e-14 * 3e-7 * 0.75).epsilon(1e-12));
  CHECK(loss["ratio"] ==
        Approx(number(loss, "/work_per_cycle") / number(loss, "/small_amplitude_work")));
  // What it answers goes into a file as well.
  test.done(paraboloid + "-o rest.h5");
  test.done(paraboloid + shear + "-o loss.h5");
  CHECK(test.files() == "loss.h5 rest.h5");
  // Much friction is full stick; the loop is followed in 2000 straight steps.
  const auto rough = test.answer(paraboloid + shear + "--friction-coefficient 1e5");
  CHECK(rough["work_per_cycle"] == Approx(loss["work_per_cycle"]).epsilon(1e-4));
  CHECK(rough["work_per_cycle_without_slip"] == loss["work_per_cycle"]);
  CHECK(rough["power"].is_null());
}

TEST_CASE("Profiles and trajectories are read from files", "[indenter]") {
  const ProgramTest test;
  std::string profile = "r, f\n", path = "# time indentation x\n";
  for (int i = 0; i <= 50; ++i) {
    const double r = 4e-6 * i;
    profile += std::to_string(r * 1e6) + "e-6, " + std::to_string(r * r / 0.02 * 1e12) + "e-12\n";
  }
  for (int i = 0; i <= 400; ++i) {
    const double angle = 2 * pi * i / 400;
    path += std::to_string(i) + " " + std::to_string(1000 - 300 * std::cos(angle)) + "e-9 " +
            std::to_string(200 * std::cos(angle + pi / 3)) + "e-9\n";
  }
  test.write("profile.txt", profile);
  test.write("path.txt", path);
  const auto table =
      test.answer("damping --law table --table profile.txt --indentation 1um " + body + shear);
  const auto exact =
      test.answer("damping --law paraboloid --radius 10mm --indentation 1um " + body + shear);
  // The table is written with 1e-12 m and interpolated by cubics.
  CHECK(table["work_per_cycle"] == Approx(exact["work_per_cycle"]).epsilon(1e-3));
  const auto followed =
      test.answer("damping --law paraboloid --radius 10mm --trajectory path.txt " + body);
  CHECK(followed["work_per_cycle"] == Approx(exact["work_per_cycle"]).epsilon(1e-3));
  CHECK(followed["loss_factor"] > 0);

  // The phase of y is a quarter of a turn away; each direction by itself makes the sum.
  std::string both = "t, indentation, x, y\n", across;
  for (int i = 0; i <= 400; ++i) {
    const double angle = 2 * pi * i / 400;
    const std::string place =
        std::to_string(i) + " " + std::to_string(1000 - 300 * std::cos(angle)) + "e-9 ";
    const std::string y = std::to_string(100 * std::cos(angle - pi / 6)) + "e-9\n";
    both += place + std::to_string(200 * std::cos(angle + pi / 3)) + "e-9 " + y;
    across += place + y;
  }
  test.write("both.txt", both);
  test.write("across.txt", across);
  const std::string follow = "damping --law paraboloid --radius 10mm --trajectory ";
  const auto planar = test.answer(follow + "both.txt -o both.h5 --plot both.svg " + body);
  CHECK(planar["work_per_cycle"] ==
        Approx(number(followed, "/work_per_cycle") +
               test.answer(follow + "across.txt " + body)["work_per_cycle"].get<double>())
            .epsilon(1e-9));
  CHECK(planar["premises"]["slip_of_opening_levels"]["verdict"] == "unknown");
}

TEST_CASE("damping writes the maps of Fig. 4 and of finite friction", "[indenter]") {
  const ProgramTest test;
  const std::string command =
      "damping --law paraboloid --radius 10mm --indentation 1um --json " + body + shear;
  test.done(command + "--map-phases 32 --map-radii 32 --stress-map fig4.h5 --plot fig4.svg");
  CHECK(test.files() == "fig4.h5 fig4.svg");
  CHECK_THAT(test.read("fig4.svg"), Contains("tangential stress"));
  check_refused(test.run(command + "--stress-map fig4.h5"), "--overwrite");
  test.done(command +
            "--steps 64 --friction-numbers 0.1:10:3 --friction-map map.h5 --plot map.png");
  CHECK(test.files() == "fig4.h5 fig4.svg map.h5 map.png");
}

TEST_CASE("damping draws an indenter at rest and a period of any of its motions",
          "[indenter][plot]") {
  const ProgramTest test;
  for (const std::string shape :
       {"paraboloid --radius 10mm", "cone --angle 0.1", "sphere --radius 1mm",
        "cylinder --radius 0.1mm", "rounded-cylinder --radius 0.1mm --edge-radius 1mm"}) {
    test.done("damping --law " + shape + " --indentation 1um --overwrite --plot rest.svg " + body);
    CHECK_THAT(test.read("rest.svg"), Contains("one-dimensional image"));
  }
  const std::string motion =
      "--mode two-frequencies --normal-amplitude 1.2um --tangential-amplitude 200nm --phase 60deg "
      "--frequency 300Hz --tangential-frequency 200Hz --plot cycle.svg ";
  const auto opening =
      test.answer("damping --law cone --angle 0.1 --indentation 1um --friction-coefficient 0.5 " +
                  body + motion);
  CHECK(opening["slip_share"] >= 0);
  CHECK_THAT(test.read("cycle.svg"), Contains("in contact"));
}

TEST_CASE("Every indenter takes ranges, and a coarse table is warned of", "[indenter]") {
  const ProgramTest test;
  // A ball of 1 mm radius with a cap worn to 2 mm within 30 µm, in steps of 2.5 and 7.5 µm: at 500
  // nm g(a) changes by 2.6 and 12 % without every other point.
  for (const int step : {1, 3}) {
    std::string rows;
    for (int i = 0; i <= 40; i += step) {
      const double r = 2.5e-6 * i;
      rows += std::to_string(r * 1e6) + "e-6 " +
              std::to_string((r < 30e-6 ? 0.5 * r * r : r * r - 4.5e-10) / 2e-3 * 1e12) + "e-12\n";
    }
    test.write("table" + std::to_string(step) + ".txt", rows);
  }
  const std::string at = "--indentation 500nm " + body;
  const std::string table = "damping --law table --table table";
  const std::string ranges =
      "--normal-amplitude 10nm:50nm:5 --drag-velocity 1um/s --frequency 20kHz";
  CHECK(test.answer(table + "1.txt " + at + ranges)["work_per_cycle"].size() == 5);
  CHECK(test.run(table + "1.txt " + at).err.empty());
  CHECK_THAT(test.done(table + "3.txt " + at).err, Contains("warning: the table is coarse"));
}

TEST_CASE("A table that is most likely not in metres is warned of", "[indenter]") {
  const ProgramTest test;
  // The ball of 1 mm radius in µm.
  std::string rows;
  for (int r = 0; r <= 100; r += 2)
    rows += std::to_string(r) + " " + std::to_string(r * r / 2000.0) + "\n";
  test.write("table.txt", rows);
  const auto result =
      test.done("damping --law table --table table.txt --normal-force 50mN " + body);
  CHECK_THAT(result.err, Contains("warning: the table has radii up to 100 m; check the unit"));
}

TEST_CASE("A damper: γ, the decay it makes and the amplitude that stabilises", "[damper]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 ";
  const std::string single = law + "--normal-amplitude 20nm --frequency 20kHz ";
  const std::string map = law + "--normal-amplitude 1:50nm:4 --frequency 1:100kHz:3 ";
  const auto one = test.answer(single + "--mass 10g --spring-stiffness 1kN/m");
  const double gamma = one["damping_constant"];
  CHECK(test.answer(single + "--drag-velocity 1mm/s")["damping_constant"].get<double>() ==
        Approx(gamma).epsilon(1e-9));
  CHECK(one["decay"]["damping_ratio"] ==
        Approx(gamma / (2 * 0.01 * number(one, "/decay/natural_frequency"))).epsilon(1e-12));
  const auto stable =
      test.answer(law + "--frequency 20kHz --falling-slope " + std::to_string(gamma));
  CHECK(stable["stabilising_amplitude"] == Approx(20e-9).epsilon(1e-4));
  const auto several = test.answer(map + "--falling-slope 5 --output map.h5 --plot map.svg");
  REQUIRE(several["damping_constant"].size() == 4);
  REQUIRE(several["damping_constant"][0].size() == 3);
  CHECK(several["stabilising_amplitude"].size() == 3);
  CHECK_THAT(test.read("map.svg"), Contains("Steady sliding is stable where"));
  test.done(single + "--mass 10g --plot decay.svg");
  CHECK(test.files() == "map.h5 map.svg decay.svg");
}
