// SPDX-License-Identifier: GPL-3.0-or-later
// Sampled paths of harmonic and two-frequency motions, and their common period.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/oscillation.hpp>

namespace salebra {
namespace {

using std::numbers::pi;

// Samples δ = mean − u_z cos(ω_z t) and x = tangential(θ) with θ = ω_z t − π, over a number of
// normal cycles. The first and the last sample are minima of δ.
SampledMotion sample_cycles(double mean, double amplitude, double angular_frequency, int cycles,
                            int steps, const std::function<double(double)>& tangential) {
  require(steps >= 3, "steps", steps, "must be >= 3");
  SampledMotion path;
  const int count = cycles * steps;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * pi * i / steps;
    path.time.push_back(angle / angular_frequency);
    // Uses the index within the cycle, so that δ of each cycle is the same to the last bit.
    path.indentation.push_back(mean - amplitude * std::cos(2 * pi * (i % steps) / steps));
    path.displacement.push_back(tangential(angle - pi));
  }
  return path;
}

}  // namespace

Motion motion_of(const Oscillation& motion) {
  return std::visit([](const auto& one) -> Motion { return one; }, motion);
}

std::optional<Oscillation> oscillation_of(const Motion& motion) {
  if (const auto* equal = std::get_if<EqualFrequency>(&motion)) return *equal;
  if (const auto* drag = std::get_if<Drag>(&motion)) return *drag;
  return {};
}

CommonPeriod common_period(const TwoFrequencies& motion, int max_cycles) {
  require_positive(motion.normal_angular_frequency, "normal_angular_frequency");
  require_positive(motion.tangential_angular_frequency, "tangential_angular_frequency");
  const double ratio = motion.tangential_angular_frequency / motion.normal_angular_frequency;
  for (int p = 1; p <= max_cycles; ++p) {
    const double q = std::round(ratio * p);
    if (q >= 1 && q < 1e9 && std::abs(ratio * p - q) <= 1e-9 * q) return {p, static_cast<int>(q)};
  }
  return {};
}

void SampledMotion::validate() const {
  require(time.size() >= 3, "trajectory", time.size(), "samples given; give at least 3");
  require(indentation.size() == time.size() && displacement.size() == time.size(), "trajectory",
          time.size(), "times need the same number of indentations and displacements");
  for (std::size_t i = 0; i < time.size(); ++i) {
    require(
        std::isfinite(time[i]) && std::isfinite(indentation[i]) && std::isfinite(displacement[i]),
        "trajectory", i, "is the index of a sample that is not finite");
    require(i == 0 || time[i] > time[i - 1], "trajectory", i,
            "is the index of a time that is not later than the time before");
  }
  const auto [low, high] = std::ranges::minmax(indentation);
  const double gap = indentation.back() - indentation.front();
  require(std::abs(gap) <= 1e-9 * (high - low), "trajectory", gap,
          "m is the difference between the last and the first indentation; give one whole period, "
          "both ends included");
}

SampledMotion sample(const Oscillation& motion, double mean_indentation, int steps) {
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    require_positive(drag->angular_frequency, "angular_frequency");
    const double speed = drag->drag_velocity / drag->angular_frequency;
    return sample_cycles(mean_indentation, drag->normal_amplitude, drag->angular_frequency, 1,
                         steps, [&](double angle) { return speed * angle; });
  }
  const auto& equal = std::get<EqualFrequency>(motion);
  const double frequency = equal.angular_frequency > 0 ? equal.angular_frequency : 1;
  return sample_cycles(
      mean_indentation, equal.normal_amplitude, frequency, 1, steps,
      [&](double angle) { return equal.tangential_amplitude * std::cos(angle + equal.phase); });
}

SampledMotion sample(const TwoFrequencies& motion, double mean_indentation, int steps) {
  const CommonPeriod period = common_period(motion);
  require(period.normal_cycles > 0, "tangential_angular_frequency",
          motion.tangential_angular_frequency,
          "rad/s has no common period with the normal frequency; choose a rational ratio");
  const double ratio = static_cast<double>(period.tangential_cycles) / period.normal_cycles;
  return sample_cycles(mean_indentation, motion.normal_amplitude, motion.normal_angular_frequency,
                       period.normal_cycles, steps, [&](double angle) {
                         return motion.tangential_amplitude *
                                std::cos(ratio * angle + motion.phase);
                       });
}

}  // namespace salebra
