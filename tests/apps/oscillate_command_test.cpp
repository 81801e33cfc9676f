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

TEST_CASE("A killed cycle with friction resumes to the same numbers and lists all its fields",
          "[oscillate]") {
  const ProgramTest test;
  const std::string without_friction =
      "oscillate --shape cone --points 40 --steps 16 --intervals 4 --contact-modulus 1GPa "
      "--poisson "
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
                "friction_coefficient is 0.4");
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

TEST_CASE("A killed coupled cycle resumes to the same numbers", "[oscillate]") {
  const ProgramTest test;
  const std::string command =
      "oscillate --shape paraboloid --points 20 --steps 8 --intervals 4 --max-periods 2 "
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
  check_refused(test.run(without_phase + "40deg --checkpoint c.h5 --resume"), "phase is 0.785");
  const auto resumed = test.answer(with_checkpoint + " --resume");
  for (const char* key :
       {"work_per_cycle", "dissipated", "work", "time", "fft_count", "contact_area_max"})
    CHECK(resumed[key] == whole[key]);
  CHECK(test.files().count("c.h5") == 0);
  check_refused(test.run(with_checkpoint + " --resume"), "--resume");
}
