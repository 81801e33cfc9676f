// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/distributions.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "run_program.hpp"

using Catch::Contains;

using namespace salebra;

namespace {

void make_rough(const ProgramTest& test) {
  test.done(
      "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
      "--rms-height 10nm --seed 3 -o rough.h5");
}

}  // namespace

TEST_CASE("A contact is described by the agreed keys and is the same for one and two threads",
          "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --pressure 20MPa --contact-modulus 10GPa ";
  const auto answer = test.answer(press + "--threads 1");
  CHECK(keys(answer) ==
        "pressure force contact_area_fraction mean_gap indentation max_pressure elastic_energy "
        "iterations fft_count ladder_count residual converged seconds");
  CHECK(answer["converged"] == true);
  CHECK(answer["pressure"] == Approx(2e7).epsilon(1e-9));
  CHECK(answer["force"] == Approx(2e7 * 16e-12).epsilon(1e-9));
  CHECK(answer["residual"] < 1e-10);

  const auto other = test.answer(press + "--threads 2 -o two.h5");
  test.done(press + "--threads 1 -o one.h5");
  const Field first = ResultReader(test.folder() / "one.h5").field("contact/contact_pressure");
  const Field second = ResultReader(test.folder() / "two.h5").field("contact/contact_pressure");
  CHECK(((first > 0) == (second > 0)).all());
  CHECK((first > 0).count() > 10);
  CHECK(other["contact_area_fraction"] == answer["contact_area_fraction"]);
  for (const char* key : {"mean_gap", "indentation", "max_pressure", "elastic_energy"}) {
    INFO(key);
    CHECK(other[key] == Approx(answer[key]).epsilon(1e-10));
  }
}

TEST_CASE("Pressure, force, indentation and mean gap lead to one contact, periodic or free",
          "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string boundary = GENERATE("periodic", "free");
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --boundary " + boundary;
  const auto loaded = test.answer(press + " --pressure 20MPa");
  std::vector<std::string> positions{
      " --normal-force 0.32mN",
      fmt::format(" --indentation {}", loaded["indentation"].get<double>())};
  if (boundary == "periodic")
    positions.push_back(fmt::format(" --mean-gap {}", loaded["mean_gap"].get<double>()));
  for (const std::string& position : positions) {
    INFO(boundary << position);
    const auto held = test.answer(press + position);
    // All to a residual of 1e-10, which is an energy.
    CHECK(held["indentation"] == Approx(loaded["indentation"]).epsilon(1e-8));
    CHECK(held["pressure"] == Approx(2e7).epsilon(boundary == "free" ? 1e-6 : 1e-8));
    CHECK(held["contact_area_fraction"] == loaded["contact_area_fraction"]);
  }
}

TEST_CASE("A contact starts from an earlier one, in the precision asked for", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --pressure 20MPa ";
  const auto cold = test.answer(press + "-o cold.h5");
  const auto warm = test.answer(press + "--initial cold.h5");
  CHECK(warm["iterations"] < cold["iterations"]);
  CHECK(warm["mean_gap"] == Approx(cold["mean_gap"]).epsilon(1e-6));
  const auto full = test.answer(press + "--precision full --tolerance 1e-12");
  CHECK(full["residual"] < 1e-12);
  CHECK(full["fft_count"] != cold["fft_count"]);
}

TEST_CASE("A checkpoint keeps the pressure of a contact until it has converged", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --json --pressure 20MPa ";
  const std::string kept = press + "--checkpoint c.h5 --checkpoint-every 0 ";
  const auto numbers = [](const ProgramTest::Result& result) {
    auto answer = result.json();
    answer.erase("seconds");
    return answer;
  };
  const auto plain = numbers(test.run(press));
  CHECK(numbers(test.run(kept)) == plain);
  CHECK(test.files() == "rough.h5");

  // Every hour: of a contact of milliseconds its end alone.
  const auto ended =
      test.run(press + "--checkpoint c.h5 --checkpoint-every 1h --max-iterations 9 -o r.h5");
  CHECK(ended.status == 1);
  CHECK(test.files() == "c.h5 rough.h5");
  const ResultReader reader(test.folder() / "c.h5");
  CHECK(reader.datasets("contact") == std::vector<std::string>{"contact_pressure", "x", "y"});
  const Field pressure = reader.field("contact/contact_pressure");
  CHECK((pressure >= 0).all());
  CHECK(pressure.mean() == Approx(2e7).epsilon(1e-6));  // in float

  check_refused(test.run(kept), "c.h5: exists; continue from it with --initial c.h5");
  const auto warm = test.answer(kept + "--initial c.h5");
  CHECK(warm["converged"] == true);
  CHECK(warm["iterations"] < plain["iterations"]);
  // To the square root of the tolerance, which is that of an energy.
  CHECK(warm["mean_gap"] == Approx(plain["mean_gap"]).epsilon(1e-5));
  CHECK(test.files() == "rough.h5");

  // One command for the first time and for every other.
  const auto anew = test.run(kept + "--initial c.h5");
  CHECK(numbers(anew) == plain);
  CHECK_THAT(anew.err, Contains("c.h5 is not there yet: the contact starts anew"));
}

TEST_CASE("A checkpoint that the disk has no room for is warned of, and the last one stays",
          "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press =
      "contact rough.h5 --contact-modulus 10GPa --pressure 20MPa --quiet --checkpoint c.h5 ";
  REQUIRE(test.run(press + "--max-iterations 3").status == 1);
  const std::string last = test.read("c.h5");
  const std::string loud =
      "contact rough.h5 --contact-modulus 10GPa --pressure 20MPa --json --initial c.h5 "
      "--checkpoint c.h5 --checkpoint-every 0 ";
  // 8 kB, half of what 64² numbers in float take.
  const auto full = test.run(loud + "--max-iterations 4", "ulimit -f 16;");
  CHECK(full.status == 1);
  CHECK_THAT(full.err, Contains("salebra: warning: --checkpoint: c.h5: cannot be written"));
  CHECK_THAT(full.err, Contains("; the file before stays"));
  // Four checkpoints failed, and one line says so.
  CHECK(full.err.find("warning: --checkpoint") == full.err.rfind("warning: --checkpoint"));
  CHECK_THAT(full.err, Contains("raise --max-iterations"));
  CHECK(test.read("c.h5") == last);
  CHECK(test.files() == "c.h5 rough.h5");
  const auto through = test.run(loud, "ulimit -f 16;");
  CHECK(through.status == 0);
  CHECK(through.json()["converged"] == true);
}

TEST_CASE("SIGUSR1 leaves a checkpoint, from which the contact continues", "[contact]") {
  const ProgramTest test;
  test.done(
      "generate --points 512 --size-x 4um --hurst 0.8 --short-cutoff 0.1um --rms-height 10nm "
      "--seed 3 -o rough.h5");
  const std::string press =
      "contact rough.h5 --contact-modulus 10GPa --json --pressure 20MPa --precision full ";
  // Killed when the first checkpoint appears; one after each iteration leaves time enough.
  const auto stopped =
      test.run(press + "--checkpoint c.h5 --checkpoint-every 0 -o r.h5",
               "(while [ ! -e c.h5 ] && [ -e /proc/$$ ]; do sleep 0.02; done; kill -USR1 $$) &");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Contains("contact: interrupted; continue with --initial c.h5"));
  CHECK(test.files() == "c.h5 rough.h5");
  test.done(press + "--initial c.h5");
}

TEST_CASE("The output of a contact has the fields asked for, in double or float", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --pressure 20MPa ";
  const auto whole = test.answer(press + "-o all.h5");
  test.done(press + "--fields pressure --field-type float -o pressure.h5");
  test.done(press + "--fields none -o none.h5");
  test.done(press + "--field-type float -o float.h5");
  const ResultReader all(test.folder() / "all.h5"), pressure(test.folder() / "pressure.h5"),
      none(test.folder() / "none.h5"), rounded(test.folder() / "float.h5");
  CHECK(all.datasets("contact") == std::vector<std::string>{"contact_pressure", "gap", "x", "y"});
  CHECK(rounded.datasets("contact") == all.datasets("contact"));
  CHECK(pressure.datasets("contact") == std::vector<std::string>{"contact_pressure", "x", "y"});
  CHECK(none.datasets("contact").empty());
  for (const ResultReader* file : {&pressure, &none, &rounded})
    CHECK(file->attributes("contact") == all.attributes("contact"));
  for (const std::string field : {"contact/contact_pressure", "contact/gap"})
    CHECK((rounded.field(field) == all.field(field).cast<float>().cast<double>()).all());
  CHECK(std::filesystem::file_size(test.folder() / "float.h5") <
        0.6 * double(std::filesystem::file_size(test.folder() / "all.h5")));

  for (const std::string file : {"pressure.h5", "float.h5"})
    CHECK(test.answer(press + "--initial " + file)["iterations"] < whole["iterations"]);
  check_refused(test.run(press + "--initial none.h5"), "none.h5 has no contact pressure");
  check_refused(test.run("statistics none.h5"), "none.h5: has no dataset heights");
  check_refused(test.run("report none.h5 -o none.html"), "none.h5: contains no study");
}

TEST_CASE("The stiffness of full contact is infinite: valid JSON without a number", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --stiffness ";
  const auto open = test.answer(press + "--pressure 20MPa");
  CHECK(open["normal_stiffness"] > 0);
  CHECK_FALSE(open.contains("tangential_stiffness"));
  const auto sheared = test.answer(press + "--pressure 20MPa --poisson 0.3");
  CHECK(sheared["tangential_stiffness"] ==
        Approx(1.4 / 1.7 * open["normal_stiffness"].get<double>()).epsilon(1e-12));
  // A stick solve finds what it finds for the same contact in a curve.
  const std::string stuck = press + "--poisson 0.3 --stick --pressure 20MPa";
  CHECK(test.answer(stuck)["tangential_stiffness"] ==
        test.answer(stuck + ",40MPa")["curve"]["tangential_stiffness"][0]);
  CHECK(open["normal_stiffness_per_area"] ==
        Approx(open["normal_stiffness"].get<double>() * open["pressure"].get<double>() /
               open["force"].get<double>()));
  const auto closed = test.answer(press + "--pressure 100GPa");
  CHECK(closed["contact_area_fraction"] == 1);
  CHECK(closed["normal_stiffness"].is_null());
  CHECK(closed.contains("normal_stiffness"));
  CHECK(closed["normal_stiffness_per_area"].is_null());
  const auto curve = test.answer(
      "contact rough.h5 --contact-modulus 10GPa --poisson 0.3 --stiffness --pressure 20MPa,100GPa")
                         ["curve"];
  CHECK(curve["normal_stiffness"][0] > 0);
  CHECK(curve["normal_stiffness"][1].is_null());
  CHECK(curve["tangential_stiffness"][1].is_null());
  CHECK(curve["converged"][1] == true);
}

TEST_CASE("The conductance of contacts follows from their stiffness, in answers and files",
          "[contact][conductance]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa ";
  const std::string bodies = "--conductivity 50W/mK,400 --resistivity '2 uohm cm' ";
  // 2/[E*(1/κ_1 + 1/κ_2)] and 2/[E*(ρ + ρ)] of 2e-8 Ω m.
  const double thermal = 2 / (10e9 * (1.0 / 50 + 1.0 / 400)), electrical = 1 / (10e9 * 2e-8);
  const std::string hardness = GENERATE("", "--hardness 600MPa ");
  const auto one =
      test.answer(press + bodies + hardness + "--pressure 20MPa --fields none -o one.h5");
  const double stiffness = one["normal_stiffness_per_area"];
  CHECK(stiffness > 0);
  CHECK(one["thermal_conductance"] == Approx(thermal * stiffness).epsilon(1e-12));
  CHECK(one["electrical_conductance"] == Approx(electrical * stiffness).epsilon(1e-12));
  const ResultReader file(test.folder() / "one.h5");
  for (const char* name : {"thermal_conductance", "electrical_conductance", "normal_stiffness"})
    CHECK(file.number_attribute("contact", name) == one[name].get<double>());

  const auto curve = test.answer(press + bodies + hardness + "--pressure 20MPa,200MPa -o curve.h5");
  const ResultReader columns(test.folder() / "curve.h5");
  for (const char* name : {"thermal_conductance", "electrical_conductance"}) {
    const double factor = name[0] == 't' ? thermal : electrical;
    CHECK(columns.numbers("curve/" + std::string(name)) ==
          curve["curve"][name].get<std::vector<double>>());
    for (const int k : {0, 1})
      CHECK(curve["curve"][name][k] ==
            Approx(factor * curve["curve"]["normal_stiffness_per_area"][k].get<double>())
                .epsilon(1e-12));
  }
  CHECK(read_force_curve(test.folder() / "curve.h5").samples.size() == 2);
}

TEST_CASE("A contact without gaps conducts as its stiffness says, without a number",
          "[contact][conductance]") {
  const ProgramTest test;
  make_rough(test);
  const auto closed =
      test.answer("contact rough.h5 --contact-modulus 10GPa --pressure 100GPa --resistivity 2e-8");
  CHECK(closed["electrical_conductance"].is_null());
  CHECK_FALSE(closed.contains("thermal_conductance"));
  const auto summits = test.answer(
      "contact rough.h5 --model gw_moments --contact-modulus 10GPa --pressure 20MPa,30MPa "
      "--conductivity 1 -o summits.csv");
  CHECK(summits["curve"]["thermal_conductance"][1] ==
        Approx(1e-10 * summits["curve"]["normal_stiffness_per_area"][1].get<double>()));
  CHECK_THAT(test.read("summits.csv"), Contains("thermal_conductance [W/(m^2 K)]"));
}

TEST_CASE("Flow factors and densities of a contact are those of its fields", "[contact][flow]") {
  const ProgramTest test;
  make_rough(test);
  const std::string press = "contact rough.h5 --contact-modulus 10GPa --flow-factors ";
  const auto one = test.answer(press + "--pressure 10MPa --distributions 20 -o one.h5");
  const ResultReader file(test.folder() / "one.h5");
  NormalContactState state;
  state.contact_pressure = file.field("contact/contact_pressure");
  state.gap = file.field("contact/gap");
  const Grid2D grid{64, 64, 4e-6, 4e-6};
  const FlowFactors flow = flow_factors(state, grid);
  REQUIRE(flow.percolates_x);
  CHECK(one["percolates_x"] == true);
  for (const auto& [name, value] :
       {std::pair("pressure_flow_factor_x", flow.pressure_flow_factor_x),
        {"pressure_flow_factor_y", flow.pressure_flow_factor_y},
        {"effective_gap", flow.effective_gap},
        {"bruggeman_flow_factor", flow.bruggeman_flow_factor}}) {
    CHECK(one[name] == Approx(value).epsilon(1e-12));
    CHECK(file.number_attribute("contact", name) == one[name].get<double>());
  }
  const ContactDistributions found = contact_distributions(state, grid, 20);
  CHECK(one["distributions"]["gap_density"].get<std::vector<double>>() == found.gap_density);
  CHECK(file.numbers("distributions/pressure_density") == found.pressure_density);
  CHECK(file.numbers("distributions/contact_pressure") == found.contact_pressure);

  // Most of the area touches at the second pressure: there is no way through.
  const auto curve = test.answer(press + "--pressure 10MPa,200MPa -o curve.h5")["curve"];
  CHECK(curve["pressure_flow_factor_x"][0] ==
        Approx(one["pressure_flow_factor_x"].get<double>()).epsilon(1e-9));
  CHECK(curve["contact_area_fraction"][1] > 0.6);
  CHECK(curve["percolates_x"] == nlohmann::json{true, false});
  CHECK(curve["percolates_y"][1] == false);
  for (const char* name : {"pressure_flow_factor_x", "effective_gap", "bruggeman_flow_factor"})
    CHECK(curve[name][1].is_null());
  const ResultReader columns(test.folder() / "curve.h5");
  CHECK(columns.numbers("curve/percolates_x") == std::vector<double>{1, 0});
  CHECK(std::isnan(columns.numbers("curve/pressure_flow_factor_x")[1]));
}

TEST_CASE("A contact that does not converge is not presented as a result", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const auto result = test.run(
      "contact rough.h5 --pressure 20MPa --contact-modulus 10GPa --tolerance 1e-12 "
      "--max-iterations 2 -o c.h5");
  CHECK(result.status == 1);
  CHECK_THAT(result.err, Contains("salebra: error: contact: "));
  CHECK(test.files() == "rough.h5");
}

TEST_CASE("fit answers with the fit, the test and the sensitivity of the window and weights asked",
          "[fit]") {
  const ProgramTest test;
  make_rough(test);
  test.done("contact rough.h5 --pressure 2:60MPa:10 --contact-modulus 10GPa -o curve.h5");
  const ForceCurve curve = read_force_curve(test.folder() / "curve.h5");
  const PressureWindow window{3e6, 40e6, 0};
  const auto found = test.answer("fit curve.h5 --pressure-window 3MPa,40MPa --weights force");
  const ExponentialFit fit = fit_exponential(curve, window, FitWeights::force);
  REQUIRE(fit.window.points < 10);
  CHECK(found["decay_length"] == fit.decay_length);
  CHECK(found["decay_length_low"] == fit.decay_length_low);
  CHECK(found["decay_length_high"] == fit.decay_length_high);
  CHECK(found["reference_pressure"] == fit.reference_pressure);
  CHECK(found["r_squared"] == fit.r_squared);
  CHECK(found["window"]["points"] == fit.window.points);
  for (const auto& [name, weights] : {std::pair{"spacing", FitWeights::spacing},
                                      {"equal", FitWeights::equal},
                                      {"force", FitWeights::force}})
    CHECK(found["decay_length_by_weights"][name] ==
          fit_exponential(curve, window, weights).decay_length);
  const ExponentialTest bend = test_exponential(curve, window, FitWeights::force);
  CHECK(found["test"]["significance"] == bend.significance);
  CHECK(found["test"]["decay_length_closest"] == bend.decay_length_closest);
  CHECK(found["test"]["decay_length_farthest"] == bend.decay_length_farthest);
  const WindowSensitivity parts = window_sensitivity(curve, window, FitWeights::force);
  CHECK(found["window_sensitivity"]["decay_length_min"] == parts.decay_length_min);
  CHECK(found["window_sensitivity"]["decay_length_max"] == parts.decay_length_max);
}

TEST_CASE("Several pressures lead to a curve, its fit and a damping constant", "[contact][fit]") {
  const ProgramTest test;
  make_rough(test);
  const auto swept = test.answer(
      "contact rough.h5 --pressure 2:60MPa:8 --stiffness --contact-modulus 10GPa --poisson 0.3 -o "
      "curve.h5");
  const auto curve = swept["curve"];
  CHECK(keys(swept) == "curve");
  CHECK(keys(curve) ==
        "pressure force mean_gap indentation contact_area_fraction normal_stiffness "
        "tangential_stiffness converged normal_stiffness_per_area tangential_stiffness_per_area");
  // Area: force over pressure.
  CHECK(curve["normal_stiffness_per_area"][3] ==
        Approx(curve["normal_stiffness"][3].get<double>() * curve["pressure"][3].get<double>() /
               curve["force"][3].get<double>())
            .epsilon(1e-12));
  for (const auto& column : curve) CHECK(column.size() == 8);
  // One elastic body: G*/E* = 2(1 − ν)/(2 − ν).
  CHECK(curve["tangential_stiffness"][3] ==
        Approx(1.4 / 1.7 * curve["normal_stiffness"][3].get<double>()).epsilon(1e-12));

  const auto fit = test.answer("fit curve.h5 --pressure-window 2MPa,60MPa");
  // A computed curve has misfit in place of scatter: neither interval nor probability.
  CHECK(keys(fit) ==
        "decay_length reference_pressure r_squared window decay_length_over_rms_height local test "
        "window_sensitivity weights decay_length_by_weights");
  CHECK(keys(fit["window"]) == "pressure_min pressure_max points");
  CHECK(fit["window"]["points"] == 8);
  CHECK(keys(fit["test"]) == "fair decay_length_closest decay_length_farthest");

  const auto damping = test.answer(
      "damping --curve curve.h5 --pressure 20MPa --poisson 0.3 --normal-amplitude 0.1nm "
      "--drag-velocity 1mm/s --frequency 20kHz");
  CHECK(damping["damping_constant"] > 0);
  CHECK(damping["force"] == Approx(20e6 * 16e-12).epsilon(1e-9));
}

TEST_CASE("Greenwood-Williamson curves come from a surface or from parameters", "[contact]") {
  const ProgramTest test;
  make_rough(test);
  const std::set<std::string> curve_keys{"separation",
                                         "pressure",
                                         "force",
                                         "mean_gap",
                                         "indentation",
                                         "contact_area_fraction",
                                         "normal_stiffness",
                                         "tangential_stiffness",
                                         "normal_stiffness_per_area",
                                         "tangential_stiffness_per_area",
                                         "converged"};
  for (const std::string model : {"gw_moments", "gw_deterministic"}) {
    const auto answer = test.answer("contact rough.h5 --model " + model +
                                    " --pressure 2:60MPa:5 --contact-modulus 10GPa --poisson 0.3");
    CHECK(keys(answer) == "parameters curve");
    CHECK(keys(answer["curve"]) == curve_keys);
    CHECK(answer["parameters"]["summit_density"] > 0);
    CHECK(answer["curve"]["pressure"][0] == Approx(2e6).epsilon(1e-9));
    // The same state by each kind of position.
    const auto& curve = answer["curve"];
    for (const auto& [option, column] : {std::pair("--normal-force", "force"),
                                         {"--mean-gap", "mean_gap"},
                                         {"--indentation", "indentation"}}) {
      INFO(option);
      const auto same = test.answer(
          fmt::format("contact rough.h5 --model {} {}={} --contact-modulus 10GPa --poisson 0.3",
                      model, option, curve[column][2].get<double>()));
      CHECK(same["curve"]["pressure"][0] == Approx(curve["pressure"][2]).epsilon(1e-8));
    }
  }
  const auto answer = test.answer(
      "contact --model gw_moments --summit-density 10/um2 --radius 100nm --summit-rms 10nm "
      "--distribution exponential --mean-gap 10nm,30nm --contact-modulus 10GPa");
  // F ∝ exp(−s/σ), from the lowest force to the highest.
  CHECK(answer["curve"]["pressure"][1].get<double>() /
            answer["curve"]["pressure"][0].get<double>() ==
        Approx(std::exp(2.0)).epsilon(1e-12));
  CHECK(answer["curve"]["tangential_stiffness"][0].is_null());
}

TEST_CASE("A contact that reaches the edge of an isolated surface is warned of", "[contact]") {
  const ProgramTest test;
  test.done("generate --shape sphere --radius 2um --points 32 --size-x 1um -o s.h5");
  const std::string contact =
      "contact s.h5 --boundary free --contact-modulus 1GPa --poisson 0.3 --indentation ";
  const auto light = test.run(contact + "5nm"), heavy = test.run(contact + "300nm");
  INFO(light.err << heavy.err);
  CHECK_THAT(light.err, !Contains("reaches the edge"));
  CHECK_THAT(heavy.err, Contains("the contact reaches the edge of the surface"));
}

TEST_CASE("An adhesive contact pulls, comes off, and answers with the agreed keys",
          "[contact][adhesion]") {
  const ProgramTest test;
  test.done(
      "generate --points 48 --size-x 48um --hurst 0.8 --rolloff 48um --short-cutoff 24um "
      "--rms-slope 0.2 --seed 3 -o rough.h5");
  const std::string press =
      "contact rough.h5 --contact-modulus 1MPa --work-of-adhesion 0.3 --adhesion-range 2um ";
  const auto pressed = test.answer(press +
                                   "--pressure 50kPa --stiffness --resistivity 1e-8 --flow-factors "
                                   "--distributions -o one.h5");
  for (const char* key :
       {"tension_force", "adhesive_energy", "total_energy", "tabor", "cells_in_process_zone",
        "outer_iterations", "detached", "adhesion_residual", "normal_stiffness",
        "electrical_conductance", "percolates_x", "distributions"}) {
    INFO(key);
    CHECK(pressed.contains(key));
  }
  CHECK(pressed["detached"] == false);
  CHECK(pressed["tension_force"] > 0);
  CHECK(pressed["adhesive_energy"] < 0);
  const ResultReader file(test.folder() / "one.h5");
  const double net =
      file.field("contact/contact_pressure").mean() - file.field("contact/tension").mean();
  CHECK(net == Approx(5e4).epsilon(1e-6));
  CHECK(file.number_attribute("contact", "tension_force") == pressed["tension_force"]);

  const auto parted = test.answer(press + "--pressure=-300kPa --stiffness");
  CHECK(parted["detached"] == true);
  CHECK(parted["mean_gap"].is_null());
  CHECK_FALSE(parted.contains("normal_stiffness"));
  // Along a branch the pull holds that parts the surfaces without a history.
  const auto branch = test.answer(press + "--mean-gap 20um,30um,25um");
  CHECK(branch["curve"]["mean_gap"][0] == Approx(30e-6));
  CHECK(branch["curve"]["outer_iterations"].size() == 3);
  CHECK_FALSE(branch.contains("unloading"));
}

TEST_CASE("A cycle of adhesive contacts has two branches, a pull-off, and the work between them",
          "[contact][adhesion]") {
  const ProgramTest test;
  test.done(
      "generate --points 64 --size-x 128um --hurst 0.8 --rolloff 64um --short-cutoff 16um "
      "--rms-slope 0.1 --seed 1 -o rough.h5");
  const std::string cycle =
      "contact rough.h5 --contact-modulus 1MPa --work-of-adhesion 0.05 --adhesion-range 500nm "
      "--cycle ";
  const auto gaps = test.answer(cycle + "--mean-gap 8:0.1um:12 --stiffness -o cycle.h5");
  CHECK(keys(gaps) ==
        "curve unloading pull_off_pressure adhesion_work_per_cycle adhesion_work_error "
        "reversible_amplitude reversible_amplitude_error reversible tabor");
  CHECK(gaps["reversible"] == false);
  CHECK(gaps["reversible_amplitude_error"] > 0);
  // A curve with adhesion is no law.
  const auto damped = test.run(
      "damping --curve cycle.h5 --poisson 0.3 --pressure 1kPa --normal-amplitude 1nm "
      "--drag-velocity 1um/s --frequency 1kHz");
  CHECK(damped.status == 2);
  CHECK_THAT(damped.err, Contains("is of contacts with adhesion"));
  const std::vector<double> in = gaps["curve"]["force"], out = gaps["unloading"]["force"];
  const std::vector<double> depth = gaps["curve"]["indentation"],
                            back = gaps["unloading"]["indentation"];
  REQUIRE((in.size() == 12 && out.size() == 12));
  double work = 0;
  for (std::size_t k = 0; k + 1 < in.size(); ++k)
    work += (in[k] + in[k + 1]) / 2 * (depth[k + 1] - depth[k]) +
            (out[k] + out[k + 1]) / 2 * (back[k + 1] - back[k]);
  CHECK(gaps["adhesion_work_per_cycle"] == Approx(work));
  // The gap of 12 steps loses some 1e-11 J, and their trapezoids are known to the first digit.
  CHECK(work > 5e-12);
  CHECK(-*std::ranges::min_element(out) / (128e-6 * 128e-6) ==
        Approx(gaps["pull_off_pressure"].get<double>()));
  const ResultReader file(test.folder() / "cycle.h5");
  CHECK(file.numbers("unloading/force") == out);
  CHECK(file.numbers("curve/tension_force") ==
        gaps["curve"]["tension_force"].get<std::vector<double>>());
  CHECK(file.number_attribute("unloading", "pull_off_pressure") == gaps["pull_off_pressure"]);

  const auto loads = test.answer(cycle + "--pressure 1kPa,5kPa");
  // Bracketed to 2 %, and passed between gaps.
  CHECK(loads["pull_off_pressure"] ==
        Approx(gaps["pull_off_pressure"].get<double>()).epsilon(0.05));
  CHECK(loads["adhesion_work_per_cycle"].is_null());
  CHECK(loads["reversible"].is_null());
  // A cycle that begins within the attraction does not close.
  const auto open = test.run(cycle + "--mean-gap 1.74:0.1um:6 --json");
  CHECK(open.json()["adhesion_work_per_cycle"].is_null());
  CHECK_THAT(open.err, Contains("do not meet at its outermost position"));
}
