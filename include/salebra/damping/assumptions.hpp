// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <string>
#include <vector>

/// The assumptions behind a damping constant without slip. Each is checked against the limits at
/// which the loss changes by 5 % and by 20 % (docs/theory.md, section 8).
namespace salebra {

/// Contact parameters that the law and the motion do not contain. NaN: not known.
struct ContactParameters {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double friction_coefficient = unknown;  ///< μ > 0
  double hardness = unknown;              ///< H > 0, Pa
  double density = unknown;               ///< ρ > 0, kg/m³
  /// X > 0, m. Case (a): the largest tangential displacement from the mean, u_x by default. Case
  /// (b): the distance between the turning points of the slow motion, velocity times duration.
  double excursion = unknown;
  double contact_modulus = unknown;  ///< E* > 0, Pa
  double dundurs = unknown;          ///< Dundurs' β; default: one elastic body with G*/E*
  /// a at the deepest indentation, m: the radius of one contact, or the side of a rough surface.
  double loaded_size = unknown;
  double nominal_pressure = unknown;       ///< F over the nominal area, or over the one contact, Pa
  double max_pressure = unknown;       ///< Pa
  double mean_contact_pressure = unknown;  ///< F over contact area at the deepest indentation, Pa
  double rms_slope = unknown;              ///< h', rms slope of a rough surface
  /// Largest F of a previous plastic loading, N, with pressures up to the hardness; the law is then
  /// that of the residual surface (contact/normal/first_loading.hpp).
  double first_load = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<ContactParameters>) {
  using enum Dimension;
  using S = ContactParameters;
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
  visit(&S::max_pressure, Kept{"max_pressure", "largest pressure", pressure});
  visit(&S::mean_contact_pressure,
        Kept{"mean_contact_pressure", "normal force over the true contact area", pressure});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(
      &S::first_load,
      Kept{"first_load",
           "normal force of a plastic first loading, whose residual surface the law is of", force});
}

/// Adds the contact parameters that an indenter or the curve behind the law determines: E*, the
/// nominal pressure at the mean indentation, and the size and contact pressure at the deepest
/// indentation, which decide on plasticity and inertia. curve may be nullptr.
ContactParameters at_state(ContactParameters parameters, const ContactLaw& law, const ForceCurve* curve,
                      double indentation, double deepest);

/// Returns the radius of a typical contact patch, m: for an indenter that of its one contact; for a
/// curve 2E*A/(πK), since patches of radius a have K = 2E*Σa and A = πΣa². NaN where E* or K is not
/// known.
double spot_radius(const ContactParameters& parameters, const ContactLaw& law, const ForceCurve* curve,
                   double indentation);

enum class Verdict {
  holds,     ///< within the limit of 5 %
  doubtful,  ///< between the limits
  broken,    ///< beyond the limit of 20 %
  unknown    ///< a parameter is missing: Assumption::needs
};
template <>
struct EnumNames<Verdict> {
  static constexpr auto values =
      std::to_array<std::pair<Verdict, std::string_view>>({{Verdict::holds, "holds"},
                                                           {Verdict::doubtful, "doubtful"},
                                                           {Verdict::broken, "broken"},
                                                           {Verdict::unknown, "unknown"}});
};

/// One checked assumption. One that does not apply has the verdict `holds` and no numbers.
struct Assumption {
  double value = ContactParameters::unknown;
  /// NaN: the loss does not change by this much at any value that the law covers, or a parameter is
  /// missing that the limit depends on.
  double limit_5_percent = ContactParameters::unknown;
  double limit_20_percent = ContactParameters::unknown;
  /// For plasticity, replaces both limits: the value at which yielding starts. Its effect on the
  /// loss is not known. NaN for the other assumptions.
  double onset = ContactParameters::unknown;
  Verdict verdict = Verdict::unknown;
  std::string needs = {};  ///< missing member of ContactParameters, or "drag_velocity"; empty: none
};

constexpr void describe(auto&& visit, std::type_identity<Assumption>) {
  using enum Dimension;
  using S = Assumption;
  visit(&S::value, Quantity{"value", dimensionless, "NaN where it cannot be known"});
  visit(&S::limit_5_percent,
        Quantity{"limit_5_percent", dimensionless, "value at which the loss changes by 5 %"});
  visit(&S::limit_20_percent,
        Quantity{"limit_20_percent", dimensionless, "value at which the loss changes by 20 %"});
  visit(&S::onset, Quantity{"onset", dimensionless,
                            "value from which the contact flows, in place of both limits"});
  visit(&S::verdict, Quantity{"verdict", dimensionless, "holds, doubtful, broken or unknown"});
  visit(&S::needs,
        Kept{"needs", "keyword of ContactParameters that a verdict needs; empty where none does"});
}

/// Extent of slip in a contact.
enum class Regime {
  no_slip,       ///< both slip assumptions hold: the loss without slip is right to 5 %
  partial_slip,  ///< some springs slip, while others that carry a part of the force stick
  /// All springs slip except those that carry less than 5 % of the smallest normal force. If the
  /// contact opens in each cycle, sliding means that no spring ever sticks: case (b) from
  /// v_c = (μ/g) u_z ω on. Below v_c, case (b) counts as sliding only if slip of closed springs
  /// loses more than the relaxation of those that open; otherwise its force grows with velocity, as
  /// for a damper.
  sliding,
  /// A parameter is missing, or the excursion of case (b) is shorter than the distance per normal
  /// cycle, and the motion is not slow.
  unknown
};
template <>
struct EnumNames<Regime> {
  static constexpr auto values =
      std::to_array<std::pair<Regime, std::string_view>>({{Regime::no_slip, "no slip"},
                                                          {Regime::partial_slip, "partial slip"},
                                                          {Regime::sliding, "sliding"},
                                                          {Regime::unknown, "unknown"}});
};

/// Largest motion that keeps the slip assumptions to 5 % with a coefficient of friction.
struct LargestMotion {
  double friction_coefficient = ContactParameters::unknown;
  /// Limit for springs that open: v of case (b), m/s, otherwise u_x, m.
  double drag_velocity = ContactParameters::unknown;
  double tangential_amplitude = ContactParameters::unknown;
  double excursion =
      ContactParameters::unknown;  ///< limit of X for closed springs, m; 0: no slow motion
};

constexpr void describe(auto&& visit, std::type_identity<LargestMotion>) {
  using S = LargestMotion;
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::drag_velocity, quantity::drag_velocity);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::excursion, quantity::excursion);
}

/// The seven assumptions behind a loss, as assumptions_of() checks them. With g = K_t/K of the law at
/// the mean indentation, the spring at depth ζ may be stretched by (μ/g)(δ − ζ). Springs with
/// ζ > δ0 − u_z open and close during the cycle; the others stay closed.
struct Assumptions {
  /// value   M = μ u_z/(g u_x), case (b) μ u_z ω/(g v); dimensionless, larger is better.
  /// limits  computed from the springs of the law. (a) M at which the loss with slip differs by 5 %
  ///         from that without; all springs count, because the slip of opening and of closed
  ///         springs partly cancels at some phases. (b) The same for opening springs only.
  Assumption slip_of_opening_springs;
  /// value   X, m.
  /// limits  (a) u_x at the limit above. (b) X at which slip of the closed springs loses 5 % of the
  ///         relaxation loss over the same path there and back at velocity v, for many normal
  ///         cycles and turning points at the smallest indentation:
  ///             ∫K_t'(e + r)(X − 2e)dζ = 0.05 W Xω/(2πv),  e = (μ/g)(δ0 − u_z − ζ),
  ///         with r the mean rise of a closed spring's stretch in a normal cycle: πv/ω for v ≪ v_c,
  ///         (μ/g)u_z from v_c on. 0 where X would be shorter than the distance per normal cycle:
  ///         no slow motion at this velocity satisfies the assumption.
  Assumption slip_of_closed_springs;
  /// value   X/w, with w = 2πv/ω the distance of case (b) per normal cycle; larger is better. For
  ///         other motions the verdict is `holds`, without a value.
  /// limits  computed: a turning point at a random phase costs (1/π)∫θ²k dθ/∫θk dθ · w/X of the
  ///         loss, with k = K_t(δ0 + u_z cos θ) − K_t(δ0 − u_z); this is 0.44 w/X for constant
  ///         K_t'. At least 1: below that, a spring need not touch at all on one straight path.
  Assumption slow_motion;
  /// value   u_z, m.
  /// limits  computed: u_z at which Eq. (12), (15) or (16), proportional to u_z, is 5 % off the
  ///         theorem at finite amplitude, mean indentation held. A loss at finite amplitude does
  ///         not need this assumption.
  Assumption amplitude;
  /// value   at the deepest indentation δ0 + u_z, the largest of those that are known: max
  ///         pressure/H, 1.5 mean contact pressure/H (for a paraboloid), E*h'/H.
  /// onset   0.6, beyond which the verdict is doubtful (yielding begins below the surface at 1.6
  ///         yield stresses, H = 2.8; Greenwood and Williamson's ψ); beyond 1 it is broken. After a
  ///         first loading the value is the force at δ0 + u_z over the first load, and the onset is
  ///         1: below it the residual surface is elastic. Within 2 %, the accuracy of the law's
  ///         force, the value is set to 1.
  Assumption plasticity;
  /// value   ω a/c_s at δ0 + u_z, with c_s = √(G/ρ) of one elastic body with the law's G*/E*.
  /// limits  estimated: a stuck circle has the impedance K(1 + 0.58i ωa/c_s), so 0.55 and 1.1
  ///         change |K| by 5 and 20 %. In case (a) they are lower where waves carry away 5 % of the
  ///         loss: π·0.58 (ωa/c_s) u_x² K_t²/(2G*a).
  Assumption inertia;
  /// value   fraction of the loss that the coupling of pressure and traction changes, the largest
  ///         of direct simulations: 3.2|β|^2.62 for an indenter (12 and 52 % at β of ν = 0.3 and 0)
  ///         and 1.16|β|^2.69 for other contacts (4 and 18 %). Unknown in case (b), which was never
  ///         computed.
  /// limits  0.05 and 0.2.
  Assumption coupling;

  Regime regime = Regime::unknown;

  /// For the known μ, otherwise for μ = 0.1, 0.3 and 1.
  std::vector<LargestMotion> largest;
};

/// Description of one assumption: the condition and the value in a user's words, with {} for the
/// 5 % limit and for the value, the remedy where it fails, and the dimension of both numbers.
struct AssumptionWords : Kept {
  std::string_view assumption, here, remedy;
  Dimension value_dimension = Dimension::dimensionless;
};

constexpr void describe(auto&& visit, std::type_identity<Assumptions>) {
  using enum Dimension;
  using S = Assumptions;
  visit(&S::slip_of_opening_springs,
        AssumptionWords{{"slip_of_opening_springs", "slip where the contact opens and closes"},
                     "no slip where it opens and closes: M above {}",
                     "M = {}",
                     "use the loss with slip, which `friction_coefficient` gives"});
  visit(&S::slip_of_closed_springs,
        AssumptionWords{{"slip_of_closed_springs", "slip where it stays closed"},
                     "no slip where it stays closed: excursion below {}",
                     "{}",
                     "use the loss with slip, which `friction_coefficient` gives",
                     length});
  visit(&S::slow_motion, AssumptionWords{{"slow_motion", "slow tangential motion"},
                                      "slow: at least {} normal cycles in an excursion",
                                      "{}",
                                      "a longer `excursion`, or the two frequencies as they are"});
  visit(&S::amplitude, AssumptionWords{{"amplitude", "small amplitude of Eqs (12), (15) and (16)"},
                                    "Eqs (12), (15) and (16): amplitude below {}",
                                    "{}",
                                    "the damping constant itself has no such limit",
                                    length});
  visit(&S::plasticity, AssumptionWords{{"plasticity", "plasticity"},
                                     "elastic: pressure on spots below {} of the hardness",
                                     "{} at peak",
                                     "less load; a surface with `hardness` is loaded first"});
  visit(&S::inertia, AssumptionWords{{"inertia", "inertia"},
                                  "quasi-static: ωa/c_s below {}",
                                  "{} at peak",
                                  "a lower `frequency`, or a smaller part of the contact"});
  visit(&S::coupling, AssumptionWords{{"coupling", "coupling"},
                                   "pressure and traction uncoupled: {} of the loss",
                                   "{}",
                                   "the coupled cycle in three dimensions computes it"});
  visit(&S::regime, Kept{"regime", "no slip, partial slip, sliding or unknown"});
  visit(&S::largest, Kept{"largest",
                          "largest motions that keep the assumptions of slip to 5 %, of the "
                          "coefficient of friction that is known or of 0.1, 0.3 and 1"});
}

struct AssumptionName : AssumptionWords {
  Assumption Assumptions::*assumption;
};
std::span<const AssumptionName> assumption_names();

/// Checks the assumptions of a motion about the mean indentation δ0, m
/// (DampingResult::indentation).
///
///     Assumptions assumptions = assumptions_of(law, result.indentation, motion, {.hardness = 6e9});
///
/// A table is continued beyond its ends by exponentials with the F/K there. With an unknown
/// Drag::drag_velocity (NaN) the largest allowed one is found.
/// throws  InvalidInput for parameters that are not > 0, for a nominal pressure above the hardness,
///         and as relaxation_damping()
/// cost    about 10 ms and 10⁴ evaluations of the law
Assumptions assumptions_of(const ContactLaw& law, double mean_indentation, const Oscillation& motion,
                     const ContactParameters& parameters = {});
/// The same for two frequencies, as case (a) over the common period; without one, slip is unknown.
Assumptions assumptions_of(const ContactLaw& law, double mean_indentation, const TwoFrequencies& motion,
                     const ContactParameters& parameters = {});
/// The same for a sampled path about the middle of its indentations, with u_z and u_x half its
/// ranges; a path with drift is case (b) with its mean velocity.
Assumptions assumptions_of(const ContactLaw& law, const SampledMotion& path,
                     const ContactParameters& parameters = {});

/// Computes the loss of a law with slip: Coulomb's law holds for each of the springs that lose
/// energy without slip.
///
///     Loss loss = loss_with_slip(law, result.indentation, Drag{1e-9, 1e-6, 1e5}, 0.3, 1e-5);
///
/// Case (b) without an excursion is sliding without reversal, in which all springs slip. With an
/// excursion the result is the mean over the cycles there and back and over the phases of the
/// turning points, to first order in the distance per cycle over the excursion.
/// throws  InvalidInput for μ or an excursion that is not > 0, and as relaxation_damping()
Loss loss_with_slip(const ContactLaw& law, double mean_indentation, const Oscillation& motion,
                    double friction_coefficient, double excursion = ContactParameters::unknown);

/// Regimes of case (b) over velocity and excursion of the slow motion, computed from the springs of
/// the law.
struct RegimeMap {
  std::vector<double> velocity;   ///< v, m/s
  std::vector<double> excursion;  ///< X, m
  /// (velocities, excursions), as Assumptions::regime.
  std::vector<std::vector<Regime>> regime;
  /// W over W without slip (velocities, excursions), mean of a normal cycle there and back; NaN
  /// where X is shorter than the distance per cycle, and where nothing is lost without slip.
  Field loss_ratio;
  Field slip_ratio;  ///< part of it from springs that stay closed
  /// Largest X without slip at each velocity, m; 0: none, NaN: all.
  std::vector<double> no_slip_excursion;
  double no_slip_velocity = ContactParameters::unknown;  ///< largest v without slip, m/s; NaN: any
  double sliding_excursion =
      ContactParameters::unknown;  ///< X from which the contact slides, m; NaN: it opens in each cycle
  double critical_velocity =
      ContactParameters::unknown;  ///< v_c = (μ/g) u_z ω, m/s: above it nothing sticks
  /// W without slip over its small-amplitude form, Eq. (15), or (16) for an exponential law; times
  /// loss_ratio it is the loss over that equation.
  double full_stick_ratio = ContactParameters::unknown;
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

/// Computes the regime map of a law.
///
///     RegimeMap map = regime_map(law, result.indentation, {1e-9, 1e5}, {1e-6, 1e-5}, {1e-5}, 0.3);
///
/// throws  InvalidInput for a velocity, an excursion, an amplitude, a frequency or a μ that is
///         not > 0, and as relaxation_damping()
/// cost    some 10 ms, 1 ms for each velocity, and 256 evaluations of the law for each velocity and
///         excursion
RegimeMap regime_map(const ContactLaw& law, double mean_indentation,
                     const NormalOscillation& normal, const std::vector<double>& velocities,
                     const std::vector<double>& excursions, double friction_coefficient);

/// Whether a result can be used. The words are the same on the terminal, in JSON and result files,
/// in the report and in Python.
enum class Validity {
  valid,            ///< all assumptions hold: they change the loss by at most 5 %
  valid_with_care,  ///< one or more are between their limits of 5 and 20 %
  not_valid,        ///< one or more are beyond their limit of 20 %
  not_checked       ///< those that could be checked hold, and others could not be checked
};
template <>
struct EnumNames<Validity> {
  static constexpr auto values = std::to_array<std::pair<Validity, std::string_view>>(
      {{Validity::valid, "valid"},
       {Validity::valid_with_care, "valid with care"},
       {Validity::not_valid, "not valid"},
       {Validity::not_checked, "not checked"}});
};

/// An assumption in words, judged over all cases of a result.
struct AssumptionVerdict {
  std::string name = {};       ///< name of the member of Assumptions
  Verdict verdict = {};        ///< verdict of the worst case; unknown ranks after doubtful
  std::string assumption = {};  ///< "slow: at least 8.74 normal cycles in an excursion"
  std::string here = {};       ///< "2, at 2.04 MPa to 102 MPa"; "`hardness` not given"
  std::string remedy = {};     ///< what to do; empty where it holds
};

constexpr void describe(auto&& visit, std::type_identity<AssumptionVerdict>) {
  using S = Condition;
  visit(&S::name, Kept{"name", "name of the assumption"});
  visit(&S::verdict, Kept{"verdict", "holds, doubtful, broken or unknown"});
  visit(&S::assumption, Kept{"assumption", "what must hold for the loss to change by less than 5 %"});
  visit(&S::here, Kept{"here", "what holds in the worst case"});
  visit(&S::remedy, Kept{"remedy", "what to do; empty where it holds"});
}

/// Returns the name of the argument that supplies the contact parameter named by Assumption::needs.
std::string given_as(const std::string& parameter);

/// Returns the assumptions of a damping constant in words, worst first; `cases` is a
/// std::vector<Assumptions> here.
///
///     std::vector<AssumptionVerdict> verdicts = verdicts_of(cases, false, pressures);
///
/// pressures      of the cases, Pa, which the text then names; empty: it counts the cases
/// slip_followed  the loss includes slip, so slip is no assumption; but a contact in gross sliding
///                is not a damper
/// The small amplitude of the closed forms is not included: see closed_form_verdict().
std::vector<AssumptionVerdict> verdicts_of(std::span<const Assumptions> cases, bool slip_followed,
                                     std::span<const double> pressures = {});

/// Returns the additional assumption of Eqs (12), (15) and (16): a small amplitude.
Condition closed_form_verdict(std::span<const Assumptions> cases,
                                std::span<const double> pressures = {});

/// Returns the validity by the worst assumption.
Validity validity_of(std::span<const AssumptionVerdict> verdicts);

/// Formats one line per assumption, "  !   slow: at least … here 2, …", of at most 78 columns, with
/// the remedy below it where it does not hold. Names of parameters are in backticks.
std::string in_words(std::span<const AssumptionVerdict> verdicts);

/// Formats the regimes of the cases, "partial slip at 1 MPa to 5 MPa, sliding at 20 MPa"; empty
/// where none is known.
std::string regimes_in_words(std::span<const Assumptions> cases,
                             std::span<const double> pressures = {});

/// Formats the largest motions without slip of the least tolerant case, "no excursion (µ up to
/// 0.3), 89.6 pm at 5.75 µm/s (µ = 1)"; empty where none is known.
std::string motion_without_slip(std::span<const Assumptions> cases);

}  // namespace salebra
