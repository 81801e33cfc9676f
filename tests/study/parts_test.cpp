// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <sstream>
#include <thread>

#include "../../src/study/study_lock.hpp"
#include "skipped.hpp"
#include "small_study.hpp"

using namespace salebra;
using Catch::Contains;
using Catch::StartsWith;
namespace fs = std::filesystem;

namespace {

/// A free folder name, which is free again afterwards.
struct Scratch {
  fs::path folder =
      fs::temp_directory_path() / ("salebra-parts-" + std::to_string(getpid()) + ".parts");
  Scratch() { fs::remove_all(folder); }
  ~Scratch() { fs::remove_all(folder); }
};

Realisation some_realisation() {
  Realisation realisation;
  realisation.seed = 7;
  realisation.grid = {4, 6, 1, 1.5};
  realisation.models.resize(2);
  realisation.models[1].model = ContactModel::gw_moments;
  realisation.models[0].curve.model = "bem";
  realisation.models[0].curve.samples = {{.force = 1. / 3, .converged = false}, {.mean_gap = -0.0}};
  realisation.spots.resize(2);
  realisation.spots[1].spots_by_size = {1, 2, 3};
  realisation.models[1].damping.push_back({.pressure = 5e-324});
  realisation.picture.stride = 2;
  realisation.picture.heights = {1.5f, -0.0f};
  realisation.picture.first_load = {-1, 300};
  realisation.picture.law = "asked for";
  return realisation;
}

fs::path only_part(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".realisation") return entry.path();
  return {};
}

}  // namespace

TEST_CASE("A realisation comes back from the disk with every bit", "[parts]") {
  const Scratch scratch;
  {
    StudyParts parts(scratch.folder, false);
    parts.write(42, some_realisation());
    CHECK(parts.holds(42));
    CHECK_FALSE(parts.read(43));
  }
  StudyParts parts(scratch.folder, true);
  CHECK(parts.count() == 1);
  const auto found = parts.read(42);
  REQUIRE(found);
  CHECK(found->seed == 7);
  CHECK(found->grid == Grid2D{4, 6, 1, 1.5});
  CHECK(found->of(ContactModel::bem).curve.model == "bem");
  REQUIRE(found->of(ContactModel::bem).curve.samples.size() == 2);
  CHECK(found->of(ContactModel::bem).curve.samples[0].force == 1. / 3);
  CHECK_FALSE(found->of(ContactModel::bem).curve.samples[0].converged);
  CHECK(std::signbit(found->of(ContactModel::bem).curve.samples[1].mean_gap));
  CHECK(std::isnan(found->of(ContactModel::bem).curve.samples[1].force));
  CHECK(found->spots[1].spots_by_size == std::vector<double>{1, 2, 3});
  CHECK(found->of(ContactModel::gw_moments).damping[0].pressure == 5e-324);
  CHECK(found->picture.stride == 2);
  CHECK(found->picture.heights == std::vector<float>{1.5f, 0.0f});
  CHECK(found->picture.first_load == std::vector<std::int16_t>{-1, 300});
  CHECK(found->picture.law == "asked for");
  parts.discard();
  CHECK(parts.count() == 0);
}

TEST_CASE("A damaged part is found out wherever a bit of it has changed", "[parts]") {
  const Scratch scratch;
  StudyParts parts(scratch.folder, false);
  parts.write(42, some_realisation());
  const fs::path file = only_part(scratch.folder);
  const auto size = fs::file_size(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(stream)), {});
  int lost = 0;
  const auto put = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    CHECK_FALSE(parts.read(42));
    CHECK_FALSE(fs::exists(file));
    CHECK(parts.damaged() == ++lost);
  };
  for (std::size_t place = 0; place < size; place += 37) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 1);
    put(bad);
  }
  put(good.substr(0, size - 1));
  put(good + "x");
  put("");
  std::ofstream(file, std::ios::binary) << good;
  CHECK(parts.read(42));
  // A valid file under another key is another realisation.
  fs::rename(file, scratch.folder / "000000000000002b.realisation");
  CHECK_FALSE(parts.read(43));
}

TEST_CASE("The key of a realisation changes with what decides it, and with nothing else",
          "[parts]") {
  const StudyConfiguration study = small_study();
  const auto key = StudyParts::key(study, 1);
  CHECK(StudyParts::key(study, 2) != key);
  using Change = void (*)(StudyConfiguration&);
  static const auto of = [](StudyConfiguration& c) -> GeneratedSurfaces& {
    return std::get<GeneratedSurfaces>(c.surfaces);
  };
  const std::pair<const char*, Change> changes[] = {
      {"hurst", [](StudyConfiguration& c) { of(c).spectrum.hurst = 0.7; }},
      {"long_cutoff", [](StudyConfiguration& c) { of(c).spectrum.long_cutoff = 2e-6; }},
      {"rolloff", [](StudyConfiguration& c) { of(c).spectrum.rolloff = 2e-6; }},
      {"short_cutoff", [](StudyConfiguration& c) { of(c).spectrum.short_cutoff = 0.6e-6; }},
      {"rms_height", [](StudyConfiguration& c) { of(c).spectrum.rms_height = 2e-8; }},
      {"points", [](StudyConfiguration& c) { of(c).grid.nx = of(c).grid.ny = 128; }},
      {"size", [](StudyConfiguration& c) { of(c).grid.lx = of(c).grid.ly = 8e-6; }},
      {"method", [](StudyConfiguration& c) { of(c).method = GenerationMethod::random_phase; }},
      {"material", [](StudyConfiguration& c) { c.material.contact_modulus *= 2; }},
      {"G*", [](StudyConfiguration& c) { c.material.tangential_modulus *= 2; }},
      {"pressures", [](StudyConfiguration& c) { c.pressures.back() *= 2; }},
      {"relative", [](StudyConfiguration& c) { c.relative_pressures = false; }},
      {"tolerance", [](StudyConfiguration& c) { c.tolerance = 1e-9; }},
      {"hardness", [](StudyConfiguration& c) { c.known.hardness = 1e9; }},
      {"stick", [](StudyConfiguration& c) { c.stick = false; }},
      {"window", [](StudyConfiguration& c) { c.window = PressureWindow{1e6, 1e8, 0}; }},
      {"models", [](StudyConfiguration& c) { c.models = c.compared_models; }},
      {"velocity", [](StudyConfiguration& c) { std::get<Drag>(c.motion).drag_velocity *= 2; }},
      {"frequency", [](StudyConfiguration& c) { std::get<Drag>(c.motion).angular_frequency *= 2; }},
      {"normal_amplitude",
       [](StudyConfiguration& c) { std::get<Drag>(c.motion).normal_amplitude *= 2; }},
      {"amplitude", [](StudyConfiguration& c) { c.damping.amplitude = Amplitude::small; }},
      {"motion", [](StudyConfiguration& c) { c.motion = EqualFrequency{1e-10, 1e-9, 1, 1e5}; }},
      {"hold", [](StudyConfiguration& c) { c.damping.hold = Hold::force; }},
  };
  for (const auto& [name, change] : changes) {
    INFO(name);
    StudyConfiguration other = study;
    change(other);
    CHECK(StudyParts::key(other, 1) != key);
  }
  StudyConfiguration other = study;
  other.text += "# a comment";
  other.target_precision = 0.01;
  std::get<GeneratedSurfaces>(other.surfaces).seeds.push_back(9);
  CHECK(StudyParts::key(other, 1) == key);
}

TEST_CASE("The key of a measured surface changes with all that is read of it", "[parts]") {
  const Scratch scratch;
  fs::create_directory(scratch.folder);
  const fs::path scan = scratch.folder / "scan.npy";
  const auto write = [](const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  };
  write(scan, "heights");
  StudyConfiguration study = small_study();
  const MeasuredSurface plain{.file = scan};
  const auto key_of = [&](const MeasuredSurface& surface) {
    study.surfaces = surface;
    return StudyParts::key(study, 0);
  };
  const auto key = key_of(plain);
  MeasuredSurface other = plain;
  other.size_x = 1e-6;
  CHECK(key_of(other) != key);
  other = plain;
  other.size_y = 1e-6;
  CHECK(key_of(other) != key);
  other = plain;
  other.height_unit = "nm";
  CHECK(key_of(other) != key);
  other = plain;
  other.channel = "2";
  CHECK(key_of(other) != key);
  other = plain;
  other.detrend = Detrend::quadratic;
  CHECK(key_of(other) != key);
  // The same surface under another file name has the same key.
  other = plain;
  other.file = scratch.folder / "copy.npy";
  fs::copy_file(scan, other.file);
  CHECK(key_of(other) == key);
  // The sidecar gives the size and unit of an array.
  write(scratch.folder / "scan.npy.json", "{\"size_x\": 1e-6}");
  const auto with_sidecar = key_of(plain);
  CHECK(with_sidecar != key);
  write(scratch.folder / "scan.npy.json", "{\"size_x\": 2e-6}");
  CHECK(key_of(plain) != with_sidecar);
  write(scan, "other heights");
  CHECK(key_of(other) == key);
  CHECK(key_of(plain) != with_sidecar);
}

TEST_CASE("Surfaces that another kind of processor computed are refused, and kept", "[parts]") {
  const Scratch scratch;
  StudyConfiguration study = small_study();
  study.stick = false;
  std::get<GeneratedSurfaces>(study.surfaces).seeds = {1, 2};
  StudyParts parts(scratch.folder, false);
  const std::vector<double> pressures = study_loads(study).pressures;
  const std::string here = arithmetic();
  // The baseline computes as the oldest processor does; other architectures have nothing but a
  // baseline.
  setenv("SALEBRA_VECTOR_WIDTH", "baseline", 1);
  const std::string baseline = arithmetic();
  parts.write(StudyParts::key(study, 2),
              analyse_realisation(study_surface(study, 2), study, 2, pressures));
  unsetenv("SALEBRA_VECTOR_WIDTH");
  const auto resume = [&] {
    return run_ensembles(study, {.on_progress = {}, .on_realisation = {}, .parts = &parts});
  };
  if (testing::skipped(here == baseline, "this processor computes as the oldest does")) return;
  CHECK_THROWS_WITH(resume(),
                    StartsWith(scratch.folder.string() + ": its surfaces were computed with ") &&
                        Contains("vectors baseline") && Contains(here));
  CHECK(parts.count() == 1);
  CHECK(parts.damaged() == 0);
  // A study resumes with the arithmetic with which it began.
  setenv("SALEBRA_VECTOR_WIDTH", "baseline", 1);
  CHECK(resume().front().realisations.size() == 2);
  CHECK(parts.count() == 2);
  setenv("SALEBRA_VECTOR_WIDTH", "widest", 1);
  CHECK_THROWS_WITH(arithmetic(), StartsWith("SALEBRA_VECTOR_WIDTH: widest must be baseline"));
  unsetenv("SALEBRA_VECTOR_WIDTH");
}

TEST_CASE("Parts of a study are not begun anew by accident, nor shared by two", "[parts]") {
  const Scratch scratch;
  {
    StudyParts parts(scratch.folder, false);
    CHECK_THROWS_WITH(StudyParts(scratch.folder, true), Contains("in use by process"));
    parts.write(1, some_realisation());
  }
  CHECK_THROWS_WITH(StudyParts(scratch.folder, false), Contains("`resume`"));
  CHECK(StudyParts(scratch.folder, true).count() == 1);
  StudyParts(scratch.folder, true).discard();
  CHECK_FALSE(fs::exists(scratch.folder));
}

TEST_CASE("A pipe in place of the lock is refused, not waited for", "[parts]") {
  const Scratch scratch;
  fs::create_directory(scratch.folder);
  REQUIRE(mkfifo((scratch.folder / "lock").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(StudyParts(scratch.folder, true), Contains("lock: is not a regular file"));
}

TEST_CASE("The lock of a dead process is taken over at once", "[parts]") {
  const Scratch scratch;
  const pid_t child = fork();
  if (child == 0) {
    new StudyParts(scratch.folder, false);  // never unlocked, as if the process had been killed
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  REQUIRE(fs::exists(scratch.folder / "lock"));
  CHECK_NOTHROW(StudyParts(scratch.folder, false));
}

TEST_CASE("A stopped process keeps its lock for as long as it lives", "[parts]") {
  const Scratch scratch;
  fs::create_directory(scratch.folder);
  const fs::path file = scratch.folder / "lock";
  const pid_t child = fork();
  if (child == 0) {
    new detail::StudyLock(file);
    for (;;) pause();
  }
  while (!fs::exists(file) || fs::file_size(file) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGSTOP);
  waitpid(child, nullptr, WUNTRACED);
  CHECK_THROWS_WITH(detail::StudyLock(file), Contains("in use by process"));
  // A killed process loses the lock at once, although it stays in the process table until its
  // parent waits.
  kill(child, SIGKILL);
  siginfo_t dead = {};
  waitid(P_PID, id_t(child), &dead, WEXITED | WNOWAIT);
  CHECK_NOTHROW(detail::StudyLock(file));
  waitpid(child, nullptr, 0);
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("A lock that several share is gone with the last of them", "[parts]") {
  using enum detail::StudyLock::Kind;
  const Scratch scratch;
  fs::create_directory(scratch.folder);
  const fs::path file = scratch.folder / "lock";
  auto first = std::make_unique<detail::StudyLock>(file, shared);
  auto second = std::make_unique<detail::StudyLock>(file, shared);
  first.reset();
  CHECK_THROWS_WITH(detail::StudyLock(file), Contains("in use by shards"));
  second.reset();
  CHECK_FALSE(fs::exists(file));
  // A file that any process left is nobody's lock, whatever its date is.
  std::ofstream(file) << "elsewhere boot space\n1\n2\nword\n";
  fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(24));
  const detail::StudyLock taken(file);
  CHECK_FALSE(detail::StudyLock::take(file));
  CHECK_THROWS_WITH(detail::StudyLock(file, shared), Contains("in use by process"));
}

TEST_CASE("A study goes on with its parts and ends with the same bits", "[parts]") {
  const Scratch scratch;
  StudyConfiguration study = small_study();
  study.stick = false;
  const StudyResult whole = run_study(study);
  {
    StudyParts parts(scratch.folder, false);
    const auto cut = run_ensembles(
        study, {.on_progress = [](const ProgressReport& report) { return report.step < 1; },
                .on_realisation = {},
                .parts = &parts});
    REQUIRE(parts.count() >= 1);
    CHECK((cut.empty() || cut.front().interrupted || parts.count() == 3));
  }
  StudyParts parts(scratch.folder, true);
  const std::size_t before = parts.count();
  std::size_t restored = 0;
  const auto resumed = run_ensembles(
      study,
      {.on_progress = {},
       .on_realisation = [&](const RealisationReport& report) { restored += report.restored; },
       .parts = &parts});
  CHECK(restored == before);
  REQUIRE(resumed.front().realisations.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(resumed.front().realisations[i].of(ContactModel::bem).damping[5].work_per_cycle ==
          whole.realisations[i].of(ContactModel::bem).damping[5].work_per_cycle);
  // With other settings the study has other surfaces, and none of these is its own.
  study.tolerance = 1e-9;
  CHECK_THROWS_WITH(
      run_ensembles(study, {.on_progress = {}, .on_realisation = {}, .parts = &parts}),
      Contains("none of its 3 surfaces"));
}
