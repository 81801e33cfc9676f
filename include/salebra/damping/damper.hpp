// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>
#include <vector>

/// Under slow tangential motion, a contact with a fast normal oscillation is a linear damper whose
/// damping constant is tuned by the amplitude of the normal oscillation.
namespace salebra {

/// A fast normal oscillation of a contact.
struct NormalOscillation {
  double normal_amplitude = 0;   ///< u_z >= 0, m
  double angular_frequency = 0;  ///< ω > 0, rad/s
};

/// A mass m held by a spring k and by the contact: m ẍ + γ ẋ + (k + K_t,min) x = 0, with the
/// damping constant γ of the contact and its smallest tangential stiffness K_t,min in a cycle.
struct TangentialOscillator {
  double mass = 0;              ///< m > 0, kg
  double spring_stiffness = 0;  ///< k >= 0, N/m, without the stiffness of the contact
};

struct OscillatorDecay {
  double damping_constant = 0;  ///< γ, N s/m
  /// K_t,min = K_t(δ0 − u_z), stiffness of the springs that never separate, N/m; 0 where the
  /// contact opens.
  double contact_stiffness = 0;
  double natural_frequency = 0;  ///< ω0 = √((k + K_t,min)/m), rad/s
  double damping_ratio = 0;      ///< ζ = γ/(2mω0); >= 1: no oscillation
  double quality_factor = 0;     ///< 1/(2ζ)
  /// Time in which the amplitude falls to 1/e, s: 2m/γ for ζ < 1; for ζ >= 1 the time of the slower
  /// of the two exponential decays.
  double decay_time = 0;
  double logarithmic_decrement = 0;  ///< 2πζ/√(1 − ζ²); NaN for ζ >= 1
  /// ω0/ω, natural over normal frequency. A linear damper describes the contact only if this ratio
  /// is small; the relative error is about its square, and larger if the ratio is near a simple
  /// fraction.
  double frequency_ratio = 0;
};

constexpr void describe(auto&& visit, std::type_identity<OscillatorDecay>) {
  using enum Dimension;
  using S = OscillatorDecay;
  visit(&S::damping_constant, Kept{"damping_constant", "damping constant", damping});
  visit(&S::contact_stiffness, Quantity{"contact_stiffness", stiffness,
                                        "tangential stiffness of what is always in contact"});
  visit(&S::natural_frequency, Quantity{"natural_frequency", angular_frequency,
                                        "natural angular frequency of the oscillator"});
  visit(&S::damping_ratio,
        Quantity{"damping_ratio", dimensionless, "damping over critical damping"});
  visit(&S::quality_factor, Quantity{"quality_factor", dimensionless, "quality factor"});
  visit(&S::decay_time,
        Quantity{"decay_time", Dimension::time, "time in which the amplitude falls by e"});
  visit(&S::logarithmic_decrement,
        Quantity{"logarithmic_decrement", dimensionless, "logarithmic decrement"});
  visit(&S::frequency_ratio,
        Quantity{"frequency_ratio", dimensionless, "tangential over normal frequency"});
}

/// Computes the decay of a tangential oscillator under fast normal oscillation of its contact.
///
///     OscillatorDecay decay = oscillator_decay(law, at_force(1), {1e-9, 1e5}, {.mass = 1});
///
/// Throws InvalidInput wherever relaxation_damping() does, and for an oscillator without mass or
/// without any stiffness.
OscillatorDecay oscillator_decay(const ContactLaw& law, const OperatingPoint& point,
                                 const NormalOscillation& normal,
                                 const TangentialOscillator& oscillator,
                                 const DampingOptions& options = {});

/// Computes the decay from a known damping constant and a known contact stiffness K_t(δ0 − u_z);
/// angular_frequency is that of the normal oscillation.
OscillatorDecay oscillator_decay(double damping_constant, double contact_stiffness,
                                 double angular_frequency, const TangentialOscillator& oscillator);

/// Damping constant for each pair of normal amplitude and angular frequency.
struct DamperMap {
  std::vector<double> normal_amplitude;   ///< m
  std::vector<double> angular_frequency;  ///< rad/s
  Field damping_constant;                 ///< γ, shape (amplitudes, frequencies), N s/m
};

constexpr void describe(auto&& visit, std::type_identity<DamperMap>) {
  using enum Dimension;
  using S = DamperMap;
  visit(&S::normal_amplitude,
        Kept{"normal_amplitude", "amplitudes of the normal oscillation", length});
  visit(&S::angular_frequency,
        Kept{"angular_frequency", "angular frequencies of the normal oscillation",
             Dimension::angular_frequency});
  visit(&S::damping_constant,
        Kept{"damping_constant", "damping constant (amplitudes, frequencies)", damping});
}

/// Computes γ for all pairs of normal amplitude and angular frequency. At each amplitude γ is
/// exactly proportional to 1/ω, so the loss is computed once for each amplitude.
DamperMap damper_map(const ContactLaw& law, const OperatingPoint& point,
                     const std::vector<double>& normal_amplitudes,
                     const std::vector<double>& angular_frequencies,
                     const DampingOptions& options = {});

/// Returns the smallest normal amplitude, m, at which γ >= falling_slope. It estimates, without
/// slip, the oscillation that prevents stick–slip of a slider whose friction force falls with its
/// velocity v by b = falling_slope > 0, N s/m: for small disturbances of steady sliding such a
/// friction force acts like a damping constant of −b. NaN if no amplitude up to max_amplitude (m)
/// suffices; under a constant mean force (a dead weight) γ has a maximum as a function of the
/// amplitude.
double stabilising_amplitude(const ContactLaw& law, const OperatingPoint& point,
                             double angular_frequency, double falling_slope, double max_amplitude,
                             const DampingOptions& options = {});

}  // namespace salebra
