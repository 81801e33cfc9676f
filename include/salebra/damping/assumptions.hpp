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
#include <salebra/damping/regime.hpp>
#include <span>
#include <string>
#include <vector>

/// The assumptions behind a damping constant without slip. Each assumption is checked against two
/// limits: the values at which its violation changes the loss by 5 % and by 20 % (docs/theory.md,
/// section 8).
namespace salebra {

/// Contact parameters that the law and the motion do not contain. NaN: not known.
struct ContactParameters {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double friction_coefficient = unknown;  ///< μ > 0
  double hardness = unknown;              ///< H > 0, Pa
  double density = unknown;               ///< ρ > 0, kg/m³
  /// Excursion X > 0, m. Case (a), EqualFrequency: the largest tangential displacement from the
  /// mean, u_x by default. Case (b), Drag: the distance between the turning points of the slow
  /// motion, its velocity times its duration from one turning point to the next.
  double excursion = unknown;
  double contact_modulus = unknown;  ///< E* > 0, Pa
  double dundurs = unknown;          ///< Dundurs' β; default: one elastic body with G*/E*
  /// Size a of the contact at the deepest indentation, m: its radius for one contact, the side of
  /// the surface for a rough surface.
  double loaded_size = unknown;
  double nominal_pressure = unknown;  ///< F over the nominal area or that of the one contact, Pa
  double max_pressure = unknown;      ///< largest contact pressure, Pa
  double mean_contact_pressure = unknown;  ///< F over contact area at the deepest indentation, Pa
  double rms_slope = unknown;              ///< h', rms slope of a rough surface
  /// Largest normal force of an earlier plastic first loading, N, in which pressures reached the
  /// hardness. The law of the contact must then be that of the residual surface
  /// (contact/normal/first_loading.hpp).
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

/// Adds to `parameters` those that follow from an indenter law or from the curve of a tabulated
/// law: E*, the nominal pressure at the mean indentation `indentation`, and the contact size and
/// contact pressure at the indentation `deepest`, which decide on plasticity and inertia. curve may
/// be nullptr.
ContactParameters at_state(ContactParameters parameters, const ContactLaw& law,
                           const ForceCurve* curve, double indentation, double deepest);

/// Returns the radius of a typical contact patch, m. For an indenter it is the radius of its one
/// contact. For a curve it is 2E*A/(πK) with the contact area A, since circular patches of radius a
/// have K = 2E*Σa and A = πΣa². NaN where E* or K is not known.
double spot_radius(const ContactParameters& parameters, const ContactLaw& law,
                   const ForceCurve* curve, double indentation);

enum class Verdict {
  holds,     ///< the value is within the 5 % limit
  doubtful,  ///< the value is between the 5 % and the 20 % limit
  broken,    ///< the value is beyond the 20 % limit
  unknown    ///< a parameter is missing, named by Assumption::needs
};
template <>
struct EnumNames<Verdict> {
  static constexpr auto values =
      std::to_array<std::pair<Verdict, std::string_view>>({{Verdict::holds, "holds"},
                                                           {Verdict::doubtful, "doubtful"},
                                                           {Verdict::broken, "broken"},
                                                           {Verdict::unknown, "unknown"}});
};

/// One checked assumption. An assumption that does not apply to the motion has the verdict `holds`
/// and no numbers.
struct Assumption {
  double value = ContactParameters::unknown;
  /// Values at which the loss changes by 5 % and by 20 %. NaN: the loss does not change by this
  /// much at any value that the law covers, or a parameter on which the limit depends is missing.
  double limit_5_percent = ContactParameters::unknown;
  double limit_20_percent = ContactParameters::unknown;
  /// For plasticity, replaces both limits: the value at which yielding starts. The effect of
  /// yielding on the loss is not known. NaN for all assumptions except plasticity.
  double onset = ContactParameters::unknown;
  Verdict verdict = Verdict::unknown;
  /// Name of the missing member of ContactParameters, "drag_velocity" or "angular_frequency"; empty
  /// if nothing is missing.
  std::string needs = {};
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

/// Largest motion at which slip with a given coefficient of friction changes the loss by at most 5
/// %.
struct MaxMotion {
  double friction_coefficient = ContactParameters::unknown;
  /// Limit set by springs that open and close: the velocity v of case (b), m/s; for other motions
  /// the tangential amplitude u_x, m.
  double drag_velocity = ContactParameters::unknown;
  double tangential_amplitude = ContactParameters::unknown;
  double excursion =
      ContactParameters::unknown;  ///< limit of X for closed springs, m; 0: no slow motion
};

constexpr void describe(auto&& visit, std::type_identity<MaxMotion>) {
  using S = MaxMotion;
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::drag_velocity, quantity::drag_velocity);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::excursion, quantity::excursion);
}

/// The seven assumptions behind a loss, as assumptions_of() checks them. With g = K_t/K of the law
/// at the mean indentation δ0, friction limits the stretch of the spring at depth ζ to (μ/g)(δ −
/// ζ). Springs with ζ > δ0 − u_z open and close during the cycle; springs with a smaller ζ stay
/// closed. Case (a) is EqualFrequency, case (b) is Drag with velocity v; W is the loss per normal
/// cycle.
struct Assumptions {
  /// value   friction number M = μ u_z/(g u_x), in case (b) M = μ u_z ω/(g v); dimensionless,
  ///         larger is better.
  /// limits  computed from the springs of the law. Case (a): the M at which the loss with slip
  ///         differs from the loss without slip by 5 %, over all springs, because the effects of
  ///         slip in opening and in closed springs partly cancel at some phases. Case (b): the same
  ///         over the opening springs only.
  Assumption slip_of_opening_springs;
  /// value   excursion X, m.
  /// limits  Case (a): the u_x at which M of slip_of_opening_springs is at its limit. Case (b): the
  ///         X at which slip of the closed springs loses 5 % of the relaxation loss over the same
  ///         path there and back at velocity v, for many normal cycles and for turning points at
  ///         the smallest indentation:
  ///             ∫K_t'(e + r)(X − 2e)dζ = 0.05 W Xω/(2πv),  e = (μ/g)(δ0 − u_z − ζ),
  ///         with r the mean rise of a closed spring's stretch in a normal cycle: πv/ω for v ≪ v_c,
  ///         (μ/g)u_z from v_c on. 0 where X would be shorter than the distance per normal cycle:
  ///         no slow motion at this velocity satisfies the assumption.
  Assumption slip_of_closed_springs;
  /// value   normal cycles per excursion, X/w, in case (b), where the body advances by w = 2πv/ω
  ///         per normal cycle; larger is better. For motions other than case (b) the verdict is
  ///         `holds`, without a value.
  /// limits  computed: a turning point at a random phase changes the loss by the fraction (1/π)∫θ²k
  ///         dθ/∫θk dθ · w/X, integrated over θ from 0 to π, with k = K_t(δ0 + u_z cos θ) − K_t(δ0
  ///         − u_z); for constant K_t' this fraction is 0.44 w/X. The limit is at least 1: with
  ///         less than one normal cycle per excursion, a spring may not touch at all between two
  ///         turning points.
  Assumption slow_motion;
  /// value   u_z, m.
  /// limits  computed: the u_z at which Eq. (12), (15) or (16), which are proportional to u_z,
  ///         differs by 5 % from the exact loss at finite amplitude (docs/theory.md, section 7) at
  ///         a constant mean indentation. Amplitude::finite does not need this assumption.
  Assumption amplitude;
  /// value   the largest of these numbers, as far as they are known, at the deepest indentation δ0
  ///         + u_z: maximum pressure/H, 1.5 mean contact pressure/H (for a paraboloid), and E*h'/H,
  ///         with the hardness H and the rms slope h'.
  /// onset   0.6: above it the verdict is doubtful, because yielding begins below the surface at a
  ///         pressure of 1.6 yield stresses, and H is 2.8 yield stresses (Greenwood and
  ///         Williamson's plasticity index has the same limit). Above 1 the verdict is broken.
  ///         After a plastic first loading the value is F(δ0 + u_z) over the largest force of the
  ///         first loading, and the onset is 1: at smaller forces the residual surface is elastic.
  ///         A value within 2 % of 1, the accuracy of the law's force, is set to 1.
  Assumption plasticity;
  /// value   ω a/c_s, with the contact size a at the indentation δ0 + u_z and the shear wave speed
  ///         c_s = √(G/ρ) of one elastic body with the law's G*/E*.
  /// limits  estimated: a stuck circular contact has the dynamic stiffness K(1 + 0.58i ωa/c_s), so
  ///         ωa/c_s of 0.55 and 1.1 changes its magnitude by 5 and 20 %. In case (a) the limits are
  ///         lower if waves carry away 5 or 20 % of the loss at smaller ωa/c_s; the energy of the
  ///         waves is π·0.58 (ωa/c_s) u_x² K_t²/(2G*a) per cycle.
  Assumption inertia;
  /// value   relative change of the loss by the coupling of pressure and traction, a fit to the
  ///         largest changes found in direct simulations: 3.2|β|^2.62 for an indenter (12 % for ν =
  ///         0.3, 52 % for ν = 0) and 1.16|β|^2.69 for other contacts (4 % and 18 %), with Dundurs'
  ///         β. Unknown in case (b), for which no simulation was made.
  /// limits  a change of 0.05 and of 0.2.
  Assumption coupling;

  Regime regime = Regime::unknown;

  /// Largest motions without slip: one entry for the known μ, otherwise entries for μ = 0.1, 0.3
  /// and 1.
  std::vector<MaxMotion> largest;
};

constexpr void describe(auto&& visit, std::type_identity<Assumptions>) {
  using S = Assumptions;
  visit(&S::slip_of_opening_springs,
        Kept{"slip_of_opening_springs", "slip where the contact opens and closes"});
  visit(&S::slip_of_closed_springs, Kept{"slip_of_closed_springs", "slip where it stays closed"});
  visit(&S::slow_motion, Kept{"slow_motion", "slow tangential motion"});
  visit(&S::amplitude, Kept{"amplitude", "small amplitude of Eqs (12), (15) and (16)"});
  visit(&S::plasticity, Kept{"plasticity", "plasticity"});
  visit(&S::inertia, Kept{"inertia", "inertia"});
  visit(&S::coupling, Kept{"coupling", "coupling"});
  visit(&S::regime, Kept{"regime", "no slip, partial slip, lifts off, sliding or unknown"});
  visit(&S::largest, Kept{"largest",
                          "largest motions that keep the assumptions of slip to 5 %, of the "
                          "coefficient of friction that is known or of 0.1, 0.3 and 1"});
}

/// Checks the assumptions of a motion about the mean indentation δ0, m
/// (DampingResult::indentation).
///
///     Assumptions assumptions =
///         assumptions_of(law, result.indentation, motion, {.hardness = 6e9});
///
/// A tabulated law is continued beyond the first and last indentation of its table by exponentials
/// with the decay length F/K at that indentation. If Drag::drag_velocity is NaN, the function finds
/// the largest velocity that the assumptions allow.
/// throws  InvalidInput for contact parameters that are not > 0, for a nominal pressure above the
///         hardness, and wherever relaxation_damping() does
/// cost    about 10 ms and 10⁴ evaluations of the law
Assumptions assumptions_of(const ContactLaw& law, double mean_indentation,
                           const Oscillation& motion, const ContactParameters& parameters = {});
/// Checks the assumptions of a motion with two frequencies, as for case (a) but over the common
/// period of the two; without a common period, the slip assumptions are unknown.
Assumptions assumptions_of(const ContactLaw& law, double mean_indentation,
                           const TwoFrequencies& motion, const ContactParameters& parameters = {});
/// Checks the assumptions of a sampled path. The mean indentation is the middle of the path's range
/// of indentations; u_z and u_x are half its ranges of indentation and displacement. A path with
/// drift counts as case (b) with its mean velocity.
Assumptions assumptions_of(const ContactLaw& law, const SampledMotion& path,
                           const ContactParameters& parameters = {});

/// Computes the loss of a law with slip: Coulomb's law holds for each of the springs that lose
/// energy without slip.
///
///     Loss loss = loss_with_slip(law, result.indentation, Drag{1e-9, 1e-6, 1e5}, 0.3, 1e-5);
///
/// A Drag (case (b)) without an excursion is sliding without reversal, in which all springs slip.
/// With an excursion the result is the mean loss per normal cycle over one path there and back and
/// over all phases of the turning points, to first order in (distance per normal cycle)/excursion.
/// throws  InvalidInput for a coefficient of friction or an excursion that is not > 0, and wherever
///         relaxation_damping() does
Loss loss_with_slip(const ContactLaw& law, double mean_indentation, const Oscillation& motion,
                    double friction_coefficient, double excursion = ContactParameters::unknown);

/// Slip regimes of a Drag, case (b), over velocity and excursion of the slow motion, computed from
/// the springs of the law.
struct RegimeMap {
  std::vector<double> velocity;   ///< v, m/s
  std::vector<double> excursion;  ///< X, m
  /// Regime for each velocity and, inside, each excursion, as Assumptions::regime.
  std::vector<std::vector<Regime>> regime;
  /// Loss with slip over loss without slip, shape (velocities, excursions); both are means per
  /// normal cycle over one path there and back. NaN where X is shorter than the distance per normal
  /// cycle, and where nothing is lost without slip.
  Field loss_ratio;
  Field slip_ratio;  ///< part of loss_ratio from springs that stay closed
  /// Largest excursion X without slip at each velocity, m; 0: slip at every X; NaN: every X is
  /// without slip.
  std::vector<double> no_slip_excursion;
  /// Largest velocity v without slip of springs that open and close, m/s; NaN: no slip at any v.
  double no_slip_velocity = ContactParameters::unknown;
  /// Excursion X above which the contact slides, m; NaN where it opens in each cycle.
  double sliding_excursion = ContactParameters::unknown;
  /// v_c = (μ/g) u_z ω with g = K_t/K, m/s: above it no spring sticks.
  double critical_velocity = ContactParameters::unknown;
  /// Loss without slip over its small-amplitude form, Eq. (15), or Eq. (16) for an exponential law.
  /// Multiplied by loss_ratio it gives the loss with slip over that small-amplitude form.
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
  visit(&S::slip_ratio, Kept{"slip_ratio", "part of it from springs that stay closed"});
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
/// throws  InvalidInput for a velocity, an excursion, an amplitude, a frequency or a coefficient of
///         friction that is not > 0, and wherever relaxation_damping() does
/// cost    some 10 ms, 1 ms for each velocity, and 256 evaluations of the law for each velocity and
///         excursion
RegimeMap regime_map(const ContactLaw& law, double mean_indentation,
                     const NormalOscillation& normal, const std::vector<double>& velocities,
                     const std::vector<double>& excursions, double friction_coefficient);

/// Whether a result can be used. The words are the same on the terminal, in JSON and result files,
/// in the report and in Python.
enum class Validity {
  valid,            ///< all assumptions hold: each error of the loss is at most 5 %
  valid_with_care,  ///< an assumption is between its limits of 5 and 20 %
  not_valid,        ///< an assumption is beyond its limit of 20 %
  not_checked       ///< some assumptions could not be checked; all others hold
};
template <>
struct EnumNames<Validity> {
  static constexpr auto values = std::to_array<std::pair<Validity, std::string_view>>(
      {{Validity::valid, "valid"},
       {Validity::valid_with_care, "valid with care"},
       {Validity::not_valid, "not valid"},
       {Validity::not_checked, "not checked"}});
};

}  // namespace salebra
