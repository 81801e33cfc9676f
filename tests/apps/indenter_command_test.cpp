// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "run_program.hpp"

namespace {

constexpr double pi = std::numbers::pi;
const std::string body = "--contact-modulus 1GPa --poisson 0.3 ";
const std::string shear =
    "--mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm --phase 60deg ";

}  // namespace

TEST_CASE("A paraboloid has Hertz's contact at rest, and its losses at any amplitude",
          "[indenter]") {
  const ProgramTest test;
  const std::string paraboloid =
      "damping --law paraboloid --radius 10mm --indentation 1um --json " + body;
  const auto state = test.run(paraboloid).json();
  CHECK(state["contact_radius"].get<double>() == Approx(1e-4).epsilon(1e-12));
  CHECK(state["force"].get<double>() == Approx(4.0 / 3 * 1e9 * 0.1 * 1e-9).epsilon(1e-12));
  const auto loss = test.run(paraboloid + shear).json();
  CHECK(keys(state) == std::set<std::string>{"contact_radius", "indentation", "force",
                                             "normal_stiffness", "tangential_stiffness",
                                             "force_curvature"});
  const double ratio = 1.4 / 1.7;
  CHECK(loss["small_amplitude_work"].get<double>() ==
        Approx(8.0 / 3 * ratio * 1e11 * 4e-14 * 3e-7 * 0.75).epsilon(1e-12));
  CHECK(loss["ratio"].get<double>() ==
        Approx(loss["work_per_cycle"].get<double>() / loss["small_amplitude_work"].get<double>()));
  // What it answers goes into a file as well.
  CHECK(test.run(paraboloid + "-o rest.h5").status == 0);
  CHECK(test.run(paraboloid + shear + "-o loss.h5").status == 0);
  CHECK(test.files() == std::set<std::string>{"loss.h5", "rest.h5"});
  // Much friction is full stick; the loop is followed in 2000 straight steps.
  const auto rough = test.run(paraboloid + shear + "--friction-coefficient 1e5").json();
  CHECK(rough["with_slip"]["work_per_cycle"].get<double>() ==
        Approx(loss["work_per_cycle"].get<double>()).epsilon(1e-4));
  CHECK(rough["work_per_cycle"] == loss["work_per_cycle"]);
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
      test.run("damping --law table --table profile.txt --indentation 1um --json " + body + shear)
          .json();
  const auto exact =
      test.run("damping --law paraboloid --radius 10mm --indentation 1um --json " + body + shear)
          .json();
  // The table is written with 1e-12 m and interpolated by cubics.
  CHECK(table["work_per_cycle"].get<double>() ==
        Approx(exact["work_per_cycle"].get<double>()).epsilon(1e-3));
  const auto followed =
      test.run("damping --law paraboloid --radius 10mm --trajectory path.txt --json " + body)
          .json();
  CHECK(followed["work_per_cycle"].get<double>() ==
        Approx(exact["work_per_cycle"].get<double>()).epsilon(1e-3));
  CHECK(followed["loss_factor"].get<double>() > 0);

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
  const auto planar = test.run(follow + "both.txt -o both.h5 --plot both.svg --json " + body);
  INFO(planar.err);
  REQUIRE(planar.status == 0);
  CHECK(
      planar.json()["work_per_cycle"].get<double>() ==
      Approx(followed["work_per_cycle"].get<double>() +
             test.run(follow + "across.txt --json " + body).json()["work_per_cycle"].get<double>())
          .epsilon(1e-9));
  CHECK(planar.json()["premises"]["slip_of_opening_levels"]["verdict"] == "unknown");
  check_refused(test.run(follow + "both.txt --friction-coefficient 0.3 " + body),
                "--friction-coefficient");

  test.write("open.txt", "0 1e-6 0\n1 2e-6 0\n2 1.5e-6 0\n");
  check_refused(test.run("damping --law paraboloid --radius 10mm --trajectory open.txt " + body),
                "one whole period");
  test.write("short.txt", "0 1e-6\n");
  check_refused(test.run("damping --law paraboloid --radius 10mm --trajectory short.txt " + body),
                "line 1");
  test.write("falling.txt", "0 0\n1 1\n2 3\n3 2\n4 5\n5 6\n6 7\n");
  check_refused(test.run("damping --law table --table falling.txt --indentation 1 " + body),
                "4 is a row");
}

TEST_CASE("damping writes the maps of Fig. 4 and of finite friction", "[indenter]") {
  const ProgramTest test;
  const std::string command =
      "damping --law paraboloid --radius 10mm --indentation 1um --json " + body + shear;
  CHECK(test.run(command + "--map-phases 32 --map-radii 32 --stress-map fig4.h5 --plot fig4.svg")
            .status == 0);
  CHECK(test.files() == std::set<std::string>{"fig4.h5", "fig4.svg"});
  CHECK_THAT(test.read("fig4.svg"), Catch::Contains("tangential stress"));
  check_refused(test.run(command + "--stress-map fig4.h5"), "--overwrite");
  CHECK(test.run(command +
                 "--steps 64 --friction-numbers 0.1:10:3 --friction-map map.h5 --plot map.png")
            .status == 0);
  CHECK(test.files() == std::set<std::string>{"fig4.h5", "fig4.svg", "map.h5", "map.png"});
}

TEST_CASE("damping draws an indenter at rest and a period of any of its motions",
          "[indenter][plot]") {
  const ProgramTest test;
  for (const std::string shape :
       {"paraboloid --radius 10mm", "cone --angle 0.1", "sphere --radius 1mm",
        "cylinder --radius 0.1mm", "rounded-cylinder --radius 0.1mm --edge-radius 1mm"}) {
    const auto result = test.run("damping --law " + shape +
                                 " --indentation 1um --overwrite --plot rest.svg --json " + body);
    INFO(shape << ": " << result.err);
    CHECK(result.status == 0);
    CHECK_THAT(test.read("rest.svg"), Catch::Contains("one-dimensional image"));
  }
  const std::string motion =
      "--mode two-frequencies --normal-amplitude 1.2um --tangential-amplitude 200nm --phase 60deg "
      "--frequency 300Hz --tangential-frequency 200Hz --plot cycle.svg --json ";
  const auto opening =
      test.run("damping --law cone --angle 0.1 --indentation 1um --friction-coefficient 0.5 " +
               body + motion);
  INFO(opening.err);
  REQUIRE(opening.status == 0);
  CHECK(opening.json()["with_slip"]["slip_work"].get<double>() >= 0);
  CHECK_THAT(test.read("cycle.svg"), Catch::Contains("in contact"));
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
  CHECK(test.run(table + "1.txt --json " + at + ranges).json()["work_per_cycle"].size() == 5);
  CHECK(test.run(table + "1.txt " + at).err.empty());
  const auto coarse = test.run(table + "3.txt " + at);
  CHECK(coarse.status == 0);
  CHECK_THAT(coarse.err, Catch::Contains("warning: the table is coarse"));
}

TEST_CASE("A table that is most likely not in metres is warned of", "[indenter]") {
  const ProgramTest test;
  // The ball of 1 mm radius in µm.
  std::string rows;
  for (int r = 0; r <= 100; r += 2)
    rows += std::to_string(r) + " " + std::to_string(r * r / 2000.0) + "\n";
  test.write("table.txt", rows);
  const auto result = test.run("damping --law table --table table.txt --normal-force 50mN " + body);
  CHECK(result.status == 0);
  CHECK_THAT(result.err,
             Catch::Contains("warning: the table has radii up to 100 m; check the unit"));
}

TEST_CASE("The CLI refuses each unusable input of a damped contact with its reason",
          "[indenter][damping][bad-input]") {
  const ProgramTest test;
  const std::string paraboloid = "damping --law paraboloid --radius 10mm " + body;
  const std::string cone = "damping --law cone --angle 0.1 " + body;
  const std::string damping = "damping --law cone --angle 0.1 " + body;
  const std::string table = "damping --law table --indentation 1um --table table.txt " + body;
  const auto refused_table = [&](const std::string& rows, const std::string& reason) {
    test.write("table.txt", rows);
    check_refused(test.run(table), reason);
  };
  // Profile tables: falling, with doubled or unsorted radii, with too few points, undersampled, not
  // numbers, empty.
  refused_table("0 0\n1 1\n2 3\n3 2\n4 5\n5 6\n6 7\n", "4 is a row");
  refused_table("0 0\n1 1\n1 3\n3 4\n4 5\n5 6\n6 7\n", "is a row whose radius");
  refused_table("0 0\n2 1\n1 3\n3 4\n4 5\n5 6\n6 7\n", "is a row whose radius");
  refused_table("0 0\n1 1\n2 2\n", "points");
  refused_table("0 0\n1e-3 1e-9\n2e-3 1e-9\n3e-3 1e-4\n4e-3 1.1e-4\n5e-3 9e-3\n6e-3 1e-2\n7e-3 2\n",
                "point");
  refused_table("0 0\n1 nan\n2 2\n3 3\n4 4\n5 5\n6 6\n7 7\n", "not a finite number");
  refused_table("", "table.txt");
  check_refused(test.run("damping --law table --indentation 1um --table none.txt " + body),
                "none.txt");
  // The path leaves the table.
  test.write(
      "short.txt",
      "0 0\n1e-6 1e-9\n2e-6 4e-9\n3e-6 9e-9\n4e-6 16e-9\n5e-6 25e-9\n6e-6 36e-9\n7e-6 49e-9\n");
  check_refused(test.run("damping --law table --indentation 1um --table short.txt " + body),
                "indentation");

  for (const std::string indentation : {"0", "-1um", "nan"}) {
    check_refused(test.run(paraboloid + shear + "--indentation " + indentation), "--indentation");
    check_refused(test.run(damping + shear + "--indentation " + indentation), "--indentation");
    check_refused(
        test.run("damping --law cone --angle 0.1 --normal-amplitude 1nm --frequency 1kHz " + body +
                 "--indentation " + indentation),
        "--indentation");
  }
  for (const std::string force : {"0", "-1", "inf"})
    check_refused(test.run(damping + shear + "--normal-force " + force), "--normal-force");
  for (const std::string friction : {"-1", "-1e-9", "nan"}) {
    check_refused(
        test.run(paraboloid + shear + "--indentation 1um --friction-coefficient " + friction),
        "friction");
    check_refused(
        test.run(damping + shear + "--indentation 1um --friction-coefficient " + friction),
        "friction");
  }
  const std::string drag = "--indentation 1um --normal-amplitude 1nm --drag-velocity 1mm/s ";
  const std::string two =
      "--indentation 1um --mode two-frequencies --normal-amplitude 1nm --tangential-amplitude 1nm "
      "--phase 0 ";
  for (const std::string frequency : {"0", "-1kHz", "nan"}) {
    for (const std::string& command : {cone, damping}) {
      check_refused(test.run(command + drag + "--frequency " + frequency), "--frequency");
      check_refused(
          test.run(command + two + "--frequency 1kHz --tangential-frequency " + frequency),
          "--tangential-frequency");
    }
    check_refused(test.run(cone + shear + "--indentation 1um --frequency " + frequency),
                  "--frequency");
    check_refused(
        test.run("damping --law cone --angle 0.1 --indentation 1um --normal-amplitude 1nm " + body +
                 "--frequency " + frequency),
        "--frequency");
  }
  check_refused(
      test.run(cone +
               "--indentation 1um --normal-amplitude -1nm --drag-velocity 1mm/s --frequency 1kHz"),
      "--normal-amplitude");
  // Trajectories that are no period: open, standing still in time, too short, not numbers.
  const auto refused_path = [&](const std::string& rows, const std::string& reason) {
    test.write("path.txt", rows);
    check_refused(test.run(cone + "--trajectory path.txt"), reason);
    check_refused(test.run("damping --law cone --angle 0.1 --trajectory path.txt " + body), reason);
  };
  refused_path("0 1e-6 0\n1 2e-6 0\n2 1.5e-6 0\n", "one whole period");
  refused_path("0 1e-6 0\n1 2e-6 0\n1 1e-6 0\n", "not later");
  refused_path("0 1e-6 0\n1 1e-6 0\n", "samples");
  refused_path("0 1e-6 0\n1 nan 0\n2 1e-6 0\n", "not finite");
  CHECK(test.files() == std::set<std::string>{"table.txt", "short.txt", "path.txt"});
}

TEST_CASE("u_z beyond the indentation opens the contact and keeps the answer right",
          "[indenter][bad-input]") {
  const ProgramTest test;
  // The cone while it opens, by the released distances of Eq. (7) over the levels 0 … δ + u_z
  // alone.
  const double indentation = 1e-6, amplitude = 1.5e-6, stroke = 2e-7, phase = pi / 3;
  const double ratio = 1.4 / 1.7, curvature = 2e9 / (pi / 2 * std::tan(0.1));
  double sum = 0;
  const int levels = 200000;
  for (int i = 0; i < levels; ++i) {
    const double z = -indentation + (indentation + amplitude) * (i + 0.5) / levels;
    const double s = 2 * stroke * std::sin(phase) * std::sqrt(1 - z * z / (amplitude * amplitude));
    sum += s * s;
  }
  const double work = 0.5 * ratio * curvature * sum * (indentation + amplitude) / levels;
  const std::string motion =
      " --indentation 1um --mode equal-frequency --normal-amplitude 1.5um --tangential-amplitude "
      "200nm --phase 60deg --json " +
      body;
  CHECK(
      test.run("damping --law cone --angle 0.1" + motion).json()["work_per_cycle"].get<double>() ==
      Approx(work).epsilon(1e-8));
  CHECK(
      test.run("damping --law cone --angle 0.1" + motion).json()["work_per_cycle"].get<double>() ==
      Approx(work).epsilon(1e-8));
}

TEST_CASE("damping refuses of an indenter what it cannot use by name", "[indenter]") {
  const ProgramTest test;
  check_refused(test.run("damping --law sphere --indentation 1um " + body), "--radius");
  check_refused(test.run("damping --law cone --angle 0.1 --radius 1 --indentation 1um " + body),
                "--radius");
  check_refused(test.run("damping --law cone --angle 0.1 " + body), "--indentation");
  check_refused(test.run("damping --law cone --angle 0.1 --indentation -1um " + body),
                "--indentation");
  check_refused(
      test.run("damping --law cone --angle 0.1 --indentation 1um --friction-coefficient -1 " +
               body + shear),
      "friction");
  check_refused(test.run("damping --law ball --indentation 1um " + body), "ball");
  check_refused(test.run("damping --law cone --angle 0.1 --indentation 1um --contact-modulus 1GPa"),
                "--tangential-modulus");
}

TEST_CASE("A damper: γ, the decay it makes and the amplitude that stabilises", "[damper]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 --json ";
  const auto one = test.run(law +
                            "--normal-amplitude 20nm --frequency 20kHz --mass 10g "
                            "--spring-stiffness 1kN/m")
                       .json();
  const double gamma = one["damping_constant"].get<double>();
  const auto same = test.run(
                            "damping --law exponential --normal-force 1 --decay-length 100nm "
                            "--poisson 0.3 --json "
                            "--normal-amplitude 20nm --frequency 20kHz --drag-velocity 1mm/s")
                        .json();
  CHECK(gamma == Approx(same["damping_constant"].get<double>()).epsilon(1e-9));
  const auto& decay = one["decay"];
  CHECK(decay["damping_ratio"].get<double>() ==
        Approx(gamma / (2 * 0.01 * decay["natural_frequency"].get<double>())).epsilon(1e-12));
  const auto stable =
      test.run(law + "--frequency 20kHz --falling-slope " + std::to_string(gamma)).json();
  CHECK(stable["stabilising_amplitude"].get<double>() == Approx(20e-9).epsilon(1e-4));
  const auto map = test.run(law +
                            "--normal-amplitude 1:50nm:4 --frequency 1:100kHz:3 "
                            "--falling-slope 5 --output map.h5")
                       .json();
  REQUIRE(test.run(law + "--normal-amplitude 1:50nm:4 --frequency 1:100kHz:3 "
                         "--falling-slope 5 --plot map.svg")
              .status == 0);
  CHECK_THAT(test.read("map.svg"), Catch::Contains("Steady sliding is stable where"));
  CHECK(test.run(law + "--normal-amplitude 20nm --frequency 20kHz --mass 10g --plot decay.svg")
            .status == 0);
  check_refused(test.run(law + "--normal-amplitude 20nm --frequency 20kHz --plot none.svg"),
                "--plot");
  REQUIRE(map["damping_constant"].size() == 4);
  REQUIRE(map["damping_constant"][0].size() == 3);
  CHECK(map["stabilising_amplitude"].size() == 3);
  CHECK(test.files() == std::set<std::string>{"map.h5", "map.svg", "decay.svg"});
  check_refused(test.run(law + "--normal-amplitude 1nm"), "--frequency");
  check_refused(test.run(law + "--frequency 1kHz"), "--normal-amplitude");
  check_refused(test.run(law + "--normal-amplitude 1nm,2nm --frequency 1kHz --mass 1"), "--mass");
  check_refused(test.run(law + "--normal-amplitude 1nm --frequency 1kHz --falling-slope 0"),
                "--falling-slope");
}
