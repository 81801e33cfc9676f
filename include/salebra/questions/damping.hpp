// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/premises.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/questions/contact.hpp>
#include <salebra/questions/slip.hpp>
#include <string>
#include <variant>
#include <vector>

/// What a contact loses in a motion, and what the answer assumes.
namespace salebra {

/// Positions, motions and amplitudes of the force: of each one, for all cases, or one for each.
struct DampingQuestion {
  ContactQuestion contact;  ///< of a surface, with the pressures; the amplitude comes from here
  std::vector<Motion> motions = {};
  /// F_a of F + F_a cos ωt at a force, in place of the normal amplitudes, N; empty: none.
  std::vector<double> force_amplitude = {};
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  /// For the premises; with a coefficient of friction the loss is that with slip.
  ContactFacts facts = {};
  int steps = 2000;  ///< straight ones in a normal cycle where slip is followed; >= 8
  /// Of a surface: its boundary, relative error and seam; what is above holds for the rest.
  SurfaceDampingOptions surface = {};
};

constexpr void describe(auto&& visit, std::type_identity<DampingQuestion>) {
  visit(&DampingQuestion::force_amplitude,
        Quantity{"force_amplitude", Dimension::force, "amplitude of the normal force"});
}

/// Each list has an entry for each case, or none where it is not of these cases.
struct DampingAnswer {
  ContactAnswer contact;
  std::vector<Motion> motions = {};
  /// The loss of each case as described (questions/slip.hpp): of a law by its springs, of a surface
  /// by contacts inside the oscillation, with their numerical error.
  std::vector<DampingResult> results = {};
  std::vector<double> ratio = {};             ///< of the loss to its small-amplitude form
  std::vector<CommonPeriod> periods = {};     ///< of two frequencies
  std::vector<double> slow_limit_power = {};  ///< of two frequencies, without slip, W
  /// Of a slow motion with a known excursion X: W·2X/w, w = 2πv/ω, J.
  std::vector<double> work_there_and_back = {};
  std::vector<Premises> premises = {};
  std::vector<std::string> doubts = {};  ///< beside those of the contact

  const std::optional<FirstLoading>& first_loading() const { return contact.first_loading; }
};

constexpr void describe(auto&& visit, std::type_identity<DampingAnswer>) {
  using enum Dimension;
  using S = DampingAnswer;
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

/// throws  InvalidInput for lists of other lengths, for amplitudes of the force without a force or
///         of a surface, and as ask(ContactQuestion) and relaxation_damping(); Interrupted
/// cost    of a case some hundred evaluations of the law, 10 ms for its premises and one step of
///         the law for each of `steps` with friction; of a surface surface_damping() beside
DampingAnswer ask(DampingQuestion question, const Context& context = {});

/// Stresses under an indenter in the first case, a motion of one frequency.
StressMap stress_map_of(const DampingAnswer& answer, int phases, int radii,
                        const Context& context = {});
/// Losses of the first case, of equal frequencies, over M and phases of 5° to 90°.
/// friction_numbers  M; empty: 25 from 0.1 to 100
FrictionMap friction_map_of(const DampingAnswer& answer, std::vector<double> friction_numbers,
                            int steps, const Context& context = {});

/// A measured motion, which brings its own indentations.
struct PathQuestion {
  ContactQuestion contact;  ///< its positions are not looked at
  SampledMotion path;
  std::vector<double> transverse = {};  ///< y at the samples, without slip, m; empty: none
  ContactFacts facts = {};              ///< with a coefficient of friction slip is followed
};
constexpr void describe(auto&& visit, std::type_identity<PathQuestion>) {
  visit(&PathQuestion::transverse,
        Quantity{"transverse", Dimension::length, "displacement along y"});
}

/// The loss of a path and whether its premises hold.
struct PathAnswer {
  TrajectoryDamping loss;
  Premises premises;
};
PathAnswer ask(const PathQuestion& question, const Context& context = {});

/// A contact as a damper of slow tangential motions under fast normal oscillation, over amplitudes
/// and frequencies.
struct DamperQuestion {
  ContactQuestion contact = {};                ///< at one position
  std::vector<double> normal_amplitude = {};   ///< m; empty: falling_slope finds it
  std::vector<double> angular_frequency = {};  ///< rad/s, at least one
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  std::optional<TangentialOscillator> oscillator = {};  ///< on the contact, of one amplitude, one ω
  std::optional<double> falling_slope = {};  ///< b of a friction force that falls by b, N s/m
  double largest_amplitude = 0;              ///< to look for stability in, m
  /// Of the slow motion, m/s; with friction γ depends on it and on facts.excursion.
  double drag_velocity = ContactFacts::unknown;
  ContactFacts facts = {};
};

/// The damping constant over amplitude and frequency, and what it does to an oscillator or a slider.
struct DamperAnswer {
  ContactAnswer contact;
  /// Empty without amplitudes. With friction γ is that with slip, NaN where the velocity or the
  /// excursion of the slow motion is not known, or the motion is not slow.
  DamperMap map = {};
  Field damping_constant_error = {};  ///< of the map of a surface, N s/m; empty: a law's
  Field damping_constant_without_slip = {}, slip_share = {};  ///< of the map with friction
  std::optional<OscillatorDecay> decay = {};
  /// Of a surface, by what the damping constant is off; NaN for what follows from K_t of the law.
  std::optional<OscillatorDecay> decay_error = {};
  std::vector<double> stabilising_amplitude = {};        ///< for each frequency, m; empty: no slope
  std::vector<double> stabilising_amplitude_error = {};  ///< of a surface, m
  /// Of each amplitude at the highest frequency: slip does not depend on it, inertia grows with it.
  std::vector<Premises> premises = {};
  std::vector<std::string> doubts = {};  ///< beside those of the contact

  const std::optional<FirstLoading>& first_loading() const { return contact.first_loading; }
};

constexpr void describe(auto&& visit, std::type_identity<DamperAnswer>) {
  using S = DamperAnswer;
  visit(&S::decay, Part{"decay", "free decay of the oscillator"});
  visit(&S::decay_error, Part{"decay_error", "errors of the free decay, of a surface"});
  visit(&S::stabilising_amplitude, Quantity{"stabilising_amplitude", Dimension::length,
                                            "minimum normal amplitude that stabilises the slider"});
  visit(&S::stabilising_amplitude_error, Quantity{"stabilising_amplitude_error", Dimension::length,
                                                  "error of stabilising_amplitude"});
  visit(&S::first_loading, Part{"first_loading", "plastic first loading of the surface"});
}

/// throws  InvalidInput for several positions, no frequency, an oscillator of several amplitudes or
///         frequencies, a slope or velocity that is not > 0, and as the functions of damper.hpp
DamperAnswer ask(DamperQuestion question, const Context& context = {});

/// Partial slip of a contact under tangential oscillations, with a normal one or without.
struct JointQuestion {
  ContactQuestion contact = {};  ///< at one position
  std::vector<TangentialOscillation> motions = {};
  double normal_amplitude = 0;   ///< u_z of δ + u_z cos ωt, m; 0: the normal force is constant
  double phase = 0;              ///< φ0 of the tangential motions against it, rad
  double angular_frequency = 0;  ///< to judge inertia, rad/s; 0: not known
  ContactFacts facts = {};       ///< with the coefficient of friction
  int steps = 2000;              ///< in a cycle with a normal oscillation; >= 16
  /// Of the part, m²: the law of a curve or a surface is scaled to it; of another law it is the area
  /// of the part that has this law. NaN: what was given is the part.
  double nominal_area = std::numeric_limits<double>::quiet_NaN();
  /// In a cycle of a surface that is simulated cell by cell too; empty: none is.
  std::optional<int> direct_steps = {};
};

/// The loss of each motion, and whether its premises hold.
struct JointAnswer {
  ContactAnswer contact;
  LawState state = {};  ///< at the mean indentation
  /// Of each motion; with a normal oscillation by the law, otherwise of a surface by its contacts.
  std::vector<JointLoss> losses = {};
  std::vector<JointLoss> simulated = {};  ///< cell by cell
  EqualFrequency largest = {};            ///< of the motions
  Premises premises = {};                 ///< of it
  std::vector<std::string> remarks = {};  ///< on the error of the losses
};

/// throws  InvalidInput for several positions, no motion, direct steps without a surface, and as
///         ask(ContactQuestion) and the functions of joint.hpp, whose costs are its own; NotConverged
///         where an integral or a simulated cycle did not; Interrupted
JointAnswer ask(JointQuestion question, const Context& context = {});

/// Slow motion, case (b), that moves on by more than a contact spot in one normal cycle: what
/// sticks then is no longer the same spot when it opens. A radius that is not known is NaN.
std::vector<std::string> doubts_of_path(double drag_velocity, double angular_frequency,
                                        double spot_radius);

}  // namespace salebra
