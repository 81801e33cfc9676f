// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/io/result_file.hpp>

#include "run_program.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

const std::string material = " --contact-modulus 1GPa --poisson 0.3 --json ";

double number(const nlohmann::json& object, const char* key) { return object[key].get<double>(); }

std::vector<double> numbers(const nlohmann::json& object, const char* key) {
  return object[key].get<std::vector<double>>();
}

}  // namespace

TEST_CASE("oscillate takes a position as depth, force, pressure or gap", "[oscillate]") {
  const ProgramTest test;
  const std::string parabola =
      "oscillate --shape paraboloid --points 32 --levels 4 --method levels" + material;
  const auto deep = test.answer(parabola + "--indentation 10um");
  // Hertz up to the cells: the apex lies between them.
  CHECK(number(deep, "force") == Approx(4.0 / 3 * 1e9 * std::sqrt(4e-3 * 1e-15)).epsilon(0.02));
  // The sweep goes with the depth, u_z = 0.3 δ, and a² = Rδ.
  CHECK(number(deep, "contact_area_max") / number(deep, "contact_area_min") ==
        Approx(1.3 / 0.7).epsilon(0.02));
  // A longer cell has more of the same cells.
  CHECK(test.answer(parabola + "--indentation 5um --size-x 1mm --size-y 2mm")["ny"] == 64);
  // The force of the levels' fit at this depth, whose four levels leave 1e-3 of F, two thirds of it
  // in the depth.
  const std::string force = std::to_string(number(deep, "force"));
  CHECK(number(test.answer(parabola + "--normal-force " + force), "indentation") ==
        Approx(10e-6).epsilon(1e-3));
  test.done(
      "generate --points 32 --size-x 10um --hurst 0.8 --rolloff 2.5um --short-cutoff 2.5um "
      "--rms-slope 0.1 --seed 3 -o r.h5 --quiet");
  const auto contact = test.answer("contact r.h5 --pressure 3MPa --contact-modulus 1GPa");
  const std::string rough =
      "oscillate --surface r.h5 --levels 4 --method levels --mode drag --normal-amplitude 4nm "
      "--drag-velocity 1mm/s --frequency 20kHz" +
      material;
  const double indentation = number(test.answer(rough + "--pressure 3MPa"), "indentation");
  const std::string gap = nlohmann::json(number(contact, "mean_gap")).dump();
  CHECK(number(test.answer(rough + "--mean-gap " + gap), "indentation") ==
        Approx(indentation).epsilon(1e-5));
}

TEST_CASE("oscillate answers for Eqs (12) and (15), finite amplitude and the exponential law",
          "[oscillate]") {
  const ProgramTest test;
  const std::string parabola =
      "oscillate --shape paraboloid --points 32 --steps 16 --levels 12 --decay-length 8um" +
      material;
  const double amplitude = 6e-6, k = amplitude / 8e-6, modulus_ratio = 2 * 0.7 / 1.7;
  const double hertz = std::sqrt(4e-3) * 1e9 / std::sqrt(20e-6);  // F'' at 20 µm
  const auto equal = test.answer(parabola + "--phase 45deg");
  const double force = number(equal, "force");
  const double twelve = 8.0 / 3 * modulus_ratio * std::pow(amplitude, 3) / 2;  // Eq. (12) over F''
  CHECK(number(equal, "small_amplitude_work") == Approx(twelve * number(equal, "force_curvature")));
  // A second derivative over some 20 cells.
  CHECK(number(equal, "force_curvature") == Approx(hertz).epsilon(0.05));
  CHECK(number(equal, "predicted_exponential") == Approx(twelve * force / 64e-12));
  CHECK(number(equal, "predicted_exponential_finite") ==
        Approx(twelve * force / 64e-12 * 3 * (k * std::cosh(k) - std::sinh(k)) / (k * k * k)));
  // v/ω = 1 mm/s / (2π 50 Hz); here F''' makes 8 % of difference, by which the two predictions are
  // told apart.
  const auto drag = test.answer(parabola + "--mode drag --drag-velocity 1mm/s --frequency 50Hz");
  const double fifteen =
      2 * (pi * pi - 4) * modulus_ratio * amplitude * std::pow(1e-3 / (100 * pi), 2);
  CHECK(number(drag, "small_amplitude_work") == Approx(fifteen * number(drag, "force_curvature")));
  CHECK(number(drag, "work_by_force") > 1.05 * number(drag, "small_amplitude_work"));
  CHECK(number(drag, "predicted_exponential") == Approx(fifteen * number(drag, "force") / 64e-12));
  for (const auto& answer : {equal, drag}) {
    const double work = number(answer, "work_per_cycle");
    CHECK(number(answer, "ratio") == Approx(work / number(answer, "small_amplitude_work")));
    CHECK(number(answer, "ratio_finite") == Approx(work / number(answer, "work_by_force")));
    CHECK(number(answer, "ratio_exponential") ==
          Approx(work / number(answer, "predicted_exponential")));
    CHECK(number(answer, "levels") == 12);
    // The levels are a route of their own, and agree to their error.
    CHECK(number(answer, "work_by_levels") != work);
  }
  // The energy is ½K_t u_x² with the stiffness 2G*a of the largest contact, in which x is u_x or
  // v/ω; K_t is that of the last level, shy of the end.
  const double stiffest = 2 * modulus_ratio * 1e9 * std::sqrt(4e-3 * 26e-6);
  CHECK(number(equal, "work_over_elastic_energy") ==
        Approx(number(equal, "work_per_cycle") / (stiffest * amplitude * amplitude / 2))
            .epsilon(0.03));
  CHECK(number(drag, "work_over_elastic_energy") ==
        Approx(number(drag, "work_per_cycle") / (stiffest * std::pow(1e-3 / (100 * pi), 2) / 2))
            .epsilon(0.03));
}

TEST_CASE("oscillate frees the lateral displacement in all its simulations", "[oscillate]") {
  const ProgramTest test;
  const auto run = [&](const char* lateral) {
    return test.answer(
        std::string("oscillate --shape pyramids --points 32 --steps 16 --levels 8 --friction 100 "
                    "--contact-modulus 1GPa --poisson 0.5 --lateral ") +
        lateral);
  };
  const auto held = run("held"), free = run("free");
  const double steps = number(free, "work_per_cycle") / number(held, "work_per_cycle") - 1;
  // What is free can only be softer: by 0.4 % here, the same for each route up to a tenth of it,
  // the errors of steps and cells.
  CHECK(steps < -0.003);
  CHECK(number(free, "work_by_levels") / number(held, "work_by_levels") - 1 ==
        Approx(steps).epsilon(0.2));
  CHECK(number(free["friction"], "work_per_cycle") / number(held["friction"], "work_per_cycle") -
            1 ==
        Approx(steps).epsilon(0.2));
}

TEST_CASE("oscillate moves in its direction by levels and by steps", "[oscillate]") {
  const ProgramTest test;
  const auto run = [&](const char* direction) {
    return test.answer(std::string("oscillate --shape elliptic-paraboloid --points 32 --steps 16 "
                                   "--levels 8 --contact-modulus 1GPa --poisson 0.5 --direction ") +
                       direction);
  };
  const auto along = run("0deg"), across = run("90deg");
  // The contact is longer along x: stiffer across it, by both routes alike up to the errors of the
  // cells, which they share.
  const double steps = number(across, "work_per_cycle") / number(along, "work_per_cycle");
  CHECK(std::abs(steps - 1) > 0.05);
  CHECK(number(across, "work_by_levels") / number(along, "work_by_levels") ==
        Approx(steps).epsilon(0.01));
}

TEST_CASE("oscillate keeps one boundary in all its solves", "[oscillate]") {
  const ProgramTest test;
  const auto run = [&](const std::string& options) {
    return test.answer("oscillate --points 32 --steps 32 --levels 8 --friction 100" + material +
                       options);
  };
  const std::string parabola = "--shape paraboloid --indentation 5um ";
  const auto free = run(parabola), same = run(parabola + "--boundary free");
  const auto periodic = run(parabola + "--boundary periodic"), waves = run("--shape sinusoids");
  CHECK(same["work_per_cycle"] == free["work_per_cycle"]);
  // The cells' images carry, too: at the same depth more force, and a stiffness that is far higher.
  CHECK(number(periodic, "force") > 1.3 * number(free, "force"));
  CHECK(number(periodic, "work_per_cycle") > 1.5 * number(free, "work_per_cycle"));
  for (const auto& answer : {free, periodic, waves}) {
    CHECK(answer["routes_agree"] == true);
    // The constants of the steps differ: 4 % at 16 steps, a quarter of it here.
    CHECK(number(answer["friction"], "over_stick") == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("The file of oscillate holds what its answer says", "[oscillate]") {
  const ProgramTest test;
  const auto answer = test.answer(
      "oscillate --shape elliptic-paraboloid --points 28 --steps 12 --phase 70deg --friction 0.3 "
      "--relative-error 20% --output f.h5" +
      material);
  const ResultReader file(test.folder() / "f.h5");
  const auto attribute = [&](const char* group, const char* name) {
    return file.number_attribute(group, name).value();
  };
  CHECK(file.numbers("cycle/time_in_periods") == numbers(answer, "time_in_periods"));
  CHECK(file.numbers("cycle/work") == numbers(answer, "work"));
  CHECK(file.numbers("cycle/dissipated").back() == number(answer, "dissipated"));
  CHECK(attribute("cycle", "work_per_cycle") == number(answer, "work_per_cycle"));
  CHECK(attribute("levels", "work_per_cycle") == number(answer, "work_by_levels"));
  CHECK(attribute("levels", "error_estimate") == number(answer, "work_by_levels_error"));
  CHECK(attribute("levels", "work_by_whole_cells") == number(answer, "work_by_whole_cells"));
  // The map of the cells: 2 always in contact, 1 sometimes.
  const Field map = file.field("cycle/contact_map");
  const double cell = 1e-6 / static_cast<double>(map.size());
  CHECK(static_cast<double>((map == 2).count()) * cell ==
        Approx(number(answer, "contact_area_min")));
  CHECK(static_cast<double>((map >= 1).count()) * cell ==
        Approx(number(answer, "contact_area_max")));
  const std::vector<double> area = file.numbers("cycle/contact_area");
  CHECK(*std::max_element(area.begin(), area.end()) == number(answer, "contact_area_max"));
  // K_t/K lies between 1 − ν/2 of strips and (1 − ν/2)/(1 − ν), times G*/E*, at every level: no
  // column stands for the other.
  const std::vector<double> tangential = file.numbers("levels/tangential_stiffness"),
                            normal = file.numbers("levels/normal_stiffness");
  for (std::size_t k = 1; k + 1 < normal.size(); ++k) {
    CHECK(tangential[k] < 0.99 * normal[k]);
    CHECK(tangential[k] > 0.7 * normal[k]);
  }
  const auto& friction = answer["friction"];
  CHECK(attribute("friction", "friction_coefficient") == 0.3);
  for (const char* name : {"work_per_cycle", "slip_work", "relaxation_work"})
    CHECK(attribute("friction", name) == number(friction, name));
  CHECK(file.field("friction/loss").sum() * cell == Approx(number(friction, "dissipated")));
  CHECK(file.numbers("friction/tangential_force") == numbers(friction, "tangential_force"));
  CHECK(file.numbers("friction/tangential") == numbers(friction, "tangential"));
  CHECK(file.numbers("friction/dissipated").back() == Approx(number(friction, "dissipated")));
  // An automatic choice of cells adds their error to that of the steps, which the file has by
  // itself.
  CHECK(answer["error_contains"] == nlohmann::json{"steps", "cells"});
  CHECK(number(answer, "error_estimate") > attribute("cycle", "error_estimate"));
  CHECK(map.rows() == answer["nx"]);
}

TEST_CASE("oscillate warns of a loss that is not steady and of steps that are too few",
          "[oscillate]") {
  const ProgramTest test;
  // Coupled, a drag goes on to draw the contact out, and its second period is not its first.
  const std::string drag =
      "oscillate --shape cone --points 24 --steps 8 --levels 4 --mode drag --drag-velocity 1mm/s "
      "--frequency 500Hz --max-periods 2 " +
      material;
  const auto hasty = test.run(drag + "--coupled");
  CHECK(hasty.err.find("coupling: after 2 periods the loss still differs") != std::string::npos);
  CHECK(hasty.json()["coupling"]["steady"] == false);
  CHECK(hasty.json()["coupling"]["periods"] == 2);
  // With friction alone it starts from the state of sliding, in which nothing changes from the
  // first period on.
  const auto slid = test.run(drag + "--friction 0.4");
  CHECK(slid.err.find("after") == std::string::npos);
  const auto friction = slid.json()["friction"];
  CHECK(friction["steady"] == true);
  const auto number = [&](const char* key) { return friction[key].get<double>(); };
  CHECK(number("mean_tangential_force") ==
        Approx(number("work_per_cycle") / (1e-3 / 500)).epsilon(1e-9));
  CHECK(number("mean_tangential_force") < 0.4 * number("mean_force"));
}

TEST_CASE("Several shapes move as they are told", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape paraboloid,pyramids,sinusoids --points 24 --steps 8" + material;
  const auto quarter = test.answer(command), eighth = test.answer(command + "--phase 45deg");
  const auto drag = test.answer(command + "--mode drag");
  for (const char* shape : {"paraboloid", "pyramids", "sinusoids"}) {
    const auto &a = quarter[shape], &b = eighth[shape], &c = drag[shape];
    CHECK(a["time_in_periods"].size() == 9);
    CHECK(number(b, "work_per_cycle") == Approx(number(a, "work_per_cycle") / 2).epsilon(1e-6));
    // Eq. (15) over Eq. (12) where v/ω = u_x, with one F'' from 32 levels and one from 16.
    // On so few cells a force may bend the wrong way, and has no such prediction.
    if (!c["small_amplitude_work"].is_null() && !a["small_amplitude_work"].is_null())
      CHECK(number(c, "small_amplitude_work") / number(c, "force_curvature") ==
            Approx(0.75 * (pi * pi - 4) * number(a, "small_amplitude_work") /
                   number(a, "force_curvature")));
    CHECK((shape != std::string("paraboloid") || c["small_amplitude_work"].is_number()));
    CHECK(a["routes_agree"] == true);
    CHECK(c["routes_agree"] == true);
  }
  // What tells the shapes apart: a² = Rδ up to 26 µm; 16 pyramids whose contacts are about those of
  // cones of their slope, a = 2δ/(π 0.1) up to 7.8 µm; waves drawn out along the motion, so that
  // K_t < (G*/E*)K, and across it would be more.
  CHECK(number(quarter["paraboloid"], "contact_area_max") ==
        Approx(pi * 4e-3 * 26e-6).epsilon(0.1));
  CHECK(number(quarter["paraboloid"], "ratio_finite") == Approx(1).epsilon(0.05));
  CHECK(number(quarter["pyramids"], "contact_area_max") ==
        Approx(16 * pi * std::pow(2 * 7.8e-6 / (pi * 0.1), 2)).epsilon(0.5));
  CHECK(number(quarter["sinusoids"], "ratio_finite") < 0.95);
}
