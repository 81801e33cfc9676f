// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <salebra/base/error.hpp>
#include <vector>

namespace salebra::detail {

/// Weighted means over rings about a point, of a spectrum or a correlation. The limits of the rings are in the ratio
/// 2^(1/rings_per_octave), the first half a ring below `innermost`, so that no radius of a square lattice lies on a limit where
/// rounding would decide. The radius 0 is a ring of its own.
template <std::size_t quantities>
class RingMeans {
 public:
  struct Ring {
    double weight = 0;                      ///< > 0
    double radius = 0;                      ///< mean
    std::array<double, quantities> mean{};  ///< of each quantity
  };

  RingMeans(double innermost, int rings_per_octave)
      : innermost_(innermost), rings_per_octave_(rings_per_octave) {
    require(rings_per_octave >= 1, "bins_per_octave", rings_per_octave, "must be >= 1");
  }

  void add(double radius, double weight, const std::array<double, quantities>& values) {
    const std::size_t number = number_of(radius);
    if (number >= sums_.size()) sums_.resize(number + 1);
    Ring& sum = sums_[number];
    sum.weight += weight;
    sum.radius += weight * radius;
    for (std::size_t k = 0; k < quantities; ++k) sum.mean[k] += weight * values[k];
  }

  /// From the innermost on; rings of no weight are left out.
  std::vector<Ring> rings() const {
    std::vector<Ring> means;
    for (Ring ring : sums_) {
      if (ring.weight == 0) continue;
      ring.radius /= ring.weight;
      for (double& value : ring.mean) value /= ring.weight;
      means.push_back(ring);
    }
    return means;
  }

 private:
  std::size_t number_of(double radius) const {
    if (radius == 0) return 0;
    return 1 + static_cast<std::size_t>(std::log2(radius / innermost_) * rings_per_octave_ + 0.5);
  }

  double innermost_;
  int rings_per_octave_;
  std::vector<Ring> sums_;
};

}  // namespace salebra::detail
