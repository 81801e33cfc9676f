// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of a slider that a spring pulls over an oscillating contact: integration of the full and
// of the averaged equation of motion, the motion in the end, stability of sliding.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <utility>

#include "averaged_slider.hpp"
#include "base/numerics/quadrature.hpp"
#include "max_motion.hpp"
#include "slider_equation.hpp"

namespace salebra {
namespace {

using detail::AveragedSlider;
using detail::SliderContact;
using detail::SliderEquation;
using detail::SliderTotals;
using std::numbers::pi;

double natural_frequency(const Slider& slider) {
  return std::sqrt(slider.spring_stiffness / slider.mass);
}

void check(const NormalOscillation& normal, const Slider& slider, double friction_coefficient,
           const SliderOptions& options) {
  require_positive(slider.mass, "mass");
  require_positive(slider.spring_stiffness, "spring_stiffness");
  require_positive(slider.velocity, "velocity");
  const auto check_damping = [](double value, const char* name) {
    require(std::isfinite(value) && value >= 0, name, value, "must be finite and >= 0");
  };
  check_damping(slider.support_damping, "support_damping");
  check_damping(slider.falling_slope, "falling_slope");
  require_positive(friction_coefficient, "friction_coefficient");
  require(options.steps >= 16, "steps", options.steps, "must be >= 16");
  require(options.tolerance >= 1e-6 && options.tolerance <= 0.5, "tolerance", options.tolerance,
          "must lie between 1e-6 and 0.5");
  require(options.max_cycles > 0, "max_cycles", options.max_cycles, "must be > 0");
  require(std::isfinite(normal.normal_amplitude) && normal.normal_amplitude >= 0,
          "normal_amplitude", normal.normal_amplitude, "must be finite and >= 0");
  if (!(normal.normal_amplitude > 0)) return;
  require_positive(normal.angular_frequency, "angular_frequency");
  const double slow = natural_frequency(slider);
  require(normal.angular_frequency > 4 * slow, "angular_frequency",
          format_quantity(normal.angular_frequency, Dimension::angular_frequency),
          "must be above 4 times √(k/m) of the slider, " +
              format_quantity(slow, Dimension::angular_frequency) +
              "; the averages need a faster oscillation than that");
}

// Counts the steps of an equation, and reports progress each time `interval` of them have passed,
// which takes some hundredths of a second.
class Watch {
 public:
  Watch(const Progress& progress, const char* stage) : progress_(progress), stage_(stage) {}

  // Throws Interrupted if the callback asks to stop.
  void passed(long steps, double fraction, int cycles = 0) {
    since_ += steps;
    if (!progress_ || since_ < interval) return;
    since_ = 0;
    if (!progress_({stage_, std::min(fraction, 1.0), cycles, 0}))
      throw Interrupted("slider: stopped before its motion was known");
  }

 private:
  static constexpr long interval = 1 << 14;
  const Progress& progress_;
  const char* stage_;
  long since_ = 0;
};

// The contact at its mean indentation, and its steady sliding at the velocity of the drive.
struct Case {
  SliderContact contact;
  SteadySliding sliding;
  // X − Vt of steady sliding by the averaged equation, with the position x of the slider and the
  // drive at Vt, m.
  double spring_offset;

  Case(const ContactLaw& law, const OperatingPoint& point, const NormalOscillation& normal,
       const Slider& slider, double friction_coefficient, const SliderOptions& options)
      : contact{law, 0, normal.normal_amplitude, normal.angular_frequency, friction_coefficient} {
    check(normal, slider, friction_coefficient, options);
    if (!(contact.normal_amplitude > 0)) contact.angular_frequency = 1;
    DampingOptions averages;
    averages.hold = options.hold;
    sliding = steady_sliding(
        law, point, Drag{contact.normal_amplitude, slider.velocity, contact.angular_frequency},
        friction_coefficient, averages);
    contact.indentation = sliding.indentation;
    spring_offset = (slider.falling_slope * slider.velocity - sliding.mean_tangential_force) /
                    slider.spring_stiffness;
    check_velocity(slider.velocity, slider, "is reached by the drive");
    constexpr double most = 500'000;
    const double steps = SliderEquation::steps_of_period(contact, slider, options.steps);
    require(steps <= most, "steps", steps,
            "are needed in a period of the oscillation, but at most 500000 are allowed; use a "
            "faster oscillation, a heavier slider or a less stiff contact");
  }

  // Upper bound of the duration of a slow cycle, s: a free oscillation on the spring, and the time
  // in which the drive loads the spring while the slider sticks.
  double slow_cycle(const Slider& slider) const {
    return 2 * pi / natural_frequency(slider) +
           4 * sliding.mean_tangential_force / (slider.spring_stiffness * slider.velocity);
  }

  // Throws if a slow cycle needs more than 1e7 steps. An equation takes `steps` steps in `time`. A
  // processor computes some two million steps per second.
  void check_cost(double steps, double time, const Slider& slider) const {
    constexpr double most = 1e7;
    const double needed = std::ceil(steps * slow_cycle(slider) / time);
    require(needed <= most, "steps", needed,
            "are needed in a slow cycle, but at most 1e7 are allowed; use a slower oscillation, a "
            "stiffer spring, a lighter slider or a faster drive");
  }

  // Throws if the total friction force, lowered by the falling slope, would be negative at this
  // velocity.
  void check_velocity(double velocity, const Slider& slider, const char* what) const {
    const double friction = sliding.mean_tangential_force;
    if (!(slider.falling_slope * velocity < friction))
      throw InvalidInput("falling_slope", format_quantity(slider.falling_slope, Dimension::damping),
                         "makes friction negative from " +
                             format_quantity(friction / slider.falling_slope, Dimension::velocity) +
                             " on, which " + what +
                             "; give the slope of friction at the velocities of the motion");
  }

  std::pair<double, double> start(const Slider& slider, SliderStart start,
                                  double static_force) const {
    if (start == SliderStart::sliding) return {spring_offset, -0.01 * slider.velocity};
    return {(slider.support_damping * slider.velocity - static_force) / slider.spring_stiffness,
            -slider.velocity};
  }
};

struct Sample {
  double offset = 0, stored = 0;
  SliderTotals totals;
};

// Finds slow cycles in samples of equal spacing. A cycle lasts from one minimum of x − Vt to the
// next (position x of the slider, position Vt of the drive).
class CycleMeter {
 public:
  CycleMeter(const Slider& slider, double tolerance)
      : slow_period_(2 * pi / natural_frequency(slider)),
        length_(slider.velocity / natural_frequency(slider)),
        tolerance_(tolerance) {}

  // A maximum or minimum of x − Vt, located between samples by the parabola through three of them.
  struct Turn {
    Sample sample;
    double time = 0, offset = 0;
  };
  struct Cycle {
    Turn begin, end;
    double highest;
    double range() const { return highest - 0.5 * (begin.offset + end.offset); }
  };

  void add(const Sample& sample) {
    if (count_++ == 0) {
      window_ = extreme_ = before_extreme_ = last_ = sample;
      last_turn_.offset = low_ = high_ = sample.offset;
      return;
    }
    low_ = std::min(low_, sample.offset), high_ = std::max(high_, sample.offset);
    if (sample.totals.time - window_.totals.time >= slow_period_) {
      // The motion is steady sliding if x − Vt stays within 2e-3 of length_ for a slow period. A
      // velocity disturbance of a thousandth of the drive's velocity makes this range.
      steady_ = high_ - low_ < 2e-3 * length_;
      window_ = sample, low_ = high_ = sample.offset;
    }
    const double beyond = (sample.offset - extreme_.offset) * (rising_ ? 1 : -1);
    if (beyond >= 0) {
      before_extreme_ = last_, extreme_ = sample, after_extreme_.reset();
    } else {
      if (!after_extreme_) after_extreme_ = sample;
      // Smaller swings are not cycles: the contact may oscillate elastically while it sticks.
      if (-beyond > std::max(0.25 * last_swing_, 1e-3 * length_)) turn(sample);
    }
    last_ = sample;
  }

  bool steady() const { return steady_; }
  const std::vector<Cycle>& cycles() const { return cycles_; }
  double slow_period() const { return slow_period_; }

  // Returns whether the cycles repeat: the mean ranges of x − Vt in the last quarter of the cycles
  // and in the quarter before it agree. A motion without stick may grow or decay slowly, so it
  // needs more cycles.
  bool repeats() {
    const std::size_t count = cycles_.size();
    if (count < 6 || count == seen_) return false;
    seen_ = count;
    const std::size_t part = kept() / 2;
    const double last = mean_range(count - part, count),
                 before = mean_range(count - 2 * part, count - part);
    drift_ = std::abs(last - before) / last;
    if (stuck_time() > 0) return drift_ < 0.25 * tolerance_;
    return count >= 40 && drift_ < 0.05 * tolerance_;
  }

  // Number of cycles at the end of the record that count as repeating; their samples are averaged.
  std::size_t kept() const {
    return std::min(2 * std::max<std::size_t>(cycles_.size() / 4, 2), cycles_.size());
  }
  const Turn& begin() const { return cycles_[cycles_.size() - kept()].begin; }
  const Turn& end() const { return cycles_.back().end; }
  double stuck_time() const { return end().sample.totals.stuck - begin().sample.totals.stuck; }
  double period() const { return (end().time - begin().time) / static_cast<double>(kept()); }
  double mean_range(std::size_t from, std::size_t to) const {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += cycles_[i].range();
    return sum / static_cast<double>(to - from);
  }
  double range() const { return mean_range(cycles_.size() - kept(), cycles_.size()); }
  double lowest() const {
    double sum = 0;
    for (std::size_t i = cycles_.size() - kept(); i < cycles_.size(); ++i)
      sum += cycles_[i].end.offset;
    return sum / static_cast<double>(kept());
  }
  double drift() const { return drift_; }

 private:
  void turn(const Sample& sample) {
    Turn turn{extreme_, extreme_.totals.time, extreme_.offset};
    const double left = before_extreme_.offset - turn.offset,
                 right = after_extreme_->offset - turn.offset, bend = left + right;
    if (std::abs(bend) > 0) {
      const double part = 0.5 * (left - right) / bend;
      turn.time += part * (after_extreme_->totals.time - extreme_.totals.time);
      turn.offset -= 0.125 * (left - right) * (left - right) / bend;
    }
    last_swing_ = std::abs(turn.offset - last_turn_.offset);
    if (!rising_) {
      if (turns_ >= 2) cycles_.push_back({trough_, turn, last_turn_.offset});
      trough_ = turn;
    }
    ++turns_;
    last_turn_ = turn;
    before_extreme_ = last_, extreme_ = sample, after_extreme_.reset();
    rising_ = !rising_;
  }

  double slow_period_, length_, tolerance_;
  bool rising_ = true, steady_ = false;
  Sample window_, last_, before_extreme_, extreme_;
  std::optional<Sample> after_extreme_;
  Turn last_turn_, trough_;
  double low_ = 0, high_ = 0, last_swing_ = 0, drift_ = 0;
  int turns_ = 0;
  long count_ = 0;
  std::size_t seen_ = 0;
  std::vector<Cycle> cycles_;
};

template <class Equation>
Sample sample_of(const Equation& equation) {
  return {equation.offset(), equation.stored_energy(), equation.totals()};
}

void set_means(SliderMotion& motion, const Case& at, const Sample& begin, const Sample& end) {
  const SliderTotals &from = begin.totals, &to = end.totals;
  const double time = to.time - from.time;
  motion.stuck_fraction = (to.stuck - from.stuck) / time;
  motion.mean_tangential_force = (to.impulse - from.impulse) / time;
  motion.friction_coefficient = motion.mean_tangential_force / at.sliding.mean_force;
  motion.drive_power = (to.drive_work - from.drive_work) / time;
  motion.support_power = (to.support_loss - from.support_loss) / time;
  motion.falling_slope_power = (to.falling_gain - from.falling_gain) / time;
  motion.contact_power = (to.contact_loss - from.contact_loss) / time;
  const double rest = motion.drive_power + motion.falling_slope_power - motion.support_power -
                      motion.contact_power - (end.stored - begin.stored) / time;
  motion.energy_error = std::abs(rest / motion.drive_power);
}

template <class Equation>
void record(SliderMotion& motion, Equation& equation, const Slider& slider, double duration,
            Watch& watch) {
  constexpr double max_samples = 1500;
  const double end = equation.time() + duration, spacing = duration / max_samples;
  double next = equation.time();
  while (equation.time() < end) {
    if (equation.time() >= next) {
      motion.time.push_back(equation.time());
      motion.slider_offset.push_back(equation.offset());
      motion.slider_velocity.push_back(equation.relative_velocity() + slider.velocity);
      motion.tangential_force.push_back(equation.tangential_force());
      next += spacing;
    }
    equation.advance();
    watch.passed(equation.steps(), 1);
  }
}

// Integrates an equation of motion until the motion repeats.
template <class Equation>
SliderMotion follow(Equation& equation, const Case& at, const Slider& slider,
                    const SliderOptions& options) {
  Watch watch(options.on_progress, "slider");
  const auto [offset, relative_velocity] = at.start(slider, options.start, equation.slid_force());
  equation.begin(offset, relative_velocity);
  CycleMeter meter(slider, options.tolerance);
  meter.add(sample_of(equation));
  const double longest = options.max_cycles * at.slow_cycle(slider);
  SliderMotion motion;
  while (true) {
    equation.advance();
    at.check_velocity(equation.relative_velocity() + slider.velocity, slider, "the motion reaches");
    meter.add(sample_of(equation));
    if (meter.steady() || meter.repeats()) {
      motion.converged = true;
      break;
    }
    if (equation.time() > longest ||
        meter.cycles().size() > static_cast<std::size_t>(options.max_cycles))
      break;
    const auto done = static_cast<int>(meter.cycles().size());
    watch.passed(
        equation.steps(),
        std::max(equation.time() / longest, static_cast<double>(done) / options.max_cycles), done);
  }
  if (meter.steady()) {
    motion.state = SliderState::steady;
    motion.slider_amplitude = motion.slider_amplitude_error = 0;
    const Sample begin = sample_of(equation);
    const double until = equation.time() + meter.slow_period();
    double lowest = equation.offset();
    while (equation.time() < until) {
      equation.advance();
      watch.passed(equation.steps(), 1);
      lowest = std::min(lowest, equation.offset());
    }
    motion.max_spring_force = -slider.spring_stiffness * lowest;
    set_means(motion, at, begin, sample_of(equation));
    record(motion, equation, slider, 3 * meter.slow_period(), watch);
    return motion;
  }
  motion.cycles = static_cast<int>(meter.kept());
  if (meter.cycles().empty()) return motion;
  motion.slider_amplitude = 0.5 * meter.range();
  motion.slider_amplitude_error = meter.drift() * motion.slider_amplitude;
  motion.slider_period = meter.period();
  motion.max_spring_force = -slider.spring_stiffness * meter.lowest();
  motion.state = meter.stuck_time() > 0 ? SliderState::stick_slip : SliderState::pulsating;
  set_means(motion, at, meter.begin().sample, meter.end().sample);
  record(motion, equation, slider, 3 * motion.slider_period, watch);
  return motion;
}

// Maps (x − Vt, ẋ − V) at one minimum of the indentation to the same quantities one period of the
// oscillation later, by the full equation of motion.
struct PeriodMap {
  SliderEquation& equation;
  Watch& watch;

  std::array<double, 2> operator()(double offset, double relative_velocity) const {
    equation.begin(offset, relative_velocity);
    equation.advance();
    watch.passed(equation.steps(), 0);
    return {equation.offset(), equation.relative_velocity()};
  }
};

// Jacobian matrix of a PeriodMap by central differences. The map is smooth, except that the second
// derivatives of the friction force jump.
struct Jacobian {
  double a, b, c, d;  // elements, row by row
  double determinant() const { return a * d - b * c; }
  double radius() const {
    const double half = 0.5 * (a + d), square = half * half - determinant();
    if (square < 0) return std::sqrt(determinant());
    return std::abs(half) + std::sqrt(square);
  }
};
Jacobian jacobian(const PeriodMap& map, double offset, double relative_velocity, double length,
                  double velocity) {
  const double dx = 1e-3 * length, dv = 1e-3 * velocity;
  const auto right = map(offset + dx, relative_velocity),
             left = map(offset - dx, relative_velocity);
  const auto up = map(offset, relative_velocity + dv), down = map(offset, relative_velocity - dv);
  return {(right[0] - left[0]) / (2 * dx), (up[0] - down[0]) / (2 * dv),
          (right[1] - left[1]) / (2 * dx), (up[1] - down[1]) / (2 * dv)};
}

// Amplitude of the first harmonic of the tangential force if all springs slip all the time, divided
// by (μK/K_t)u_z, N/m. This is a weighted mean of K_t over the cycle.
double sliding_stiffness(const SliderContact& contact) {
  // The integrand is a smooth, even and periodic function of the phase, for which the trapezoidal
  // rule is exact to round-off.
  constexpr int nodes = 64;
  double sum = 0;
  for (int i = 1; i < nodes; ++i) {
    const double phase = pi * i / nodes;
    sum += std::pow(std::sin(phase), 2) *
           contact.law.tangential_stiffness(contact.indentation +
                                            contact.normal_amplitude * std::cos(phase));
  }
  return 2 * sum / nodes;
}

// The error of SteadySliding::sliding_damping, explained at slider_stability().
double damping_error(const Case& at, const Slider& slider, double friction_coefficient) {
  const double damping = at.sliding.sliding_damping;
  if (!(damping > 0)) return 0;
  const double omega = at.contact.angular_frequency;
  const double f = at.sliding.low_speed_damping / (pi * slider.mass * omega);
  const double angle = 2 * pi * std::sqrt(f);
  if (!(angle < 0.5 * pi)) return SliderStability::unknown;
  const double more = damping * (-2 * std::log(std::cos(angle)) / (angle * angle) - 1);
  const double yielding =
      std::min(sliding_stiffness(at.contact) / (slider.mass * omega * omega), 0.999);
  const double velocities[] = {slider.velocity / (1 - yielding)};
  const double faster = detail::steady_sliding_about(at.contact.law, at.contact.indentation,
                                                     {at.contact.normal_amplitude, omega},
                                                     velocities, friction_coefficient)
                            .front()
                            .sliding_damping;
  const double slow = natural_frequency(slider) / omega;
  // The factor 1.1 allows for terms of higher order.
  return 1.1 * std::max(more, damping - faster) + pi * pi / 3 * slow * slow * damping;
}

// The smallest argument in (low, high] at which the function `excess` reaches 0. NaN if there is
// none, or if excess(low) >= 0, since the smallest argument is then below `low`.
double first_reached(const std::function<double(double)>& excess, double low, double high) {
  constexpr double ratio = 1.05;
  constexpr int most = 2000;  // 2000 steps cover 42 decades
  double before = low, position = low;
  for (int k = 0; k < most && position < high; ++k) {
    position = std::min(ratio * position, high);
    if (excess(position) >= 0) {
      if (before == low && !(excess(low) < 0)) break;
      return detail::find_root(excess, before, position);
    }
    before = position;
  }
  return SliderThreshold::unknown;
}

// A slider on a contact. The normal oscillation that is to stabilise its sliding is not included.
struct SlidingPair {
  const ContactLaw& law;
  const OperatingPoint& point;
  const Slider& slider;
  double friction_coefficient;
  const SliderOptions& options;
};

// Threshold of stable sliding in a quantity that normal_of() turns into a normal oscillation, for
// example its amplitude. The search begins at `low`; the contact never sticks below `low`.
SliderThreshold threshold(const SlidingPair& pair, double low, double high,
                          const std::function<NormalOscillation(double)>& normal_of) {
  const ContactLaw& law = pair.law;
  const OperatingPoint& point = pair.point;
  const Slider& slider = pair.slider;
  const double friction_coefficient = pair.friction_coefficient;
  const SliderOptions& options = pair.options;
  const double needed = slider.falling_slope - slider.support_damping;
  SliderThreshold threshold;
  if (!(low < high)) return threshold;
  const auto estimate = [&](double errors) {
    return first_reached(
        [&](double position) {
          const Case at(law, point, normal_of(position), slider, friction_coefficient, options);
          const double error = errors != 0 ? damping_error(at, slider, friction_coefficient) : 0;
          // If the error is unknown, the estimate with +error returns its first argument and the
          // estimate with −error finds no threshold.
          if (std::isnan(error)) return errors * needed;
          return at.sliding.sliding_damping + errors * error - needed;
        },
        low, high);
  };
  threshold.linear_estimate = estimate(0);
  const double further = estimate(-1) - threshold.linear_estimate,
               nearer = threshold.linear_estimate - estimate(1);
  threshold.linear_estimate_error =
      std::isnan(nearer) ? SliderThreshold::unknown : std::max(further, nearer);
  threshold.value = first_reached(
      [&](double position) {
        const SliderStability one = slider_stability(law, point, normal_of(position), slider,
                                                     friction_coefficient, options);
        return one.converged ? -one.growth_rate : -needed;
      },
      low, high);
  return threshold;
}

void check_falling(const Slider& slider) {
  require(slider.falling_slope > slider.support_damping, "falling_slope", slider.falling_slope,
          "N s/m must exceed `support_damping`; otherwise sliding is stable without oscillation");
}

// v_c/(u_z ω) = μK/K_t, with the critical velocity v_c = (μK/K_t)u_z ω.
double limit_of_slope(const ContactLaw& law, const OperatingPoint& point,
                      double friction_coefficient) {
  return friction_coefficient / law.stiffness_ratio(indentation_of(law, point));
}

}  // namespace

SliderMotion slider_motion(const ContactLaw& law, const OperatingPoint& point,
                           const NormalOscillation& normal, const Slider& slider,
                           double friction_coefficient, const SliderOptions& options) {
  const Case at(law, point, normal, slider, friction_coefficient, options);
  at.check_cost(SliderEquation::steps_of_period(at.contact, slider, options.steps),
                SliderEquation::period_of(at.contact, slider), slider);
  const auto motion_with = [&](int steps) {
    SliderEquation equation(at.contact, slider, steps);
    return follow(equation, at, slider, options);
  };
  constexpr int max_halvings = 4;
  SliderMotion coarse = motion_with(options.steps);
  for (int halving = 1;; ++halving) {
    SliderMotion fine = motion_with(options.steps << halving);
    const bool same = fine.state == coarse.state;
    // The error of the steps is of second order: a third of the difference between the coarse and
    // the fine solution remains in the fine one.
    const double difference = std::abs(fine.slider_amplitude - coarse.slider_amplitude);
    fine.slider_amplitude_error += difference / 3;
    const bool close = same && difference <= options.tolerance * fine.slider_amplitude;
    if (close || halving == max_halvings || !fine.converged) {
      fine.converged = fine.converged && close;
      return fine;
    }
    coarse = std::move(fine);
  }
}

SliderMotion averaged_slider_motion(const ContactLaw& law, const OperatingPoint& point,
                                    const NormalOscillation& normal, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options) {
  const Case at(law, point, normal, slider, friction_coefficient, options);
  constexpr double parts = 256;  // advance() covers 1/256 of a slow period
  at.check_cost(parts, 2 * pi / natural_frequency(slider), slider);
  AveragedSlider equation(at.contact, at.sliding, friction_coefficient, slider);
  return follow(equation, at, slider, options);
}

SliderStability slider_stability(const ContactLaw& law, const OperatingPoint& point,
                                 const NormalOscillation& normal, const Slider& slider,
                                 double friction_coefficient, const SliderOptions& options) {
  const Case at(law, point, normal, slider, friction_coefficient, options);
  SliderStability result;
  result.sliding_damping = at.sliding.sliding_damping;
  result.sliding_damping_error = damping_error(at, slider, friction_coefficient);
  const double support = slider.support_damping - slider.falling_slope;
  const double natural = natural_frequency(slider);
  const double decay = 0.5 * (result.sliding_damping + support) / slider.mass;
  const double square = decay * decay - natural * natural;
  result.averaged_growth_rate = -decay + (square > 0 ? std::sqrt(square) : 0);

  SliderEquation equation(at.contact, slider, 4 * options.steps);
  Watch watch(options.on_progress, "stability");
  const PeriodMap map{equation, watch};
  double offset = at.spring_offset, relative_velocity = 0;
  constexpr int max_iterations = 20;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Jacobian j =
        jacobian(map, offset, relative_velocity, slider.velocity / natural, slider.velocity);
    const auto [next_offset, next_velocity] = map(offset, relative_velocity);
    if (!(equation.min_velocity() > 0)) return result;
    const double left = offset - next_offset, left_velocity = relative_velocity - next_velocity;
    const double determinant = (j.a - 1) * (j.d - 1) - j.b * j.c;
    const double step = ((j.d - 1) * left - j.b * left_velocity) / determinant;
    const double velocity_step = ((j.a - 1) * left_velocity - j.c * left) / determinant;
    offset += step, relative_velocity += velocity_step;
    if (std::abs(velocity_step) > 1e-6 * slider.velocity ||
        std::abs(step) > 1e-6 * slider.velocity / natural)
      continue;
    result.converged = true;
    result.growth_rate = std::log(j.radius()) / equation.period();
    if (j.determinant() > 0)
      result.slider_damping =
          -slider.mass * std::log(j.determinant()) / equation.period() - support;
    return result;
  }
  return result;
}

SliderThreshold threshold_amplitude(const ContactLaw& law, const OperatingPoint& point,
                                    const NormalOscillation& last, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options) {
  check(last, slider, friction_coefficient, options);
  check_falling(slider);
  const double low =
      slider.velocity / last.angular_frequency / limit_of_slope(law, point, friction_coefficient);
  return threshold(
      {law, point, slider, friction_coefficient, options}, low, last.normal_amplitude,
      [&](double amplitude) { return NormalOscillation{amplitude, last.angular_frequency}; });
}

SliderThreshold threshold_angular_frequency(const ContactLaw& law, const OperatingPoint& point,
                                            const NormalOscillation& last, const Slider& slider,
                                            double friction_coefficient,
                                            const SliderOptions& options) {
  require_positive(last.normal_amplitude, "normal_amplitude");
  check(last, slider, friction_coefficient, options);
  check_falling(slider);
  const double touch =
      slider.velocity / last.normal_amplitude / limit_of_slope(law, point, friction_coefficient);
  // A lower frequency than about four times the natural frequency would not average the friction.
  const double low = std::max(touch, 4.01 * natural_frequency(slider));
  return threshold(
      {law, point, slider, friction_coefficient, options}, low, last.angular_frequency,
      [&](double frequency) { return NormalOscillation{last.normal_amplitude, frequency}; });
}

}  // namespace salebra
