// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/grid.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <string>
#include <vector>

/// Whether a damping constant without slip may be used: the premises behind it, each with the
/// limits at which the loss changes by 5 % and by 20 % (docs/theory.md, section 8).
namespace salebra {

/// What is known of a contact in addition to its law and its motion. NaN: not known.
struct ContactFacts {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double friction_coefficient = unknown;  ///< μ > 0
  double hardness = unknown;              ///< H > 0, Pa
  double density = unknown;               ///< ρ > 0, kg/m³
  /// X > 0, m: case (a) the greatest tangential displacement from the mean, u_x if not given; case
  /// (b) the way from one turning point of the slow motion to the other, velocity times duration.
  double excursion = unknown;
  double contact_modulus = unknown;  ///< E* > 0, Pa
  double dundurs = unknown;          ///< β; one elastic body with the law's G*/E* if not given
  /// a at the deepest indentation, m: radius of one contact, side of a rough surface.
  double loaded_size = unknown;
  double nominal_pressure = unknown;       ///< F over the nominal area or over the one contact, Pa
  double largest_pressure = unknown;       ///< Pa
  double mean_contact_pressure = unknown;  ///< F over the contact area at the deepest, Pa
  double rms_slope = unknown;              ///< h' of a rough surface
  /// F up to which the surface was loaded before with pressures up to its hardness, N; the law is
  /// that of its residual surface (contact/normal/first_loading.hpp).
  double first_load = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<ContactFacts>) {
  using enum Dimension;
  using S = ContactFacts;
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::hardness, Quantity{"hardness", pressure, "hardness of the softer body"});
  visit(&S::density, Quantity{"density", mass_density, "mass density of the elastic body"});
  visit(&S::excursion, quantity::excursion);
  visit(&S::contact_modulus, Quantity{"contact_modulus", pressure, "contact modulus E*"});
  visit(&S::dundurs,
        Quantity{"dundurs", dimensionless, "Dundurs' constant beta of the two bodies"});
  visit(&S::loaded_size,
        Kept{"loaded_size", "radius of one contact, side of a rough surface", length});
  visit(&S::nominal_pressure,
        Kept{"nominal_pressure", "normal force over the nominal area", pressure});
  visit(&S::largest_pressure, Kept{"largest_pressure", "largest pressure", pressure});
  visit(&S::mean_contact_pressure,
        Kept{"mean_contact_pressure", "normal force over the true contact area", pressure});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(
      &S::first_load,
      Kept{"first_load",
           "normal force of a plastic first loading, whose residual surface the law is of", force});
}

/// Adds what an indenter, or the curve that the law is made of, says of the contact: E*, the nominal
/// pressure at a mean indentation, and the size and the pressure in contact at the deepest
/// indentation of the oscillation, by which plasticity and inertia are judged. curve may be nullptr.
ContactFacts at_state(ContactFacts facts, const ContactLaw& law, const ForceCurve* curve,
                      double indentation, double deepest);

/// Radius of a typical contact spot, m: of an indenter's one contact; of a curve 2E*A/(πK), since
/// spots of radius a have K = 2E*Σa and A = πΣa². NaN where E* or K is not known.
double spot_radius(const ContactFacts& facts, const ContactLaw& law, const ForceCurve* curve,
                   double indentation);

enum class Verdict {
  holds,     ///< within the limit of 5 %
  doubtful,  ///< between the limits
  broken,    ///< beyond the limit of 20 %
  unknown    ///< something is not known: Premise::needs
};
template <>
struct Words<Verdict> {
  static constexpr auto values =
      std::to_array<std::pair<Verdict, std::string_view>>({{Verdict::holds, "holds"},
                                                           {Verdict::doubtful, "doubtful"},
                                                           {Verdict::broken, "broken"},
                                                           {Verdict::unknown, "unknown"}});
};

/// One that an answer does not need holds, and has neither value nor limits.
struct Premise {
  double value = ContactFacts::unknown;
  /// NaN: the loss does not change so much at any value that the law covers, or a fact is missing
  /// without which there is no limit.
  double limit_5_percent = ContactFacts::unknown;
  double limit_20_percent = ContactFacts::unknown;
  /// Of plasticity in place of both: the value from which the contact flows. How much this changes
  /// the loss is not known. NaN: of another premise.
  double onset = ContactFacts::unknown;
  Verdict verdict = Verdict::unknown;
  std::string needs =
      {};  ///< member of ContactFacts, or "drag_velocity", that a verdict needs; empty: none
};

constexpr void describe(auto&& visit, std::type_identity<Premise>) {
  using enum Dimension;
  using S = Premise;
  visit(&S::value, Quantity{"value", dimensionless, "NaN where it cannot be known"});
  visit(&S::limit_5_percent,
        Quantity{"limit_5_percent", dimensionless, "value at which the loss changes by 5 %"});
  visit(&S::limit_20_percent,
        Quantity{"limit_20_percent", dimensionless, "value at which the loss changes by 20 %"});
  visit(&S::onset, Quantity{"onset", dimensionless,
                            "value from which the contact flows, in place of both limits"});
  visit(&S::verdict, Quantity{"verdict", dimensionless, "holds, doubtful, broken or unknown"});
  visit(&S::needs,
        Kept{"needs", "keyword of ContactFacts that a verdict needs; empty where none does"});
}

/// How much of a contact slips.
enum class Regime {
  no_slip,       ///< both premises of slip hold: the loss is that without slip to 5 %
  partial_slip,  ///< levels slip, and others that carry a part of the force do not
  /// All levels slip but those that carry less than 5 % of the least normal force; where the
  /// contact opens in each cycle, levels never stick, which is case (b) from v_c = (μ/g) u_z ω on.
  /// Case (b) below v_c slides only where the slip of closed levels loses more than the relaxation
  /// of those that open; otherwise its force grows with the velocity, as that of a damper.
  sliding,
  /// Not known: a fact is missing, or the excursion of case (b) is shorter than the way in one
  /// normal cycle, and the motion not slow.
  unknown
};
template <>
struct Words<Regime> {
  static constexpr auto values =
      std::to_array<std::pair<Regime, std::string_view>>({{Regime::no_slip, "no slip"},
                                                          {Regime::partial_slip, "partial slip"},
                                                          {Regime::sliding, "sliding"},
                                                          {Regime::unknown, "unknown"}});
};

/// Largest motion that keeps the slip premises to 5 % with a coefficient of friction.
struct LargestMotion {
  double friction_coefficient = ContactFacts::unknown;
  /// The limit of the opening levels: v of case (b), m/s, else u_x, m.
  double drag_velocity = ContactFacts::unknown;
  double tangential_amplitude = ContactFacts::unknown;
  double excursion =
      ContactFacts::unknown;  ///< X of the closed levels, m; 0: no slow motion at this velocity
};

constexpr void describe(auto&& visit, std::type_identity<LargestMotion>) {
  using S = LargestMotion;
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::drag_velocity, quantity::drag_velocity);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::excursion, quantity::excursion);
}

/// The seven premises. With g = K_t/K of the law at the mean indentation, levels ζ that open and
/// close during the cycle (ζ > δ0 − u_z) and levels that stay closed, each a spring that may be
/// stretched by (μ/g)(δ − ζ):
struct Premises {
  /// value  M = μ u_z/(g u_x), case (b) μ u_z ω/(g v); dimensionless, the larger the better.
  /// limits computed from the springs of the law: (a) M at which the loss with slip differs by 5 %
  /// from that without; all levels,
  ///        because the slip of opening and of closed levels partly cancel at some phases. (b) the
  ///        same of the opening levels.
  Premise slip_of_opening_levels;
  /// value  X, m.
  /// limits (a) the u_x of the limit above. (b) X at which the closed levels lose, by slip, 5 % of
  /// the relaxation loss over the same
  ///        way there and back at the velocity v, many normal cycles that touch the turning points
  ///        at the least indentation: ∫K_t'(e + r)(X − 2e)dζ = 0.05 W Xω/(2πv), e = (μ/g)(δ0 − u_z
  ///        − ζ), r the mean rise of a closed level's stretch in a normal cycle: πv/ω for v ≪ v_c,
  ///        (μ/g)u_z from v_c on. 0 where X would be shorter than the way in one normal cycle: no
  ///        slow motion at this velocity keeps the premise.
  Premise slip_of_closed_levels;
  /// value  X/w, w = 2πv/ω the way of case (b) in one normal cycle; the larger the better. Other
  ///        motions are not slow: no value, holds.
  /// limits computed: a turning point at a random phase costs (1/π)∫θ²k dθ/∫θk dθ · w/X of the
  /// loss, k = K_t(δ0 + u_z cos θ) −
  ///        K_t(δ0 − u_z), which is 0.44 w/X for constant K_t'. At least 1: below, no level needs
  ///        to touch on one straight way.
  Premise slow_motion;
  /// value  u_z, m.
  /// limits computed: u_z at which Eq. (12), (15) or (16), proportional to u_z, is 5 % off the
  /// theorem at finite amplitude, mean
  ///        indentation held. A loss at finite amplitude does not need this premise.
  Premise amplitude;
  /// value  at the deepest indentation δ0 + u_z, the largest that is known of: largest pressure/H,
  ///        1.5 mean pressure of the contact/H (a paraboloid's), E*h'/H.
  /// onset  0.6 (flow begins below the surface at 1.6 yield stresses, H = 2.8; Greenwood and
  ///        Williamson's ψ), beyond which the premise is doubtful; it is broken beyond 1. After a
  ///        first loading: the force at δ0 + u_z over the first load, 1: below it the residual
  ///        surface is elastic. To 2 %, by which the law's force may be off that of the contact.
  Premise plasticity;
  /// value  ω a/c_s at δ0 + u_z, c_s = √(G/ρ) of one elastic body with the law's G*/E*.
  /// limits estimated: a stuck circle has the impedance K(1 + 0.58i ωa/c_s), so that 0.55 and 1.1
  /// change |K| by 5 and 20 %; in case (a)
  ///        less, where waves carry away 5 % of the loss: π·0.58 (ωa/c_s) u_x² K_t²/(2G*a).
  Premise inertia;
  /// value  share of the loss that the coupling of pressure and traction changes, the largest of
  ///        direct simulations, for β of ν = 0.3 and 0: 3.2|β|^2.62 of an indenter, 12 and 52 %, and
  ///        1.16|β|^2.69 of other contacts, 4 and 18 %. Case (b) was never computed: unknown.
  /// limits 0.05 and 0.2.
  Premise coupling;

  Regime regime = Regime::unknown;

  /// For the μ that is known, otherwise for μ = 0.1, 0.3 and 1.
  std::vector<LargestMotion> largest;
};

/// Of a premise what stands behind its name: the condition and the value in the words of a user,
/// with {} for the limit of 5 % and the value, what to do where it fails, and the dimension of both.
struct PremiseWords : Kept {
  std::string_view condition, here, remedy;
  Dimension value_dimension = Dimension::dimensionless;
};

constexpr void describe(auto&& visit, std::type_identity<Premises>) {
  using enum Dimension;
  using S = Premises;
  visit(&S::slip_of_opening_levels,
        PremiseWords{{"slip_of_opening_levels", "slip where the contact opens and closes"},
                     "no slip where it opens and closes: M above {}",
                     "M = {}",
                     "use the loss with slip, which `friction_coefficient` gives"});
  visit(&S::slip_of_closed_levels,
        PremiseWords{{"slip_of_closed_levels", "slip where it stays closed"},
                     "no slip where it stays closed: excursion below {}",
                     "{}",
                     "use the loss with slip, which `friction_coefficient` gives",
                     length});
  visit(&S::slow_motion, PremiseWords{{"slow_motion", "slow tangential motion"},
                                      "slow: at least {} normal cycles in an excursion",
                                      "{}",
                                      "a longer `excursion`, or the two frequencies as they are"});
  visit(&S::amplitude, PremiseWords{{"amplitude", "small amplitude of Eqs (12), (15) and (16)"},
                                    "Eqs (12), (15) and (16): amplitude below {}",
                                    "{}",
                                    "the damping constant itself has no such limit",
                                    length});
  visit(&S::plasticity, PremiseWords{{"plasticity", "plasticity"},
                                     "elastic: pressure on spots below {} of the hardness",
                                     "{} at peak",
                                     "less load; a surface with `hardness` is loaded first"});
  visit(&S::inertia, PremiseWords{{"inertia", "inertia"},
                                  "quasi-static: ωa/c_s below {}",
                                  "{} at peak",
                                  "a lower `frequency`, or a smaller part of the contact"});
  visit(&S::coupling, PremiseWords{{"coupling", "coupling"},
                                   "pressure and traction uncoupled: {} of the loss",
                                   "{}",
                                   "the coupled cycle in three dimensions computes it"});
  visit(&S::regime, Kept{"regime", "no slip, partial slip, sliding or unknown"});
  visit(&S::largest, Kept{"largest",
                          "largest motions that keep the premises of slip to 5 %, of the "
                          "coefficient of friction that is known or of 0.1, 0.3 and 1"});
}

struct PremiseName : PremiseWords {
  Premise Premises::*premise;
};
std::span<const PremiseName> premise_names();

/// mean_indentation: δ0, m, as DampingResult::indentation. A table is continued beyond its ends by
/// exponentials with the F/K there. Drag::drag_velocity NaN: not known; the largest is found.
/// throws  InvalidInput for facts that are not > 0, for a nominal pressure above the hardness, and
///         as relaxation_damping()
/// cost    about 10 ms and 10⁴ evaluations of the law
Premises premises_of(const ContactLaw& law, double mean_indentation, const Oscillation& motion,
                     const ContactFacts& facts = {});
/// Two frequencies: as case (a), over the common period; without one the slip is not known.
Premises premises_of(const ContactLaw& law, double mean_indentation, const TwoFrequencies& motion,
                     const ContactFacts& facts = {});
/// A sampled path about the middle of its indentations, u_z and u_x half its ranges; one that
/// drifts is case (b) with its mean velocity.
Premises premises_of(const ContactLaw& law, const SampledMotion& path,
                     const ContactFacts& facts = {});

/// The loss of a law with slip: Coulomb's law holds for each of the springs that lose energy without
/// slip. Case (b) without an excursion: sliding that goes on, all
/// levels slip; with one: mean of a cycle on the way there and back, and over the phases of the
/// turning points, to first order in the way of a cycle over the excursion.
/// throws  InvalidInput for μ or an excursion that is not > 0, and as relaxation_damping()
Loss loss_with_slip(const ContactLaw& law, double mean_indentation, const Oscillation& motion,
                    double friction_coefficient, double excursion = ContactFacts::unknown);

/// Regimes of case (b) over velocity and excursion of the slow motion, with borders from the
/// springs of the law.
struct RegimeMap {
  std::vector<double> velocity;   ///< v, m/s
  std::vector<double> excursion;  ///< X, m
  /// (velocities, excursions): as Premises::regime.
  std::vector<std::vector<Regime>> regime;
  /// W/W without slip (velocities, excursions), mean of a normal cycle on the way there and back;
  /// NaN where X is shorter than the way in one, and where nothing is lost without slip.
  Field loss_ratio;
  Field slip_ratio;  ///< its part from levels that stay closed
  /// X up to which there is no slip at each velocity, m; 0: at no excursion, NaN: at every one.
  std::vector<double> no_slip_excursion;
  double no_slip_velocity =
      ContactFacts::unknown;  ///< v up to which there may be no slip, m/s; NaN: any
  double sliding_excursion =
      ContactFacts::unknown;  ///< X from which the contact slides, m; NaN: it opens in each cycle
  double critical_velocity =
      ContactFacts::unknown;  ///< v_c = (μ/g) u_z ω, m/s: levels never stick beyond
  /// W without slip over its small-amplitude form, Eq. (15), or (16) of an exponential law:
  /// loss_ratio times this is the loss over that equation.
  double full_stick_ratio = ContactFacts::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<RegimeMap>) {
  using enum Dimension;
  using S = RegimeMap;
  visit(&S::velocity, Kept{"velocity", "velocities of the slow motion", Dimension::velocity});
  visit(&S::excursion, Kept{"excursion", "distances between the turning points", length});
  visit(&S::regime, Kept{"regime",
                         "'no slip', 'partial slip', 'sliding' or 'unknown', for each velocity a "
                         "list over the excursions"});
  visit(&S::loss_ratio,
        Kept{"loss_ratio",
             "energy dissipated over that without slip (velocities, excursions); NaN where the "
             "excursion is shorter than the way in one normal cycle"});
  visit(&S::slip_ratio, Kept{"slip_ratio", "part of it from levels that stay closed"});
  visit(&S::no_slip_excursion,
        Kept{"no_slip_excursion",
             "largest excursion without slip at each velocity; 0: none, NaN: all", length});
  visit(&S::no_slip_velocity, Quantity{"no_slip_velocity", Dimension::velocity,
                                       "largest velocity of a slow motion without slip"});
  visit(&S::sliding_excursion,
        Quantity{"sliding_excursion", length, "excursion from which the contact slides"});
  visit(&S::critical_velocity,
        Quantity{"critical_velocity", Dimension::velocity, "velocity from which nothing sticks"});
  visit(&S::full_stick_ratio,
        Quantity{"full_stick_ratio", dimensionless,
                 "energy dissipated in a cycle without slip over its small-amplitude form"});
}

/// throws  InvalidInput for a velocity, an excursion, an amplitude, a frequency or a μ that is not
///         > 0, and as relaxation_damping()
/// cost    some 10 ms, 1 ms for each velocity, and 256 evaluations of the law for each velocity and
///         excursion
RegimeMap regime_map(const ContactLaw& law, double mean_indentation,
                     const NormalOscillation& normal, const std::vector<double>& velocities,
                     const std::vector<double>& excursions, double friction_coefficient);

/// Whether a result may be used, in one word and in the words of a user: the same on the terminal,
/// in JSON and files, in the report and in Python.
enum class Validity {
  valid,            ///< all conditions hold: 5 % of the loss at most
  valid_with_care,  ///< one or more are between their limits of 5 and 20 %
  not_valid,        ///< one or more are beyond their limit of 20 %
  not_checked       ///< those that could be judged hold, and others could not
};
template <>
struct Words<Validity> {
  static constexpr auto values = std::to_array<std::pair<Validity, std::string_view>>(
      {{Validity::valid, "valid"},
       {Validity::valid_with_care, "valid with care"},
       {Validity::not_valid, "not valid"},
       {Validity::not_checked, "not checked"}});
};

/// A premise in words, judged over all cases of a result.
struct Condition {
  std::string name = {};       ///< of the member of Premises
  Verdict verdict = {};        ///< the worst of the cases; one that is unknown comes after doubtful
  std::string condition = {};  ///< "slow: at least 8.74 normal cycles in an excursion"
  std::string here = {};       ///< "2, at 2.04 MPa to 102 MPa"; "`hardness` not given"
  std::string remedy = {};     ///< what to do; empty where it holds
};

constexpr void describe(auto&& visit, std::type_identity<Condition>) {
  using S = Condition;
  visit(&S::name, Kept{"name", "name of the premise"});
  visit(&S::verdict, Kept{"verdict", "holds, doubtful, broken or unknown"});
  visit(&S::condition, Kept{"condition", "what must hold for the loss to change by less than 5 %"});
  visit(&S::here, Kept{"here", "what holds in the worst case"});
  visit(&S::remedy, Kept{"remedy", "what to do; empty where it holds"});
}

/// The argument that gives a fact of Premise::needs.
std::string given_as(const std::string& fact);

/// The conditions of a damping constant, worst first. pressures: of the cases, Pa, to be named;
/// empty: they are counted. slip_followed: the loss is that with slip, which then is no condition,
/// but a contact that slides as a whole is no damper.
/// The amplitude of the closed forms is none: see closed_form_condition().
std::vector<Condition> conditions_of(std::span<const Premises> cases, bool slip_followed,
                                     std::span<const double> pressures = {});

/// What Eqs (12), (15) and (16) need in addition.
Condition closed_form_condition(std::span<const Premises> cases,
                                std::span<const double> pressures = {});

/// Of the worst condition.
Validity validity_of(std::span<const Condition> conditions);

/// A line for each condition, "  !   slow: at least … here 2, …", of at most 78 columns, with its
/// remedy below where it does not hold. Names of facts stand in backticks.
std::string in_words(std::span<const Condition> conditions);

/// The regimes of the cases, "partial slip at 1 MPa to 5 MPa, sliding at 20 MPa"; empty where none
/// is known.
std::string regimes_in_words(std::span<const Premises> cases,
                             std::span<const double> pressures = {});

/// The largest motions without slip, "no excursion (µ up to 0.3), 89.6 pm at 5.75 µm/s (µ = 1)", of the
/// case that bears least; empty where none is known.
std::string motion_without_slip(std::span<const Premises> cases);

}  // namespace salebra
