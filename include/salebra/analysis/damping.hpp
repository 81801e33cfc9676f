// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <string>
#include <variant>
#include <vector>

/// The loss of a contact under a motion, and the assumptions behind it.
namespace salebra {

/// Each list (operating points, motions, force amplitudes) has either one entry, used for all
/// cases, or one entry per case.
struct DampingProblem {
  ContactProblem contact;  ///< of a surface, its pressures; `motions` set its amplitude
  std::vector<Motion> motions = {};
  /// F_a of a force-controlled oscillation F + F_a cos ωt, replaces the normal amplitudes, N;
  /// empty: none.
  std::vector<double> force_amplitude = {};
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  /// Used to check the assumptions; with a coefficient of friction the loss includes slip.
  ContactParameters parameters = {};
  int steps = 2000;  ///< straight steps per normal cycle to compute slip; >= 8
  /// For a surface: boundary, relative error and seam; the members above replace the others.
  SurfaceDampingOptions surface = {};
};

constexpr void describe(auto&& visit, std::type_identity<DampingProblem>) {
  visit(&DampingProblem::force_amplitude,
        Quantity{"force_amplitude", Dimension::force, "amplitude of the normal force"});
}

/// Each list has one entry per case, or is empty where it does not apply.
struct DampingSolution {
  ContactSolution contact;
  std::vector<Motion> motions = {};
  /// Loss of each case as described (analysis/slip.hpp), with its numerical error: from the
  /// springs of a law, or from contacts solved inside the oscillation of a surface.
  std::vector<DampingResult> results = {};
  std::vector<double> ratio = {};             ///< loss over its small-amplitude form
  std::vector<CommonPeriod> periods = {};     ///< for two frequencies
  std::vector<double> slow_limit_power = {};  ///< for two frequencies, without slip, W
  /// For a slow motion with a known excursion X: W·2X/w with w = 2πv/ω, J.
  std::vector<double> work_there_and_back = {};
  std::vector<Assumptions> assumptions = {};
  std::vector<std::string> warnings = {};  ///< warnings besides those of the contact

  const std::optional<FirstLoading>& first_loading() const { return contact.first_loading; }
};

constexpr void describe(auto&& visit, std::type_identity<DampingSolution>) {
  using enum Dimension;
  using S = DampingSolution;
  visit(&S::results, Table{"results", "losses of the contact as described"});
  visit(&S::ratio,
        Quantity{"ratio", dimensionless, "energy dissipated in a cycle over small_amplitude_work"});
  visit(&S::work_there_and_back,
        Quantity{"work_there_and_back", energy,
                 "energy dissipated on the way there and back over the excursion"});
  visit(&S::first_loading, Part{"first_loading", "plastic first loading of the surface"});
  visit(&S::periods, Table{"periods", "common periods of two frequencies"});
  visit(&S::slow_limit_power, Quantity{"slow_limit_power", Dimension::power,
                                       "mean power if the tangential motion were slow"});
}

/// Computes the loss of each case and checks its assumptions.
///
///     DampingSolution solution = solve(DampingProblem{.contact = ExponentialContact{30e-9, 0.8, {1}},
///                                                .motions = {Drag{1e-9, 1e-6, 1e5}}});
///
/// throws  InvalidInput for lists of other lengths, for force amplitudes without a force or with a
///         surface, and as solve(ContactProblem) and relaxation_damping(); Interrupted
/// cost    per case some hundred evaluations of the law, 10 ms for the assumptions and, with
///         friction, one step of the law for each of `steps`; for a surface also surface_damping()
DampingSolution solve(DampingProblem problem, const Context& context = {});

/// Computes the stresses under an indenter in the first case, a motion of one frequency.
StressMap stress_map_of(const DampingSolution& solution, int phases, int radii,
                        const Context& context = {});
/// Computes the losses of the first case, of equal frequencies, over M and phases of 5° to 90°.
/// friction_numbers  M; empty: 25 from 0.1 to 100
FrictionMap friction_map_of(const DampingSolution& solution, std::vector<double> friction_numbers,
                            int steps, const Context& context = {});

/// A measured motion with its own indentations.
struct PathProblem {
  ContactProblem contact;  ///< its operating points are ignored
  SampledMotion path;
  std::vector<double> transverse = {};  ///< y at the samples, without slip, m; empty: none
  ContactParameters parameters = {};              ///< a coefficient of friction adds slip
};
constexpr void describe(auto&& visit, std::type_identity<PathProblem>) {
  visit(&PathProblem::transverse,
        Quantity{"transverse", Dimension::length, "displacement along y"});
}

/// The loss of a path and the check of its assumptions.
struct PathSolution {
  TrajectoryDamping loss;
  Assumptions assumptions;
};
PathSolution solve(const PathProblem& problem, const Context& context = {});

/// A contact as a damper of slow tangential motions under fast normal oscillation, over amplitudes
/// and frequencies.
struct DamperProblem {
  ContactProblem contact = {};                 ///< at one operating point
  std::vector<double> normal_amplitude = {};   ///< m; empty: found for falling_slope
  std::vector<double> angular_frequency = {};  ///< rad/s, at least one
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  std::optional<TangentialOscillator> oscillator = {};  ///< for one amplitude and one ω
  std::optional<double> falling_slope = {};  ///< slope b of a falling friction force, N s/m
  double max_amplitude = 0;              ///< end of the search for stability, m
  /// Velocity of the slow motion, m/s; with friction γ depends on it and on parameters.excursion.
  double drag_velocity = ContactParameters::unknown;
  ContactParameters parameters = {};
};

/// The damping constant over amplitude and frequency, and its effect on an oscillator or a slider.
struct DamperSolution {
  ContactSolution contact;
  /// Empty without amplitudes. With friction γ includes slip; it is NaN where the velocity or the
  /// excursion of the slow motion is unknown, or the motion is not slow.
  DamperMap map = {};
  Field damping_constant_error = {};  ///< error of the map, N s/m; empty for a law
  Field damping_constant_without_slip = {}, slip_share = {};  ///< of the map with friction
  std::optional<OscillatorDecay> decay = {};
  /// For a surface: errors due to that of the damping constant; NaN for what follows from K_t of
  /// the law.
  std::optional<OscillatorDecay> decay_error = {};
  std::vector<double> stabilising_amplitude = {};        ///< for each frequency, m; empty: no slope
  std::vector<double> stabilising_amplitude_error = {};  ///< for a surface, m
  /// For each amplitude at the highest frequency: slip does not depend on frequency, inertia grows
  /// with it.
  std::vector<Assumptions> assumptions = {};
  std::vector<std::string> warnings = {};  ///< warnings besides those of the contact

  const std::optional<FirstLoading>& first_loading() const { return contact.first_loading; }
};

constexpr void describe(auto&& visit, std::type_identity<DamperSolution>) {
  using S = DamperSolution;
  visit(&S::decay, Part{"decay", "free decay of the oscillator"});
  visit(&S::decay_error, Part{"decay_error", "errors of the free decay, of a surface"});
  visit(&S::stabilising_amplitude, Quantity{"stabilising_amplitude", Dimension::length,
                                            "minimum normal amplitude that stabilises the slider"});
  visit(&S::stabilising_amplitude_error, Quantity{"stabilising_amplitude_error", Dimension::length,
                                                  "error of stabilising_amplitude"});
  visit(&S::first_loading, Part{"first_loading", "plastic first loading of the surface"});
}

/// Computes the map, the decay of the oscillator and the stabilising amplitude, as far as given.
///
///     DamperSolution damper = solve(DamperProblem{.contact = ExponentialContact{30e-9, 0.8, {1}},
///                                              .normal_amplitude = {1e-9},
///                                              .angular_frequency = {1e5}});
///
/// throws  InvalidInput for several operating points, no frequency, an oscillator with several
///         amplitudes or frequencies, a slope or velocity that is not > 0, and as the functions of
///         damper.hpp
DamperSolution solve(DamperProblem problem, const Context& context = {});

/// Partial slip of a contact under tangential oscillations, with or without a normal one.
struct JointProblem {
  ContactProblem contact = {};  ///< at one operating point
  std::vector<TangentialOscillation> motions = {};
  double normal_amplitude = 0;   ///< u_z of δ + u_z cos ωt, m; 0: the normal force is constant
  double phase = 0;              ///< φ0 of the tangential motions against the normal one, rad
  double angular_frequency = 0;  ///< to check inertia, rad/s; 0: not known
  ContactParameters parameters = {};       ///< including the coefficient of friction
  int steps = 2000;              ///< steps per cycle with a normal oscillation; >= 16
  /// Nominal area of the joint, m²: the law of a curve or a surface is scaled to it; for another
  /// law it is the area that has this law. NaN: no scaling.
  double nominal_area = std::numeric_limits<double>::quiet_NaN();
  /// Steps of an additional cycle of a surface, simulated cell by cell; empty: none.
  std::optional<int> direct_steps = {};
};

/// The loss of each motion, and the check of the assumptions.
struct JointSolution {
  ContactSolution contact;
  LawState state = {};  ///< at the mean indentation
  /// Loss of each motion: from contacts solved for a surface without normal oscillation, otherwise
  /// from the law.
  std::vector<JointLoss> losses = {};
  std::vector<JointLoss> simulated = {};  ///< the same, simulated cell by cell
  EqualFrequency largest = {};            ///< largest of the motions
  Assumptions assumptions = {};                 ///< for the largest motion
  std::vector<std::string> warnings = {};  ///< warnings about the losses and their error
};

/// Computes the loss of each motion.
///
///     JointSolution joint = solve(JointProblem{.contact = ExponentialContact{30e-9, 0.8, {100}},
///                                           .motions = {TangentialForce{20}},
///                                           .parameters = {.friction_coefficient = 0.5}});
///
/// throws  InvalidInput for several operating points, no motion, direct steps without a surface,
///         and as solve(ContactProblem) and the functions of joint.hpp; NotConverged where an
///         integral or a simulated cycle did not converge; Interrupted
/// cost    that of the functions of joint.hpp
JointSolution solve(JointProblem problem, const Context& context = {});

/// Warns about a slow motion, case (b), that advances by more than a contact patch in one normal
/// cycle: the patch that sticks is then no longer the one that opens. An unknown radius is NaN.
std::vector<std::string> warnings_of_path(double drag_velocity, double angular_frequency,
                                        double spot_radius);

}  // namespace salebra
