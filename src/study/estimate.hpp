// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/study/study.hpp>
#include <vector>

namespace salebra {

/// Which values a quantity can have. Its interval is kept above 0 only if it cannot be negative:
/// values of either sign may all be positive by chance.
enum class Sign { positive, either };

/// Mean and 95 % Student-t interval of the mean, over the values that are not NaN. Fewer than two
/// values give no limits (NaN). If all values of a positive quantity are > 0, but the interval mean ± a
/// reaches 0, the limits are those of the logarithm, mean exp(±a/mean). Of intervals of three log-normal values (σ = 1),
/// 90 % then contain the mean, without this rule 84 %. The rule also holds for Bootstrap.
EnsembleMean student_mean(const std::vector<double>& values, Sign sign = Sign::positive);

/// Mean, and the 95 % Student-t prediction interval for one more value of the same kind. If all
/// values are > 0 it is
///     m exp(±t_{0.975, n−1} s √(1 + 1/n)),
/// with mean m and standard deviation s of the logarithms of the n values; otherwise m ± t s √(1 +
/// 1/n) with m and s of the values themselves. The surfaces of a surface twin have different
/// spectra, drawn from those that the scans allow. For them, one more surface stands for the part
/// that was scanned.
EnsembleMean prediction(const std::vector<double>& values);

/// Bootstrap-t 95 % intervals of means [Efron and Tibshirani (1993), ch. 12.5]. Draws n values with
/// replacement from the n given values, `resamples` times. Each resample has a mean (mean*), a
/// standard error (s*/√n) and t* = (mean* − mean)/(s*/√n). The 2.5 % and 97.5 % quantiles of t*
/// give the interval
///     mean − t*_97.5 s/√n … mean − t*_2.5 s/√n.
/// Unlike the interval between percentiles of mean*, this one contains the mean in about 95 % of
/// cases even for the few surfaces of an ensemble. Unlike Student's t, it follows a skew
/// distribution. The random numbers are Philox streams for resampling only: an interval depends
/// only on the values and their order, and all quantities of one ensemble use the same draws. With
/// fewer than min_bootstrap_count values the interval is Student's t.
///
/// Each arm of the interval, from the mean to a limit, is kept between half and twice that of
/// Student's interval. If most of a few values are alike, resamples without scatter would otherwise
/// decide one limit, and the mean would lie at the edge of its own interval. By Hall's expansion
/// the largest skewness that n values can have, √n, changes an arm by 3/4 of its length [Hall
/// (1988)], so this rule hardly changes other intervals: of 1500 intervals of six log-normal values
/// (σ = 0.5), 92.9 % contain the mean; without the rule 93.1 %, with Student's t 92.2 %.
class Bootstrap {
 public:
  static constexpr int min_bootstrap_count = 6;

  /// resamples: at least 200, or InvalidInput.
  explicit Bootstrap(int resamples = 2000, std::uint64_t seed = 1);

  /// Mean and interval of the values that are not NaN. Time: proportional to resamples × values;
  /// memory: 12 bytes per value and thread, and half a megabyte.
  EnsembleMean mean(const std::vector<double>& values, Sign sign = Sign::positive) const;

 private:
  int resamples_;
  std::uint64_t seed_;
};

}  // namespace salebra
