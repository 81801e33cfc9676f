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
/// drags over such a contact.
namespace salebra {

/// Steady sliding at several velocities and at one or several amplitudes of the normal oscillation.
struct SlidingProblem {
  std::vector<double> normal_amplitude;      ///< u_z, m
  double angular_frequency = 0;              ///< ω of the normal oscillation, rad/s
  double friction_coefficient = 0;           ///< μ
  std::vector<double> velocities;            ///< m/s
  std::vector<double> velocity_ratios = {};  ///< v/v_c of each amplitude, instead of velocities
  /// Excursions X of slow motions, m, for a regime map, which needs a single amplitude; empty: no
  /// map.
  std::vector<double> excursions = {};
  Hold hold = Hold::automatic;
};

/// Friction under vibration at each amplitude and velocity.
struct SlidingSolution {
  std::vector<SlidingPoint> points;  ///< all velocities of the first amplitude first
  std::optional<RegimeMap> regimes;
  std::vector<std::string> warnings = {};  ///< additional to those of the contact
};

/// Computes steady sliding of a law, and the regimes if excursions are given.
///
///     SlidingProblem problem{{1e-9}, 1e5, 0.3, {1e-5, 1e-4}};
///     SlidingSolution sliding = solve(problem, law, at_force(1));
///
/// throws  InvalidInput wherever steady_sliding() and regime_map() do, and for velocity ratios
///         without an amplitude > 0; NotConverged if a quadrature did not reach its tolerance
SlidingSolution solve(const SlidingProblem& problem, const ContactLaw& law,
                      const OperatingPoint& point);
/// Computes steady sliding at the first operating point of a contact. For a surface each
/// SlidingPoint comes from contacts solved inside the oscillation, with errors (surface_sliding());
/// the regime map always comes from the law.
/// body      body under a surface; not used for other contacts
/// throws    NotConverged, Interrupted
SlidingSolution solve(const SlidingProblem& problem, const ContactSolution& contact,
                      const Body& body, const Context& context = {});

/// The final motion of a slider, its stability, and the threshold of the oscillation.
struct SliderProblem {
  Slider slider;
  NormalOscillation normal;         ///< amplitude 0: no oscillation; frequency 0: no thresholds
  double friction_coefficient = 0;  ///< μ
  /// Upper end of the search for the threshold amplitude, m; empty: 10 times the smallest amplitude
  /// that has an effect.
  std::optional<double> max_amplitude = {};
  SliderOptions options = {};
};

/// The final motion of a slider by the full and by the averaged equation, and the stability of
/// steady sliding.
struct SliderSolution {
  SliderMotion motion, averaged;
  SteadySliding sliding;  ///< steady sliding at the velocity of the drive
  SliderStability stability;
  SliderThresholds thresholds;  ///< empty unless falling_slope > support_damping
  Drag judged;                  ///< motion for which assumptions should be checked
};

/// Simulates a slider on a contact.
/// throws  InvalidInput wherever slider_motion() does; NotConverged if a motion does not repeat;
///         Interrupted
SliderSolution solve(const SliderProblem& problem, const ContactLaw& law,
                     const OperatingPoint& point);

}  // namespace salebra
