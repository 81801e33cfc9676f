// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <string>
#include <vector>

/// Friction of a sliding contact under normal oscillation, and the motion of a slider that a spring
/// drags over it.
namespace salebra {

/// Steady sliding over velocities, at one or several amplitudes.
struct SlidingProblem {
  std::vector<double> normal_amplitude;      ///< u_z, m
  double angular_frequency = 0;              ///< rad/s
  double friction_coefficient = 0;           ///< μ
  std::vector<double> velocities;            ///< m/s
  std::vector<double> velocity_ratios = {};  ///< v/v_c of each amplitude, instead of velocities
  /// Excursions X of slow motions, m, for a regime map; with one amplitude.
  std::vector<double> excursions = {};
  Hold hold = Hold::indentation;
};

/// Friction under vibration at each amplitude and velocity.
struct SlidingSolution {
  std::vector<SlidingPoint> points;  ///< amplitude by amplitude
  std::optional<RegimeMap> regimes;
  std::vector<std::string> warnings = {};  ///< beside those of the contact
};

/// Computes steady sliding of a law, and the regimes if excursions are given.
///
///     SlidingProblem problem{{1e-9}, 1e5, 0.3, {1e-5, 1e-4}};
///     SlidingSolution sliding = solve(problem, law, at_force(1));
///
/// throws  InvalidInput as steady_sliding() and regime_map(), and for ratios without an amplitude;
///         NotConverged where a quadrature did not reach its tolerance
SlidingSolution solve(const SlidingProblem& problem, const ContactLaw& law,
                      const OperatingPoint& point);
/// The same at the first operating point of a contact. On a surface each point comes from contacts
/// solved inside the oscillation, with errors (surface_sliding()); regimes always come from the
/// law.
/// material  of a surface; ignored otherwise
/// throws    NotConverged, Interrupted
SlidingSolution solve(const SlidingProblem& problem, const ContactSolution& contact,
                      const Material& material, const Context& context = {});

/// The final motion of a slider, its stability, and the threshold of the oscillation.
struct SliderProblem {
  Slider slider;
  NormalOscillation normal;         ///< amplitude 0: none; frequency 0: no thresholds
  double friction_coefficient = 0;  ///< μ
  /// End of the search for the threshold, m; empty: 10 times the smallest amplitude with an effect.
  std::optional<double> max_amplitude = {};
  SliderOptions options = {};
};

/// The motion of a slider, simulated and averaged over the oscillation, and its stability.
struct SliderSolution {
  SliderMotion motion, averaged;
  SteadySliding sliding;  ///< at the velocity of the drive
  SliderStability stability;
  SliderThresholds thresholds;  ///< known where friction falls by more than the support damps
  Drag judged;                  ///< motion for which assumptions are checked
};

/// Simulates a slider.
/// throws  InvalidInput as slider_motion(); NotConverged where a motion does not repeat;
///         Interrupted
SliderSolution solve(const SliderProblem& problem, const ContactLaw& law,
                     const OperatingPoint& point);

}  // namespace salebra
