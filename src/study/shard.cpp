// SPDX-License-Identifier: GPL-3.0-or-later
// Run of one shard of a study: the surfaces that it computes, its claims on them, and the text that
// names a shard.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <deque>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>

#include "base/memory.hpp"
#include "base/task_pool.hpp"
#include "case_run.hpp"
#include "cost.hpp"
#include "study_lock.hpp"

namespace salebra {
namespace {

using Clock = std::chrono::steady_clock;

struct Point {
  Point(const StudyConfiguration& point, std::vector<double> loads)
      : configuration(point), pressures(std::move(loads)), rule(configuration) {}

  const StudyConfiguration& configuration;
  std::vector<double> pressures;
  std::vector<std::uint64_t> keys;  ///< keys of the realisations, in the order of the seeds
  detail::PrecisionRule rule;
  std::size_t prefix = 0;  ///< number of surfaces that `rule` has taken so far
  std::size_t limit = std::numeric_limits<std::size_t>::max();
};

struct Item {
  std::size_t point = 0;
  std::size_t index = 0;  ///< index of `seed` in the list of seeds
  std::uint64_t seed = 0;
  std::uint64_t key = 0;
};

struct Taken {
  Item item;
  std::size_t slot = 0;  ///< index of its progress in fractions_
  /// Lock file while it is computed; only used by Shard::any().
  std::unique_ptr<detail::StudyLock> claim;
};

class ShardRun {
 public:
  ShardRun(const std::vector<StudyConfiguration>& points, const Shard& shard, const StudyRun& run)
      : shard_(shard), run_(run), parts_(*run.parts) {
    std::size_t ordinal = 0;
    for (const StudyConfiguration& configuration : points) {
      StudyLoads loads = study_loads(configuration);
      if (run.on_warning) std::ranges::for_each(loads.warnings, run.on_warning);
      Point& point = points_.emplace_back(configuration, std::move(loads.pressures));
      for (const std::uint64_t seed : detail::seeds_of(configuration)) {
        const std::uint64_t key = StudyParts::key(configuration, seed);
        if (shard.holds(ordinal++))
          pending_.push_back({points_.size() - 1, point.keys.size(), seed, key});
        point.keys.push_back(key);
      }
    }
    outcome_.wanted = pending_.size();
    fractions_ = std::vector<std::atomic<double>>(pending_.size());
  }

  ShardOutcome run() {
    drop_present();
    require_disk_space();
    // When a thread has finished its surface, another process may have ended and left its claim. So
    // each thread looks for another surface until none is left.
    loop_.run(std::max(Index(pending_.size()), Index(1)), [this](Index) {
      while (const std::optional<Taken> taken = take()) compute(*taken);
      loop_.close();
    });
    outcome_.interrupted = loop_.stopped();
    outcome_.elsewhere = loop_.stopped() ? 0 : pending_.size();
    outcome_.damaged = parts_.damaged();
    return outcome_;
  }

 private:
  /// Removes the surfaces whose parts exist. A numbered shard reads these parts to find damaged
  /// ones, since no other process computes its surfaces. With Shard::any() each process would read
  /// the whole study, so it only checks that the files exist.
  void drop_present() {
    std::erase_if(pending_, [&](const Item& item) {
      const bool present = shard_.any() ? parts_.holds(item.key) : bool(parts_.read(item.key));
      if (present) note_present(item);
      return present;
    });
  }

  void require_disk_space() const {
    std::size_t checked = std::numeric_limits<std::size_t>::max();
    for (const Item& item : pending_) {
      const StudyConfiguration& point = points_[item.point].configuration;
      const auto* recipe = std::get_if<GeneratedSurfaces>(&point.surfaces);
      if (item.point == checked || !recipe) continue;
      require_memory(recipe->grid,
                     study_memory(point, recipe->grid, parallel::threads(), pending_.size()),
                     "the surfaces of all threads (fewer `threads` need less)");
      checked = item.point;
    }
  }

  /// Takes the next surface that is neither present nor claimed. Searches from the first surface
  /// each time, because a process that held a claim may have ended.
  std::optional<Taken> take() {
    const std::scoped_lock lock(guard_);
    for (auto item = pending_.begin(); !loop_.stopped() && item != pending_.end();) {
      const bool present = parts_.holds(item->key);
      if (present) note_present(*item);
      if (present || is_superfluous(*item)) {
        if (!present) --outcome_.wanted;
        item = pending_.erase(item);
        continue;
      }
      Taken taken{*item, slots_, nullptr};
      if (shard_.any()) {
        taken.claim = detail::StudyLock::take(
            parts_.folder() / fmt::format("{:016x}{}", item->key, detail::claim_suffix));
        if (!taken.claim) ++item;
        // The process that held the claim may have finished the surface since `present` was
        // computed.
        if (!taken.claim || parts_.holds(item->key)) continue;
      }
      ++slots_;
      pending_.erase(item);
      return taken;
    }
    return {};
  }

  /// Returns whether the surfaces of smaller seeds exist and already have the requested precision.
  bool is_superfluous(const Item& item) {
    Point& point = points_[item.point];
    if (!shard_.any() || point.configuration.target_precision <= 0) return false;
    while (point.prefix < std::min(point.keys.size(), point.limit)) {
      const auto realisation = parts_.read(point.keys[point.prefix]);
      if (!realisation) break;
      ++point.prefix;
      if (point.rule.met_with(*realisation)) point.limit = point.prefix;
    }
    return item.index >= point.limit;
  }

  void compute(const Taken& taken) {
    const auto start = Clock::now();
    const Point& point = points_[taken.item.point];
    try {
      const Realisation realisation = detail::realise(
          point.configuration, taken.item.seed, point.pressures, [&](const ProgressReport& sweep) {
            fractions_[taken.slot] = sweep.fraction;
            return loop_.going_on();
          });
      parts_.write(taken.item.key, realisation);
      const std::scoped_lock lock(guard_);
      ++outcome_.computed;
      fractions_[taken.slot] = 1;
      note(taken.item, std::chrono::duration<double>(Clock::now() - start).count(), false);
    } catch (const Interrupted&) {
      // The run was stopped.
    }
  }

  void note_present(const Item& item) {
    ++outcome_.present;
    fractions_[slots_++] = 1;
    note(item, 0, true);
  }

  /// The caller must hold guard_, unless there are no threads yet.
  void note(const Item& item, double seconds, bool restored) {
    news_.push_back({.point = item.point,
                     .points = points_.size(),
                     .finished = outcome_.present + outcome_.computed,
                     .wanted = outcome_.wanted,
                     .seed = item.seed,
                     .seconds = seconds,
                     .restored = restored});
  }

  bool report() {
    std::vector<RealisationReport> news;
    std::size_t finished = 0, wanted = 0;
    {
      const std::scoped_lock lock(guard_);
      news.swap(news_);
      finished = outcome_.present + outcome_.computed;
      wanted = std::max(outcome_.wanted, std::size_t{1});
    }
    if (run_.on_realisation)
      for (const RealisationReport& item : news) run_.on_realisation(item);
    if (!run_.on_progress) return true;
    double sum = 0;
    for (const std::atomic<double>& fraction : fractions_) sum += fraction;
    const std::string stage = fmt::format("shard {} {}/{}", to_text(shard_), finished, wanted);
    return run_.on_progress(
        {.stage = stage, .fraction = std::min(sum / double(wanted), 1.0), .step = int(finished)});
  }

  const Shard shard_;
  const StudyRun& run_;
  StudyParts& parts_;
  std::deque<Point> points_;  // a deque, because the rule of a Point refers to the Point
  std::list<Item> pending_;
  ShardOutcome outcome_;
  std::size_t slots_ = 0;
  std::vector<std::atomic<double>> fractions_;
  std::vector<RealisationReport> news_;
  std::mutex guard_;
  detail::TaskLoop loop_{{.at_once = 0, .communicator = {}, .talk = [this] { return report(); }}};
};

}  // namespace

ShardOutcome run_shard(const StudyConfiguration& configuration, const Shard& shard,
                       const StudyRun& run) {
  require_that(run.parts != nullptr, "parts",
               "not given; a shard needs the folder that it shares with the others");
  configuration.pressed().modulus_ratio();
  const std::vector<StudyConfiguration> points = parameter_combinations(configuration);
  if (run.parts->count() > 0) detail::require_some_of(*run.parts, points);
  return ShardRun(points, shard, run).run();
}

Shard parse_shard(std::string_view text) {
  if (text == "any") return {};
  Shard shard;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto read = [](std::string_view digits, std::size_t& number) {
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    return error == std::errc() && stop == end;
  };
  const bool good = read(text.substr(0, slash), shard.number) && slash < text.size() &&
                    read(text.substr(slash + 1), shard.count) && shard.count > 0 &&
                    shard.number <= shard.count;
  require(good, "shard", fmt::format("'{}'", text),
          "must be K/N, such as 3/8, with K from 1 to N or from 0 to N - 1, or any");
  return shard;
}

std::string to_text(const Shard& shard) {
  return shard.any() ? "any" : fmt::format("{}/{}", shard.number, shard.count);
}

}  // namespace salebra
