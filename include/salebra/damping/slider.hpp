// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

/// A slider on a spring: stick–slip, and its suppression by a normal oscillation.
namespace salebra {

/// A mass m that a spring k and a parallel dashpot c pull at the constant velocity V over a contact
/// with the friction force T. A part −bẋ that falls with velocity may be added to the friction
/// force:
///     m ẍ + c(ẋ − V) − bẋ + k(x − Vt) + T = 0.
/// x is the position of the mass. The dashpot belongs to the support, as in the model of a mass on
/// a moving belt: it carries no force in steady sliding.
struct Slider {
  double mass = 0;              ///< m > 0, kg
  double spring_stiffness = 0;  ///< k > 0, N/m
  double velocity = 0;          ///< velocity V > 0 of the drive (far end of the spring), m/s
  double support_damping = 0;   ///< dashpot constant c >= 0, N s/m
  double falling_slope = 0;     ///< slope b >= 0 of the falling part of the friction force, N s/m
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
  rest,    ///< at rest, with the spring stretched to the point of slipping
  sliding  ///< steady sliding, but 1 % too slow: shows whether small disturbances grow
};

template <>
struct EnumNames<SliderStart> {
  static constexpr auto values = std::to_array<std::pair<SliderStart, std::string_view>>(
      {{SliderStart::rest, "rest"}, {SliderStart::sliding, "sliding"}});
};

/// The final state of the motion.
enum class SliderState {
  steady,     ///< sliding at the velocity of the drive
  pulsating,  ///< the velocity oscillates slowly, without sticking
  stick_slip  ///< the slider sticks during part of each slow cycle
};

template <>
struct EnumNames<SliderState> {
  static constexpr auto values = std::to_array<std::pair<SliderState, std::string_view>>(
      {{SliderState::steady, "steady"},
       {SliderState::pulsating, "pulsating"},
       {SliderState::stick_slip, "stick_slip"}});
};

struct SliderOptions {
  Hold hold = Hold::automatic;  ///< mean value that the oscillation keeps, as in DampingOptions
  SliderStart start = SliderStart::rest;  ///< initial state
  /// Steps per period of the normal oscillation, >= 16. More are taken if the natural frequency of
  /// the slider, or its resonance √(K_t/m) on the contact stiffness, is faster than the
  /// oscillation.
  int steps = 32;
  /// Relative tolerance of the amplitude of a slow cycle, 1e-6 to 0.5: the amplitude must change by
  /// less when the steps are halved, and from one averaged cycle to the next.
  double tolerance = 1e-2;
  int max_cycles = 200;       ///< > 0: gives up after this many slow periods 2π√(m/k)
  Progress on_progress = {};  ///< for all functions of this header; a stop throws Interrupted
};

/// The final motion of a slider. Means are taken over whole slow cycles, from one maximum of the
/// spring's stretch to another; for steady sliding over one slow period 2π√(m/k).
struct SliderMotion {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  SliderState state = SliderState::steady;
  double slider_amplitude = unknown;  ///< half the range of x − Vt in a slow cycle, m; 0: steady
  double slider_amplitude_error = unknown;  ///< m: from halved steps and the scatter of cycles
  double slider_period = unknown;           ///< period of a slow cycle, s; NaN: steady
  /// Fraction of the time in which the contact as a whole sticks, i.e. in which some of its springs
  /// do not slip during a normal period.
  double stuck_fraction = unknown;
  double mean_tangential_force = unknown;  ///< mean of T, N, without the falling part −bẋ
  double friction_coefficient = unknown;   ///< mean T over the mean normal force
  double max_spring_force = unknown;       ///< maximum of k(Vt − x) in a slow cycle, N
  double drive_power = unknown;            ///< power of the drive, W
  double contact_power = unknown;          ///< power lost by the contact's springs, W
  double support_power = unknown;          ///< power lost in the dashpot, W
  double falling_slope_power = unknown;  ///< b⟨ẋ²⟩, friction loss saved by the part −bẋ, W
  /// Residual of the energy balance of the four powers, divided by drive_power: the error due to
  /// finite steps.
  double energy_error = unknown;
  int cycles = 0;          ///< number of slow cycles averaged
  bool converged = false;  ///< whether the motion repeats to the tolerance
  /// The motion during the last slow cycles, sampled once per normal period, where δ is smallest.
  std::vector<double> time;              ///< s
  std::vector<double> slider_offset;     ///< x − Vt, m
  std::vector<double> slider_velocity;   ///< ẋ, m/s
  std::vector<double> tangential_force;  ///< T, N; for the averaged equation its period mean T̄
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

/// Integrates the full equation of motion of Slider until the motion repeats, with T from the
/// springs of the contact and the history of each spring (TangentialContact). The steps are of
/// second order; their number is doubled, starting from `steps`, until the amplitude of the slow
/// cycle changes by less than the tolerance.
///
///     SliderMotion end = slider_motion(law, at_force(1), {1e-9, 1e6}, {.mass = 1e-3,
///                                      .spring_stiffness = 1e4, .velocity = 1e-5}, 0.3);
///
/// normal_oscillation  δ = δ0 − u_z cos ωt with ω > 4√(k/m); u_z = 0: none, and ω is not used
/// friction_coefficient  μ > 0, finite
/// throws  InvalidInput wherever steady_sliding() does, if the motion reaches velocities at which
///         −bẋ makes the friction force negative, and if a period of the oscillation takes more
///         than 500,000 steps or a slow cycle more than 10 million; Interrupted if on_progress says
///         stop
/// cost    some 0.6 µs per step; a slow cycle has ω/√(k/m) · `steps` steps, and more if the drive
///         is slower
SliderMotion slider_motion(const ContactLaw& law, const OperatingPoint& point,
                           const NormalOscillation& normal, const Slider& slider,
                           double friction_coefficient, const SliderOptions& options = {});

/// Integrates the equation of motion of Slider averaged over a normal period, m ẍ + c(ẋ − V) − bẋ +
/// k(x − Vt) + T̄(ẋ) = 0, with the mean tangential force T̄ of steady_sliding() and |T| <=
/// μF(δ_min) at rest. It is the limit of the full equation for √(k/m) ≪ √(K_t/m) ≪ ω. It is solved
/// by Runge–Kutta steps of order 8; the moments at which sticking begins or ends are located within
/// the steps.
SliderMotion averaged_slider_motion(const ContactLaw& law, const OperatingPoint& point,
                                    const NormalOscillation& normal, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options = {});

/// Growth of a small disturbance of steady sliding.
struct SliderStability {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double sliding_damping = unknown;  ///< dT̄/dv at V, from steady_sliding(), N s/m
  /// Estimated difference between sliding_damping and slider_damping, N s/m, which arises because
  /// the mass moves within a normal period. NaN: too large to estimate.
  double sliding_damping_error = unknown;
  /// The damping constant, N s/m, that must replace dT̄/dv in the averaged equation to give the
  /// growth rate of the full equation. NaN if K_t/m is so large that the mass oscillates on the
  /// contact stiffness within a normal period.
  double slider_damping = unknown;
  double growth_rate = unknown;  ///< growth rate by the full equation, 1/s; < 0: decays
  /// Growth rate by the averaged equation, 1/s: real part of the root s of m s² + (dT̄/dv + c − b)s
  /// + k = 0; < 0: the disturbance decays.
  double averaged_growth_rate = unknown;
  bool converged =
      false;  ///< false: no steady sliding without reversal was found; growth_rate is NaN

  /// Whether small disturbances decay; empty where growth_rate is unknown.
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

/// Computes the stability of steady sliding. While the slider never reverses, all springs in
/// contact are at their stretch limit whenever δ is smallest, so that the state at that moment
/// consists of only two numbers, (x − Vt, ẋ). One period of the full equation maps these two
/// numbers to their next values. Steady sliding is the fixed point of this map; the eigenvalues of
/// the map at the fixed point give the growth per period.
///
///     SliderStability sliding = slider_stability(law, at_force(1), normal, slider, 0.3);
///
/// sliding_damping_error estimates two effects of the mass, with f = Γ/(πmω) in place of K_t/(mω²)
/// and Γ of SteadySliding::low_speed_damping. First, springs that stick for a whole period have −ln
/// cos(2π√f)/(2π²f) times the damping. Second, the mass follows the oscillating friction force, so
/// that V/(1 − f) instead of V decides whether springs stick. The error is the larger of these two
/// effects plus the fraction (π²/3)(k/m)/ω² of the damping.
/// throws  InvalidInput wherever slider_motion() does
/// cost    some ten periods of the full equation with 4 · `steps` steps each
SliderStability slider_stability(const ContactLaw& law, const OperatingPoint& point,
                                 const NormalOscillation& normal, const Slider& slider,
                                 double friction_coefficient, const SliderOptions& options = {});

/// Threshold: the smallest amplitude, m, or angular frequency, rad/s, of the normal oscillation at
/// which small disturbances of steady sliding decay.
struct SliderThreshold {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double value = unknown;            ///< threshold by the full equation; NaN: none inside the range
  double linear_estimate = unknown;  ///< from dT̄/dv + c = b; NaN as for value
  /// Change of linear_estimate due to SliderStability::sliding_damping_error; NaN: the changed
  /// estimate lies outside the range of the search.
  double linear_estimate_error = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<SliderThreshold>) {
  using S = SliderThreshold;
  visit(&S::value, Kept{"value", "threshold of the full equation"});
  visit(&S::linear_estimate, Kept{"linear_estimate", "threshold where dT/dv + c = b"});
  visit(&S::linear_estimate_error,
        Kept{"linear_estimate_error", "error of linear_estimate by the slider's mass"});
}

/// Results of a search for thresholds; a threshold that was not searched for is empty.
struct SliderThresholds {
  std::optional<SliderThreshold> amplitude = {};  ///< normal amplitude at the given frequency, m
  std::optional<SliderThreshold> frequency = {};  ///< frequency at the given amplitude, Hz
};

constexpr void describe(auto&& visit, std::type_identity<SliderThresholds>) {
  using S = SliderThresholds;
  visit(&S::amplitude, Quantity{"threshold_amplitude", Dimension::length,
                                "minimum normal amplitude at which sliding is stable"});
  visit(&S::frequency,
        Quantity{"threshold_frequency", Dimension::frequency,
                 "minimum frequency of the normal oscillation at which sliding is stable"});
}

/// Search upwards for the smallest amplitude, or angular frequency, of the normal oscillation at
/// which steady sliding is stable, in steps of a ratio of 1.05. The search starts where v_c of
/// SteadySliding equals V, because no spring sticks at smaller values; frequencies start at 4.01
/// times the natural frequency √(k/m) of the slider, because a slower oscillation cannot be
/// averaged. Sliding may become unstable again at larger values, since Γ of SteadySliding falls
/// with amplitude and with frequency.
/// last    the oscillation at the upper end of the search, with the largest amplitude or frequency
/// throws  InvalidInput wherever slider_motion() does, and if b <= c: sliding is then stable
///         without an oscillation
/// cost    some tens to hundreds of calls of slider_stability() and steady_sliding()
SliderThreshold threshold_amplitude(const ContactLaw& law, const OperatingPoint& point,
                                    const NormalOscillation& last, const Slider& slider,
                                    double friction_coefficient, const SliderOptions& options = {});
SliderThreshold threshold_angular_frequency(const ContactLaw& law, const OperatingPoint& point,
                                            const NormalOscillation& last, const Slider& slider,
                                            double friction_coefficient,
                                            const SliderOptions& options = {});

}  // namespace salebra
