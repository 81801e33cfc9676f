// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/io/result_file.hpp>

#include "run_program.hpp"

namespace {

constexpr double pi = std::numbers::pi;
const std::string drag = "--normal-amplitude 5nm --drag-velocity 2mm/s --frequency 20kHz ";

}  // namespace

TEST_CASE("Damping of the exponential law at small amplitude is Eq. (16)", "[damping]") {
  const ProgramTest test;
  const auto result =
      test.run("damping --law exponential --force-newton 1 --decay-length 1e-7 --poisson 0.3 " +
               drag + "--amplitude small --json");
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto answer = result.json();
  CHECK(keys(answer) ==
        std::set<std::string>{"work_per_cycle", "power", "damping_constant", "curvature", "force"});
  const double omega = 2 * pi * 2e4, ratio = 2 * 0.7 / 1.7;
  const double work = 2 * (pi * pi - 4) * ratio * 1 / 1e-14 * 5e-9 * 4e-6 / (omega * omega);
  // The same few products in another order.
  CHECK(answer["work_per_cycle"].get<double>() == Approx(work).epsilon(1e-12));
  CHECK(answer["power"].get<double>() == Approx(work * omega / (2 * pi)).epsilon(1e-12));
  CHECK(answer["damping_constant"].get<double>() ==
        Approx(work * omega / (2 * pi) / 4e-6).epsilon(1e-12));
  CHECK(answer["curvature"].get<double>() == Approx(1e14).epsilon(1e-12));
  CHECK(answer["force"].get<double>() == Approx(1).epsilon(1e-12));
}

TEST_CASE("One quantity may be a range and makes the answers arrays", "[damping]") {
  const ProgramTest test;
  const std::string law = "damping --law exponential --decay-length 100nm --poisson 0.3 ";
  const auto forces =
      test.run(law + "--force-newton 0.1:10:3 --amplitude small --json " + drag).json();
  REQUIRE(forces["damping_constant"].size() == 3);
  // Eq. (16) is proportional to the force.
  CHECK(forces["damping_constant"][2].get<double>() / forces["damping_constant"][0].get<double>() ==
        Approx(100).epsilon(1e-12));
  const auto amplitudes = test.run(law +
                                   "--force-newton 1 --normal-amplitude 1nm,2nm --drag-velocity "
                                   "1mm/s --frequency 1kHz --amplitude small --json")
                              .json();
  CHECK(amplitudes["normal_amplitude"] == nlohmann::json({1e-9, 2e-9}));
  CHECK(amplitudes["work_per_cycle"][1].get<double>() /
            amplitudes["work_per_cycle"][0].get<double>() ==
        Approx(2).epsilon(1e-12));
  check_refused(
      test.run(
          law +
          "--force-newton 1,2 --normal-amplitude 1nm,2nm --drag-velocity 1mm/s --frequency 1kHz"),
      "range");
}

TEST_CASE("A damping curve is kept with units where a file is asked for", "[damping]") {
  const ProgramTest test;
  const auto answer = test.run(
                              "damping --law exponential --decay-length 100nm --poisson 0.3 "
                              "--force-newton 1,2,4 --json -o d.h5 " +
                              drag)
                          .json();
  const salebra::ResultReader file(test.folder() / "d.h5");
  CHECK(file.numbers("damping/damping_constant") ==
        answer["damping_constant"].get<std::vector<double>>());
  CHECK(file.text_attribute("damping/damping_constant", "units") == "N s/m");
  check_refused(test.run("verify -o d2.h5"), "--output");
  CHECK(test.files() == std::set<std::string>{"d.h5"});
}

TEST_CASE("A cone loses what Eqs (12) and (15) say at any amplitude", "[damping]") {
  const ProgramTest test;
  const std::string law =
      "damping --law cone --angle 0.1 --indentation 100nm --contact-modulus 1GPa --poisson 0.3 ";
  // F'' = 2E*/g' with g' = (π/2) tanθ.
  const double curvature = 2e9 / (pi / 2 * std::tan(0.1));
  const double ratio = 2 * 0.7 / 1.7;
  const auto shear = test.run(law +
                              "--mode equal-frequency --normal-amplitude 50nm "
                              "--tangential-amplitude 30nm --phase 60deg --json")
                         .json();
  CHECK(shear["curvature"].get<double>() == Approx(curvature).epsilon(1e-12));
  // The theorem's quadrature has a relative tolerance of 1e-10.
  CHECK(shear["work_per_cycle"].get<double>() ==
        Approx(8. / 3. * ratio * curvature * 9e-16 * 5e-8 * 0.75).epsilon(1e-9));
  CHECK(shear["power"].is_null());
  const auto parabola = test.run(
      "damping --law parabola --radius 1mm --force-newton 1mN --young 2GPa --poisson 0.5 " + drag +
      "--json");
  CHECK(parabola.status == 0);
}

TEST_CASE("Damping without what it needs is refused by name", "[damping]") {
  const ProgramTest test;
  const std::string law = "damping --law exponential --decay-length 100nm ";
  check_refused(test.run(law + "--force-newton 1 " + drag), "--tangential-modulus");
  check_refused(test.run(law + "--poisson 0.3 " + drag), "position");
  check_refused(test.run(law + "--poisson 0.3 --force-newton -1 " + drag), "--force-newton");
  check_refused(test.run(law + "--poisson 0.3 --force-newton 1 --mode equal-frequency " + drag),
                "--tangential-amplitude");
  check_refused(
      test.run(law + "--poisson 0.3 --force-newton 1 --normal-amplitude 1nm --drag-velocity 1mm/s"),
      "--frequency");
  check_refused(test.run("damping --poisson 0.3 --force-newton 1 " + drag), "--law");
  check_refused(test.run(law + "--poisson 0.7 --force-newton 1 " + drag), "poisson");
  check_refused(test.run(law + "--poisson 0.3 --force-newton 1kg " + drag), "--force-newton");
}
