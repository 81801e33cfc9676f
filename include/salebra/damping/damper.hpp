// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>
#include <vector>

/// Under slow shear, a contact under fast normal oscillation is a linear damper, tuned by the
/// vibration amplitude.
namespace salebra {

/// A fast normal oscillation of a contact.
struct NormalOscillation {
  double normal_amplitude = 0;   ///< u_z >= 0, m
  double angular_frequency = 0;  ///< ω > 0, rad/s
};

/// A mass on a spring and on the contact: m ẍ + γ ẋ + (k + K_t,min) x = 0.
struct TangentialOscillator {
  double mass = 0;              ///< m > 0, kg
  double spring_stiffness = 0;  ///< k >= 0, N/m, without the contact's own stiffness
};

struct OscillatorDecay {
  double damping_constant = 0;  ///< γ, N s/m
  double contact_stiffness =
      0;  ///< K_t(δ0 − u_z), of the springs that never separate, N/m; 0 where the contact opens
  double natural_frequency = 0;  ///< ω0 = √((k + K_t,min)/m), rad/s
  double damping_ratio = 0;      ///< ζ = γ/(2mω0); >= 1: no oscillation
  double quality_factor = 0;     ///< 1/(2ζ)
  double decay_time =
      0;  ///< time in which the amplitude falls by e, 2m/γ for ζ < 1, otherwise the slower of two,
          ///< s
  double logarithmic_decrement = 0;  ///< 2πζ/√(1 − ζ²); NaN for ζ >= 1
  /// ω0/ω, which the description assumes to be small. The relative error is about its square, and
  /// larger near a simple fraction.
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
/// Throws InvalidInput as relaxation_damping(), and for an oscillator without mass or without any
/// stiffness.
OscillatorDecay oscillator_decay(const ContactLaw& law, const OperatingPoint& point,
                                 const NormalOscillation& normal,
                                 const TangentialOscillator& oscillator,
                                 const DampingOptions& options = {});

/// The same for a known γ and K_t(δ0 − u_z).
OscillatorDecay oscillator_decay(double damping_constant, double contact_stiffness,
                                 double angular_frequency, const TangentialOscillator& oscillator);

/// The damping constant over normal amplitudes × angular frequencies.
struct DamperMap {
  std::vector<double> normal_amplitude;   ///< m
  std::vector<double> angular_frequency;  ///< rad/s
  Field damping_constant;                 ///< γ (amplitudes, frequencies), N s/m
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

/// Computes the map. At each amplitude γ is exactly a constant over ω, so each is computed once.
DamperMap damper_map(const ContactLaw& law, const OperatingPoint& point,
                     const std::vector<double>& normal_amplitudes,
                     const std::vector<double>& angular_frequencies,
                     const DampingOptions& options = {});

/// Returns the smallest normal amplitude, m, at which γ >= falling_slope. It estimates, without
/// slip, the oscillation that prevents stick–slip of a slider whose friction force falls with
/// velocity, F_f = F_0 − bv, with b = falling_slope > 0, N s/m: for small disturbances of steady
/// sliding this is a damping constant of −b. NaN where no amplitude up to max_amplitude
/// suffices: under a dead weight γ has a maximum over u_z.
double stabilising_amplitude(const ContactLaw& law, const OperatingPoint& point,
                             double angular_frequency, double falling_slope,
                             double max_amplitude, const DampingOptions& options = {});

}  // namespace salebra
