// SPDX-License-Identifier: GPL-3.0-or-later
// Contact under fast normal oscillation as a tangential damper: map of its damping constant γ,
// decay of a tangential oscillator, stability border of sliding.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/damper.hpp>

#include "base/numerics/quadrature.hpp"
#include "max_motion.hpp"

namespace salebra {
namespace {

// Damping constant of a contact that is dragged; it does not depend on the drag velocity.
DampingResult damper_at(const ContactLaw& law, const OperatingPoint& point, double amplitude,
                        double angular_frequency, const DampingOptions& options) {
  const DampingResult result = relaxation_damping(law, point,
                                                  Drag{.normal_amplitude = amplitude,
                                                       .drag_velocity = 0,
                                                       .angular_frequency = angular_frequency},
                                                  options);
  if (!result.converged)
    throw NotConverged("damper: the integral for the damping constant did not reach the tolerance");
  return result;
}

}  // namespace

OscillatorDecay oscillator_decay(const ContactLaw& law, const OperatingPoint& point,
                                 const NormalOscillation& normal,
                                 const TangentialOscillator& oscillator,
                                 const DampingOptions& options) {
  const DampingResult damper =
      damper_at(law, point, normal.normal_amplitude, normal.angular_frequency, options);
  return oscillator_decay(damper.damping_constant,
                          law.tangential_stiffness(damper.indentation - normal.normal_amplitude),
                          normal.angular_frequency, oscillator);
}

OscillatorDecay oscillator_decay(double damping_constant, double contact_stiffness,
                                 double angular_frequency, const TangentialOscillator& oscillator) {
  require_positive(oscillator.mass, "mass");
  require(std::isfinite(oscillator.spring_stiffness) && oscillator.spring_stiffness >= 0,
          "spring_stiffness", oscillator.spring_stiffness, "must be finite and >= 0");
  OscillatorDecay decay;
  decay.damping_constant = damping_constant;
  decay.contact_stiffness = contact_stiffness;
  const double stiffness = oscillator.spring_stiffness + decay.contact_stiffness;
  require(stiffness > 0, "spring_stiffness", oscillator.spring_stiffness,
          "N/m leaves the oscillator without stiffness, because the contact opens; give a spring");
  decay.natural_frequency = std::sqrt(stiffness / oscillator.mass);
  decay.frequency_ratio = decay.natural_frequency / angular_frequency;
  const double ratio = decay.damping_constant / (2 * oscillator.mass * decay.natural_frequency);
  decay.damping_ratio = ratio;
  decay.quality_factor = 1 / (2 * ratio);
  // Overdamped decay at the rate ω0(D − √(D² − 1)) with the damping ratio D, written without the
  // difference of two close numbers.
  const double rate = ratio < 1 ? ratio : 1 / (ratio + std::sqrt((ratio - 1) * (ratio + 1)));
  decay.decay_time = 1 / (decay.natural_frequency * rate);
  decay.logarithmic_decrement =
      ratio < 1 ? 2 * std::numbers::pi * ratio / std::sqrt((1 - ratio) * (1 + ratio))
                : std::numeric_limits<double>::quiet_NaN();
  return decay;
}

DamperMap damper_map(const ContactLaw& law, const OperatingPoint& point,
                     const std::vector<double>& normal_amplitudes,
                     const std::vector<double>& angular_frequencies,
                     const DampingOptions& options) {
  for (const double frequency : angular_frequencies)
    require_positive(frequency, "angular_frequency");
  std::vector<DampingCase> cases;
  for (const double amplitude : normal_amplitudes) cases.push_back({point, Drag{amplitude, 0, 1}});
  const std::vector<DampingResult> results = relaxation_damping(law, cases, options);
  DamperMap map{normal_amplitudes, angular_frequencies,
                Field(static_cast<Index>(normal_amplitudes.size()),
                      static_cast<Index>(angular_frequencies.size()))};
  for (Index i = 0; i < map.damping_constant.rows(); ++i)
    for (Index j = 0; j < map.damping_constant.cols(); ++j)
      map.damping_constant(i, j) = results[static_cast<std::size_t>(i)].damping_constant /
                                   angular_frequencies[static_cast<std::size_t>(j)];
  return map;
}

double stabilising_amplitude(const ContactLaw& law, const OperatingPoint& point,
                             double angular_frequency, double falling_slope, double max_amplitude,
                             const DampingOptions& options) {
  require_positive(falling_slope, "falling_slope");
  require_positive(max_amplitude, "max_amplitude");
  DampingOptions held = options;
  held.hold = hold_of(law, point, max_amplitude, options.hold);
  if (held.hold == Hold::indentation)
    max_amplitude =
        std::min(max_amplitude, detail::possible_amplitude(law, indentation_of(law, point)));
  auto excess = [&](double amplitude) {
    return damper_at(law, point, amplitude, angular_frequency, held).damping_constant -
           falling_slope;
  };
  // Searches the smallest amplitude that gives the required γ. γ grows in proportion to u_z at
  // first and may have a maximum, so fine steps are taken, and the first step with enough γ
  // brackets the amplitude. They begin well below the amplitude that the proportion gives, but no
  // lower: if u_z is as small as the last digit of δ, round-off exceeds the loss.
  DampingOptions small = options;
  small.amplitude = Amplitude::small;
  const double proportional =
      max_amplitude * falling_slope /
      damper_at(law, point, max_amplitude, angular_frequency, small).damping_constant;
  const double lowest = std::min(proportional / 16, max_amplitude / 256);
  constexpr int steps_per_octave = 4;
  const int steps =
      static_cast<int>(std::ceil(steps_per_octave * std::log2(max_amplitude / lowest)));
  double below = 0;
  for (int i = -steps; i <= 0; ++i) {
    const double amplitude = max_amplitude * std::exp2(static_cast<double>(i) / steps_per_octave);
    if (excess(amplitude) >= 0) return detail::find_root(excess, below, amplitude);
    below = amplitude;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace salebra
