// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

/// A slider on a spring: stick–slip, and the normal oscillation that suppresses it.
namespace salebra {

/// A mass m that a spring k and a dashpot c in parallel with it drag at constant velocity V over a
/// contact, whose friction force T may be given a falling part −bẋ:
///     m ẍ + c(ẋ − V) − bẋ + k(x − Vt) + T = 0.
/// The dashpot is that of the support, as in the model of a mass on a moving belt: it carries no
/// force in steady sliding.
struct Slider {
  double mass = 0;              ///< m > 0, kg
  double spring_stiffness = 0;  ///< k > 0, N/m
  double velocity = 0;          ///< V > 0 of the drive, m/s
  double support_damping = 0;   ///< c >= 0, N s/m
  double falling_slope = 0;     ///< b >= 0, N s/m
};

constexpr void describe(auto&& visit, std::type_identity<Slider>) {
  using enum Dimension;
  using S = Slider;
  visit(&S::mass, Quantity{"mass", Dimension::mass, "mass of the oscillator"});
  visit(&S::spring_stiffness,
        Quantity{"spring_stiffness", stiffness, "stiffness of the spring, without the contact"});
  visit(&S::velocity, Quantity{"velocity", Dimension::velocity, "sliding velocity"});
  visit(&S::support_damping, Quantity{"support_damping", damping,
                                      "damping constant of the dashpot parallel to the spring"});
  visit(&S::falling_slope,
        Quantity{"falling_slope", damping, "decrease of friction with velocity"});
}

enum class SliderStart {
  rest,    ///< at rest, dragged to the point of slipping
  sliding  ///< steady sliding with a velocity that is 1 % too low: shows whether small disturbances
           ///< grow
};

template <>
struct Words<SliderStart> {
  static constexpr auto values = std::to_array<std::pair<SliderStart, std::string_view>>(
      {{SliderStart::rest, "rest"}, {SliderStart::sliding, "sliding"}});
};

/// What the motion ends in.
enum class SliderState {
  steady,     ///< sliding at the velocity of the drive
  pulsating,  ///< the velocity oscillates slowly, without sticking
  stick_slip  ///< with times of sticking
};

template <>
struct Words<SliderState> {
  static constexpr auto values = std::to_array<std::pair<SliderState, std::string_view>>(
      {{SliderState::steady, "steady"},
       {SliderState::pulsating, "pulsating"},
       {SliderState::stick_slip, "stick_slip"}});
};

struct SliderOptions {
  Hold hold = Hold::indentation;  ///< what of the position stays fixed, as in DampingOptions
  SliderStart start = SliderStart::rest;  ///< where the motion begins
  /// >= 16, in a period of the oscillation. More are taken where the slider or the contact's
  /// resonance √(K_t/m) is faster.
  int steps = 32;
  /// Relative, of the amplitude of a slow cycle: between halved steps, and between the cycles that
  /// are averaged. 1e-6 … 0.5.
  double tolerance = 1e-2;
  int most_cycles = 200;      ///< > 0, slow periods 2π√(m/k), after which the motion is given up
  Progress on_progress = {};  ///< of all functions here; a stop throws Interrupted
};

/// The motion in which a slider ends. Means are over whole slow cycles, from one largest stretch of
/// the spring to the next; of steady sliding over one slow period.
struct SliderMotion {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  SliderState state = SliderState::steady;
  double slider_amplitude = unknown;  ///< half the range of x − Vt in a slow cycle, m; 0: steady
  double slider_amplitude_error = unknown;  ///< m: halved steps, and the spread of the cycles
  double slider_period = unknown;           ///< of a slow cycle, s; NaN: steady
  /// Part of the time in which not all levels slip in a normal period, so that the contact as a
  /// whole stays where it is.
  double stuck_fraction = unknown;
  double mean_tangential_force = unknown;  ///< of T, N, without the falling part
  double friction_coefficient = unknown;   ///< that over the mean normal force
  double max_spring_force = unknown;       ///< k(Vt − x) in a slow cycle, N
  double drive_power = unknown;            ///< what the drive puts in, W
  double contact_power = unknown;          ///< lost by the contact's levels, W
  double support_power = unknown;          ///< lost in the dashpot, W
  double falling_slope_power = unknown;    ///< b⟨ẋ²⟩, by which friction loses less, W
  /// What the balance of these and of the stored energy leaves, over drive_power: error of the
  /// steps.
  double energy_error = unknown;
  int cycles = 0;          ///< slow cycles that were averaged
  bool converged = false;  ///< whether a motion that repeats was found, to the tolerance
  /// Some last cycles, where δ is least.
  std::vector<double> time;              ///< s
  std::vector<double> slider_offset;     ///< x − Vt, m
  std::vector<double> slider_velocity;   ///< ẋ, m/s
  std::vector<double> tangential_force;  ///< T, N; of the averaged equation its mean T̄
};

constexpr void describe(auto&& visit, std::type_identity<SliderMotion>) {
  using enum Dimension;
  using S = SliderMotion;
  visit(&S::state,
        Quantity{"state", dimensionless,
                 "sliding at the velocity of the drive, slowly pulsating, or stick-slip"});
  visit(&S::slider_amplitude,
        Quantity{"slider_amplitude", length,
                 "half the range of the displacement from the drive's in a slow cycle"});
  visit(&S::slider_amplitude_error,
        Quantity{"slider_amplitude_error", length, "numerical error of slider_amplitude"});
  visit(&S::slider_period, Quantity{"slider_period", Dimension::time, "period of a slow cycle"});
  visit(&S::stuck_fraction,
        Quantity{"stuck_fraction", dimensionless, "part of the time in which the slider sticks"});
  visit(&S::mean_tangential_force,
        Quantity{"mean_tangential_force", force, "tangential force, mean over a cycle"});
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::max_spring_force,
        Quantity{"max_spring_force", force, "largest force of the spring in a slow cycle"});
  visit(&S::drive_power, Quantity{"drive_power", power, "mean power of the drive"});
  visit(&S::contact_power,
        Quantity{"contact_power", power, "mean power dissipated by the contact"});
  visit(&S::support_power,
        Quantity{"support_power", power, "mean power dissipated by the dashpot"});
  visit(&S::falling_slope_power,
        Quantity{"falling_slope_power", power,
                 "mean power by which the falling slope lowers the dissipation"});
  visit(&S::energy_error,
        Quantity{"energy_error", dimensionless, "rest of the energy balance over drive_power"});
  visit(&S::cycles, Kept{"cycles", "slow cycles that were averaged"});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
  visit(&S::time, quantity::time);
  visit(&S::slider_offset, Quantity{"slider_offset", length, "displacement from the drive's"});
  visit(&S::slider_velocity, Quantity{"slider_velocity", velocity, "velocity of the slider"});
  visit(&S::tangential_force, quantity::tangential_force);
}

/// The full equation: T from the contact's levels with the history of each (TangentialContact),
/// step by step until the motion repeats. Steps of second order; the motion is followed with
/// `steps` and twice as many until the amplitude changes by less than the tolerance.
/// normal_oscillation  δ = δ0 − u_z cos ωt; u_z = 0: none, and ω is not used; else ω > 4√(k/m)
/// friction_coefficient  μ > 0, finite
/// throws  InvalidInput as steady_sliding(), where the motion reaches velocities at which −bẋ makes
///         friction negative, and where a period of the oscillation takes more than 500,000 steps
///         or a slow cycle more than 10 million; Interrupted where on_progress says stop
/// cost    some 0.6 µs a step; slow cycles have ω/√(k/m) times `steps` of them, and more the slower
///         the drive
SliderMotion slider_motion(const ContactLaw& law, const Position& position,
                           const NormalOscillation& normal, const Slider& slider,
                           double friction_coefficient, const SliderOptions& options = {});

/// The averaged equation m ẍ + c(ẋ − V) − bẋ + k(x − Vt) + T̄(ẋ) = 0 with T̄ of steady_sliding(),
/// |T| <= μF(δ_min) at rest: the limit of √(k/m) << √(K_t/m) << ω of the full one. Solved by
/// Runge–Kutta steps of order 8 between sticking and slipping, which are located.
SliderMotion averaged_slider_motion(const ContactLaw& law, const Position& position,
                                    const NormalOscillation& normal, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options = {});

/// What becomes of a small disturbance of steady sliding.
struct SliderStability {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double sliding_damping = unknown;  ///< dT̄/dv at V, by steady_sliding(), N s/m
  /// Difference of sliding_damping from slider_damping, N s/m: what the mass does within a period.
  /// NaN: too much for an estimate.
  double sliding_damping_error = unknown;
  /// What has to take the place of dT̄/dv for the mass and the spring alone to have the full
  /// equation's growth, N s/m; NaN where K_t/m is so large that the contact swings within a period.
  double slider_damping = unknown;
  double growth_rate = unknown;           ///< of the full equation, 1/s
  double averaged_growth_rate = unknown;  ///< 1/s, of m s² + (dT̄/dv + c − b)s + k; < 0: it dies
                                          ///< out
  bool converged =
      false;  ///< false: no steady sliding without turning back was found; growth_rate is NaN

  /// Whether small disturbances die out; empty where growth_rate is not known.
  std::optional<bool> stable() const {
    return converged ? std::optional(growth_rate < 0) : std::nullopt;
  }
};

constexpr void describe(auto&& visit, std::type_identity<SliderStability>) {
  using enum Dimension;
  using S = SliderStability;
  visit(&S::sliding_damping, Quantity{"sliding_damping", damping,
                                      "growth of the mean friction force with velocity, dT/dv"});
  visit(&S::sliding_damping_error, Quantity{"sliding_damping_error", damping,
                                            "error of sliding_damping by the slider's mass"});
  visit(&S::slider_damping,
        Quantity{"slider_damping", damping, "sliding_damping of the full equation of motion"});
  visit(&S::growth_rate, Kept{"growth_rate", "growth of a disturbance by the full equation, 1/s"});
  visit(&S::averaged_growth_rate,
        Kept{"averaged_growth_rate", "growth of a disturbance by the averaged equation, 1/s"});
  visit(&S::converged, Kept{"converged", "false: no sliding without turning back was found"});
  visit(&S::stable, Quantity{"stable", dimensionless, "steady sliding is stable"});
}

/// While the slider never turns back, all levels that touch are at the limit of their stretch
/// whenever δ is least: the state there is (x − Vt, ẋ) and a period of the full equation is a map
/// of two numbers. Its fixed point is steady sliding, its multipliers are the growth. The error of
/// the averaged estimate is that of two effects of the mass, f = Γ/(πmω) in place of K_t/(mω²).
/// Levels that stick for a whole period have −ln cos(2π√f)/(2π²f) times the damping. The mass
/// yields to the oscillating friction, so that V is V/(1 − f) to what decides on sticking. To the
/// larger of both (π²/3)(k/m)/ω² of the damping are added.
/// throws  InvalidInput as slider_motion()
/// cost    some ten periods of the full equation with 4 `steps`
SliderStability slider_stability(const ContactLaw& law, const Position& position,
                                 const NormalOscillation& normal, const Slider& slider,
                                 double friction_coefficient, const SliderOptions& options = {});

/// The least amplitude, m, or angular frequency, rad/s, of the normal oscillation at which small
/// disturbances of sliding die out.
struct SliderThreshold {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double value = unknown;  ///< of the full equation; NaN: none in the range, or one below it
  double linear_estimate = unknown;  ///< where dT̄/dv + c = b; NaN as value
  /// How far linear_estimate moves with the error of dT̄/dv (SliderStability). NaN: out of the
  /// range.
  double linear_estimate_error = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<SliderThreshold>) {
  using S = SliderThreshold;
  visit(&S::value, Kept{"value", "threshold of the full equation"});
  visit(&S::linear_estimate, Kept{"linear_estimate", "threshold where dT/dv + c = b"});
  visit(&S::linear_estimate_error,
        Kept{"linear_estimate_error", "error of linear_estimate by the slider's mass"});
}

/// Thresholds that were looked for.
struct SliderThresholds {
  std::optional<SliderThreshold> amplitude = {};  ///< of the normal oscillation at its frequency, m
  std::optional<SliderThreshold> frequency = {};  ///< at its amplitude, Hz
};

constexpr void describe(auto&& visit, std::type_identity<SliderThresholds>) {
  using S = SliderThresholds;
  visit(&S::amplitude, Quantity{"threshold_amplitude", Dimension::length,
                                "minimum normal amplitude at which sliding is stable"});
  visit(&S::frequency,
        Quantity{"threshold_frequency", Dimension::frequency,
                 "minimum frequency of the normal oscillation at which sliding is stable"});
}

/// Both look upwards from where v_c = V, below which nothing sticks, in ratios of 1.05, and
/// frequencies from 4.01 of the slider's natural one, below which an oscillation does not average. The
/// estimate has an upper end too, for Γ falls with either.
/// last    the oscillation at the end of the range: the largest amplitude, or the largest frequency
/// throws  InvalidInput as slider_motion(), and where b <= c, which needs no oscillation
/// cost    slider_stability() and steady_sliding() some tens to hundreds of times
SliderThreshold threshold_amplitude(const ContactLaw& law, const Position& position,
                                    const NormalOscillation& last, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options = {});
SliderThreshold threshold_angular_frequency(const ContactLaw& law, const Position& position,
                                            const NormalOscillation& last, const Slider& slider,
                                            double friction_coefficient,
                                            const SliderOptions& options = {});

}  // namespace salebra
