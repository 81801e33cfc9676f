// SPDX-License-Identifier: GPL-3.0-or-later
// Means over realisations with Student and bootstrap intervals.
#include "estimate.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <tuple>
#include <utility>

#include "base/random.hpp"

namespace salebra {
namespace {

// Surface generators, Monte Carlo ensembles and bootstrap resampling may use the same seed. This
// number gives the resampling random numbers of its own.
constexpr std::uint32_t bootstrap_stream = 0xb0075;

std::vector<double> known(const std::vector<double>& values) {
  std::vector<double> kept;
  std::ranges::copy_if(values, std::back_inserter(kept),
                       [](double value) { return !std::isnan(value); });
  return kept;
}

struct Moments {
  double mean = 0;
  double deviation = 0;  ///< standard deviation of a single value, with the divisor n − 1
};

Moments moments_of(const std::vector<double>& values) {
  Moments result;
  for (const double value : values) result.mean += value;
  result.mean /= double(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (double(values.size()) - 1));
  return result;
}

/// Quantile of values, linear between neighbouring values in order of size. Sorts no more than
/// necessary.
double quantile(std::vector<double>& values, double probability) {
  const double position = probability * (double(values.size()) - 1);
  const auto below = static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[std::size_t(below)];
  const double high = below + 1 < std::ptrdiff_t(values.size())
                          ? *std::min_element(values.begin() + below + 1, values.end())
                          : low;
  return low + (position - double(below)) * (high - low);
}

/// The draws of all resamples of a few values. All quantities of an ensemble use the same draws, so
/// the last table is kept. More values would need too much memory: empty.
std::shared_ptr<const std::vector<std::int32_t>> draws_of(std::uint64_t seed, int resamples,
                                                          std::int32_t count) {
  constexpr std::int32_t most = 64;
  if (count > most) return {};
  using Key = std::tuple<std::uint64_t, int, std::int32_t>;
  static std::mutex mutex;
  static std::pair<Key, std::shared_ptr<const std::vector<std::int32_t>>> last;
  const Key key{seed, resamples, count};
  const std::lock_guard lock(mutex);
  if (!last.second || last.first != key) {
    const auto values = std::size_t(count);
    std::vector<std::int32_t> draws(std::size_t(resamples) * values);
    for (int number = 0; number < resamples; ++number)
      fill_draws(seed, number, 0, count, {draws.data() + std::size_t(number) * values, values},
                 bootstrap_stream);
    last = {key, std::make_shared<const std::vector<std::int32_t>>(std::move(draws))};
  }
  return last.second;
}

}  // namespace

double EnsembleMean::relative_precision() const { return (high - low) / 2 / std::abs(mean); }

namespace {

/// The mean of the values, and Student's 95 % interval of a quantity whose standard deviation is
/// that of a single value divided by `divisor`.
EnsembleMean student(const std::vector<double>& kept, double divisor) {
  EnsembleMean estimate;
  if (kept.empty()) return estimate;
  const Moments moments = moments_of(kept);
  estimate.mean = moments.mean;
  if (kept.size() < 2) return estimate;
  const double half =
      gsl_cdf_tdist_Pinv(0.975, double(kept.size()) - 1) * moments.deviation / divisor;
  estimate.low = estimate.mean - half;
  estimate.high = estimate.mean + half;
  return estimate;
}

/// The mean, and Student's interval of the mean.
EnsembleMean student_of_mean(const std::vector<double>& kept) {
  return student(kept, std::sqrt(double(kept.size())));
}

/// Replaces limits of a positive quantity that reach 0 although all values are positive, mean − a …
/// mean + b, by those of the logarithm, mean exp(−a/mean) … mean exp(b/mean).
EnsembleMean kept_positive(EnsembleMean estimate, const std::vector<double>& kept, Sign sign) {
  const double mean = estimate.mean;
  if (sign == Sign::either || !(estimate.low <= 0) ||
      !std::ranges::all_of(kept, [](double value) { return value > 0; }))
    return estimate;
  return {mean, mean * std::exp(estimate.low / mean - 1),
          mean * std::exp(estimate.high / mean - 1)};
}

}  // namespace

EnsembleMean student_mean(const std::vector<double>& values, Sign sign) {
  const std::vector<double> kept = known(values);
  return kept_positive(student_of_mean(kept), kept, sign);
}

EnsembleMean prediction(const std::vector<double>& values) {
  std::vector<double> kept = known(values);
  const double divisor = 1 / std::sqrt(1 + 1 / double(kept.size()));
  if (!std::ranges::all_of(kept, [](double value) { return value > 0; }))
    return student(kept, divisor);
  const double mean = student(kept, divisor).mean;
  for (double& value : kept) value = std::log(value);
  const EnsembleMean logarithm = student(kept, divisor);
  return {mean, std::exp(logarithm.low), std::exp(logarithm.high)};
}

Bootstrap::Bootstrap(int resamples, std::uint64_t seed) : resamples_(resamples), seed_(seed) {
  require(resamples >= 200, "resamples", resamples,
          "is too few for a quantile of 2.5 %; use at least 200");
}

EnsembleMean Bootstrap::mean(const std::vector<double>& values, Sign sign) const {
  const std::vector<double> kept = known(values);
  if (kept.size() < std::size_t(min_bootstrap_count)) return student_mean(kept, sign);
  const Moments sample = moments_of(kept);
  EnsembleMean estimate{sample.mean, sample.mean, sample.mean};
  // If all values are equal up to round-off, every resample has the same mean.
  if (sample.deviation <= 1e-14 * std::abs(sample.mean)) return estimate;
  std::vector<double> statistics(static_cast<std::size_t>(resamples_));
  const auto count = std::int32_t(kept.size());
  const auto draws = draws_of(seed_, resamples_, count);
  const auto resample_slab = [&](Index begin, Index end) {
    std::vector<std::int32_t> drawn_now(draws ? 0 : kept.size());
    std::vector<double> resample(kept.size());
    for (Index number = begin; number < end; ++number) {
      if (!draws) fill_draws(seed_, std::int32_t(number), 0, count, drawn_now, bootstrap_stream);
      const std::int32_t* positions = draws ? draws->data() + number * count : drawn_now.data();
      for (std::size_t k = 0; k < kept.size(); ++k) resample[k] = kept[std::size_t(positions[k])];
      const Moments drawn = moments_of(resample);
      const double shift = drawn.mean - sample.mean;
      // A resample that repeats a single value has no scatter; the limit of the divisor puts it
      // into the tail on its side. The factor √n of t* cancels in the limits and is left out.
      statistics[std::size_t(number)] = shift / std::max(drawn.deviation, 1e-12 * sample.deviation);
    }
  };
  parallel::for_slabs(resamples_, resample_slab, Index(resamples_) * count);
  const double half = student_of_mean(kept).high - sample.mean;
  const auto arm = [&](double statistic) {
    return std::clamp(statistic * sample.deviation, half / 2, 2 * half);
  };
  estimate.low = sample.mean - arm(quantile(statistics, 0.975));
  estimate.high = sample.mean + arm(-quantile(statistics, 0.025));
  return kept_positive(estimate, kept, sign);
}

}  // namespace salebra
