// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/version.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study_file.hpp>
#include <set>

#include "../../src/study/realisation_record.hpp"
#include "../../src/study/study_lock.hpp"
#include "small_study.hpp"
#include "study/cost.hpp"

using namespace salebra;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// A folder for a result and its parts.
struct Scratch {
  fs::path folder = fs::temp_directory_path() / ("salebra-shards-" + std::to_string(getpid()));
  fs::path parts = folder / "run.h5.parts";
  Scratch() {
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  ~Scratch() { fs::remove_all(folder); }
};

/// Two points of four surfaces.
StudyConfiguration two_points() {
  StudyConfiguration study =
      parse_study_configuration(study_text("seeds = [1, 2, 3, 4]", 5), "small.toml");
  study.stick = false;
  study.ensemble.hurst = {0.6, 0.8};
  return study;
}

/// One point of four surfaces.
StudyConfiguration one_point() {
  StudyConfiguration study = two_points();
  study.ensemble.hurst.clear();
  return study;
}

ShardOutcome compute(const Scratch& scratch, const StudyConfiguration& study,
                     const std::string& shard, const Progress& progress = {}) {
  const auto parts = StudyParts::of_shard(scratch.parts, parse_shard(shard));
  return run_shard(study, parse_shard(shard),
                   {.on_progress = progress, .on_realisation = {}, .parts = parts.get()});
}

struct Merged {
  std::vector<StudyResult> results;
  std::vector<std::size_t> missing;
  int damaged = 0;
};

Merged merge(const Scratch& scratch, const StudyConfiguration& study) {
  Merged merged;
  const auto parts = StudyParts::to_merge(scratch.parts);
  merged.results = run_ensembles(
      study,
      {.on_progress = {}, .on_realisation = {}, .parts = parts.get(), .missing = &merged.missing});
  merged.damaged = parts->damaged();
  return merged;
}

/// The bytes of a result file, with the same dates in all files.
std::string file_of(const Scratch& scratch, const std::vector<StudyResult>& results) {
  const fs::path file = scratch.folder / "result.h5";
  write_ensembles(file, results, {.created = "2026-01-01T00:00:00Z"}, {.overwrite = true});
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> realisations(const Scratch& scratch) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(scratch.parts))
    if (entry.path().extension() == ".realisation") files.push_back(entry.path());
  return files;
}

}  // namespace

TEST_CASE("A shard is named by K/N, from 1 or from 0 on, or any", "[shard]") {
  for (const std::size_t count : {1, 3, 8})
    for (std::size_t place = 0; place < 20; ++place) {
      std::size_t holders = 0;
      for (std::size_t number = 1; number <= count; ++number)
        holders += parse_shard(std::to_string(number) + "/" + std::to_string(count)).holds(place);
      CHECK(holders == 1);
      CHECK(parse_shard("any").holds(place));
    }
  CHECK(parse_shard("3/8").holds(2));
  for (std::size_t place = 0; place < 20; ++place)
    CHECK(parse_shard("0/8").holds(place) == parse_shard("8/8").holds(place));
  for (const std::string text : {"3/8", "any"}) CHECK(to_text(parse_shard(text)) == text);
  for (const std::string text : {"", "3", "3/", "/8", "9/8", "-1/8", "0/0", "3/8/9", "3 /8", "all",
                                 "1e9/8", "99999999999999999999/8"}) {
    INFO(text);
    CHECK_THROWS_WITH(parse_shard(text), Contains("shard: '" + text + "' must be K/N"));
  }
}

TEST_CASE("Shards in any order, some twice, merge to the bytes of one run", "[shard]") {
  const Scratch scratch;
  const StudyConfiguration study = two_points();
  const std::string whole = file_of(scratch, run_ensembles(study));
  CHECK(compute(scratch, study, "3/3").computed == 2);
  CHECK(compute(scratch, study, "1/3").computed == 3);
  const ShardOutcome again = compute(scratch, study, "0/3");
  CHECK(again.wanted == 2);
  CHECK(again.present == 2);
  CHECK(again.computed == 0);
  // Missing surfaces are named by their index: those of the second shard.
  CHECK(merge(scratch, study).missing == std::vector<std::size_t>{1, 4, 7});
  // A division into another number of shards skips existing surfaces.
  CHECK(compute(scratch, study, "2/4").computed == 1);
  CHECK(compute(scratch, study, "any").computed == 2);
  const Merged merged = merge(scratch, study);
  CHECK(merged.missing.empty());
  CHECK(file_of(scratch, merged.results) == whole);
}

TEST_CASE("A merge stops where one run would have stopped for its precision", "[shard]") {
  const Scratch scratch;
  StudyConfiguration study = one_point();
  std::get<GeneratedSurfaces>(study.surfaces).seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  study.target_precision = 0.9;
  study.min_realisations = 3;
  const auto whole = run_ensembles(study);
  const std::size_t enough = whole.front().realisations.size();
  REQUIRE(enough < 11);
  REQUIRE(whole.front().precision_reached);
  // One surface lies beyond the limit, and the others beyond it are not missing.
  compute(scratch, study, "12/12");
  for (std::size_t shard = 1; shard <= enough; ++shard)
    compute(scratch, study, std::to_string(shard) + "/12");
  CHECK(realisations(scratch).size() == enough + 1);
  Merged merged = merge(scratch, study);
  CHECK(merged.missing.empty());
  CHECK(file_of(scratch, merged.results) == file_of(scratch, whole));
  // Before each surface `any` checks whether the surfaces before it are enough; a single thread has
  // no surface in progress meanwhile.
  fs::remove_all(scratch.parts);
  parallel::set_threads(1);
  const ShardOutcome outcome = compute(scratch, study, "any");
  parallel::set_threads(0);
  CHECK(outcome.computed == enough);
  CHECK(outcome.wanted == enough);
  merged = merge(scratch, study);
  CHECK(merged.missing.empty());
  CHECK(file_of(scratch, merged.results) == file_of(scratch, whole));
}

TEST_CASE("A merge finds damaged parts, and those of other settings and versions", "[shard]") {
  const Scratch scratch;
  const StudyConfiguration study = one_point();
  compute(scratch, study, "any");
  fs::resize_file(scratch.parts / fs::path(realisations(scratch).front()).filename(), 500);
  StudyConfiguration other = study;
  other.tolerance = 1e-7;
  {
    const auto parts = StudyParts::of_shard(scratch.parts, {2, 3});
    const std::vector<double> pressures = study_loads(other).pressures;
    parts->write(StudyParts::key(other, 1),
                 analyse_realisation(study_surface(other, 1), other, 1, pressures));
    std::ofstream(scratch.parts / "000000000000002a.realisation", std::ios::binary)
        << detail::encode({{"0.0.9", "an abacus", "elsewhere", "1/2"}, Realisation()}, 42);
    std::ofstream(scratch.parts / "000000000000002b.realisation") << "of a form that nobody reads";
  }
  const Merged merged = merge(scratch, study);
  CHECK(merged.missing.size() == 1);
  CHECK(merged.damaged == 1);
  const auto parts = StudyParts::to_merge(scratch.parts);
  const auto keys = StudyParts::keys(study);
  std::multiset<std::string> versions, shards;
  for (const PartOrigin& origin : parts->others(keys)) {
    versions.insert(origin.version);
    shards.insert(origin.shard);
  }
  CHECK(versions == std::multiset<std::string>{"", "0.0.9", std::string(version())});
  CHECK(shards == std::multiset<std::string>{"", "1/2", "2/3"});
  // The parts are somebody's work: when the result is safe, only the study's own are removed.
  parts->discard(keys);
  CHECK(realisations(scratch).size() == 3);
}

TEST_CASE("Surfaces of several arithmetics are merged, and told", "[shard]") {
  const Scratch scratch;
  const StudyConfiguration study = one_point();
  compute(scratch, study, "1/2");
  setenv("SALEBRA_VECTOR_WIDTH", "baseline", 1);
  const std::string baseline = arithmetic();
  compute(scratch, study, "any");
  unsetenv("SALEBRA_VECTOR_WIDTH");
  const auto parts = StudyParts::to_merge(scratch.parts);
  std::vector<std::size_t> missing;
  const auto results = run_ensembles(
      study, {.on_progress = {}, .on_realisation = {}, .parts = parts.get(), .missing = &missing});
  CHECK(missing.empty());
  CHECK(results.front().realisations.size() == 4);
  REQUIRE(parts->origins().size() == 4);
  CHECK(parts->origins()[0].shard == "1/2");
  CHECK(parts->origins()[0].arithmetic == arithmetic());
  CHECK(parts->origins()[1].shard == "any");
  CHECK(parts->origins()[1].arithmetic == baseline);
  CHECK_FALSE(parts->origins()[1].host.empty());
}

TEST_CASE("A shard of other settings is refused before any work", "[shard]") {
  const Scratch scratch;
  StudyConfiguration study = one_point();
  compute(scratch, study, "1/4");
  study.tolerance = 1e-7;
  CHECK_THROWS_WITH(compute(scratch, study, "2/4"), Contains("none of its 1 surfaces"));
  CHECK_THROWS_WITH(compute(scratch, study, "any"), Contains("none of its 1 surfaces"));
  CHECK(realisations(scratch).size() == 1);
}

TEST_CASE("Shards share the folder with each other, and with nobody else", "[shard]") {
  const Scratch scratch;
  {
    const auto shard = StudyParts::of_shard(scratch.parts, {1, 3});
    const auto same = StudyParts::of_shard(scratch.parts, {1, 3});
    CHECK_THROWS_WITH(StudyParts::to_merge(scratch.parts), Contains("in use by shards"));
    CHECK_THROWS_WITH(StudyParts(scratch.parts, true), Contains("in use by shards"));
    // A file that another process is writing now, and one that a killed process left, stay.
    std::ofstream(scratch.parts / ".000000000000002a.realisation.1-0.part") << "half of it";
    const auto late = StudyParts::of_shard(scratch.parts, {2, 3});
    CHECK(fs::exists(scratch.parts / ".000000000000002a.realisation.1-0.part"));
  }
  // A shard does not remove an empty folder either, because another may be about to start in it.
  CHECK(fs::exists(scratch.parts));
  {
    const StudyParts alone(scratch.parts, true);
    CHECK_FALSE(fs::exists(scratch.parts / ".000000000000002a.realisation.1-0.part"));
    CHECK_THROWS_WITH(StudyParts::of_shard(scratch.parts, {1, 3}), Contains("in use by process"));
  }
  CHECK_FALSE(fs::exists(scratch.parts));
}

TEST_CASE("A claim holds while its process lives, and no longer", "[shard]") {
  const Scratch scratch;
  const StudyConfiguration study = one_point();
  fs::create_directory(scratch.parts);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.claim",
                static_cast<unsigned long long>(StudyParts::key(study, 2)));
  const fs::path claim = scratch.parts / name;
  {
    const detail::StudyLock held(claim);
    const ShardOutcome outcome = compute(scratch, study, "any");
    CHECK(outcome.computed == 3);
    CHECK(outcome.elsewhere == 1);
  }
  CHECK(merge(scratch, study).missing == std::vector<std::size_t>{1});
  // A claim file without a lock is left from a killed process.
  std::ofstream(claim) << "process 1 on elsewhere";
  CHECK(compute(scratch, study, "any").computed == 1);
  CHECK_FALSE(fs::exists(claim));
  std::ofstream(claim) << "process 1 on elsewhere";
  CHECK(merge(scratch, study).missing.empty());
  CHECK_FALSE(fs::exists(claim));
}

TEST_CASE("A stopped shard keeps what it has finished", "[shard]") {
  const Scratch scratch;
  const StudyConfiguration study = two_points();
  const ShardOutcome cut =
      compute(scratch, study, "1/1", [](const ProgressReport& report) { return report.step < 1; });
  CHECK(cut.interrupted);
  CHECK(realisations(scratch).size() == cut.computed);
  const ShardOutcome rest = compute(scratch, study, "1/1");
  CHECK(rest.present == cut.computed);
  CHECK(rest.present + rest.computed == 8);
}

TEST_CASE("The number of shards follows from the time that one may take", "[shard]") {
  StudyCost cost;
  cost.threads = 4;
  PointCost point;
  point.configuration = one_point();
  point.grid = {64, 64, 4e-6, 4e-6};
  point.pressures = {1e6};
  point.surfaces = 40;
  point.seconds = 4000;
  cost.points = {point};
  // 4000 s on 4 threads are 1000 s.
  CHECK(plan_shards(cost, 1000).shards == 1);
  const ShardPlan plan = plan_shards(cost, 250);
  CHECK(plan.shards == 4);
  CHECK(plan.surfaces == 10);
  CHECK(plan.seconds == Approx(250));
  // One contact on all threads takes 100/(1 + 0.75·3) s, and no number of shards is faster.
  const ShardPlan most = plan_shards(cost, 1);
  CHECK(most.shards == 40);
  CHECK(most.surfaces == 1);
  CHECK(most.seconds == Approx(100 / 3.25));
  CHECK(most.memory < plan.memory);
  CHECK_THROWS_WITH(plan_shards(cost, 0), Contains("shard_seconds"));
}
