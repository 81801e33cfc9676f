// SPDX-License-Identifier: GPL-3.0-or-later
// Loss of one spring of a contact with friction.
#include "spring_loss.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "base/stop_check.hpp"
#include "mean_rise.hpp"
#include "phase_quadrature.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

constexpr int steps = 360;  // samples per period: the loss is then accurate to 1e-4

}  // namespace

SlidingSprings::SlidingSprings(double swing, double speed)
    : rise_(swing * mean_rise(speed / swing)) {
  // Computes the mean ⟨b⟩ of the drag-back distance b(φ) defined in the header. `position` is r + x
  // over two cycles, after a first cycle that makes r periodic. r follows the stretch limit when
  // this falls, and sticks when this grows faster than the body moves. Later cycles need no
  // storage: r + x grows by the distance per cycle, so its minimum lies in these two cycles.
  constexpr std::size_t phases = 240;
  const double step = 2 * pi * speed / phases;
  std::array<double, 2 * phases> position;
  double stretch = 0;
  for (std::size_t i = 0; i < 3 * phases; ++i) {
    stretch = std::min(swing * (1 - std::cos(2 * pi * double(i) / phases)), stretch + step);
    if (i >= phases) position[i - phases] = stretch + double(i - phases) * step;
  }
  double least = position.back();
  for (std::size_t i = position.size(); i-- > 0;) {
    least = std::min(least, position[i]);
    if (i < phases) back_ += (position[i] - least) / phases;
  }
}

double SlidingSprings::loss_over_distance(double min_stretch, double excursion) const {
  const double mean = min_stretch + rise_;
  return std::max(0.0, mean * (excursion - 2 * mean) + (2 * min_stretch + 4.0 / 3 * rise_) * back_);
}

double SlidingSprings::deepest(double excursion) const {
  const double linear = excursion - 4 * rise_ + 2 * back_;
  const double rest = rise_ * (excursion - 2 * rise_ + 4.0 / 3 * back_);
  return (linear + std::sqrt(linear * linear + 8 * std::max(0.0, rest))) / 4;
}

LossOfSpring::LossOfSpring(const Oscillation& motion, double stretch, double excursion)
    : motion_(motion),
      amplitude_(normal_amplitude(motion)),
      stretch_(stretch),
      excursion_(excursion) {
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    const double speed = std::abs(drag->drag_velocity) / drag->angular_frequency;
    distance_ = drag->distance_per_cycle();
    closed_.emplace(stretch * amplitude_, speed);
    depth_ = closed_->deepest(excursion) / stretch;
  } else {
    // A spring sticks if one anchor stays within its stretch limit of x at all times.
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < steps; ++i) {
      const double angle = 2 * pi * i / steps, x = displacement(angle),
                   limit = stretch * amplitude_ * std::cos(angle);
      low = std::min(low, x + limit);
      high = std::max(high, x - limit);
    }
    depth_ = std::max(0.0, (high - low) / (2 * stretch) - amplitude_);
  }
  constexpr int parts = 32;
  for (int i = 0; i < parts && depth_ > 0; ++i) {
    const double from = -amplitude_ - depth_ * i / parts, width = depth_ / parts;
    steepest_ = std::max(steepest_, std::abs((*this)(from) - (*this)(from - width)) / width);
  }
}

double LossOfSpring::displacement(double angle) const {
  if (const auto* drag = std::get_if<Drag>(&motion_))
    return drag->drag_velocity / drag->angular_frequency * angle;
  const auto& equal = std::get<EqualFrequency>(motion_);
  return equal.tangential_amplitude * std::cos(angle + equal.phase);
}

double LossOfSpring::operator()(double spring_depth) const {
  if (spring_depth >= amplitude_) return 0;
  if (spring_depth > -amplitude_) {
    const double half = std::acos(spring_depth / amplitude_),
                 loss = followed(spring_depth, half, 1);
    // If the drag turns while the spring is closed, the spring keeps a third of its loss on average
    // in slow motion.
    return closed_ ? loss * (1 - closed_->turning_share(excursion_) * half / pi) : loss;
  }
  if (!closed_) return followed(spring_depth, pi, 2);
  return closed_->loss_over_distance(stretch_ * (-amplitude_ - spring_depth), excursion_) *
         distance_ / excursion_;
}

// ∮s dx of a spring with the stretch s that touches from the phase −half to half, in the last of
// `periods` periods; exact for straight steps. This equals the loss, since the stored energy is the
// same at the beginning and the end.
double LossOfSpring::followed(double spring_depth, double half, int periods) const {
  // The limit is the same at −θ as at θ.
  std::array<double, steps / 2 + 1> limits;
  for (int i = 0; i <= steps / 2; ++i)
    limits[std::size_t(i)] = std::max(
        0.0, stretch_ * (amplitude_ * std::cos(half * (2.0 * i / steps - 1)) - spring_depth));
  const auto limit_at = [&](int i) { return limits[std::size_t(std::min(i, steps - i))]; };
  double work = 0, stretch = 0;
  for (int period = 0; period < periods; ++period) {
    detail::stop_if_asked();
    work = 0;
    double x = displacement(-half), limit = limit_at(0);
    for (int i = 1; i <= steps; ++i) {
      const double angle = half * (2.0 * i / steps - 1);
      const double next_x = displacement(angle), next_limit = limit_at(i);
      const double distance = next_x - x, stuck = stretch + distance;
      if (std::abs(stuck) <= next_limit) {
        work += (stretch + stuck) / 2 * distance;
        stretch = stuck;
      } else {
        const double side = stuck > 0 ? 1 : -1;
        const double share = (limit - side * stretch) / (side * distance - (next_limit - limit));
        const double slips = stretch + share * distance, end = side * next_limit;
        work += distance * (share * (stretch + slips) + (1 - share) * (slips + end)) / 2;
        stretch = end;
      }
      x = next_x, limit = next_limit;
    }
  }
  return work;
}

}  // namespace salebra::detail
