// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/quantities.hpp>

namespace salebra {

/// What a joint loses, and how stiff it is, under a tangential oscillation between ±x or ±T.
struct JointLoss {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double indentation = unknown;           ///< δ, or its mean over the cycle, m
  double tangential_force = unknown;      ///< T, half the range of the tangential force, N
  double tangential_amplitude = unknown;  ///< x, half the range of the displacement, m
  double work_per_cycle = unknown;        ///< W, J
  double relaxation_work = unknown;       ///< of it, by levels that open and close, J
  double slip_work = unknown;             ///< of it, by levels that stay closed, J
  double work_error = unknown;            ///< of W, of a surface, J
  double secant_stiffness = unknown;      ///< K_s = T/x, N/m
  double loss_factor = unknown;           ///< W/(2π · ½K_s x²)
  double exponent = unknown;              ///< d ln W/d ln T; 3 at small T for every smooth law
  double storage_stiffness = unknown;     ///< k' of the first harmonic of T over a harmonic x, N/m
  double loss_stiffness = unknown;        ///< k'' of it, W/(πx²), N/m
  bool converged = false;                 ///< whether the quadratures reached the tolerance
};

constexpr void describe(auto&& visit, std::type_identity<JointLoss>) {
  using enum Dimension;
  using S = JointLoss;
  visit(&S::indentation, Kept{"indentation", "mean indentation of the cycle", length});
  visit(&S::tangential_force, Extensive{quantity::tangential_force});
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::work_per_cycle, Extensive{quantity::work_per_cycle});
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::slip_work, quantity::slip_work);
  visit(&S::work_error, Extensive{"work_error", energy, "error of work_per_cycle"});
  visit(&S::secant_stiffness, Extensive{"secant_stiffness", stiffness,
                                        "tangential force over displacement, both half ranges"});
  visit(&S::loss_factor, quantity::loss_factor);
  visit(&S::exponent, Quantity{"exponent", dimensionless, "d ln W/d ln T"});
  visit(&S::storage_stiffness, Extensive{quantity::storage_stiffness});
  visit(&S::loss_stiffness,
        Extensive{"loss_stiffness", stiffness, "tangential force in quadrature over displacement"});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
}

/// The tangential oscillation: of a given displacement, or of a given force.
struct TangentialAmplitude {
  double amplitude = 0;  ///< x > 0, m
};
struct TangentialForce {
  double amplitude = 0;  ///< T > 0, N
};
using TangentialOscillation = std::variant<TangentialAmplitude, TangentialForce>;

/// The tangential oscillation beside a normal one, δ + u_z cosωt: the displacement is x cos(ωt + φ0),
/// or the force T cos(ωt + φ0).
struct JointMotion {
  TangentialOscillation tangential;
  double normal_amplitude = 0;  ///< u_z >= 0, m
  double phase = 0;             ///< φ0, rad
};

/// Partial slip under a constant normal force, by superposition of the springs of the law. With K_t
/// of the law, g = G*/E*, the greatest depth of slip c = gx/μ and δ(θ) = δ − c(1 − cosθ)/2,
///     T = (x/2) ∫_0^π K_t(δ(θ)) sinθ dθ  ( = μ[F(δ) − F(δ − c)] with K_t = gK ),
///     W = x² ∫_0^π K_t(δ(θ)) sin2θ dθ,    k' = (2/π) ∫_0^π K_t(δ(θ)) sin²θ dθ,
///     d ln W/d ln T = (T/W) · 4[T/K_t(δ − c) − x]
/// by Masing's rule, whose loop is made of the first loading (docs/theory.md, section 8). W is half
/// of Eq. (12)'s theorem for a normal oscillation of amplitude c/2 about δ − c/2 at φ0 = 90°.
/// friction_coefficient  μ > 0, finite
/// throws  InvalidInput for a force at which the contact slides (it says at which), for slip that
///         reaches levels below the range of a tabulated law, and as relaxation_damping()
/// cost    some hundred evaluations of the law, ten times as many for a force
JointLoss joint_loss(const ContactLaw& law, const Position& position,
                     const TangentialOscillation& motion, double friction_coefficient,
                     const DampingOptions& options = {});

/// The same of a surface, with W by contacts inside the range of slip, δ − c to δ, and its error:
/// half of surface_damping() for a normal oscillation of c/2 about δ − c/2 at φ0 = 90°. A law through
/// loads that lie farther apart than this range is interpolated there, and has no error. The other
/// numbers are those of the law.
/// The depth c of a force, or the force of a displacement, is that of contacts on cells of half the
/// size. Error: of surface_damping(); and of a force, d ln W/d ln T times a third of what c differs
/// by from that of the law. W that is no larger than its error is NaN, and the error is.
/// law      through the curve of this surface and material at `position`
/// throws   NotConverged where a contact did not converge; Interrupted; and as above
/// cost     for each motion some nine contacts on the cells as they are and three on cells of half
///          the size
std::vector<JointLoss> surface_joint_loss(const Surface& surface, const Material& material,
                                          const ContactLaw& law, const Position& position,
                                          const std::vector<TangentialOscillation>& motions,
                                          double friction_coefficient,
                                          const Progress& on_progress = {});

/// The same beside a normal oscillation, about δ. Followed step by step to the steady state: exact
/// for straight steps, of second order in their length. The exponent is that of ±1 % of the motion.
/// steps    in a period, >= 16
/// throws   NotConverged where a force leads to no steady state within 200 periods; InvalidInput
///          also where the normal force falls to what slides
/// on_progress  a stop throws Interrupted
/// cost     two periods of a displacement, O(steps); of a force some tens of evaluations of the
///          state for each step, and periods until the loss is steady to 1e-9
JointLoss joint_loss(const ContactLaw& law, const Position& position, const JointMotion& motion,
                     double friction_coefficient, int steps = 2000,
                     const Progress& on_progress = {});

/// Simulates the joint in three dimensions: cells with Coulomb's friction, through the motion until
/// two periods lose the same (simulate_frictional_cycle). Relaxation and slip are told apart by
/// cells, not by springs; the exponent is NaN.
/// options    with a finite friction_coefficient > 0
/// converged  every solve did, and the loss is steady
/// throws     InvalidInput as above
JointLoss simulated_joint_loss(const PressureLevels& levels, const Grid2D& grid,
                               const Material& material, double indentation,
                               const JointMotion& motion, const CycleOptions& options);

}  // namespace salebra
