// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/io/result_file.hpp>

#include "run_program.hpp"

using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;
const std::string drag = "--normal-amplitude 5nm --drag-velocity 2mm/s --frequency 20kHz ";

}  // namespace

TEST_CASE("Damping of the exponential law at small amplitude is Eq. (16)", "[damping]") {
  const ProgramTest test;
  const auto answer =
      test.answer("damping --law exponential --normal-force 1 --decay-length 1e-7 --poisson 0.3 " +
                  drag + "--amplitude small");
  CHECK(keys(answer) ==
        "validity conditions premises largest_motion regime work_per_cycle power damping_constant "
        "normal_stiffness tangential_stiffness "
        "force_curvature force mean_force indentation small_amplitude_work ratio");
  const double omega = 2 * pi * 2e4, ratio = 2 * 0.7 / 1.7;
  const double work = 2 * (pi * pi - 4) * ratio * 1 / 1e-14 * 5e-9 * 4e-6 / (omega * omega);
  // Both sides are the same few products in another order.
  CHECK(answer["work_per_cycle"] == Approx(work).epsilon(1e-12));
  CHECK(answer["power"] == Approx(work * omega / (2 * pi)).epsilon(1e-12));
  CHECK(answer["damping_constant"] == Approx(work * omega / (2 * pi) / 4e-6).epsilon(1e-12));
  CHECK(answer["force_curvature"] == Approx(1e14).epsilon(1e-12));
  CHECK(answer["tangential_stiffness"] == Approx(ratio * 1e7).epsilon(1e-12));
  CHECK(answer["force"] == Approx(1).epsilon(1e-12));
}

TEST_CASE("One quantity may be a range and makes the answers arrays", "[damping]") {
  const ProgramTest test;
  const std::string law = "damping --law exponential --decay-length 100nm --poisson 0.3 ";
  const auto forces = test.answer(law + "--normal-force 0.1:10:3 --amplitude small " + drag);
  REQUIRE(forces["damping_constant"].size() == 3);
  // Eq. (16) is proportional to the force.
  CHECK(number(forces, "/damping_constant/2") / number(forces, "/damping_constant/0") ==
        Approx(100).epsilon(1e-12));
  const auto amplitudes = test.answer(law +
                                      "--normal-force 1 --normal-amplitude 1nm,2nm --drag-velocity "
                                      "1mm/s --frequency 1kHz --amplitude small");
  CHECK(amplitudes["normal_amplitude"] == nlohmann::json({1e-9, 2e-9}));
  CHECK(number(amplitudes, "/work_per_cycle/1") / number(amplitudes, "/work_per_cycle/0") ==
        Approx(2).epsilon(1e-12));
}

TEST_CASE("A damping curve is kept with units where a file is asked for", "[damping]") {
  const ProgramTest test;
  const auto answer = test.answer(
      "damping --law exponential --decay-length 100nm --poisson 0.3 --normal-force 1,2,4 -o d.h5 " +
      drag);
  const salebra::ResultReader file(test.folder() / "d.h5");
  CHECK(file.numbers("damping/damping_constant") ==
        answer["damping_constant"].get<std::vector<double>>());
  CHECK(file.text_attribute("damping/damping_constant", "units") == "N s/m");
  CHECK(test.files() == "d.h5");
}

TEST_CASE("One or two bodies may be given by their moduli", "[damping]") {
  const ProgramTest test;
  const std::string ball = "damping --law paraboloid --radius 1mm --normal-force 1mN " + drag;
  const auto loss = [&](const std::string& material) {
    return test.answer(ball + material)["work_per_cycle"].get<double>();
  };
  // E* = 2 GPa/(1 − ¼), G*/E* = 2/3 of ν = ½; two such bodies have half of both moduli.
  CHECK(loss("--young 2GPa --poisson 0.5") ==
        Approx(loss("--contact-modulus 2.6666666666666667GPa --poisson 0.5")).epsilon(1e-10));
  CHECK(loss("--young 2GPa,2GPa --poisson 0.5,0.5") ==
        Approx(loss("--young 1GPa --poisson 0.5")).epsilon(1e-10));
}

TEST_CASE("damping says by how much the small-amplitude form is off", "[damping]") {
  const ProgramTest test;
  // k = u_z/l = 0.5: J(0.5)/J(0) by docs/theory.md, section 7, Eq. (16) is 20 % too high.
  const auto answer = test.answer(
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
      "--normal-amplitude 50nm --drag-velocity 1mm/s --frequency 20kHz");
  const double ratio = number(answer, "/ratio");
  CHECK(1 / ratio == Approx(1.2).epsilon(0.02));
  CHECK(number(answer, "/work_per_cycle") / number(answer, "/small_amplitude_work") ==
        Approx(ratio).epsilon(1e-14));
  CHECK(answer["premises"]["amplitude"]["limit_20_percent"] == Approx(5e-8).epsilon(0.02));
}

TEST_CASE("Frequencies in a rational ratio lose their energy over the common period", "[damping]") {
  const ProgramTest test;
  const std::string cone =
      "damping --law cone --angle 0.1 --indentation 100nm --contact-modulus 1GPa --poisson 0.3 "
      "--mode two-frequencies --normal-amplitude 50nm --tangential-amplitude 30nm --phase 40deg ";
  const std::string three_to_two = "--frequency 3kHz --tangential-frequency ";
  const auto answer = test.answer(cone + three_to_two + "2kHz");
  CHECK(answer["normal_cycles"] == 3);
  CHECK(answer["tangential_cycles"] == 2);
  CHECK(answer["power"] == Approx(number(answer, "/work_per_cycle") * 1000).epsilon(1e-9));
  // No common period: the mean power of a neighbour, and the work of a period is not known.
  const auto irrational = test.answer(cone + three_to_two + "1999.9998765Hz");
  CHECK(irrational["work_per_cycle"].is_null());
  CHECK(irrational["normal_cycles"] == 0);
  CHECK(irrational["power"] == Approx(answer["power"]).epsilon(1e-5));
  CHECK_THAT(test.run(cone + three_to_two + "1999.9998765Hz").err, Contains("no common period"));
  // A slow tangential oscillation under a fast normal one is the damper of case (b).
  const auto slow = test.answer(cone + "--frequency 20kHz --tangential-frequency 100Hz");
  CHECK(slow["power"] == Approx(slow["slow_limit_power"]).epsilon(1e-3));
}

TEST_CASE("The mean force or the force itself may be what is given", "[damping]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz ";
  // A dead weight on the exponential law: F at the mean indentation is lower by I_0(1).
  const auto held = test.answer(law + "--hold force --normal-amplitude 100nm");
  CHECK(held["mean_force"] == Approx(2).epsilon(1e-9));
  CHECK(held["force"] == Approx(2 / std::cyl_bessel_i(0.0, 1.0)).epsilon(1e-9));
  CHECK(test.answer(law + "--normal-amplitude 100nm")["force"].get<double>() == Approx(2));
  // Force control: proportional to F_a up to F.
  const auto controlled = test.answer(law + "--force-amplitude 0.5,2");
  CHECK(controlled["work_per_cycle"][1] ==
        Approx(4 * number(controlled, "/work_per_cycle/0")).epsilon(1e-8));
  CHECK(controlled["force_amplitude"] == nlohmann::json({0.5, 2.0}));
}

TEST_CASE("Any law follows a motion from a file", "[damping]") {
  const ProgramTest test;
  std::string path = "# time indentation x\n";
  for (int i = 0; i <= 2000; ++i) {
    const double angle = 2 * pi * i / 2000;
    path += std::to_string(i * 1e-3) + " " + std::to_string(-50 * std::cos(angle)) + "e-9 " +
            std::to_string(30 * std::cos(angle + pi / 3)) + "e-9\n";
  }
  test.write("path.txt", path);
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 ";
  const auto followed = test.answer(law + "--trajectory path.txt -o path.h5 --plot path.svg");
  const auto exact = test.answer(
      law +
      "--mode equal-frequency --normal-amplitude 50nm --tangential-amplitude 30nm --phase 60deg");
  // 2000 straight steps, written to 1e-6 nm.
  CHECK(followed["work_per_cycle"] == Approx(exact["work_per_cycle"]).epsilon(1e-5));
  CHECK(followed["power"] == Approx(number(exact, "/work_per_cycle") / 2).epsilon(1e-5));
  CHECK(test.files() == "path.txt path.h5 path.svg");
  // Friction: less is lost by relaxation, and some by slip.
  const auto rough =
      test.answer(law +
                  "--friction-coefficient 1 --mode equal-frequency --normal-amplitude 50nm "
                  "--tangential-amplitude 30nm --phase 60deg");
  CHECK(rough["work_per_cycle_without_slip"] == exact["work_per_cycle"]);
  CHECK(number(rough, "/work_per_cycle") < number(exact, "/work_per_cycle"));
  CHECK(number(rough, "/slip_share") > 0);
  CHECK(number(rough, "/relaxation_share") + number(rough, "/slip_share") == Approx(1));
}

TEST_CASE("Pictures of damping name what they show", "[damping][plot]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz --json ";
  test.done(law + "--normal-amplitude 1:50nm:6 --plot curve.svg");
  const std::string curve = test.read("curve.svg");
  CHECK_THAT(curve, Contains("amplitude of the normal oscillation (nm)"));
  CHECK_THAT(curve, Contains("small-amplitude form"));
  test.done(law + "--normal-amplitude 50nm --plot cycle.png");
  CHECK(test.read("cycle.png").substr(1, 3) == "PNG");
  check_refused(test.run(law + "--normal-amplitude 50nm --plot cycle.png"), "--overwrite");
  // Without gnuplot there is one line, status 1, and no answer is lost for a picture that was not
  // asked for.
  const auto without = test.run(law + "--normal-amplitude 50nm --plot new.png", "PATH=/nowhere;");
  CHECK(without.status == 1);
  CHECK_THAT(without.err, Contains("salebra: error: new.png: gnuplot is not installed"));
  CHECK(std::count(without.err.begin(), without.err.end(), '\n') == 1);
  CHECK(without.out.empty());
  test.done(law + "--normal-amplitude 50nm", "PATH=/nowhere;");
  CHECK(test.files() == "curve.svg cycle.png");
}

TEST_CASE("A picture is drawn where it was asked for, and its name never runs as a command",
          "[plot]") {
  const ProgramTest test;
  // gnuplot starts a name that begins with '|' as a command; quotes would end the name.
  const std::string folder = "|touch PWNED;'\"`touch PWNED`";
  std::filesystem::create_directory(test.folder() / folder);
  const std::string quoted = "\"|touch PWNED;'\\\"\\`touch PWNED\\`/x.png\"";
  test.done(
      "damping --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 "
      "--drag-velocity 1mm/s --frequency 20kHz --normal-amplitude 50nm --plot " +
      quoted);
  CHECK(test.read(folder + "/x.png").substr(1, 3) == "PNG");
  CHECK(test.files() == std::set<std::string>{folder});
}

TEST_CASE("A Poisson's ratio that contradicts a curve, or has no effect, is told", "[damping]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  const std::string sweep =
      "contact rough.h5 --contact-modulus 1GPa --poisson 0.3 --stiffness --pressure 10kPa:10MPa:8 ";
  test.done(sweep + "-o curve.h5");
  test.done(sweep + "--stick -o stick.h5");
  // Poisson's ratio against the stiffnesses of the file; a stick solve's differ from G*/E* by some
  // per cent on their own.
  const std::string at =
      "--pressure 1MPa --normal-amplitude 1nm --drag-velocity 1um/s --frequency 20kHz --curve ";
  CHECK(test.run("damping --poisson 0.3 " + at + "curve.h5").err.empty());
  CHECK(test.run("damping --poisson 0.3 " + at + "stick.h5").err.empty());
  for (const char* file : {"curve.h5", "stick.h5"})
    CHECK_THAT(test.done("damping --poisson 0 " + at + file).err,
               Contains("warning: G*/E* = 1 of --poisson"));
  CHECK_THAT(test.run("damping --poisson 0 --pressure 1MPa --normal-amplitude 1nm --frequency "
                      "20kHz --falling-slope 1 --curve curve.h5")
                 .err,
             Contains("warning: G*/E* = 1"));
  for (const std::string pressure : {"1:2MPa:4", "1MPa"})
    CHECK_THAT(
        test.run("contact rough.h5 --contact-modulus 1GPa --poisson 0.3 --pressure " + pressure)
            .err,
        Contains("--poisson: has no effect without --stiffness"));
}

TEST_CASE("A slow motion that passes a contact spot in one normal cycle is told", "[damping]") {
  const ProgramTest test;
  const std::string sphere =
      "damping --law paraboloid --radius 1mm --indentation 10nm --contact-modulus 1GPa --poisson "
      "0.3 --normal-amplitude 1nm --frequency 20kHz ";
  // a = sqrt(R d) = 3.162 um; 2 pi v/w = 50 um at 1 m/s, 5 um at 0.1 m/s.
  CHECK_THAT(test.run(sphere + "--drag-velocity 1m/s").err,
             Contains("2 pi v/w = 50 µm") && Contains("6.325 µm across"));
  CHECK(test.run(sphere + "--drag-velocity 0.1m/s").err.empty());
  // A curve has 2a = 4E*A/(pi K), where E* is given.
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  test.done(
      "contact rough.h5 --contact-modulus 1GPa --poisson 0.3 --stiffness --pressure 100kPa:1MPa:6 "
      "-o curve.h5");
  const std::string curve =
      "damping --curve curve.h5 --pressure 300kPa --poisson 0.3 --contact-modulus 1GPa "
      "--normal-amplitude 1nm --frequency 1kHz ";
  CHECK_THAT(test.run(curve + "--drag-velocity 1m/s").err, Contains("2 pi v/w = 1 mm"));
  CHECK(test.run(curve + "--drag-velocity 1mm/s").err.empty());
}

TEST_CASE("With friction a damper loses what slides, and says what it lacks", "[damper]") {
  const ProgramTest test;
  const std::string law =
      "damping --law exponential --normal-force 10 --decay-length 44nm --poisson 0.3 "
      "--normal-amplitude 1nm --frequency 20kHz ";
  // A hundred times faster than levels stick for and over 10⁵ depths, all of it slides: the power
  // is μFv, γ = μF/v, and there and back 2XμF is lost. Turning points store 1e-5 of it, the normal
  // oscillation raises the mean force by (u_z/2l)² = 1.3e-4, and levels that open add 4e-4.
  const std::string slides =
      law + "--friction-coefficient 0.3 --drag-velocity 5mm/s --excursion 10mm ";
  const auto damper = test.answer(slides + "--mass 1kg");
  CHECK(damper["damping_constant"] == Approx(0.3 * 10 / 5e-3).epsilon(1e-3));
  CHECK(damper["slip_share"] == Approx(1).epsilon(1e-3));
  CHECK(damper["decay"]["damping_ratio"].get<double>() > 0);
  const auto motion = test.answer(slides);
  CHECK(motion["work_there_and_back"] == Approx(2 * 1e-2 * 0.3 * 10).epsilon(1e-3));
  CHECK(motion["regime"] == "sliding");
  CHECK_THAT(test.run(slides).out,
             Contains("Regime: sliding: the mean friction") && Contains("`salebra sliding`"));
  // Without the velocity no number of another regime stands in the place.
  const auto without = test.answer(law + "--mass 1kg");
  const auto lacks = test.run(law + "--friction-coefficient 0.3 --mass 1kg --json");
  CHECK(lacks.json()["damping_constant"].is_null());
  CHECK(lacks.json()["decay"]["damping_ratio"].is_null());
  CHECK(lacks.json()["damping_constant_without_slip"] == without["damping_constant"]);
  CHECK_THAT(lacks.err, Contains("--drag-velocity and the --excursion"));
  check_refused(
      test.run(law + "--friction-coefficient 0.3 --falling-slope 1 --drag-velocity 5mm/s"),
      "--falling-slope");
  // Of a surface γω without slip is a number of the amplitude, with friction or without.
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  const std::string surface =
      "damping --surface rough.h5 --pressure 1MPa --contact-modulus 1GPa --poisson 0.3 "
      "--normal-amplitude 10nm --frequency 10:20kHz:2 --quiet ";
  const auto stuck = test.answer(surface),
             open = test.answer(surface + "--friction-coefficient 0.3");
  CHECK(open["damping_constant_without_slip"] == stuck["damping_constant"]);
  CHECK(open["damping_constant"][0].is_null());
  const auto slips = test.answer(
      "damping --surface rough.h5 --pressure 1MPa --contact-modulus 1GPa --poisson 0.3 "
      "--normal-amplitude 10nm --frequency 10kHz --quiet --mass 1g --spring-stiffness 1kN/m "
      "--friction-coefficient 0.3 --drag-velocity 1um/s --excursion 100nm");
  CHECK(slips["damping_constant"].get<double>() > stuck["damping_constant"][0].get<double>());
  CHECK(slips["damping_constant_error"].get<double>() < slips["damping_constant"].get<double>());
  CHECK(slips["damping_constant_without_slip"].get<double>() ==
        Approx(stuck["damping_constant"][0].get<double>()).epsilon(0.02));
}

TEST_CASE("Damping of a surface is that of a study, with its error", "[damping]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 0.25mm "
      "--rms-height 1um -o rough.h5");
  const std::string motion =
      " --contact-modulus 1GPa --poisson 0.3 --normal-amplitude 10nm --drag-velocity 1um/s "
      "--frequency 20kHz --quiet ";
  const auto one =
      test.answer("damping --surface rough.h5 --pressure 1MPa" + motion + "-o damping.h5");
  // Both sides have the same loads, from which K_t/K has its slope.
  test.write("study.toml", R"([surface]
file = "rough.h5"
[material]
contact_modulus = "1GPa"
poisson = 0.3
[contact]
pressures = ["740740.7407407408Pa", "1MPa", "1.35MPa", "1.8225MPa"]
[damping]
mode = "drag"
normal_amplitude = "10nm"
drag_velocity = "1um/s"
frequency = "20kHz"
)");
  const auto study = test.answer("study study.toml --no-report --quiet");
  const auto& constant = study["damping"]["damping_constant"];
  // The two start their contacts from different neighbours. K_t has the square of its solve's
  // tolerance of 1e-3 as error, and its slope is a difference over 30 % of the load.
  CHECK(one["damping_constant"] == Approx(constant["mean"][1]).epsilon(1e-6));
  CHECK(one["damping_constant_error"] == Approx(constant["error"][1]).epsilon(1e-5));
  CHECK(number(one, "/error_estimate") / number(one, "/work_per_cycle") ==
        Approx(number(one, "/damping_constant_error") / number(one, "/damping_constant"))
            .epsilon(1e-12));
  // The nominal area is 1 mm².
  for (const std::string name : {"work_per_cycle", "normal_stiffness"})
    CHECK(one[name + "_per_area"] == Approx(one[name].get<double>() / 1e-6));
  // K is several times the force over the rms height, as F/l, and less than that of a flat body.
  CHECK(one["normal_stiffness_per_area"] > 1e6 / 1e-6);
  CHECK(one["normal_stiffness_per_area"] < 1e9 / 1e-6);
  const auto two = test.answer("damping --surface rough.h5 --pressure 1MPa,3MPa" + motion);
  CHECK(two["work_per_cycle_per_area"][1] == Approx(number(two, "/work_per_cycle/1") / 1e-6));
  CHECK(two["damping_constant"][0] == Approx(one["damping_constant"]).epsilon(0.01));
  // The way of a normal cycle is 50 pm: what turns back within it is not slow, and no number of it
  // is given but those without slip.
  const std::string slips =
      "damping --surface rough.h5 --pressure 1MPa --friction-coefficient 0.3" + motion +
      "--excursion ";
  const auto turns = test.answer(slips + "40pm"), slow = test.answer(slips + "1nm");
  for (const std::string name : {"work_per_cycle", "power", "damping_constant", "error_estimate",
                                 "damping_constant_error", "slip_share", "relaxation_share"}) {
    INFO(name);
    CHECK(turns[name].is_null());
    CHECK_FALSE(slow[name].is_null());
  }
  for (const auto& answer : {turns, slow}) {
    CHECK(answer["damping_constant_without_slip"] == one["damping_constant"]);
    CHECK(answer["damping_constant_without_slip_error"] == one["damping_constant_error"]);
  }
  test.done(
      "joint --surface rough.h5 --pressure 1MPa --contact-modulus 1GPa --poisson 0.3 "
      "--friction-coefficient 0.3 --tangential-forces 10mN");
}
