// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/study/study.hpp>
#include <thread>

namespace salebra {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::uint64_t> seeds_of(const StudyConfiguration& configuration) {
  const auto* generated = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  return generated ? generated->seeds : std::vector<std::uint64_t>{0};
}

/// The first M >= least realisations that determine l/h_rms and κ to the precision asked; 0: none do.
std::size_t enough(const StudyResult& result,
                   const std::vector<std::optional<Realisation>>& realisations,
                   std::size_t finished) {
  const StudyConfiguration& configuration = result.configuration;
  if (configuration.precision <= 0 || finished < std::size_t(configuration.least_realisations))
    return 0;
  std::vector<double> lengths, slopes;
  for (std::size_t i = 0; i < finished; ++i) {
    const Realisation& realisation = *realisations[i];
    lengths.push_back(realisation.bem.fit.decay_length / realisation.heights.rms_height);
    slopes.push_back(realisation.bem.area_slope);
  }
  const auto precise = [&](const std::vector<double>& values) {
    const EnsembleMean estimate = result.bootstrap.mean(values);
    // No load in the range of the area law: nothing to wait for.
    return std::isnan(estimate.mean) || estimate.relative_precision() <= configuration.precision;
  };
  return precise(lengths) && precise(slopes) ? finished : 0;
}

/// The realisations of one point, computed side by side and looked at in the order of their seeds.
class PointRun {
 public:
  PointRun(StudyResult& result, const StudyRun& run, const RealisationReport& start)
      : result_(result),
        run_(run),
        report_(start),
        seeds_(seeds_of(result.configuration)),
        realisations_(seeds_.size()),
        fractions_(seeds_.size()) {}

  void go() {
    if (run_.parts && run_.parts->count() > 0) restore();
    talk();
    const auto workers = std::size_t(parallel::threads());
    if (workers > 1 && seeds_.size() - finished_ >= workers) {
      side_by_side(int(workers));
    } else {
      // Few surfaces: all threads work on each.
      for (std::size_t i = 0; i < seeds_.size() && going_on(i); ++i) compute(i, true);
    }
    if (failure_) std::rethrow_exception(failure_);
    // Realisations beyond a gap, or beyond the number that is enough, take no part.
    const std::size_t used = std::min(prefix_, limit_.load());
    for (std::size_t i = 0; i < used; ++i)
      result_.realisations.push_back(std::move(*realisations_[i]));
    result_.precision_reached = limit_ < seeds_.size();
    result_.interrupted = used < std::min(limit_.load(), seeds_.size());
  }

 private:
  void restore() {
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      realisations_[i] = run_.parts->read(StudyParts::key(result_.configuration, seeds_[i]));
      if (realisations_[i]) note(i, 0, true);
    }
  }

  /// One thread more than there is work for: it sleeps, and talks to the caller.
  void side_by_side(int workers) {
    std::atomic<std::size_t> next = 0;
    std::atomic<int> working = 0;
#pragma omp parallel num_threads(workers + 1)
    {
#pragma omp single
      working = omp_get_num_threads() - 1;  // a team may have fewer threads than were asked for
      if (omp_get_thread_num() == 0) {
        while (working > 0) {
          talk();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
      } else {
        for (std::size_t i = next++; i < seeds_.size() && going_on(i); i = next++)
          compute(i, false);
        --working;
      }
    }
    for (std::size_t i = next++; i < seeds_.size() && going_on(i); i = next++) compute(i, true);
    talk();
  }

  bool going_on(std::size_t i) const { return !stop_ && i < limit_; }

  void compute(std::size_t i, bool on_calling_thread) {
    if (restored(i)) return;
    const auto start = Clock::now();
    try {
      Realisation realisation = analyse_realisation(
          result_.configuration, seeds_[i], result_.pressures, [&](const ProgressReport& sweep) {
            fractions_[i] = sweep.fraction;
            if (on_calling_thread) talk();
            return going_on(i);
          });
      if (run_.parts)
        run_.parts->write(StudyParts::key(result_.configuration, seeds_[i]), realisation);
      const std::scoped_lock lock(guard_);
      realisations_[i] = std::move(realisation);
      note(i, std::chrono::duration<double>(Clock::now() - start).count(), false);
    } catch (const Interrupted&) {
      // Stopped, or not wanted any more.
    } catch (...) {
      const std::scoped_lock lock(guard_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
    if (on_calling_thread) talk();
  }

  bool restored(std::size_t i) {
    const std::scoped_lock lock(guard_);
    return realisations_[i].has_value();
  }

  /// With the guard held, or before there are threads.
  void note(std::size_t i, double seconds, bool restored) {
    fractions_[i] = 1;
    while (prefix_ < realisations_.size() && realisations_[prefix_]) {
      ++prefix_;
      if (const std::size_t count = enough(result_, realisations_, prefix_))
        limit_ = std::min(limit_.load(), count);
    }
    RealisationReport item = report_;
    item.finished += ++finished_;
    item.seed = seeds_[i];
    item.seconds = seconds;
    item.restored = restored;
    news_.push_back(item);
  }

  /// On the calling thread only. What the caller throws ends the run; it must not leave a parallel region.
  void talk() {
    try {
      report();
    } catch (...) {
      const std::scoped_lock lock(guard_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  }

  void report() {
    std::vector<RealisationReport> news;
    {
      const std::scoped_lock lock(guard_);
      news.swap(news_);
    }
    if (run_.on_realisation)
      for (const RealisationReport& item : news) run_.on_realisation(item);
    if (!run_.on_progress || stop_) return;
    double sum = 0;
    for (const std::atomic<double>& fraction : fractions_) sum += fraction;
    const double wanted = double(report_.wanted);
    const std::size_t finished = report_.finished + finished_;
    const std::string stage = fmt::format("study {}/{}", finished, report_.wanted);
    if (!run_.on_progress({.stage = stage,
                           .fraction = (double(report_.finished) + sum) / wanted,
                           .step = int(finished)}))
      stop_ = true;
  }

  StudyResult& result_;
  const StudyRun& run_;
  const RealisationReport report_;  ///< as it was when the point began
  const std::vector<std::uint64_t> seeds_;
  std::vector<std::optional<Realisation>> realisations_;
  std::vector<std::atomic<double>> fractions_;
  std::vector<RealisationReport> news_;
  std::atomic<std::size_t> finished_ = 0;
  std::size_t prefix_ = 0;  ///< so many from the first on are there
  std::atomic<std::size_t> limit_ = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> stop_ = false;
  std::exception_ptr failure_;
  std::mutex guard_;
};

void warn(StudyResult& result) {
  if (result.configuration.stick && !stick_solves(result.configuration)) {
    result.warnings.push_back(
        "G*/E* is not that of any elastic body: K_t = (G*/E*)K instead of stick solves; give "
        "Poisson's ratio, or --no-stick to say that it is meant");
  }
  const Realisation& first = result.realisations.front();
  if (!first.periodic) {
    result.warnings.push_back(fmt::format(
        "the surface is measured, not periodic, and is continued periodically: its opposite "
        "edges differ by {:.2g} rms heights, which adds a few steep contacts along the seam",
        first.seam_step));
  }
  int lost = 0, unconverged = 0;
  for (const Realisation& realisation : result.realisations) {
    lost += int(std::ranges::count_if(realisation.bem.damping, [](const DampingPoint& point) {
      return std::isnan(point.curve_work);
    }));
    unconverged +=
        int(std::ranges::count(realisation.bem.curve.samples, false, &ForceSample::converged));
  }
  if (unconverged > 0) {
    result.warnings.push_back(fmt::format("{} contacts did not converge to {} and were left out",
                                          unconverged, result.configuration.tolerance));
  }
  const auto total = result.realisations.size() * result.pressures.size();
  if (lost > 0 && std::size_t(lost) == total) {
    result.warnings.push_back(
        "the normal oscillation leaves the computed curve at every force: make normal_amplitude "
        "smaller or widen the pressures");
  }
}

constexpr double least_waves_in_cell = 16, least_cells_in_wave = 8, least_spots = 50;

void flag(StudyResult& result) {
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&result.configuration.surfaces)) {
    const SelfAffineParameters& spectrum = recipe->spectrum;
    const double size = std::min(result.grid.lx, result.grid.ly);
    const double longest = spectrum.rolloff.value_or(spectrum.long_cutoff.value_or(size));
    const double cell = std::max(result.grid.dx(), result.grid.dy());
    // Lengths are given in decimals: a wave of exactly 8 cells must not fall below by rounding.
    constexpr double slack = 1 + 1e-9;
    if (longest * least_waves_in_cell > size * slack)
      result.flags.push_back(
          {"finite_size",
           fmt::format("finite size: the roll-off is 1/{:.3g} of the surface, more than 1/16; few "
                       "independent hills carry the load, and surfaces scatter widely",
                       size / longest)});
    if (spectrum.short_cutoff * slack < least_cells_in_wave * cell)
      result.flags.push_back(
          {"discretisation",
           fmt::format("discretisation: the shortest wave has {:.3g} cells, fewer than 8; the "
                       "contact area is too large, the force hardly",
                       spectrum.short_cutoff / cell)});
  }
  // Where the law is fitted, the least load has the fewest spots.
  double fewest = std::numeric_limits<double>::infinity();
  for (const Realisation& realisation : result.realisations)
    for (std::size_t k = 0; k < realisation.spots.size(); ++k)
      if (result.pressures[k] >= realisation.bem.fit.window.pressure_min * (1 - 1e-9) &&
          result.pressures[k] <= realisation.bem.fit.window.pressure_max * (1 + 1e-9) &&
          !std::isnan(realisation.spots[k].count))
        fewest = std::min(fewest, realisation.spots[k].count);
  if (fewest < least_spots)
    result.flags.push_back(
        {"few_spots",
         fmt::format(
             "few contact spots: the least load of the fit has {:.0f} on one surface, fewer "
             "than 50; a larger surface, more seeds or a higher window helps",
             fewest)});
}

/// Parts of other settings would be passed over in silence, and days of work with them.
void require_some_of(const StudyParts& parts, const std::vector<StudyConfiguration>& points) {
  for (const StudyConfiguration& point : points)
    for (const std::uint64_t seed : seeds_of(point))
      if (parts.holds(StudyParts::key(point, seed))) return;
  throw InvalidInput(fmt::format(
      "{}: none of its {} surfaces belongs to this study; the settings or the program have changed "
      "since, restore them or remove the folder",
      parts.folder().string(), parts.count()));
}

}  // namespace

std::vector<StudyResult> run_ensembles(const StudyConfiguration& configuration,
                                       const StudyRun& run) {
  configuration.material.modulus_ratio();
  const std::vector<StudyConfiguration> points = grid_points(configuration);
  RealisationReport report{.points = points.size()};
  for (const StudyConfiguration& point : points) {
    const std::size_t count = seeds_of(point).size();
    require(count > 0, "seeds", 0, "is too few; give at least one");
    report.wanted += count;
  }
  if (run.parts && run.parts->count() > 0) require_some_of(*run.parts, points);
  std::vector<StudyResult> results;
  for (const StudyConfiguration& point : points) {
    StudyResult result;
    result.configuration = point;
    if (const auto* recipe = std::get_if<GeneratedSurfaces>(&point.surfaces))
      result.grid = recipe->grid;
    result.contact_scale = contact_scale(point);
    result.pressures = study_pressures(point);
    report.point = results.size();
    PointRun(result, run, report).go();
    report.finished += seeds_of(point).size();
    const bool interrupted = result.interrupted;
    if (!result.realisations.empty()) {
      result.grid = result.realisations.front().grid;
      warn(result);
      flag(result);
      results.push_back(std::move(result));
    }
    if (interrupted) break;
  }
  return results;
}

StudyResult run_study(const StudyConfiguration& configuration, const Progress& progress) {
  const auto points = grid_points(configuration).size();
  require(points == 1, "ensemble", points, "points; this takes one, run_ensembles all");
  std::vector<StudyResult> results = run_ensembles(configuration, {.on_progress = progress});
  if (!results.empty()) return std::move(results.front());
  StudyResult nothing;
  nothing.configuration = configuration;
  nothing.interrupted = true;
  return nothing;
}

EnsembleMean StudyResult::mean(const std::function<double(const Realisation&)>& value) const {
  std::vector<double> values;
  for (const Realisation& realisation : realisations) values.push_back(value(realisation));
  return bootstrap.mean(values);
}

EnsembleMean StudyResult::decay_length(ModelResult Realisation::*model) const {
  if (realisations.size() != 1)
    return mean([&](const Realisation& r) { return (r.*model).fit.decay_length; });
  const ExponentialFit& fit = (realisations.front().*model).fit;
  return {fit.decay_length, fit.decay_length_low, fit.decay_length_high};
}

EnsembleMean StudyResult::decay_length_over_rms_height(ModelResult Realisation::*model) const {
  if (realisations.size() != 1) {
    return mean(
        [&](const Realisation& r) { return (r.*model).fit.decay_length / r.heights.rms_height; });
  }
  const EnsembleMean length = decay_length(model);
  const double rms_height = realisations.front().heights.rms_height;
  return {length.mean / rms_height, length.low / rms_height, length.high / rms_height};
}

EnsembleMean StudyResult::area_slope(ModelResult Realisation::*model) const {
  return mean([&](const Realisation& r) { return (r.*model).area_slope; });
}

std::vector<EnsembleMean> StudyResult::curve(ModelResult Realisation::*model,
                                             double ForceSample::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto& samples = (r.*model).curve.samples;
      return k < samples.size() && samples[k].converged ? samples[k].*quantity
                                                        : ForceSample::unknown;
    }));
  }
  return estimates;
}

namespace {

template <class Value>
std::vector<EnsembleMean> over_realisations(const StudyResult& result,
                                            ModelResult Realisation::*model, Value value) {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    estimates.push_back(result.mean([&](const Realisation& r) {
      const auto& points = (r.*model).damping;
      return k < points.size() ? double(std::invoke(value, points[k])) : ForceSample::unknown;
    }));
  }
  return estimates;
}

}  // namespace

std::vector<EnsembleMean> StudyResult::damping(double DampingPoint::*quantity,
                                               ModelResult Realisation::*model) const {
  return over_realisations(*this, model, quantity);
}

std::vector<EnsembleMean> StudyResult::damping_deviation(ModelResult Realisation::*model) const {
  return over_realisations(*this, model, &DampingPoint::deviation);
}

EnsembleMean StudyResult::law_bend(ModelResult Realisation::*model) const {
  return mean([&](const Realisation& r) {
    const ExponentialTest& test = (r.*model).test;
    return test.window.points >= 4 ? test.decay_length_farthest / test.decay_length_closest - 1
                                   : ForceSample::unknown;
  });
}

std::vector<EnsembleMean> StudyResult::over_bem(ModelResult Realisation::*model,
                                                double ForceSample::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto &samples = (r.*model).curve.samples, &reference = r.bem.curve.samples;
      const bool known = k < samples.size() && samples[k].converged && reference[k].converged;
      return known ? samples[k].*quantity / (reference[k].*quantity) : ForceSample::unknown;
    }));
  }
  return estimates;
}

std::vector<EnsembleMean> StudyResult::damping_over_bem(ModelResult Realisation::*model,
                                                        double DampingPoint::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto& points = (r.*model).damping;
      return k < points.size() ? points[k].*quantity / r.bem.damping[k].curve_work
                               : ForceSample::unknown;
    }));
  }
  return estimates;
}

std::vector<EnsembleMean> StudyResult::convergence() const {
  std::vector<double> ratios;
  std::vector<EnsembleMean> estimates;
  for (const Realisation& realisation : realisations) {
    ratios.push_back(realisation.bem.fit.decay_length / realisation.heights.rms_height);
    if (ratios.size() >= 2) estimates.push_back(bootstrap.mean(ratios));
  }
  return estimates;
}

std::string StudyResult::interval_method() const {
  const std::size_t count = realisations.size();
  if (count == 1)
    return "95 % limits of the least-squares fit; one surface says nothing about the spread "
           "between surfaces";
  return fmt::format("95 % {} interval of the mean over {} surfaces",
                     count < Bootstrap::least_bootstrap_count ? "Student-t" : "bootstrap-t", count);
}

}  // namespace salebra
