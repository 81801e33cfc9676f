// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace salebra::detail {

// Sums over the pressures p that a LoadCorrection gives, which are within their bounds.
struct LoadSums {
  double below = 0;                       // Σp over the cells below the bound
  double unsaturated = 0, saturated = 0;  // number of cells below the bound; at the bound
  void add(double p, double bound) {
    if (p >= bound) {
      saturated += 1;
    } else {
      below += p;
      unsaturated += 1;
    }
  }
  LoadSums& operator+=(const LoadSums& other) {
    below += other.below;
    unsaturated += other.unsaturated;
    saturated += other.saturated;
    return *this;
  }
};
// Maps a pressure p to min(scale·max(p, 0) + shift, bound), or to the bound if p >= full_from.
struct LoadCorrection {
  double scale = 1, shift = 0, full_from = std::numeric_limits<double>::infinity();
  double operator()(double p, double bound) const {
    return p >= full_from ? bound : std::min(scale * std::max(p, 0.0) + shift, bound);
  }
};

// Finds the correction with which the sum of all pressures is `load`; sums_of(correction) returns
// the LoadSums after a correction. Pressures below the bound are scaled, and cells at the bound
// stay there: a scale just below 1 for all cells would free all cells at the bound, with gaps far
// from the plane. If the scale would halve the pressures below the bound or more than double them,
// all pressures are scaled; if that is not enough because most loaded cells are at the bound, all
// are shifted. The load is a concave function of scale and shift, so Newton's method cannot fail:
// its first step leads below the requested load, and from there it converges.
template <class SumsOf>
LoadCorrection correction_for_load(double load, double bound, const SumsOf& sums_of) {
  constexpr double rounding = 1e-14;
  constexpr int max_rounds = 60;
  const auto missing = [&](const LoadSums& sums) {
    return load - (sums.saturated > 0 ? sums.saturated * bound : 0);
  };
  for (const bool keeps_full : {true, false}) {
    LoadCorrection correction;
    if (keeps_full) correction.full_from = bound;
    for (int round = 0; round < max_rounds; ++round) {
      const LoadSums sums = sums_of(correction);
      const double factor = sums.below > 0      ? missing(sums) / sums.below
                            : missing(sums) > 0 ? 4.0
                                                : 0.0;
      correction.scale *= factor > 0 ? factor : 0.5;
      if (std::isfinite(bound) && (correction.scale > 2 || (keeps_full && correction.scale <= 0.5)))
        break;
      if (!std::isfinite(bound) || std::abs(factor - 1) < rounding) return correction;
    }
  }
  LoadCorrection correction;
  for (int round = 0; round < max_rounds; ++round) {
    const LoadSums sums = sums_of(correction);
    if (!(sums.unsaturated > 0)) break;
    const double more = (missing(sums) - sums.below) / sums.unsaturated;
    correction.shift += more;
    if (std::abs(more) < rounding * bound) break;
  }
  return correction;
}

}  // namespace salebra::detail
