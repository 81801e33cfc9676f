// SPDX-License-Identifier: GPL-3.0-or-later
// Self-affine law in a range of wave numbers, with an unknown floor and attenuation.
#include "surface/power_law_range.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/numerics/dense_systems.hpp"

namespace salebra::detail {
namespace {

constexpr double min_hurst = -0.2, greatest_hurst = 1.5;
constexpr double strongest_attenuation = 3;  ///< g q² at the end of a range

/// The free parameters of a law: Hurst exponent, ln of the roll-off, attenuation, and floor.
enum Parameter : std::size_t { hurst, rolloff, attenuation, floor_share, parameters };
using Numbers = std::array<double, parameters>;
using Held = std::array<bool, parameters>;

/// The self-affine law in a range of bins. Its amplitude is always set to the most likely value.
class LawInRange {
 public:
  LawInRange(std::span<const SpectrumBin> bins, const SelfAffineDensity& density)
      : bins_(bins), density_(density) {
    first_ = std::log(bins.front().wavenumber);
    last_ = std::log(bins.back().wavenumber);
    // A roll-off below the first bin means no roll-off. The attenuation g is in units of 1/q² at
    // the last wave number, the floor in units of the law at the last wave number.
    least_ = {min_hurst, first_ - 0.3, 0, 0};
    greatest_ = {greatest_hurst, last_ - 0.7, 6, 50};
  }

  struct Fit {
    Numbers at{};
    double deviance = std::numeric_limits<double>::infinity();
    double amplitude = 0;
  };

  Numbers start(double value) const { return {value, least_[rolloff], 0.05, 0.05}; }
  double no_rolloff() const { return least_[rolloff]; }
  double least(Parameter parameter) const { return least_[parameter]; }
  double greatest(Parameter parameter) const { return greatest_[parameter]; }
  std::span<const SpectrumBin> bins() const { return bins_; }

  /// Minimises the deviance (−2 ln of the likelihood, up to a constant) from a start by Fisher
  /// scoring; a step is shortened until the deviance falls.
  Fit descend(Numbers from, const Held& held) const {
    for (std::size_t p = 0; p < parameters; ++p)
      from[p] = std::clamp(from[p], least_[p], greatest_[p]);
    Fit best = at(from);
    std::vector<double> shape(bins_.size()), other(bins_.size());
    double damping = 1e-3;
    for (int iteration = 0; iteration < 25; ++iteration) {
      shapes(best.at, shape);
      // The expected power is E = amplitude·shape, ln E = ln A + ln shape, so the derivative with
      // respect to ln A is 1 in each bin.
      Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(Index(bins_.size()), Index(parameters));
      for (std::size_t k = 0; k < bins_.size(); ++k) {
        const double share = bins_[k].wavenumber / bins_.back().wavenumber;
        const double law = shape[k] - best.at[floor_share];
        slopes(Index(k), Index(attenuation)) = -share * share * law / shape[k];
        slopes(Index(k), Index(floor_share)) = 1 / shape[k];
      }
      for (const Parameter p : {hurst, rolloff}) {
        if (held[p]) continue;
        Numbers moved = best.at;
        const double step = moved[p] + 1e-5 > greatest_[p] ? -1e-5 : 1e-5;
        moved[p] += step;
        shapes(moved, other);
        for (std::size_t k = 0; k < bins_.size(); ++k)
          slopes(Index(k), Index(p)) = std::log(other[k] / shape[k]) / step;
      }
      Eigen::VectorXd weights(bins_.size()), excess(bins_.size());
      for (std::size_t k = 0; k < bins_.size(); ++k) {
        weights(Index(k)) = bins_[k].modes;
        excess(Index(k)) = bins_[k].power / (best.amplitude * shape[k]) - 1;
      }
      // The amplitude is free, so the mean over the bins is removed from the derivatives with
      // respect to each other parameter.
      for (Index p = 0; p < Index(parameters); ++p)
        slopes.col(p).array() -= slopes.col(p).dot(weights) / weights.sum();
      Eigen::VectorXd gradient = slopes.transpose() * (weights.array() * excess.array()).matrix();
      Eigen::MatrixXd information = slopes.transpose() * weights.asDiagonal() * slopes;
      // A parameter at a bound that the step would move beyond the bound is held.
      for (std::size_t p = 0; p < parameters; ++p) {
        const bool below = best.at[p] <= least_[p] && gradient(Index(p)) < 0;
        const bool above = best.at[p] >= greatest_[p] && gradient(Index(p)) > 0;
        if (!below && !above && !held[p]) continue;
        gradient(Index(p)) = 0;
        information.row(Index(p)).setZero();
        information.col(Index(p)).setZero();
        information(Index(p), Index(p)) = 1;
      }
      bool down = false;
      double gain = 0;
      for (; damping < 1e8 && !down; damping *= down ? 0.1 : 8) {
        Eigen::MatrixXd damped = information;
        damped.diagonal() *= 1 + damping;
        damped.diagonal().array() += 1e-9;
        const Eigen::VectorXd step = damped.ldlt().solve(gradient);
        Numbers next = best.at;
        for (std::size_t p = 0; p < parameters; ++p)
          next[p] =
              std::clamp(next[p] + std::clamp(step(Index(p)), -1.0, 1.0), least_[p], greatest_[p]);
        const Fit tried = at(next);
        if (tried.deviance < best.deviance) {
          gain = best.deviance - tried.deviance;
          best = tried;
          down = true;
        }
      }
      if (!down || gain < 3e-3) break;
      damping = std::max(damping, 1e-6);
    }
    return best;
  }

  /// The most likely law, from several starting values of the roll-off; without a plateau, the
  /// roll-off is held below the first bin. value: Hurst exponent to be held.
  Fit fit(bool plateau, std::optional<double> value = {}) const {
    const Held held{value.has_value(), !plateau, false, false};
    Fit best;
    for (const double position : {0.0, 0.3, 0.6}) {
      if (!plateau && position > 0) continue;
      Numbers from = start(value.value_or(0.6));
      if (position > 0) from[rolloff] = first_ + position * (last_ - first_);
      const Fit found = descend(from, held);
      if (found.deviance < best.deviance) best = found;
      // The deviance is as low as chance makes it, so no other starting value is needed.
      if (best.deviance < 0.8 * static_cast<double>(bins_.size())) break;
    }
    return best;
  }

 private:
  /// The expected power at each bin, divided by the amplitude.
  void shapes(const Numbers& at, std::vector<double>& shape) const {
    const double q_rolloff = at[rolloff] <= least_[rolloff] ? 0 : std::exp(at[rolloff]);
    const double q_last = bins_.back().wavenumber;
    const double unit = density_(q_last, at[hurst], q_rolloff);
    for (std::size_t k = 0; k < bins_.size(); ++k) {
      const double share = bins_[k].wavenumber / q_last;
      shape[k] = density_(bins_[k].wavenumber, at[hurst], q_rolloff) / unit *
                     std::exp(-at[attenuation] * share * share) +
                 at[floor_share];
    }
  }

  Fit at(const Numbers& numbers) const {
    std::vector<double> shape(bins_.size());
    shapes(numbers, shape);
    Fit fit{numbers};
    double weighted = 0, modes = 0;
    for (std::size_t k = 0; k < bins_.size(); ++k) {
      weighted += bins_[k].modes * bins_[k].power / shape[k];
      modes += bins_[k].modes;
    }
    fit.amplitude = weighted / modes;
    fit.deviance = 0;
    for (std::size_t k = 0; k < bins_.size(); ++k)
      fit.deviance -= 2 * bins_[k].modes * std::log(bins_[k].power / (fit.amplitude * shape[k]));
    return fit;
  }

  std::span<const SpectrumBin> bins_;
  const SelfAffineDensity& density_;
  double first_ = 0, last_ = 0;
  Numbers least_{}, greatest_{};
};

/// The interval of a parameter in which the deviance exceeds its minimum by at most `limit`.
IntervalEstimate interval_of(const LawInRange& range, const LawInRange::Fit& best, double limit,
                             Parameter parameter) {
  const double least = range.least(parameter), greatest = range.greatest(parameter);
  Held held{};
  held[parameter] = true;
  const auto end = [&](double direction) {
    double inside = best.at[parameter], step = 0.03;
    LawInRange::Fit warm = best;
    while (step > 2e-3 && inside > least && inside < greatest) {
      Numbers from = warm.at;
      from[parameter] = std::clamp(inside + direction * step, least, greatest);
      const LawInRange::Fit tried = range.descend(from, held);
      if (tried.deviance - best.deviance > limit) {
        step /= 3;
        continue;
      }
      inside = tried.at[parameter];
      warm = tried;
      step *= 1.5;
    }
    return std::clamp(inside + direction * step, least, greatest);
  };
  return {best.at[parameter], end(-1), end(1)};
}

}  // namespace

IntervalEstimate PowerLawRange::rolloff() const {
  constexpr double turn = 2 * std::numbers::pi;
  if (!rolloff_seen) return {};
  return {turn / q_rolloff, turn / q_rolloff_high, turn / q_rolloff_low};
}

PowerLawRange fit_power_law_range(std::span<const SpectrumBin> bins,
                                  const SelfAffineDensity& density, double min_span) {
  constexpr std::size_t fewest = 8;
  if (bins.size() < fewest) return {};
  struct Candidate {
    std::size_t begin, end;
    double span;
  };
  // Limits of the tested ranges of bins are a third of an octave apart; the longest range comes
  // first.
  std::vector<std::size_t> positions{0};
  for (std::size_t k = 1; k < bins.size(); ++k)
    if (bins[k].wavenumber > 1.25 * bins[positions.back()].wavenumber) positions.push_back(k);
  positions.push_back(bins.size());
  std::vector<Candidate> candidates;
  for (const std::size_t begin : positions)
    for (const std::size_t end : positions)
      if (end >= begin + fewest)
        if (const double span = bins[end - 1].wavenumber / bins[begin].wavenumber; span >= min_span)
          candidates.push_back({begin, end, span});
  std::ranges::stable_sort(candidates, std::greater(), &Candidate::span);
  const auto acceptable = [&](std::size_t begin, std::size_t end, const LawInRange::Fit& fit) {
    const double freedom = static_cast<double>(end - begin) - 4;
    return fit.deviance < gsl_cdf_chisq_Pinv(0.9, freedom);
  };
  for (const Candidate& candidate : candidates) {
    const LawInRange range(bins.subspan(candidate.begin, candidate.end - candidate.begin), density);
    const LawInRange::Fit best = range.fit(true);
    if (!acceptable(candidate.begin, candidate.end, best)) continue;
    if (best.at[hurst] <= min_hurst || best.at[hurst] >= greatest_hurst) continue;
    // Where the bins scatter more than their independent powers do, the deviance is judged by its
    // own scatter.
    const double freedom = static_cast<double>(candidate.end - candidate.begin) - 4;
    const double limit = gsl_cdf_chisq_Pinv(0.95, 1) * std::max(1.0, best.deviance / freedom);
    PowerLawRange found{candidate.begin, candidate.end, interval_of(range, best, limit, hurst)};
    const LawInRange::Fit straight = range.fit(false);
    // If neither floor nor attenuation is significant, the law without floor and attenuation is the
    // better estimate.
    Numbers without = best.at;
    without[attenuation] = without[floor_share] = 0;
    const LawInRange::Fit plain = range.descend(without, {false, false, true, true});
    found.pure = plain.deviance - best.deviance < limit;
    // Where less than a twentieth of the power is left, the shape of the attenuation decides, and no
    // instrument has exactly a Gaussian.
    if (!found.pure && best.at[attenuation] > strongest_attenuation) continue;
    found.attenuation = best.at[attenuation];
    if (found.pure) {
      found.hurst.value = plain.at[hurst];
      found.hurst.low = std::min(found.hurst.low, found.hurst.value);
      found.hurst.high = std::max(found.hurst.high, found.hurst.value);
    }
    found.rolloff_seen = straight.deviance - best.deviance > limit &&
                         best.at[rolloff] > std::log(bins[candidate.begin].wavenumber);
    if (found.rolloff_seen) {
      const IntervalEstimate logarithm = interval_of(range, best, limit, rolloff);
      found.q_rolloff_low = std::exp(logarithm.low);
      found.q_rolloff_high = std::exp(logarithm.high);
    }
    // Repeat the fit without the shortest half octave, where errors of instruments appear: the
    // difference shows the effect of the choice of the range.
    const double shorter = bins[candidate.end - 1].wavenumber / std::numbers::sqrt2;
    std::size_t end = candidate.end;
    while (end > candidate.begin + fewest && bins[end - 1].wavenumber > shorter) --end;
    const double other = LawInRange(bins.subspan(candidate.begin, end - candidate.begin), density)
                             .fit(true)
                             .at[hurst];
    found.hurst.low = std::min(found.hurst.low, other);
    found.hurst.high = std::max(found.hurst.high, other);
    // An interval of the Hurst exponent that covers 0 … 1 excludes nothing, and an exponent below 0
    // means no law.
    if ((found.hurst.low <= 0 && found.hurst.high >= 1) || found.hurst.value < 0) return {};
    if (best.at[rolloff] > range.no_rolloff()) found.q_rolloff = std::exp(best.at[rolloff]);
    found.amplitude = best.amplitude /
                      density(bins[candidate.end - 1].wavenumber, best.at[hurst], found.q_rolloff);
    return found;
  }
  return {};
}

}  // namespace salebra::detail
