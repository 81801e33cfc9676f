// SPDX-License-Identifier: GPL-3.0-or-later
// Mean friction of a contact that slides steadily under a normal oscillation.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <span>
#include <vector>

#include "max_motion.hpp"
#include "mean_rise.hpp"
#include "sweep_breaks.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

// One period of steady sliding in dimensionless form, the same for springs of all depths. φ is the
// phase since the smallest indentation, and r = v/v_c.
class Period {
 public:
  explicit Period(double ratio) : ratio_(ratio), sticks_from_(std::asin(std::min(ratio, 1.0))) {}

  // Springs that touch between these two phases stick at first.
  double sticks_from() const { return sticks_from_; }
  double sticks_to() const { return pi - sticks_from_; }

  double ratio() const { return ratio_; }

  // Phase φ_e at which a spring that touched and stuck at the phase `start` begins to slip: −cosφ −
  // rφ is the same at both phases.
  double slips_at(double start) const {
    const double high = 2 * pi - start;
    return slips_at(start, high - (high - start) * std::min(ratio_, 0.5));
  }

  // Finds the same phase by Newton's method from a guess, within bounds.
  double slips_at(double start, double guess) const {
    const auto lead = [&](double phase) {
      return 2 * std::sin(0.5 * (phase + start)) * std::sin(0.5 * (phase - start)) -
             ratio_ * (phase - start);
    };
    double low = sticks_to(), high = 2 * pi - start, phase = guess;
    if (!(lead(low) > 0)) return low;
    for (int iteration = 0; iteration < 100; ++iteration) {
      if (!(phase > low && phase < high)) phase = 0.5 * (low + high);
      const double value = lead(phase);
      (value > 0 ? low : high) = phase;
      const double slope = std::sin(phase) - ratio_, step = value / slope;
      phase -= step;
      // After a step the remaining error is at most step²/(2|slope|), since |cosφ| bounds the
      // second derivative of −cosφ − rφ.
      if (!(step * step > 1e-16 * std::abs(slope)) || !(high - low > 1e-15 * high)) break;
    }
    return std::clamp(phase, low, high);
  }

  // Mean over the period of (m − δ_min)/u_z. Springs of depth ζ that never open have the stretch
  // (μK/K_t)(m − ζ).
  double mean_rise() const {
    if (ratio_ >= 1) return 1;
    const double end = slips_at(sticks_from_), stuck = end - sticks_from_;
    const double slides = 2 * pi - stuck - (std::sin(sticks_from_) - std::sin(end));
    const double sticks =
        2 * std::pow(std::sin(0.5 * sticks_from_), 2) * stuck + 0.5 * ratio_ * stuck * stuck;
    return (slides + sticks) / (2 * pi);
  }

 private:
  double ratio_, sticks_from_;
};

// K and K_t at a phase of the oscillation.
struct PhaseState {
  double phase, sine, normal_stiffness, tangential_stiffness;
};

// Gauss–Kronrod rule of 7 points, exact for polynomials up to degree 11, with the weights of the
// Gauss rule of 3 points that it contains.
constexpr int rule_points = 7;
constexpr double rule_point[rule_points] = {
    -0.960491268708020283, -0.774596669241483377, -0.434243749346802558, 0,
    0.434243749346802558,  0.774596669241483377,  0.960491268708020283};
constexpr double rule_weight[rule_points] = {
    0.104656226026467265, 0.268488089868333440, 0.401397414775962222, 0.450916538658474142,
    0.401397414775962222, 0.268488089868333440, 0.104656226026467265};
constexpr double gauss_rule_weight[rule_points] = {0, 5.0 / 9, 0, 8.0 / 9, 0, 5.0 / 9, 0};

// A contact law over half an oscillation δ = δ_min + u_z(1 − cosφ), 0 <= φ <= π, evaluated at nodes
// that all velocities use.
class HalfPeriod {
 public:
  HalfPeriod(const ContactLaw& law, double low, double amplitude)
      : law_(law), low_(low), amplitude_(amplitude) {
    breaks_.push_back(0);
    // Computes half angles by arctan, because arccos loses half the digits near 0 and π.
    const double high = low + 2 * amplitude;
    for (const double point : detail::sweep_breaks(law, low, high)) {
      const double phase = 2 * std::atan2(std::sqrt(std::max(point - low, 0.0)),
                                          std::sqrt(std::max(high - point, 0.0)));
      if (phase > breaks_.back()) breaks_.push_back(phase);
    }
    if (pi > breaks_.back()) breaks_.push_back(pi);
    for (std::size_t i = 1; i < breaks_.size(); ++i)
      for (const PhaseState& node : nodes_between(breaks_[i - 1], breaks_[i]))
        nodes_.push_back(node);
  }

  // Calls add(nodes, from, to) for each piece of 0 <= φ <= π. The pieces are divided at break
  // points of the law and at the two phases between which springs stick.
  template <class Add>
  void for_each_piece(const Period& period, const Add& add) const {
    for (std::size_t i = 1; i < breaks_.size(); ++i) {
      const double begin = breaks_[i - 1], end = breaks_[i];
      double from = begin;
      for (const double cut : {period.sticks_from(), period.sticks_to()})
        if (cut > from && cut < end) {
          add(nodes_between(from, cut), from, cut);
          from = cut;
        }
      if (from == begin)
        add(std::span(nodes_).subspan((i - 1) * rule_points, rule_points), begin, end);
      else
        add(nodes_between(from, end), from, end);
    }
  }

  std::array<PhaseState, rule_points> nodes_between(double from, double to) const {
    std::array<PhaseState, rule_points> nodes;
    for (std::size_t j = 0; j < rule_points; ++j) {
      const double phase = 0.5 * (from + to) + 0.5 * (to - from) * rule_point[j];
      const double level = low_ + 2 * amplitude_ * std::pow(std::sin(0.5 * phase), 2);
      nodes[j] = {phase, std::sin(phase), law_.normal_stiffness(level),
                  law_.tangential_stiffness(level)};
    }
    return nodes;
  }

 private:
  const ContactLaw& law_;
  double low_, amplitude_;
  std::vector<double> breaks_;
  std::vector<PhaseState> nodes_;
};

// Contribution of one phase: the friction force above μF(δ_min), and its derivative with respect to
// the velocity v, both times 2π.
struct PhaseShare {
  double force, damping;
};

// Integrals of both contributions over a piece of the phase, with the error of the force.
struct PhasePiece {
  double from, to, value, error, damping;
};

// Computes the contributions (PhaseShare) at one velocity.
struct Shares {
  const Period& period;
  double limit_scale, velocity, omega;

  PhaseShare of(const PhaseState& node, double slips_at) const {
    const double limit = limit_scale * node.normal_stiffness * node.sine;
    if (!(node.phase > period.sticks_from() && node.phase < period.sticks_to()))
      return {limit * 2 * (pi - node.phase), 0};
    const double stuck = slips_at - node.phase, r = period.ratio();
    return {limit * (2 * pi - node.phase - slips_at) +
                velocity / omega * node.tangential_stiffness * stuck,
            node.tangential_stiffness / omega * stuck *
                (1 + (node.sine - r) / (r - std::sin(slips_at)))};
  }

  PhasePiece over(std::span<const PhaseState> nodes, double from, double to) const {
    double values[rule_points], kronrod = 0, gauss = 0, damping = 0, before = 0, slipped = 0;
    for (int j = 0; j < rule_points; ++j) {
      const PhaseState& node = nodes[static_cast<std::size_t>(j)];
      double slips = 0;
      if (node.phase > period.sticks_from() && node.phase < period.sticks_to()) {
        // From the second node on, the guess uses the slope dφ_e/dφ of the phase at which springs
        // slip.
        slips = before > 0 ? period.slips_at(node.phase,
                                             slipped + (std::sin(before) - period.ratio()) /
                                                           (std::sin(slipped) - period.ratio()) *
                                                           (node.phase - before))
                           : period.slips_at(node.phase);
        before = node.phase, slipped = slips;
      }
      const PhaseShare share = of(node, slips);
      values[j] = share.force;
      kronrod += rule_weight[j] * share.force;
      gauss += gauss_rule_weight[j] * share.force;
      damping += rule_weight[j] * share.damping;
    }
    double spread = 0;
    for (int j = 0; j < rule_points; ++j)
      spread += rule_weight[j] * std::abs(values[j] - 0.5 * kronrod);
    // The difference of the two rules is the error of the Gauss rule. Divided by the spread of the
    // integrand and raised to the power 3/2, it estimates the error of the Kronrod rule (QUADPACK).
    const double part = spread > 0 ? 200 * std::abs(kronrod - gauss) / spread : 0;
    const double half_width = 0.5 * (to - from);
    return {from, to, half_width * kronrod,
            half_width * spread * std::min(1.0, part * std::sqrt(part)), half_width * damping};
  }
};

struct Force {
  double value = 0, error = 0, damping = 0;
  bool converged = true;
};

// ∫_0^π of the contributions over 2π. Starts with the pieces of the law at the nodes that all
// velocities use, then halves the piece with the largest error until the sum of the errors reaches
// the tolerance. A spring that touches at φ near 0 begins to slip at φ_e ≈ 2π − √(φ² + 4πr) if the
// velocity ratio r = v/v_c is small; this function bends more than any law.
Force force_above_min(const HalfPeriod& half, const Shares& shares, double tolerance) {
  std::vector<PhasePiece> pieces;
  half.for_each_piece(shares.period,
                      [&](std::span<const PhaseState> nodes, double from, double to) {
                        pieces.push_back(shares.over(nodes, from, to));
                      });
  std::ranges::make_heap(pieces, {}, &PhasePiece::error);
  Force force;
  double size = 0;
  for (const PhasePiece& piece : pieces) size += std::abs(piece.value), force.error += piece.error;
  constexpr std::size_t max_pieces = 10'000;
  while (force.error > tolerance * size && pieces.size() < max_pieces) {
    std::ranges::pop_heap(pieces, {}, &PhasePiece::error);
    const PhasePiece worst = pieces.back();
    pieces.pop_back();
    force.error -= worst.error;
    const double middle = 0.5 * (worst.from + worst.to);
    for (const auto& [from, to] : {std::pair(worst.from, middle), std::pair(middle, worst.to)}) {
      pieces.push_back(shares.over(half.nodes_between(from, to), from, to));
      force.error += pieces.back().error;
      std::ranges::push_heap(pieces, {}, &PhasePiece::error);
    }
  }
  force.error = 0;
  for (const PhasePiece& piece : pieces) {
    force.value += piece.value;
    force.error += piece.error;
    force.damping += piece.damping;
  }
  force.converged = force.error <= tolerance * size;
  return {force.value / (2 * pi), force.error / (2 * pi), force.damping / (2 * pi),
          force.converged};
}

void check(std::span<const double> velocities, double friction_coefficient) {
  require(std::isfinite(friction_coefficient) && friction_coefficient >= 0, "friction_coefficient",
          friction_coefficient, "must be finite and >= 0");
  for (const double velocity : velocities) require_positive(velocity, "drag_velocity");
}

// stuck: result for the same oscillation without slip.
std::vector<SteadySliding> sliding_of(const DampingResult& stuck, const ContactLaw& law,
                                      const NormalOscillation& normal,
                                      std::span<const double> velocities,
                                      double friction_coefficient, double tolerance) {
  const double amplitude = normal.normal_amplitude, omega = normal.angular_frequency;
  const double low = stuck.indentation - amplitude;
  const double stiffness_ratio = law.stiffness_ratio(stuck.indentation);
  SteadySliding common;
  common.indentation = stuck.indentation;
  common.mean_force = stuck.mean_force;
  common.relaxation_damping = stuck.damping_constant;
  // Velocity at which the friction limit of a spring falls fastest in a cycle; while the bodies
  // touch, it may fall more slowly.
  const double limit = friction_coefficient / stiffness_ratio, fastest = limit * amplitude * omega;
  common.critical_velocity =
      limit * omega * detail::fastest_opening(law, stuck.indentation, amplitude);
  const double min_friction = friction_coefficient * law.force(low);
  common.static_friction_coefficient = min_friction / common.mean_force;
  if (amplitude > 0)
    common.low_speed_damping =
        common.relaxation_damping + pi * law.tangential_stiffness(low) / omega;

  std::optional<HalfPeriod> half;
  std::vector<SteadySliding> all;
  all.reserve(velocities.size());
  for (const double velocity : velocities) {
    SteadySliding& result = all.emplace_back(common);
    const Period period(velocity / fastest);
    if (velocity >= common.critical_velocity) {
      result.mean_tangential_force = friction_coefficient * common.mean_force;
      result.sliding_damping = 0;
      result.error_estimate = 1e-12 * result.mean_tangential_force;
      result.converged = stuck.converged;
    } else {
      if (!half) half.emplace(law, low, amplitude);
      const Force force = force_above_min(
          *half, {period, friction_coefficient * amplitude, velocity, omega}, tolerance);
      result.mean_tangential_force = min_friction + force.value;
      result.sliding_damping = force.damping;
      result.error_estimate = force.error;
      result.converged = force.converged && stuck.converged;
    }
    const double travel = 2 * pi * velocity / omega;
    const double rise = amplitude > 0 ? amplitude * period.mean_rise() : 0;
    result.slip_work =
        travel * (min_friction + friction_coefficient * law.normal_stiffness(low) * rise);
    result.relaxation_work = travel * result.mean_tangential_force - result.slip_work;
    result.friction_coefficient = result.mean_tangential_force / result.mean_force;
  }
  return all;
}

}  // namespace

double detail::mean_rise(double velocity_ratio) { return Period(velocity_ratio).mean_rise(); }

std::vector<SteadySliding> steady_sliding(const ContactLaw& law, const OperatingPoint& point,
                                          const NormalOscillation& normal,
                                          std::span<const double> velocities,
                                          double friction_coefficient,
                                          const DampingOptions& options) {
  check(velocities, friction_coefficient);
  if (velocities.empty()) return {};
  DampingOptions exact = options;
  exact.amplitude = Amplitude::finite;
  const DampingResult stuck = relaxation_damping(
      law, point, Drag{normal.normal_amplitude, velocities.front(), normal.angular_frequency},
      exact);
  return sliding_of(stuck, law, normal, velocities, friction_coefficient, options.tolerance);
}

std::vector<SteadySliding> detail::steady_sliding_about(const ContactLaw& law,
                                                        double mean_indentation,
                                                        const NormalOscillation& normal,
                                                        std::span<const double> velocities,
                                                        double friction_coefficient) {
  check(velocities, friction_coefficient);
  if (velocities.empty()) return {};
  const double tolerance = DampingOptions{}.tolerance;
  const Drag first{normal.normal_amplitude, velocities.front(), normal.angular_frequency};
  const DampingResult stuck = damping_about(law, mean_indentation, first, tolerance);
  return sliding_of(stuck, law, normal, velocities, friction_coefficient, tolerance);
}

SteadySliding steady_sliding(const ContactLaw& law, const OperatingPoint& point, const Drag& motion,
                             double friction_coefficient, const DampingOptions& options) {
  const double velocities[] = {motion.drag_velocity};
  return steady_sliding(law, point,
                        NormalOscillation{motion.normal_amplitude, motion.angular_frequency},
                        velocities, friction_coefficient, options)
      .front();
}

}  // namespace salebra
