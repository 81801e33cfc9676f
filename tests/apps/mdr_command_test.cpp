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

TEST_CASE("mdr gives Hertz's contact and its losses at any amplitude", "[mdr]") {
  const ProgramTest test;
  const std::string paraboloid =
      "mdr --profile parabola --radius 10mm --indentation 1um --json " + body;
  const auto state = test.run(paraboloid).json();
  CHECK(state["contact_radius"].get<double>() == Approx(1e-4).epsilon(1e-12));
  CHECK(state["force"].get<double>() == Approx(4.0 / 3 * 1e9 * 0.1 * 1e-9).epsilon(1e-12));
  const auto loss = test.run(paraboloid + shear).json();
  CHECK(keys(loss) == std::set<std::string>{"contact_radius", "indentation", "force",
                                            "normal_stiffness", "tangential_stiffness", "curvature",
                                            "work_per_cycle", "power", "damping_constant",
                                            "closed_form", "ratio"});
  const double ratio = 1.4 / 1.7;
  CHECK(loss["closed_form"].get<double>() ==
        Approx(8.0 / 3 * ratio * 1e11 * 4e-14 * 3e-7 * 0.75).epsilon(1e-12));
  CHECK(loss["ratio"].get<double>() ==
        Approx(loss["work_per_cycle"].get<double>() / loss["closed_form"].get<double>()));
  // Much friction is full stick; the loop is followed in 2000 straight steps.
  const auto rough = test.run(paraboloid + shear + "--friction 1e5").json();
  CHECK(rough["work_per_cycle"].get<double>() ==
        Approx(loss["work_per_cycle"].get<double>()).epsilon(1e-4));
  CHECK(rough["full_stick_work"] == loss["work_per_cycle"]);
}

TEST_CASE("mdr reads profiles and trajectories from files", "[mdr]") {
  const ProgramTest test;
  std::string profile = "r, f\n", path = "# time indentation x\n";
  for (int i = 0; i <= 200; ++i) {
    const double r = 1e-6 * i;
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
      test.run("mdr --profile table --table profile.txt --indentation 1um --json " + body + shear)
          .json();
  const auto exact =
      test.run("mdr --profile parabola --radius 10mm --indentation 1um --json " + body + shear)
          .json();
  // The table is written with 1e-12 m and interpolated by cubics.
  CHECK(table["work_per_cycle"].get<double>() ==
        Approx(exact["work_per_cycle"].get<double>()).epsilon(1e-3));
  const auto followed =
      test.run("mdr --profile parabola --radius 10mm --trajectory path.txt --json " + body).json();
  CHECK(followed["work_per_cycle"].get<double>() ==
        Approx(exact["work_per_cycle"].get<double>()).epsilon(1e-3));
  CHECK(followed["loss_factor"].get<double>() > 0);

  test.write("open.txt", "0 1e-6 0\n1 2e-6 0\n2 1.5e-6 0\n");
  check_refused(test.run("mdr --profile parabola --radius 10mm --trajectory open.txt " + body),
                "one whole period");
  test.write("short.txt", "0 1e-6\n");
  check_refused(test.run("mdr --profile parabola --radius 10mm --trajectory short.txt " + body),
                "line 1");
  test.write("falling.txt", "0 0\n1 1\n2 3\n3 2\n4 5\n5 6\n6 7\n");
  check_refused(test.run("mdr --profile table --table falling.txt --indentation 1 " + body),
                "4 is a row");
}

TEST_CASE("mdr writes the maps of Fig. 4 and of finite friction", "[mdr]") {
  const ProgramTest test;
  const std::string command =
      "mdr --profile parabola --radius 10mm --indentation 1um --json " + body + shear;
  CHECK(test.run(command + "--stress-map fig4.h5").status == 0);
  CHECK(test.files() == std::set<std::string>{"fig4.h5"});
  check_refused(test.run(command + "--stress-map fig4.h5"), "--force");
  CHECK(test.run(command + "--steps 64 --friction-numbers 0.1:10:3 --friction-map map.h5").status ==
        0);
  CHECK(test.files() == std::set<std::string>{"fig4.h5", "map.h5"});
}

TEST_CASE("mdr refuses what it cannot use by name", "[mdr]") {
  const ProgramTest test;
  check_refused(test.run("mdr --profile sphere --indentation 1um " + body), "--radius");
  check_refused(test.run("mdr --profile cone --angle 0.1 --radius 1 --indentation 1um " + body),
                "--radius");
  check_refused(test.run("mdr --profile cone --angle 0.1 " + body), "--indentation");
  check_refused(test.run("mdr --profile cone --angle 0.1 --indentation -1um " + body),
                "--indentation");
  check_refused(
      test.run("mdr --profile cone --angle 0.1 --indentation 1um --friction -1 " + body + shear),
      "friction");
  check_refused(test.run("mdr --profile ball --indentation 1um " + body), "ball");
  check_refused(test.run("mdr --profile cone --angle 0.1 --indentation 1um --contact-modulus 1GPa"),
                "--tangential-modulus");
}

TEST_CASE("damper: γ, the decay it makes and the amplitude that stabilises", "[damper]") {
  const ProgramTest test;
  const std::string law =
      "damper --law exponential --force-newton 1 --decay-length 100nm --poisson 0.3 --json ";
  const auto one = test.run(law +
                            "--normal-amplitude 20nm --frequency 20kHz --mass 10g "
                            "--spring-stiffness 1kN/m")
                       .json();
  const double gamma = one["damping_constant"].get<double>();
  const auto same = test.run(
                            "damping --law exponential --force-newton 1 --decay-length 100nm "
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
  REQUIRE(map["damping_constant"].size() == 4);
  REQUIRE(map["damping_constant"][0].size() == 3);
  CHECK(map["stabilising_amplitude"].size() == 3);
  CHECK(test.files() == std::set<std::string>{"map.h5"});
  check_refused(test.run(law + "--normal-amplitude 1nm"), "--frequency");
  check_refused(test.run(law + "--frequency 1kHz"), "--normal-amplitude");
  check_refused(test.run(law + "--normal-amplitude 1nm,2nm --frequency 1kHz --mass 1"), "--mass");
  check_refused(test.run(law + "--normal-amplitude 1nm --frequency 1kHz --falling-slope 0"),
                "--falling-slope");
}
