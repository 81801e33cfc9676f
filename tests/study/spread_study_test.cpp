// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <new>
#include <salebra/base/error.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <utility>
#include <vector>

#include "../../src/study/realisation_record.hpp"
#include "ranks_in_threads.hpp"
#include "study_text.hpp"

// A study on several processes: every number has the bits of one process, so no tolerance is
// needed.

using namespace salebra;
using Catch::Contains;
using salebra::testing::run_ranks;
namespace fs = std::filesystem;

namespace {

StudyConfiguration study_of(const std::string& seeds) {
  return parse_study_configuration(study_text(seeds, 5), "small.toml");
}

/// Every bit of the realisations, the warnings and pressures, and how the run ended.
std::string bits_of(const std::vector<StudyResult>& results) {
  std::string bits;
  for (const StudyResult& result : results) {
    for (const Realisation& realisation : result.realisations)
      bits += detail::encode({{}, realisation}, 0);
    for (const std::string& warning : result.warnings) bits += warning;
    for (const double pressure : result.pressures) bits += std::to_string(pressure);
    bits += result.interrupted ? "interrupted" : result.precision_reached ? "precise" : "all";
  }
  return bits;
}

/// Checks that every process, in so many groups, gets the result.
void compare(const StudyConfiguration& study, const std::string& alone, int ranks, int groups) {
  INFO(ranks << " processes in " << groups << " groups");
  std::atomic<int> same = 0;
  run_ranks(ranks, [&](const Communicator& all) {
    same += bits_of(run_ensembles(study, {.groups = Groups(all, groups)})) == alone;
  });
  CHECK(same == ranks);
}

struct Scratch {
  fs::path folder =
      fs::temp_directory_path() / ("salebra-spread-study-" + std::to_string(getpid()));
  Scratch() {
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  ~Scratch() { fs::remove_all(folder); }
};

}  // namespace

TEST_CASE("A study over processes has the bits of one process", "[study][share]") {
  SECTION("of several surfaces, in groups too") {
    StudyConfiguration study = study_of("seeds = [4, 1, 3]");
    study.models = contact_models(
        {"gw_moments", "gw_deterministic", "gw_monte_carlo", "persson", "greenwood_tripp"});
    const std::string alone = bits_of(run_ensembles(study));
    for (const auto& [ranks, groups] : {std::pair(1, 1), {2, 1}, {5, 1}, {3, 2}})
      compare(study, alone, ranks, groups);
  }
  SECTION("of one surface, whose cells are halved") {
    const StudyConfiguration study = study_of("seeds = [2]");
    compare(study, bits_of(run_ensembles(study)), 3, 1);
  }
  SECTION("of odd numbers of points, whose cells are doubled") {
    StudyConfiguration study = study_of("seeds = [1]");
    std::get<GeneratedSurfaces>(study.surfaces).grid = {65, 65, 4e-6, 4e-6};
    compare(study, bits_of(run_ensembles(study)), 3, 1);
  }
  SECTION("with processes that have no rows") {
    StudyConfiguration study = study_of("seeds = [1]");
    // On this grid a contact without an initial guess begins on a coarser grid.
    auto& surfaces = std::get<GeneratedSurfaces>(study.surfaces);
    surfaces.grid = {128, 128, 4e-6, 4e-6};
    study.pressures = {3e-3, 0.01, 0.03, 0.1};
    compare(study, bits_of(run_ensembles(study)), 9, 1);
  }
  SECTION("of parameters that vary, on the curve between loads") {
    StudyConfiguration study = study_of("seeds = [1, 2]");
    study.ensemble.hurst = {0.7, 0.9};
    study.intervals = 0;
    compare(study, bits_of(run_ensembles(study)), 3, 2);
  }
  SECTION("until the mean is precise") {
    StudyConfiguration study = study_of("seed_count = 6");
    study.intervals = 0;
    study.stick = false;
    study.target_precision = 10;
    study.min_realisations = 4;
    const std::vector<StudyResult> alone = run_ensembles(study);
    REQUIRE(alone.front().precision_reached);
    REQUIRE(alone.front().realisations.size() == 4);
    compare(study, bits_of(alone), 3, 3);
  }
}

TEST_CASE("A study of a scan over processes has the bits of one process", "[study][share]") {
  const Scratch scratch;
  Surface scan = study_surface(study_of("seeds = [1]"), 1);
  scan.periodic = false;
  StudyConfiguration study = study_of("seeds = [1]");
  study.surfaces = MeasuredSurface{.file = scratch.folder / "scan.h5"};
  const fs::path file = std::get<MeasuredSurface>(study.surfaces).file;
  write_surface(file, scan, {});
  study.seam = SeamCheck::window;
  compare(study, bits_of(run_ensembles(study)), 3, 1);

  std::get<MeasuredSurface>(study.surfaces).detrend = Detrend::lines;
  run_ranks(2, [&](const Communicator& all) {
    try {
      run_ensembles(study, {.groups = Groups(all, 1)});
      throw Error("a scan was detrended line by line");
    } catch (const InvalidInput& error) {
      if (error.statement().find("is spread over 2 processes") == std::string::npos) throw;
    }
  });
}

TEST_CASE("What of a study needs surfaces whole is refused before any work", "[study][share]") {
  std::vector<std::pair<std::string, StudyConfiguration>> cases;
  for (const char* field : {"hardness", "relative_error", "models"})
    cases.emplace_back(field, study_of("seeds = [1, 2]"));
  cases[0].second.known.hardness = 1e12;
  cases[1].second.relative_error = 0.1;
  cases[2].second.models.push_back(ContactModel::gw_interacting);
  for (const auto& [field, study] : cases) {
    std::atomic<int> refused = 0;
    const auto run = [&, &field = field, &study = study](const Communicator& all, int groups) {
      try {
        run_ensembles(study, {.on_progress = [](const ProgressReport&) -> bool {
                                throw Interrupted("was not refused");
                              },
                              .groups = Groups(all, groups)});
      } catch (const InvalidInput& error) {
        refused += error.field() == field;
      } catch (const Interrupted&) {
      }
    };
    run_ranks(3, [&](const Communicator& all) { run(all, 2); });
    CHECK(refused == 3);
    // A group of a single process holds its surfaces whole.
    run_ranks(2, [&](const Communicator& all) { run(all, 2); });
    CHECK(refused == 3);
  }
}

TEST_CASE("A study over processes that is stopped continues with any number of them",
          "[study][share][parts]") {
  const Scratch scratch;
  const fs::path folder = scratch.folder / "run.h5.parts";
  const StudyConfiguration study = study_of("seeds = [1, 2, 3, 4]");
  const std::string whole = bits_of(run_ensembles(study));
  // Only the first process keeps files. The last process asks to stop within the sweep after two
  // surfaces, while another group finishes its third.
  const auto run = [&](int ranks, int groups, bool resume, bool stop) {
    std::atomic<int> interrupted = 0, same = 0, computed = 0;
    run_ranks(ranks, [&](const Communicator& all) {
      std::unique_ptr<StudyParts> parts;
      if (all.is_root()) parts = std::make_unique<StudyParts>(folder, resume);
      const std::vector<StudyResult> results = run_ensembles(
          study, {.on_progress =
                      [&](const ProgressReport& report) {
                        return !stop || report.fraction < 0.6 || all.rank() + 1 < all.size();
                      },
                  .on_realisation =
                      [&](const RealisationReport& report) {
                        computed += all.is_root() && !report.restored;
                      },
                  .parts = parts.get(),
                  .groups = Groups(all, groups)});
      interrupted += results.front().interrupted;
      same += bits_of(results) == whole;
      if (parts && !stop) parts->discard();
    });
    CHECK(interrupted == (stop ? ranks : 0));
    CHECK(same == (stop ? 0 : ranks));
    return computed.load();
  };
  SECTION("one of several groups") {
    CHECK(run(3, 2, false, true) == 3);
    CHECK(run(2, 1, true, false) == 1);
  }
  SECTION("one of several processes that share a surface") {
    CHECK(run(3, 1, false, true) == 2);
    CHECK(run(2, 2, true, false) == 2);
  }
}

namespace {

/// A process that fails by itself at its call number `last`, as for lack of memory, and must not
/// call the others after that.
class Failing : public detail::Transport {
 public:
  Failing(const Communicator& all, std::shared_ptr<std::atomic<int>> left, std::atomic<int>& late)
      : all_(all), left_(std::move(left)), late_(late) {}
  int rank() const override { return all_.rank(); }
  int size() const override { return all_.size(); }
  void broadcast(void* bytes, std::size_t count, int from) override {
    called();
    all_.broadcast(bytes, count, from);
  }
  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) override {
    called();
    all_.gather_all(mine, bytes, all);
  }
  void exchange(std::size_t unit, const void* from, const Parts& sent, void* to,
                const Parts& received) override {
    called();
    all_.exchange({unit,
                   {sent.counts.begin(), sent.counts.end()},
                   {received.counts.begin(), received.counts.end()}},
                  from, to);
  }
  std::shared_ptr<Transport> split(int group) override {
    return std::make_shared<Failing>(all_.split(group), left_, late_);
  }

 private:
  void called() {
    const int left = (*left_)--;
    if (left < 0) ++late_;
    if (left <= 0) throw std::bad_alloc();
  }
  Communicator all_;
  std::shared_ptr<std::atomic<int>> left_;
  std::atomic<int>& late_;
};

}  // namespace

TEST_CASE("A process that fails alone leaves a study at once", "[study][share]") {
  const StudyConfiguration study = study_of("seeds = [1, 2, 3]");
  for (const int groups : {1, 2})
    for (const int call : {0, 1, 5, 20, 100, 500, 2000}) {
      std::atomic<int> late = 0, failed = 0;
      INFO(groups << " groups, call " << call);
      try {
        run_ranks(3, [&](const Communicator& all) {
          const auto left = std::make_shared<std::atomic<int>>(all.rank() == 1 ? call : 1 << 30);
          const Communicator mine(std::make_shared<Failing>(all, left, late));
          try {
            run_ensembles(study, {.groups = Groups(mine, groups)});
          } catch (const std::bad_alloc&) {
            ++failed;
            throw;
          }
        });
      } catch (const std::exception&) {
        // The others wait for a process that has ended; the transport of the tests notices that,
        // and so does salebra-mpi.
      }
      CHECK(failed == 1);
      CHECK(late == 0);
    }
}

TEST_CASE("What fails in the first process of a study fails in all", "[study][share]") {
  const StudyConfiguration study = study_of("seeds = [1, 2]");
  const Scratch scratch;
  std::atomic<int> failed = 0, stopped = 0;
  SECTION("a part that cannot be written") {
    run_ranks(3, [&](const Communicator& all) {
      std::unique_ptr<StudyParts> parts;
      const fs::path folder = scratch.folder / "run.h5.parts";
      if (all.is_root()) {
        parts = std::make_unique<StudyParts>(folder, false);
      }
      try {
        run_ensembles(study, {.on_progress =
                                  [&](const ProgressReport& report) {
                                    if (all.is_root() && report.fraction > 0.1)
                                      fs::remove_all(folder);
                                    return true;
                                  },
                              .parts = parts.get(),
                              .groups = Groups(all, 2)});
      } catch (const Error& error) {
        failed += std::string(error.what()).find(".realisation") != std::string::npos;
      }
    });
    CHECK(failed == 3);
  }
  SECTION("a callback that throws") {
    run_ranks(3, [&](const Communicator& all) {
      try {
        run_ensembles(study, {.on_progress =
                                  [&](const ProgressReport& report) {
                                    if (all.is_root() && report.fraction > 0.1)
                                      throw Error("the terminal is gone");
                                    return true;
                                  },
                              .groups = Groups(all, 2)});
      } catch (const Error& error) {
        stopped += error.what() == std::string("the terminal is gone");
      }
    });
    CHECK(stopped == 3);
  }
  SECTION("a surface whose contacts do not converge") {
    StudyConfiguration few = study;
    few.pressures = {0.01, 0.05, 0.1};  // a study needs four
    run_ranks(3, [&](const Communicator& all) {
      try {
        run_ensembles(few, {.groups = Groups(all, 2)});
      } catch (const NotConverged&) {
        ++failed;
      }
    });
    CHECK(failed == 3);
  }
}
