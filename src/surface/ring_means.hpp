// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/error.hpp>
#include <span>
#include <vector>

namespace salebra::detail {

/// √(x² + y²) for lengths whose squares are normal numbers; takes a fifth of the time of
/// std::hypot.
inline double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// Weighted means of a spectrum or a correlation over rings about a point. The inner and the outer
/// radius of a ring are in the ratio 2^(1/rings_per_octave). The first limit is half a ring below
/// the radius `innermost`, because no radius of a square lattice may lie on a limit, where rounding
/// would decide on the ring. The radius 0 is a ring of its own. The caller keeps the sums and may
/// add the sums of several parts.
template <std::size_t quantities>
class RingMeans {
 public:
  struct Ring {
    double weight = 0;                      ///< sum of the weights, > 0
    double radius = 0;                      ///< mean radius
    std::array<double, quantities> mean{};  ///< of each quantity
  };

  RingMeans(double innermost, double outermost, int rings_per_octave)
      : innermost_(innermost), rings_per_octave_(rings_per_octave) {
    require(rings_per_octave >= 1, "bins_per_octave", rings_per_octave, "must be >= 1");
    rings_ = number_of(std::max(innermost, outermost)) + 1;
    for (std::size_t k = 0; k <= rings_; ++k)
      limits_.push_back(
          k == 0 ? 0 : innermost * std::exp2((static_cast<double>(k) - 1.5) / rings_per_octave));
  }

  /// Length of the array that holds the sums of all rings.
  std::size_t size() const { return rings_ * stride; }

  /// Adds the values at a radius. near: first guess of the ring that contains the radius; set to
  /// that ring.
  void add(double radius, double weight, const std::array<double, quantities>& values,
           std::span<double> sums, std::size_t& near) const {
    // Well inside the ring `near`, the number of the ring need not be computed, which takes a
    // logarithm.
    if (near == 0 ||
        !(radius > limits_[near] * (1 + 1e-9) && radius < limits_[near + 1] * (1 - 1e-9)))
      near = std::min(number_of(radius), rings_ - 1);
    const auto sum = sums.subspan(near * stride, stride);
    sum[0] += weight;
    sum[1] += weight * radius;
    for (std::size_t k = 0; k < quantities; ++k) sum[2 + k] += weight * values[k];
  }

  /// The rings from the innermost on, without rings of zero weight.
  std::vector<Ring> rings(const std::vector<double>& sums) const {
    std::vector<Ring> means;
    for (std::size_t at = 0; at < sums.size(); at += stride) {
      Ring ring{sums[at]};
      if (ring.weight == 0) continue;
      ring.radius = sums[at + 1] / ring.weight;
      for (std::size_t k = 0; k < quantities; ++k) ring.mean[k] = sums[at + 2 + k] / ring.weight;
      means.push_back(ring);
    }
    return means;
  }

 private:
  static constexpr std::size_t stride = 2 + quantities;

  std::size_t number_of(double radius) const {
    if (radius == 0) return 0;
    return 1 + static_cast<std::size_t>(std::log2(radius / innermost_) * rings_per_octave_ + 0.5);
  }

  double innermost_;
  std::vector<double> limits_;  ///< inner limit of each ring, and the outer limit of the last one
  int rings_per_octave_;
  std::size_t rings_ = 0;
};

}  // namespace salebra::detail
