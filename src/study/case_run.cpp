// SPDX-License-Identifier: GPL-3.0-or-later
// Run of one point of the parameter grid: computes realisations in parallel until all seeds are
// done or the requested precision is met.
#include "case_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/study/parts.hpp>
#include <string>

#include "base/stage_time.hpp"
#include "base/task_pool.hpp"
#include "realisation_record.hpp"

namespace salebra::detail {
namespace {

using Clock = std::chrono::steady_clock;

class CaseRun {
 public:
  CaseRun(StudyResult& result, const StudyRun& run, const RealisationReport& start)
      : result_(result),
        run_(run),
        report_(start),
        seeds_(seeds_of(result.configuration)),
        fractions_(seeds_.size()),
        precision_(result.configuration) {
    // Reserves the list, because growing it would need up to three times its memory for a moment.
    if (result.configuration.target_precision <= 0) found_.reserve(seeds_.size());
  }

  void run() {
    restore();
    if (run_.missing) {
      talk();
      note_missing();
    } else if (run_.groups.all().alone()) {
      loop_.run(Index(seeds_.size()), [this](Index i) { compute(std::size_t(i)); });
    } else {
      talk();
      compute_together();
    }
    collectively(run_.groups.all(), [this] {
      if (failure_) std::rethrow_exception(failure_);
    });
    // Drops realisations after a seed without a result, and those beyond the number that is enough
    // for the precision.
    const std::size_t used = std::min(found_.size(), limit_.load());
    found_.erase(found_.begin() + std::ptrdiff_t(used), found_.end());
    result_.precision_reached = limit_ < seeds_.size();
    result_.interrupted = used < std::min(limit_.load(), seeds_.size());
  }

 private:
  void restore() {
    const Communicator& all = run_.groups.all();
    bool present = false;
    collectively(all, [&] { present = run_.parts && run_.parts->count() > 0; });
    if (all.all_agree(!present)) return;
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      std::optional<Realisation> found;
      collectively(all, [&] {
        if (run_.parts) found = run_.parts->read(StudyParts::key(result_.configuration, seeds_[i]));
      });
      for (Found& one : shared({i, std::move(found)})) {
        note(i, std::move(*one.realisation), 0, true);
      }
    }
  }

  struct Found {
    std::size_t location = 0;
    std::optional<Realisation> realisation = {};
  };

  /// Collects the realisations that the processes have found. Returns the list in each process,
  /// without the processes that found nothing.
  std::vector<Found> shared(Found mine) const {
    const Communicator& all = run_.groups.all();
    std::vector<Found> found;
    if (all.alone()) {
      if (mine.realisation) found.push_back(std::move(mine));
      return found;
    }
    std::vector<std::size_t> locations(std::size_t(all.size()));
    all.gather_all(&mine.location, std::vector(locations.size(), sizeof mine.location),
                   locations.data());
    const std::vector<std::string> records =
        all.gather_all(mine.realisation ? encode({{}, *mine.realisation}, 0) : "");
    for (std::size_t rank = 0; rank < records.size(); ++rank)
      if (!records[rank].empty())
        found.push_back({locations[rank], decode(records[rank], 0).realisation});
    return found;
  }

  /// Each group of processes computes one surface at a time, and waits for the other groups. The
  /// first process chooses the surfaces for all, because other processors might differ in the last
  /// digit of the precision, and so in the choice.
  void compute_together() {
    const Groups& groups = run_.groups;
    const Communicator& all = groups.all();
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> turn(std::size_t(groups.count()));
    for (;;) {
      const auto start = Clock::now();
      std::size_t next = 0;
      for (std::size_t& location : turn) {
        while (next < seeds_.size() && is_there(next)) ++next;
        location = next < seeds_.size() && !stop_ && is_wanted(next) ? next++ : none;
      }
      all.broadcast(turn.data(), turn.size() * sizeof(std::size_t));
      if (turn.front() == none) break;
      std::erase(turn, none);
      Found mine;
      if (const auto group = std::size_t(groups.index()); group < turn.size())
        mine = {turn[group], analysed(turn[group], turn)};
      std::vector<Found> found = shared(std::move(mine));
      stop_ = !all.all_agree(!stop_);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      for (auto& [i, realisation] : found) {
        collectively(all, [&, i = i, &made = *realisation] {
          if (run_.parts)
            run_.parts->write(StudyParts::key(result_.configuration, seeds_[i]), made);
        });
        note(i, std::move(*realisation), seconds, false);
      }
      talk();
      turn.resize(std::size_t(groups.count()));
    }
    std::size_t limit = limit_;
    all.broadcast(&limit, sizeof limit);
    limit_ = limit;
  }

  /// Computes realisation i. Returns it in the first process of a group, and nothing in the other
  /// processes of the group. Returns nothing at all if the whole group was stopped or failed. If
  /// only one process fails, its exception is thrown and ends the program.
  std::optional<Realisation> analysed(std::size_t i, const std::vector<std::size_t>& turn) {
    const Communicator& own = run_.groups.own();
    try {
      Realisation realisation = realise(
          result_.configuration, seeds_[i], result_.pressures,
          [&](const ProgressReport& report) {
            for (const std::size_t location : turn) fractions_[location] = report.fraction;
            talk();
            return !stop_;
          },
          own);
      if (own.is_root()) return realisation;
    } catch (const Interrupted&) {
      stop_ = true;
    } catch (const NotConverged&) {
      failure_ = std::current_exception();
      stop_ = true;
    }
    return {};
  }

  void note_missing() {
    for (std::size_t i = 0; i < std::min(limit_.load(), seeds_.size()); ++i)
      if (!is_there(i)) run_.missing->push_back(report_.finished + i);
  }

  bool is_wanted(std::size_t i) const { return i < limit_; }
  bool is_there(std::size_t i) const { return i < found_.size() || ahead_.contains(i); }

  void compute(std::size_t i) {
    if (!is_wanted(i) || restored(i)) return;
    const auto start = Clock::now();
    try {
      Realisation realisation = realise(result_.configuration, seeds_[i], result_.pressures,
                                        [&](const ProgressReport& sweep) {
                                          fractions_[i] = sweep.fraction;
                                          return loop_.going_on() && is_wanted(i);
                                        });
      if (run_.parts)
        run_.parts->write(StudyParts::key(result_.configuration, seeds_[i]), realisation);
      const std::scoped_lock lock(guard_);
      note(i, std::move(realisation), std::chrono::duration<double>(Clock::now() - start).count(),
           false);
    } catch (const Interrupted&) {
      // The run was stopped, or the realisation is no longer needed for the precision.
    }
  }

  bool restored(std::size_t i) {
    const std::scoped_lock lock(guard_);
    return is_there(i);
  }

  /// The caller must hold guard_, unless there are no threads yet.
  void note(std::size_t i, Realisation realisation, double seconds, bool restored) {
    fractions_[i] = 1;
    ahead_.emplace(i, std::move(realisation));
    while (!ahead_.empty() && ahead_.begin()->first == found_.size()) {
      found_.push_back(std::move(ahead_.extract(ahead_.begin()).mapped()));
      if (precision_.met_with(found_.back())) limit_ = std::min(limit_.load(), found_.size());
    }
    RealisationReport item = report_;
    item.finished += ++finished_;
    item.seed = seeds_[i];
    item.seconds = seconds;
    item.restored = restored;
    news_.push_back(item);
  }

  /// Reports progress. With several processes an exception is kept in failure_ until all processes
  /// end together.
  void talk() {
    try {
      if (!report()) stop_ = true;
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  }

  bool report() {
    std::vector<RealisationReport> news;
    {
      const std::scoped_lock lock(guard_);
      news.swap(news_);
    }
    if (run_.on_realisation)
      for (const RealisationReport& item : news) run_.on_realisation(item);
    if (!run_.on_progress || stop_) return true;
    double sum = 0;
    for (const std::atomic<double>& fraction : fractions_) sum += fraction;
    const double wanted = double(report_.wanted);
    const std::size_t finished = report_.finished + finished_;
    const std::string stage = fmt::format("study {}/{}", finished, report_.wanted);
    return run_.on_progress({.stage = stage,
                             .fraction = (double(report_.finished) + sum) / wanted,
                             .step = int(finished)});
  }

  StudyResult& result_;
  const StudyRun& run_;
  const RealisationReport report_;  ///< what the whole run had finished when this point began
  const std::vector<std::uint64_t> seeds_;
  /// Realisations of the first seeds, without gaps.
  std::vector<Realisation>& found_ = result_.realisations;
  std::map<std::size_t, Realisation> ahead_;  ///< realisations that wait for one of an earlier seed
  std::vector<std::atomic<double>> fractions_;
  std::vector<RealisationReport> news_;
  std::atomic<std::size_t> finished_ = 0;
  PrecisionRule precision_;
  std::atomic<std::size_t> limit_ = std::numeric_limits<std::size_t>::max();
  std::mutex guard_;
  TaskLoop loop_{{.at_once = 0, .communicator = {}, .talk = [this] { return report(); }}};
  bool stop_ = false;  // stop_ and failure_ are only used with several processes
  std::exception_ptr failure_;
};

}  // namespace

std::vector<std::uint64_t> seeds_of(const StudyConfiguration& configuration) {
  const auto* generated = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  return generated ? generated->seeds : std::vector<std::uint64_t>{0};
}

std::vector<std::uint64_t> keys_of(const std::vector<StudyConfiguration>& points) {
  std::vector<std::uint64_t> keys;
  for (const StudyConfiguration& point : points)
    for (const std::uint64_t seed : seeds_of(point)) keys.push_back(StudyParts::key(point, seed));
  return keys;
}

void require_some_of(StudyParts& parts, const std::vector<StudyConfiguration>& points) {
  for (const std::uint64_t key : keys_of(points))
    if (parts.holds(key)) {
      parts.read(key);
      return;
    }
  throw InvalidInput(
      parts.folder().string(),
      fmt::format("none of its {} surfaces belongs to this study, because the settings or the "
                  "program have changed; restore them or remove the folder",
                  parts.count()));
}

Realisation realise(const StudyConfiguration& configuration, std::uint64_t seed,
                    const std::vector<double>& pressures, const Progress& progress,
                    const Communicator& communicator) {
  const Progress begun = [&](const ProgressReport&) {
    return !progress || progress({.stage = "realisation"});
  };
  const StageTime time(Stage::surfaces);
  return analyse_realisation(study_surface(configuration, seed, begun, communicator), configuration,
                             seed, pressures, progress);
}

bool PrecisionRule::met_with(const Realisation& realisation) {
  if (configuration_.target_precision <= 0) return false;
  const ModelResult& bem = realisation.of(ContactModel::bem);
  lengths_.push_back(bem.fit.decay_length / realisation.heights.rms_height);
  slopes_.push_back(bem.area_slope);
  const std::size_t count = lengths_.size();
  if (count < std::size_t(configuration_.min_realisations) || !is_milestone(count)) return false;
  const auto precise = [&](const std::vector<double>& values) {
    const EnsembleMean estimate = bootstrap_.mean(values);
    // If no load lies in the range of the area law, κ is unknown for any number of surfaces.
    return std::isnan(estimate.mean) ||
           estimate.relative_precision() <= configuration_.target_precision;
  };
  return precise(lengths_) && precise(slopes_);
}

void run_case(StudyResult& result, const StudyRun& run, const RealisationReport& start) {
  CaseRun(result, run, start).run();
}

}  // namespace salebra::detail
