// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/io/result_file.hpp>

#include "results/cycle_checkpoint.hpp"
#include "run_program.hpp"
#include "skipped.hpp"

namespace {

// The settings that a checkpoint was written with.
salebra::CycleSettings settings_in(const std::filesystem::path& checkpoint) {
  const salebra::ResultReader reader(checkpoint);
  salebra::CycleSettings settings;
  for (const std::string& name :
       words("arithmetic surface nx ny size_x size_y contact_modulus cerruti_isotropic "
             "cerruti_directed indentation normal_amplitude tangential_amplitude phase direction "
             "steps tolerance max_iterations boundary lateral friction_coefficient max_periods "
             "steady_tolerance"))
    if (const auto value = reader.text_attribute("settings", name))
      settings.emplace_back(name, *value);
  return settings;
}

}  // namespace

TEST_CASE("oscillate reproduces the paper's experiment by the name of a shape", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape paraboloid --points 40 --steps 24 --contact-modulus 1GPa --poisson 0.3";
  const auto answer = test.answer(command + " --phase 45deg --output cycle.h5");
  for (const char* key : {"work_per_cycle", "small_amplitude_work", "ratio", "work_by_force",
                          "ratio_finite", "contact_area_min", "contact_area_max", "time", "work",
                          "error_estimate", "work_by_levels_error", "dissipated", "converged"})
    CHECK(answer.contains(key));
  // Each route with an error of its own, on the same cells.
  CHECK(answer["routes_agree"] == true);
  CHECK(answer["error_contains"] == nlohmann::json{"steps"});
  CHECK(number(answer, "/error_estimate") < 0.02 * number(answer, "/work_per_cycle"));
  CHECK(answer["converged"] == true);
  CHECK(test.files().count("cycle.h5") == 1);
  CHECK(salebra::ResultReader(test.folder() / "cycle.h5")
            .number_attribute("cycle", "error_estimate")
            .value() == answer["error_estimate"]);
  // A round contact: 1 up to the 20 cells across it and h²/24 = 0.3 % of the steps.
  CHECK(answer["ratio_finite"] == Approx(1).epsilon(0.02));
  CHECK(answer["dissipated"] == Approx(answer["work_per_cycle"]).epsilon(1e-6));
  CHECK(answer["time_in_periods"].size() == 25);
  CHECK(answer["time_in_periods"].back() == 1);
  CHECK(answer["time"].size() == 25);
  // The loop of equal frequencies closes: all work of the period is lost.
  CHECK(answer["work"].back() == Approx(answer["work_per_cycle"]).epsilon(1e-9));
  // a² = Rδ, R = 4 mm, from δ = 14 to 26 µm.
  CHECK(answer["contact_area_max"] == Approx(std::numbers::pi * 4e-3 * 26e-6).epsilon(0.03));
  const auto levels = test.answer(command + " --phase 45deg --method levels");
  CHECK(levels["work_per_cycle"] == Approx(answer["work_per_cycle"]).epsilon(0.02));
  CHECK_FALSE(levels.contains("time"));
  CHECK_FALSE(levels.contains("routes_agree"));
  CHECK(levels["error_contains"] == nlohmann::json{"levels"});
  CHECK(levels["error_estimate"] == answer["work_by_levels_error"]);
}

TEST_CASE("oscillate tells relaxation and slip apart under finite friction", "[oscillate]") {
  const ProgramTest test;
  const auto balanced = [&](const std::string& options) {
    const auto answer = test.answer("oscillate --points 32 --contact-modulus 1GPa " + options);
    const auto friction = answer["friction"];
    CHECK(friction["converged"] == true);
    CHECK(friction["steady"] == true);
    CHECK(number(friction, "/slip_work") + number(friction, "/relaxation_work") ==
          Approx(number(friction, "/work_per_cycle")).epsilon(1e-5));
    CHECK(std::abs(number(friction, "/balance")) < 1e-5);
    CHECK(answer["converged"] == true);
    return friction;
  };
  // Both cycles are of second order in the steps, with different constants: 3.5 % at 16 steps, 1.0
  // % at 32.
  const auto stuck = balanced("--shape cone --poisson 0.3 --friction 100 --steps 32");
  CHECK(number(stuck, "/over_stick") == Approx(1).margin(0.015));
  CHECK(number(stuck, "/slip_work") < 1e-6 * number(stuck, "/work_per_cycle"));
  const auto slipping =
      balanced("--shape cone --poisson 0.3 --friction 0.3 --steps 32 --output f.h5");
  CHECK(number(slipping, "/slip_work") > 0.1 * number(slipping, "/work_per_cycle"));
  CHECK(number(slipping, "/relaxation_work") > 0.1 * number(slipping, "/work_per_cycle"));
  CHECK(slipping["tangential_force"].size() == 33);
  CHECK(test.files() == "f.h5");
  // Along y an elongated contact is stiffer than along x: a cycle with friction that moved along
  // the other axis would be 10 % off.
  const auto across = balanced(
      "--shape elliptic-paraboloid --poisson 0.5 --friction 100 --steps 32 --direction 90deg");
  CHECK(number(across, "/over_stick") == Approx(1).epsilon(0.025));
  // The exact cone at nu = 0.3, by the method of dimensionality reduction; measured 0.3 % apart,
  // errors of the steps. The parts are not compared: springs are not cells.
  const auto exact = test.answer(
      "damping --law cone --angle 0.05 --indentation 20um --mode equal-frequency "
      "--normal-amplitude 6um --tangential-amplitude 6um --phase 90deg --contact-modulus 1GPa "
      "--poisson 0.3 --friction-coefficient 0.3");
  CHECK(number(slipping, "/work_per_cycle") ==
        Approx(number(exact, "/work_per_cycle")).epsilon(0.01));
}

TEST_CASE("oscillate lets a rough surface slip, between full stick and sliding", "[oscillate]") {
  const ProgramTest test;
  test.done(
      "generate --points 48 --size-x 10um --hurst 0.8 --rolloff 2.5um --short-cutoff 1.67um "
      "--rms-slope 0.1 --seed 3 -o r.h5 --quiet");
  // h_rms is some 40 nm. u_x/u_z = 5: whether a cell slips is decided by its own pressure. Columns:
  // friction, W over that of full stick, slip over W. Without slip it is the other simulation's
  // loss, up to the different constants of the steps: 2.2 % apart at 32.
  for (const auto& [friction, stick_low, stick_high, slip_low, slip_high] :
       std::vector<std::tuple<std::string, double, double, double, double>>{
           {"1000", 0.97, 1.03, -1e-6, 1e-6},
           {"1", 0, 2, 0.02, 0.98},
           {"0.001", 0, 0.1, 0, 1.01}}) {
    INFO(friction);
    const auto answer = test.answer(
        "oscillate --surface r.h5 --pressure 3MPa --contact-modulus 1GPa --poisson 0.3 "
        "--normal-amplitude 4nm --tangential-amplitude 20nm --phase 70deg --steps 32 "
        "--max-periods 12 --friction " +
        friction);
    const auto& cycle = answer["friction"];
    CHECK(cycle["converged"] == true);
    CHECK(cycle["steady"] == true);
    CHECK(std::abs(number(cycle, "/balance")) < 1e-5);
    const double lost = number(cycle, "/dissipated"), slip = number(cycle, "/slip_work") / lost;
    CHECK(number(cycle, "/relaxation_work") / lost + slip == Approx(1));
    CHECK(number(cycle, "/over_stick") > stick_low);
    CHECK(number(cycle, "/over_stick") < stick_high);
    CHECK(slip > slip_low);
    CHECK(slip < slip_high);
    // Sliding: F_x = μF on the whole path of 4 u_x. F swings about its mean as cosθ does and |dx|
    // as |sin(θ + φ0)|, so that the mean force along the path is that at rest up to second order
    // in u_z, and the elastic return at both ends takes μF/K_t of the way.
    if (friction == "0.001")
      CHECK(lost == Approx(0.001 * number(answer, "/force") * 4 * 20e-9).epsilon(0.05));
  }
}

TEST_CASE("A killed cycle with friction resumes to the same numbers and lists all its fields",
          "[oscillate]") {
  const ProgramTest test;
  const std::string without_friction =
      "oscillate --shape cone --points 40 --steps 16 --levels 4 --contact-modulus 1GPa --poisson "
      "0.3 --direction 30deg --phase 45deg --json --friction ";
  const std::string command = without_friction + "0.4 ";
  const auto whole = test.answer(command);
  const std::string recorded =
      command + "--checkpoint c.h5 --checkpoint-every 0 --fields f --field-steps 4,12 ";
  // Killed when the first field of the cycle with friction appears; where it ended before, nothing
  // was killed.
  const auto killed = test.run(recorded,
                               "(while [ ! -e f-friction-0004.h5 ] && [ -e /proc/$$ ]; do sleep "
                               "0.01; done; kill -KILL $$) &");
  if (salebra::testing::skipped(killed.status == 0, "the cycle ended before it was killed")) return;
  REQUIRE(test.files().count("c.h5") == 1);
  check_refused(test.run(without_friction + "0.5 --checkpoint c.h5 --resume"),
                "friction_coefficient was 0.4");
  // A checkpoint that is told something else ends otherwise: both cycles go on from it and do not
  // begin anew.
  const salebra::CycleSettings settings = settings_in(test.folder() / "c.h5");
  auto states = salebra::read_cycle_checkpoint(test.folder() / "c.h5", settings);
  REQUIRE(states.size() == 2);
  std::get<salebra::StuckState>(states[0].body).released *= 2;
  std::get<salebra::SlidingState>(states[1].body).termination =
      salebra::Termination::iteration_limit;
  salebra::write_cycle_checkpoint(test.folder() / "other.h5", states, settings, {});
  const auto other = test.run(command + "--checkpoint other.h5 --resume");
  INFO(other.err);  // a setting that settings_in does not know is named here
  CHECK(other.status != 0);
  CHECK(other.json()["friction"]["converged"] == false);
  CHECK(other.json()["converged"] == false);
  CHECK(other.json()["dissipated"] == Approx(2 * number(whole, "/dissipated")));
  const auto resumed = test.answer(recorded + "--resume");
  CHECK(resumed["friction"] == whole["friction"]);
  CHECK(resumed["work_per_cycle"] == whole["work_per_cycle"]);
  CHECK(resumed["fft_count"] == whole["fft_count"]);
  // Beside them there may be what the killed process was writing.
  for (const char* file : {"f.xdmf", "f-mesh.h5", "f-0004.h5", "f-0012.h5", "f-friction.xdmf",
                           "f-friction-mesh.h5", "f-friction-0004.h5", "f-friction-0012.h5"})
    CHECK(test.files().count(file) == 1);
  CHECK(test.files().count("c.h5") == 0);
}

TEST_CASE("oscillate couples pressures and tractions by Dundurs' constant", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape paraboloid --points 20 --steps 8 --levels 4 --max-periods 2 "
      "--contact-modulus 1GPa --coupled --quiet ";
  const auto change = [&](const std::string& material) {
    const auto answer = test.answer(command + material);
    CHECK(answer["converged"] == true);
    CHECK(answer["friction"]["friction_coefficient"].is_null());
    // The premise is judged by what was computed.
    CHECK(answer["premises"]["coupling"]["value"] ==
          Approx(std::abs(number(answer, "/coupling/work_change"))).margin(1e-12));
    return answer["coupling"];
  };
  const auto with = change("--poisson 0.3 --output f.h5");
  // The largest change over the cycle against the largest force, from the columns of the file.
  const salebra::ResultReader file(test.folder() / "f.h5");
  const auto changed = [&](const std::string& quantity) {
    const auto coupled = file.numbers("coupling/" + quantity),
               alone = file.numbers("friction/" + quantity);
    double most = 0, scale = 0;
    for (std::size_t k = 0; k < alone.size(); ++k) {
      most = std::max(most, std::abs(coupled[k] - alone[k]));
      scale = std::max(scale, std::abs(alone[k]));
    }
    return most / scale;
  };
  CHECK(with["force_change"] == Approx(changed("normal_force")));
  CHECK(with["tangential_force_change"] == Approx(changed("tangential_force")));
  CHECK(with["work_change"] ==
        Approx(file.number_attribute("coupling", "work_per_cycle").value() /
                   file.number_attribute("friction", "work_per_cycle").value() -
               1));
  CHECK(with["dundurs"] == Approx(2.0 / 7));
  CHECK(std::abs(number(with, "/work_change")) > 1e-3);
  CHECK(with["force_change"] > 1e-3);
  CHECK(with["periods"] == 2);
  // The other sum, without what the eight steps make of gaps.
  CHECK(std::abs(number(with, "/balance")) < 1e-4);
  // Without it the coupled contact is the other one.
  const auto without = change("--poisson 0.3 --dundurs 0");
  CHECK(std::abs(number(without, "/work_change")) < 1e-4);
  CHECK(without["force_change"] < 1e-5);
  CHECK(change("--poisson 0.5")["dundurs"].get<double>() == Approx(0).margin(1e-12));
  CHECK(change("--poisson 0.3 --dundurs 0.1")["dundurs"].get<double>() == Approx(0.1));
  // Without coupling it slips as the other one does.
  const auto slipping = test.answer(command + "--poisson 0.3 --dundurs 0 --friction 0.3");
  CHECK(number(slipping, "/friction/slip_work") >
        0.1 * number(slipping, "/friction/work_per_cycle"));
  CHECK(std::abs(number(slipping, "/coupling/work_change")) < 1e-3);
}

TEST_CASE("A killed coupled cycle resumes to the same numbers", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape paraboloid --points 20 --steps 8 --levels 4 --max-periods 2 "
      "--contact-modulus 1GPa --poisson 0.3 --coupled --quiet ";
  const auto whole = test.answer(command);
  const std::string recorded =
      command + "--checkpoint c.h5 --checkpoint-every 0 --fields f --field-steps 2,5 ";
  const auto killed = test.run(recorded,
                               "(while [ ! -e f-coupled-0002.h5 ] && [ -e /proc/$$ ]; do sleep "
                               "0.01; done; kill -KILL $$) &");
  if (salebra::testing::skipped(killed.status == 0, "the cycle ended before it was killed")) return;
  REQUIRE(test.files().count("c.h5") == 1);
  CHECK(test.answer(recorded + "--resume") == whole);
  for (const char* file : {"f-coupled.xdmf", "f-coupled-0002.h5", "f-coupled-0005.h5"})
    CHECK(test.files().count(file) == 1);
  CHECK(test.files().count("c.h5") == 0);
}

TEST_CASE("oscillate knows which of two bodies is the softer one", "[oscillate]") {
  const ProgramTest test;
  const auto dundurs = [&](const std::string& bodies) {
    const auto answer = test.answer(
        "oscillate --shape paraboloid --points 16 --steps 4 --levels 4 --max-periods 2 --coupled "
        "--quiet " +
        bodies);
    return number(answer, "/coupling/dundurs");
  };
  const double softer = dundurs("--young 1GPa,10GPa --poisson 0.3,0.2");
  // β = ½[(1 − 2ν_1)/G_1 − (1 − 2ν_2)/G_2]/[(1 − ν_1)/G_1 + (1 − ν_2)/G_2], G_1 = 1/2.6, G_2 =
  // 10/2.4.
  CHECK(softer == Approx(0.5 * (0.4 * 2.6 - 0.6 * 0.24) / (0.7 * 2.6 + 0.8 * 0.24)));
  CHECK(dundurs("--young 10GPa,1GPa --poisson 0.2,0.3") == Approx(-softer));
}

TEST_CASE("A killed cycle resumes to the same numbers", "[oscillate]") {
  const ProgramTest test;
  const std::string without_phase =
      "oscillate --shape elliptic-paraboloid --points 32 --steps 32 --contact-modulus 1GPa "
      "--poisson 0.3 --direction 30deg --phase ";
  const std::string command = without_phase + "45deg";
  const auto whole = test.answer(command);
  const std::string with_checkpoint = command + " --checkpoint c.h5 --checkpoint-every 0";
  // Killed outright when its first checkpoint appears; where the cycle ended before, nothing was
  // killed and nothing is left.
  const auto killed =
      test.run(with_checkpoint,
               "(while [ ! -e c.h5 ] && [ -e /proc/$$ ]; do sleep 0.02; done; kill -KILL $$) &");
  if (salebra::testing::skipped(killed.status == 0, "the cycle ended before it was killed")) return;
  REQUIRE(test.files().count("c.h5") == 1);
  check_refused(test.run(with_checkpoint), "c.h5");
  check_refused(test.run(without_phase + "40deg --checkpoint c.h5 --resume"), "phase was 0.785");
  const auto resumed = test.answer(with_checkpoint + " --resume");
  for (const char* key :
       {"work_per_cycle", "dissipated", "work", "time", "fft_count", "contact_area_max"})
    CHECK(resumed[key] == whole[key]);
  CHECK(test.files().count("c.h5") == 0);
  check_refused(test.run(with_checkpoint + " --resume"), "--resume");
}

TEST_CASE("oscillate chooses levels and cells for a requested error", "[oscillate]") {
  const ProgramTest test;
  const auto answer = test.answer(
      "oscillate --shape paraboloid --points 32 --contact-modulus 1GPa --poisson 0.3 "
      "--relative-error 2% --method levels");
  CHECK(answer["error_reached"] == true);
  CHECK(answer["error_contains"] == nlohmann::json{"levels", "cells"});
  CHECK(number(answer, "/error_estimate") <= 0.02 * number(answer, "/work_per_cycle"));
  CHECK(answer["nx"].get<int>() > 32);
  CHECK(answer["trials"].size() >= 3);
  CHECK(answer["trials"].back()["levels"] == answer["levels"]);
  // The trials of 2 % leave 0.5 %: less has to be asked for by name.
  const auto strict = test.answer(
      "oscillate --shape paraboloid --points 32 --contact-modulus 1GPa --poisson 0.3 "
      "--relative-error 0.4% --method levels");
  CHECK(strict["error_reached"] == true);
  CHECK(number(strict, "/error_estimate") <= 0.004 * number(strict, "/work_per_cycle"));
  // A round contact.
  CHECK(answer["ratio_finite"] == Approx(1).epsilon(0.02));
}

TEST_CASE("oscillate writes fields for ParaView at the steps asked for", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape cone --points 24 --steps 8 --levels 4 --contact-modulus 1GPa --poisson "
      "0.3 --quiet --fields ";
  test.done(command + "f --field-steps 2,6");
  CHECK(test.files() == "f.xdmf f-mesh.h5 f-0002.h5 f-0006.h5");
  check_refused(test.run(command + "f --field-steps 2"), "f.xdmf");
}

TEST_CASE("Several shapes stand side by side, as in the paper's Fig. 3", "[oscillate]") {
  const ProgramTest test;
  const auto answer = test.answer(
      "oscillate --shape cylinder,paraboloid,pyramids,sinusoids --points 48 --steps 16 "
      "--contact-modulus 1GPa --poisson 0.3 -o f.h5");
  CHECK(keys(answer) == "cylinder paraboloid pyramids sinusoids");
  CHECK(std::abs(number(answer, "/cylinder/work_over_elastic_energy")) < 1e-9);
  CHECK(answer["cylinder"]["ratio"].is_null());
  CHECK(answer["paraboloid"]["ratio_finite"] == Approx(1).epsilon(0.02));
  for (const auto& [shape, object] : answer.items()) CHECK(object["premises"].size() == 7);
  CHECK(test.files().count("f.h5") == 1);
  // One of them by itself gives the same, and its group of the file.
  const auto alone = test.answer(
      "oscillate --shape paraboloid --points 48 --steps 16 --contact-modulus 1GPa --poisson 0.3");
  CHECK(answer["paraboloid"] == alone);
  const salebra::ResultReader file(test.folder() / "f.h5");
  CHECK(file.numbers("paraboloid/cycle/work") == alone["work"].get<std::vector<double>>());
  CHECK(file.has("sinusoids/levels/force"));
}

TEST_CASE("A force that bends the wrong way has no small-amplitude loss", "[oscillate]") {
  const ProgramTest test;
  // A few cells carry the load: within the sweep one gives way, and the smooth force falls below
  // its chord.
  const auto answer =
      test.answer("oscillate --surface " SALEBRA_DATA
                  "/surfaces/afm-scan.txt --size-x 10um --pressure 36.66MPa --boundary periodic "
                  "--contact-modulus 115GPa --poisson 0.3 --mode drag --normal-amplitude 1nm "
                  "--drag-velocity 100nm/s --frequency 20kHz --method levels");
  for (const char* key : {"force_curvature", "small_amplitude_work", "ratio"})
    CHECK(answer[key].is_null());
  CHECK(answer["work_per_cycle"].is_number());
}
