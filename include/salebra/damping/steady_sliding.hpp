// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/quantities.hpp>
#include <span>
#include <utility>
#include <vector>

namespace salebra {

/// State of a contact in steady sliding at constant velocity under a normal oscillation.
struct SteadySliding {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double indentation = unknown;        ///< δ0, m
  double mean_force = unknown;         ///< F̄, mean normal force of the cycle, N
  double critical_velocity = unknown;  ///< v_c = μK/K_t·u_z ω, m/s; T̄ = μF̄ for v >= v_c
  /// μF(δ_min)/F̄, the apparent static coefficient of friction: limit of T̄/F̄ as v → 0. δ_min is
  /// the smallest indentation of the cycle.
  double static_friction_coefficient = unknown;
  /// Γ, N s/m, the slope of T̄ at low speed: T̄ = μF(δ_min) + Γv + O(v^{3/2}); NaN for u_z = 0.
  double low_speed_damping = unknown;
  double relaxation_damping = unknown;     ///< γ of a Drag without slip, N s/m
  double mean_tangential_force = unknown;  ///< T̄, N
  double friction_coefficient = unknown;   ///< T̄/F̄, the apparent coefficient of friction
  double sliding_damping = unknown;  ///< dT̄/dv at velocity v, N s/m: Γ as v → 0, 0 for v >= v_c
  double relaxation_work = unknown;  ///< lost per period by springs that open and close, J
  double slip_work = unknown;        ///< lost per period by springs that stay closed, J
  double error_estimate = unknown;   ///< error of mean_tangential_force by the quadrature, N
  bool converged = false;            ///< whether the quadratures reached the tolerance
};

constexpr void describe(auto&& visit, std::type_identity<SteadySliding>) {
  using enum Dimension;
  using S = SteadySliding;
  visit(&S::indentation, Kept{"indentation", "mean indentation of the cycle", length});
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::critical_velocity,
        Quantity{"critical_velocity", velocity, "velocity from which nothing sticks"});
  visit(&S::static_friction_coefficient,
        Quantity{"static_friction_coefficient", dimensionless, "friction coefficient as v -> 0"});
  visit(&S::low_speed_damping,
        Quantity{"low_speed_damping", damping, "damping constant of slow sliding"});
  visit(&S::relaxation_damping,
        Quantity{"relaxation_damping", damping, "damping constant without slip, case (b)"});
  visit(&S::mean_tangential_force,
        Quantity{"mean_tangential_force", force, "tangential force, mean over a cycle"});
  visit(&S::friction_coefficient, quantity::friction_coefficient);
  visit(&S::sliding_damping, Quantity{"sliding_damping", damping,
                                      "growth of the mean friction force with velocity, dT/dv"});
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::slip_work, quantity::slip_work);
  visit(&S::error_estimate,
        Kept{"error_estimate", "numerical error of mean_tangential_force", force});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
}

/// Numerical errors of the numbers of a SteadySliding on a surface; NaN where unknown.
struct SlidingErrors {
  static constexpr double unknown = SteadySliding::unknown;
  double mean_force_error = unknown, critical_velocity_error = unknown,
         static_friction_coefficient_error = unknown, low_speed_damping_error = unknown,
         relaxation_damping_error = unknown, mean_tangential_force_error = unknown,
         friction_coefficient_error = unknown, sliding_damping_error = unknown,
         relaxation_work_error = unknown, slip_work_error = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<SlidingErrors>) {
  using enum Dimension;
  using S = SlidingErrors;
  visit(&S::mean_force_error, Quantity{"mean_force_error", force, "error of mean_force"});
  visit(&S::critical_velocity_error,
        Quantity{"critical_velocity_error", velocity, "error of critical_velocity"});
  visit(&S::static_friction_coefficient_error,
        Quantity{"static_friction_coefficient_error", dimensionless,
                 "error of static_friction_coefficient"});
  visit(&S::low_speed_damping_error,
        Quantity{"low_speed_damping_error", damping, "error of low_speed_damping"});
  visit(&S::relaxation_damping_error,
        Quantity{"relaxation_damping_error", damping, "error of relaxation_damping"});
  visit(&S::mean_tangential_force_error,
        Quantity{"mean_tangential_force_error", force, "error of mean_tangential_force"});
  visit(&S::friction_coefficient_error,
        Quantity{"friction_coefficient_error", dimensionless, "error of friction_coefficient"});
  visit(&S::sliding_damping_error,
        Quantity{"sliding_damping_error", damping, "error of sliding_damping"});
  visit(&S::relaxation_work_error,
        Quantity{"relaxation_work_error", energy, "error of relaxation_work"});
  visit(&S::slip_work_error, Quantity{"slip_work_error", energy, "error of slip_work"});
}

/// Pairs of each number of SteadySliding and its error in SlidingErrors.
inline constexpr std::pair<double SteadySliding::*, double SlidingErrors::*> sliding_errors[]{
    {&SteadySliding::mean_force, &SlidingErrors::mean_force_error},
    {&SteadySliding::critical_velocity, &SlidingErrors::critical_velocity_error},
    {&SteadySliding::static_friction_coefficient,
     &SlidingErrors::static_friction_coefficient_error},
    {&SteadySliding::low_speed_damping, &SlidingErrors::low_speed_damping_error},
    {&SteadySliding::mean_tangential_force, &SlidingErrors::mean_tangential_force_error},
    {&SteadySliding::friction_coefficient, &SlidingErrors::friction_coefficient_error},
    {&SteadySliding::sliding_damping, &SlidingErrors::sliding_damping_error},
    {&SteadySliding::relaxation_work, &SlidingErrors::relaxation_work_error},
    {&SteadySliding::slip_work, &SlidingErrors::slip_work_error},
    {&SteadySliding::relaxation_damping, &SlidingErrors::relaxation_damping_error}};

/// Steady sliding at one amplitude and one velocity.
struct SlidingPoint {
  double normal_amplitude = 0;  ///< u_z, m
  double velocity = 0;          ///< v, m/s
  double velocity_ratio =
      SteadySliding::unknown;  ///< v/v_c, if the velocity was given as this ratio
  SteadySliding state = {};
  SlidingErrors errors = {};  ///< known for a surface
  /// RegimeMap::no_slip_excursion, m; also unknown if no regime map was computed.
  double no_slip_excursion = SteadySliding::unknown;
  /// Direction of the sliding, from the x axis, rad; NaN if the contact has no direction.
  double direction = SteadySliding::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<SlidingPoint>) {
  using enum Dimension;
  using S = SlidingPoint;
  visit(&S::normal_amplitude, quantity::normal_amplitude);
  visit(&S::velocity, Quantity{"velocity", Dimension::velocity, "sliding velocity"});
  visit(&S::velocity_ratio,
        Quantity{"velocity_ratio", dimensionless, "velocity over critical velocity"});
  visit(&S::state, Part{"state", "steady sliding"});
  visit(&S::errors, Part{"errors", "errors of steady sliding, of a surface"});
  visit(&S::no_slip_excursion,
        Quantity{"no_slip_excursion", length,
                 "largest excursion without slip; 0: none, n/a: all excursions"});
  visit(&S::direction, WhereKnown{quantity::direction});
}

/// One entry of a RegimeMap, as a row of a table.
struct RegimePoint {
  double velocity = 0, excursion = 0;     ///< m/s, m
  double loss_ratio = 0, slip_ratio = 0;  ///< as in RegimeMap
  int regime = 0;                         ///< a Regime
};

constexpr void describe(auto&& visit, std::type_identity<RegimePoint>) {
  using enum Dimension;
  using S = RegimePoint;
  visit(&S::velocity, Quantity{"velocity", Dimension::velocity, "sliding velocity"});
  visit(&S::excursion, quantity::excursion);
  visit(&S::loss_ratio, Quantity{"loss_ratio", dimensionless, "W(mu)/W(infinity)"});
  visit(&S::slip_ratio,
        Quantity{"slip_ratio", dimensionless, "part of it from slip in permanent contact"});
  visit(&S::regime,
        Quantity{"regime", dimensionless, "0 no slip, 1 partial slip, 2 sliding, 3 unknown"});
}

/// Computes the mean tangential force of steady sliding with Coulomb friction under a normal
/// oscillation δ = δ0 − u_z cosφ.
///
///     SteadySliding state = steady_sliding(law, at_force(1), Drag{1e-9, 1e-4, 1e5}, 0.3);
///
/// The spring at depth ζ sticks, or slips at the stretch limit (μK/K_t)(δ − ζ). For v > 0 every
/// closed spring is at this limit when δ is smallest, so the first period that starts at that
/// moment is already steady (docs/theory.md, section 8). Let r = v/v_c < 1 and φ_a = arcsin r. A
/// spring that starts to stick at the phase φ, φ_a < φ < π − φ_a, slips again at the phase φ_e > π
/// − φ_a with −cosφ_e − rφ_e = −cosφ − rφ. Then
///     T̄ = μF(δ_min) + (1/2π) ∫_0^π [μ u_z K (2π − φ − φ_e) sinφ + (v/ω) K_t (φ_e − φ)] dφ,
/// where outside φ_a < φ < π − φ_a φ_e is 2π − φ and the second term is left out. The low-speed
/// damping is Γ = γ + πK_t(δ_min)/ω. If the law has its own K_t, K_t/K is taken at δ0. A small
/// disturbance of the sliding velocity that is slow compared with the oscillation is damped by the
/// constant
///     dT̄/dv = (1/2πω) ∫ K_t (φ_e − φ)(1 + (sinφ − r)/(r − sinφ_e)) dφ   over φ_a < φ < π − φ_a,
/// because the stretch of a spring that sticks from the phase φ on has grown at the phase φ' by (φ'
/// − φ)/ω per unit of velocity, until it slips.
/// friction_coefficient  μ >= 0, finite
/// motion                drag_velocity is v > 0
/// throws  InvalidInput wherever relaxation_damping() does
/// cost    seven evaluations of the law for each interval between break points of a tabulated law,
///         some hundred for a smooth law; all velocities of a list share these evaluations
SteadySliding steady_sliding(const ContactLaw& law, const OperatingPoint& point, const Drag& motion,
                             double friction_coefficient, const DampingOptions& options = {});
/// Computes steady sliding for each velocity > 0, m/s, and returns the results in the same order.
std::vector<SteadySliding> steady_sliding(const ContactLaw& law, const OperatingPoint& point,
                                          const NormalOscillation& normal,
                                          std::span<const double> velocities,
                                          double friction_coefficient,
                                          const DampingOptions& options = {});

/// The motion of surface_sliding(): several velocities under one oscillation.
struct SurfaceSlidingMotion {
  NormalOscillation normal;         ///< u_z > 0
  std::vector<double> velocities;   ///< > 0, m/s
  double friction_coefficient = 0;  ///< μ
  Hold hold = Hold::automatic;
};

/// Computes steady sliding of a surface, with errors, from contacts solved inside the oscillation.
/// K between these contacts is interpolated by kriging, as in surface_damping(). All numbers are
/// nearly linear in K, so the kriging gives each number a standard deviation, and the error
/// contains 1.8 of them. The error also contains three changes of the number: a third of its change
/// on cells of half the size (the number itself is that of the smaller cells), its change if every
/// second contact is left out, and its change if K_t/K is linear in ln F. relaxation_damping is
/// that of surface_damping(). A number is NaN where it is no larger than its error.
/// body    a Material, or any Body under a periodic surface
/// curve   force curve of this surface and body, with K_t in full stick
/// load    index of the sample of the curve about which the contact oscillates
/// returns one pair (numbers, errors) for each velocity
/// throws  InvalidInput for u_z that is not > 0, and wherever steady_sliding() does; NotConverged
///         if a contact did not converge; Interrupted if on_progress says stop
/// cost    nine contacts on the given cells, five on cells of half the size, and the contacts of
///         surface_damping()
std::vector<std::pair<SteadySliding, SlidingErrors>> surface_sliding(
    const Surface& surface, const Body& body, const ForceCurve& curve, std::size_t load,
    const SurfaceSlidingMotion& motion, const Progress& on_progress = {});

}  // namespace salebra
