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
        "iterations fft_count multilevel_count residual converged seconds");
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

  check_refused(test.run(kept), "c.h5: exists already; continue from it with --initial c.h5");
  const auto warm = test.answer(kept + "--initial c.h5");
  CHECK(warm["converged"] == true);
  CHECK(warm["iterations"] < plain["iterations"]);
  // To the square root of the tolerance, which is that of an energy.
  CHECK(warm["mean_gap"] == Approx(plain["mean_gap"]).epsilon(1e-5));
  CHECK(test.files() == "rough.h5");

  // One command for the first time and for every other.
  const auto anew = test.run(kept + "--initial c.h5");
  CHECK(numbers(anew) == plain);
  CHECK_THAT(anew.err, Contains("c.h5 does not exist yet: the contact starts from the beginning"));
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
  CHECK_THAT(full.err, Contains("; the earlier checkpoint is kept"));
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
  check_refused(test.run("report none.h5 -o none.html"), "none.h5: does not contain a study");
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
  CHECK(found["test"]["decay_length_at_min_gap"] == bend.decay_length_at_min_gap);
  CHECK(found["test"]["decay_length_at_max_gap"] == bend.decay_length_at_max_gap);
  const WindowSensitivity parts = window_sensitivity(curve, window, FitWeights::force);
  CHECK(found["window_sensitivity"]["decay_length_min"] == parts.decay_length_min);
  CHECK(found["window_sensitivity"]["decay_length_max"] == parts.decay_length_max);
}
