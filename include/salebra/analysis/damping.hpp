// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <string>
#include <variant>
#include <vector>

/// The loss of a contact under a motion, and the assumptions behind it.
namespace salebra {

/// Damping of a contact in one or several cases. Each list (operating points, motions, force
/// amplitudes) has either one entry, which is used for all cases, or one entry per case.
struct DampingProblem {
  ContactProblem contact;  ///< `motions` set the amplitude of a SurfaceContact
  std::vector<Motion> motions = {};
  /// Force amplitude F_a of a force-controlled oscillation F + F_a cos ωt, N, which replaces the
  /// normal amplitude of the motion; empty: the oscillation is displacement-controlled.
  std::vector<double> force_amplitude = {};
  Hold hold = Hold::automatic;
  Amplitude amplitude = Amplitude::finite;
  /// Contact parameters for checking the assumptions. If a coefficient of friction is given, the
  /// loss includes slip.
  ContactParameters parameters = {};
  int steps = 2000;  ///< straight steps per normal cycle to compute slip; >= 8
  /// Options for a SurfaceContact, such as boundary, relative_error and seam. Its hold, amplitude,
  /// friction_coefficient, excursion and on_progress are replaced by those of this problem.
  SurfaceDampingOptions surface = {};
};

constexpr void describe(auto&& visit, std::type_identity<DampingProblem>) {
  visit(&DampingProblem::force_amplitude,
        Quantity{"force_amplitude", Dimension::force, "amplitude of the normal force"});
}

/// Damping of a contact. Each list has one entry per case, or is empty if it does not apply. If the
/// contact asks for several directions, all cases in the first direction come first, and so on.
struct DampingSolution {
  ContactSolution contact;  ///< in the first direction
  std::vector<Motion> motions = {};
  /// Loss of each case with its numerical error, including slip if a coefficient of friction is
  /// given (analysis/slip.hpp). It comes from the springs of a law or, for a surface, from contacts
  /// solved inside the oscillation.
  std::vector<DampingResult> results = {};
  std::vector<double> ratio = {};             ///< loss over small_amplitude_work
  std::vector<CommonPeriod> periods = {};     ///< common periods of TwoFrequencies
  std::vector<double> slow_limit_power = {};  ///< for TwoFrequencies: power as ω_x → 0, no slip, W
  /// For a Drag with a known excursion X: loss on one path there and back, W·2X/w, J, with the
  /// distance per normal cycle w = 2πv/ω.
  std::vector<double> work_there_and_back = {};
  /// For a body that is not a half-space: SurfaceDamping::leaving_share.
  std::vector<double> leaving_share = {};
  std::vector<Assumptions> assumptions = {};
  std::vector<std::string> warnings = {};  ///< additional to contact.warnings

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
  visit(&S::leaving_share,
        Quantity{"leaving_share", dimensionless,
                 "cells that leave while the bodies approach over those that enter"});
  visit(&S::first_loading, Part{"first_loading", "plastic first loading of the surface"});
  visit(&S::periods, Table{"periods", "common periods of two frequencies"});
  visit(&S::slow_limit_power, Quantity{"slow_limit_power", Dimension::power,
                                       "mean power if the tangential motion were slow"});
}

/// Computes the loss of each case and checks its assumptions.
///
///     DampingSolution solution =
///         solve(DampingProblem{.contact = ExponentialContact{30e-9, 0.8, {1}},
///                              .motions = {Drag{1e-9, 1e-6, 1e5}}});
///
/// throws  InvalidInput for lists of different lengths > 1, for force amplitudes without a given
///         force or with a surface, and wherever solve(ContactProblem) and relaxation_damping() do;
///         Interrupted
/// cost    per case some hundred evaluations of the law, 10 ms for the assumptions and, with
///         friction, `steps` steps of a TangentialContact; for a surface also the cost of
///         surface_damping()
DampingSolution solve(DampingProblem problem, const Context& context = {});

/// Computes the stresses under an indenter for the motion of the first case, which must not be
/// TwoFrequencies.
StressMap stress_map_of(const DampingSolution& solution, int phases, int radii,
                        const Context& context = {});
/// Computes the effect of friction in the first case, which must be an EqualFrequency, over
/// friction numbers M = μE*u_z/(G*u_x) and phases of 5° to 90°.
/// friction_numbers  values of M; empty: 25 values from 0.1 to 100
FrictionMap friction_map_of(const DampingSolution& solution, std::vector<double> friction_numbers,
                            int steps, const Context& context = {});

/// A contact that moves along a measured path, which includes its indentations.
struct PathProblem {
  ContactProblem contact;  ///< its operating points are ignored
  SampledMotion path;
  std::vector<double> transverse = {};  ///< y at the samples, m, if without slip; empty: none
  ContactParameters parameters = {};    ///< a coefficient of friction adds slip
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

/// A contact under fast normal oscillation as a damper of slow tangential motions, for several
/// amplitudes and frequencies of the normal oscillation.
struct DamperProblem {
  ContactProblem contact = {};                 ///< at one operating point
  std::vector<double> normal_amplitude = {};   ///< m; empty: only stabilising_amplitude is computed
  std::vector<double> angular_frequency = {};  ///< rad/s, at least one
  Hold hold = Hold::automatic;
  Amplitude amplitude = Amplitude::finite;
  std::optional<TangentialOscillator> oscillator = {};  ///< needs one amplitude and one frequency
  std::optional<double> falling_slope = {};  ///< dF/dv = −b of a falling friction force: b, N s/m
  double max_amplitude = 0;  ///< upper end of the search for stabilising_amplitude, m
  /// Velocity of the slow tangential motion, m/s. With friction, γ depends on this velocity and on
  /// parameters.excursion.
  double drag_velocity = ContactParameters::unknown;
  ContactParameters parameters = {};
};

/// The damping constant over amplitude and frequency, and its effect on an oscillator or a slider.
struct DamperSolution {
  ContactSolution contact;
  /// γ over amplitudes and frequencies; empty if no amplitudes are given. With friction γ includes
  /// slip; it is then NaN if the velocity or the excursion of the slow motion is unknown, or if the
  /// motion is not slow.
  DamperMap map = {};
  Field damping_constant_error = {};  ///< error of the map, N s/m; empty for a law
  Field damping_constant_without_slip = {}, slip_share = {};  ///< with friction, shapes as `map`
  std::optional<OscillatorDecay> decay = {};
  /// For a surface: errors of `decay` due to the error of the damping constant; NaN for numbers
  /// that depend only on K_t of the law.
  std::optional<OscillatorDecay> decay_error = {};
  /// Smallest stabilising amplitude for each frequency, m; empty without falling_slope.
  std::vector<double> stabilising_amplitude = {};
  std::vector<double> stabilising_amplitude_error = {};  ///< its error for a surface, m
  /// Assumptions for each amplitude at the highest frequency, at which inertia matters most; slip
  /// does not depend on the frequency.
  std::vector<Assumptions> assumptions = {};
  std::vector<std::string> warnings = {};  ///< additional to contact.warnings

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

/// Computes the map of γ and, if an oscillator or a falling slope is given, the decay of the
/// oscillator or the stabilising amplitude.
///
///     DamperSolution damper = solve(DamperProblem{.contact = ExponentialContact{30e-9, 0.8, {1}},
///                                              .normal_amplitude = {1e-9},
///                                              .angular_frequency = {1e5}});
///
/// throws  InvalidInput for several operating points, no frequency, an oscillator with several
///         amplitudes or frequencies, a slope or velocity that is not > 0, and wherever the
///         functions of damper.hpp do
DamperSolution solve(DamperProblem problem, const Context& context = {});
/// The same in each direction of the tangential motion that the contact asks for: one solution for
/// each, `across` before `along`. The law of a surface is computed once.
std::vector<DamperSolution> solve_directions(DamperProblem problem, const Context& context = {});

/// Partial slip of a contact under tangential oscillations, with or without a normal oscillation.
struct JointProblem {
  ContactProblem contact = {};  ///< at one operating point
  std::vector<TangentialOscillation> motions = {};
  double normal_amplitude = 0;   ///< u_z of δ + u_z cos ωt, m; 0: the normal force is constant
  double phase = 0;              ///< phase φ0 of the tangential against the normal motion, rad
  Hold hold = Hold::automatic;   ///< mean value that the normal oscillation keeps: hold_of()
  double angular_frequency = 0;  ///< for γ and to check inertia, rad/s; 0: not known
  ContactParameters parameters = {};  ///< must contain a coefficient of friction
  int steps = 2000;                   ///< steps per cycle with a normal oscillation; >= 16
  /// Nominal area of the joint, m². The law of a curve or a surface is scaled from its own nominal
  /// area to this area; any other law is taken as the law of this area. NaN: no scaling.
  double nominal_area = std::numeric_limits<double>::quiet_NaN();
  /// Steps of an additional cycle of a surface, simulated cell by cell; empty: none.
  std::optional<int> direct_steps = {};
};

/// The loss of each motion, and the check of the assumptions.
struct JointSolution {
  ContactSolution contact;
  LawState state = {};  ///< at the mean indentation
  /// Loss of each motion. For a surface without normal oscillation it comes from further contacts
  /// (surface_joint_loss()), otherwise from the law.
  std::vector<JointLoss> losses = {};
  std::vector<JointLoss> simulated = {};   ///< loss of each motion, simulated cell by cell
  EqualFrequency largest = {};             ///< the motion with the largest displacement
  Assumptions assumptions = {};            ///< for the largest motion
  std::vector<std::string> warnings = {};  ///< warnings about the losses and their error
};

/// Computes the loss of each motion.
///
///     JointSolution joint = solve(JointProblem{.contact = ExponentialContact{30e-9, 0.8, {100}},
///                                           .motions = {TangentialForce{20}},
///                                           .parameters = {.friction_coefficient = 0.5}});
///
/// throws  InvalidInput for several operating points, no motion, direct steps without a surface,
///         and wherever solve(ContactProblem) and the functions of joint.hpp do; NotConverged if an
///         integral or a simulated cycle did not converge; Interrupted
/// cost    that of the functions of joint.hpp
JointSolution solve(JointProblem problem, const Context& context = {});

/// Returns warnings about a Drag that advances by more than the size of a contact patch in one
/// normal cycle: the patch then sticks in another place than that in which it opens. spot_radius:
/// radius of a patch, m; NaN if unknown.
std::vector<std::string> warnings_of_path(double drag_velocity, double angular_frequency,
                                          double spot_radius);

}  // namespace salebra
