// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/study/study.hpp>
#include <vector>

namespace salebra {

/// Mean and Student-t 95 % interval of the mean, over the values that are not NaN; no limits for
/// fewer than two.
EnsembleMean student_mean(const std::vector<double>& values);

/// Mean, and the Student-t interval that holds one more value of the same kind in 95 %,
///     m exp(±t_{0.975, n−1} s √(1 + 1/n)),   m, s: of ln values
/// of values > 0, otherwise of the values themselves. Of surfaces of a twin, whose spectra are draws
/// of what the scans leave open, one more is the part that was scanned.
EnsembleMean prediction(const std::vector<double>& values);

/// Bootstrap-t 95 % intervals of means [Efron and Tibshirani (1993), ch. 12.5]: n values are drawn
/// with replacement from n values, `resamples` times; the 2.5 % and 97.5 % quantiles of t* = (mean*
/// − mean)/s* give
///     mean − t*_97.5 s/√n … mean − t*_2.5 s/√n,
/// which, unlike percentiles of mean*, holds its 95 % for the few surfaces of an ensemble, and
/// unlike Student's t follows a skew distribution. Numbers come from Philox streams of their own:
/// an interval depends on the values and their order alone, and all quantities of one ensemble are
/// drawn together. Fewer than min_bootstrap_count values: Student's t. Each arm is held between a
/// half and twice Student's: of few values most of which are alike, resamples without scatter would
/// otherwise decide one limit, and the mean lie at the edge of its own interval. By Hall's
/// expansion the largest skewness that n values can have, √n, changes an arm by 3/4 of it [Hall
/// (1988)], so that nothing is lost: 92.9 % of 1500 intervals of six log-normal values (σ = 0.5)
/// hold the mean, 93.1 % of them without the limits, 92.2 % of Student's.
class Bootstrap {
 public:
  static constexpr int min_bootstrap_count = 6;

  /// resamples: at least 200, or InvalidInput.
  explicit Bootstrap(int resamples = 2000, std::uint64_t seed = 1);

  /// Over the values that are not NaN. Cost: resamples × values in time, 12 bytes per value and
  /// thread.
  EnsembleMean mean(const std::vector<double>& values) const;

 private:
  int resamples_;
  std::uint64_t seed_;
};

}  // namespace salebra
