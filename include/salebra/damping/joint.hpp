// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/quantities.hpp>

namespace salebra {

/// Energy loss and stiffness of a joint under a tangential oscillation between ±x or ±T.
struct JointLoss {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double indentation = unknown;           ///< δ, or its mean over the cycle, m
  double tangential_force = unknown;      ///< T, half the range of the tangential force, N
  double tangential_amplitude = unknown;  ///< x, half the range of the displacement, m
  double work_per_cycle = unknown;        ///< W, J
  double relaxation_work = unknown;       ///< part of W by springs that open and close, J
  double slip_work = unknown;             ///< part of W by springs that stay closed, J
  double work_error = unknown;            ///< numerical error of W, for a surface, J
  double secant_stiffness = unknown;      ///< K_s = T/x, N/m
  double loss_factor = unknown;           ///< W/(2π · ½K_s x²)
  double exponent = unknown;              ///< d ln W/d ln T; 3 at small T for every smooth law
  double storage_stiffness = unknown;     ///< k' of the first harmonic of T under a harmonic x, N/m
  double loss_stiffness = unknown;        ///< k'' of the same, W/(πx²), N/m
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

/// The tangential oscillation, displacement-controlled or force-controlled.
struct TangentialAmplitude {
  double amplitude = 0;  ///< x > 0, m
};
struct TangentialForce {
  double amplitude = 0;  ///< T > 0, N
};
using TangentialOscillation = std::variant<TangentialAmplitude, TangentialForce>;

/// A tangential oscillation x cos(ωt + φ0), or T cos(ωt + φ0), together with a normal one, δ + u_z
/// cosωt.
struct JointMotion {
  TangentialOscillation tangential;
  double normal_amplitude = 0;  ///< u_z >= 0, m
  double phase = 0;             ///< φ0, rad
};

/// Computes partial slip under a constant normal force, by superposition of the springs of the law.
/// With g = G*/E*, the largest depth of slip c = gx/μ and δ(θ) = δ − c(1 − cosθ)/2,
///     T = (x/2) ∫_0^π K_t(δ(θ)) sinθ dθ  ( = μ[F(δ) − F(δ − c)] with K_t = gK ),
///     W = x² ∫_0^π K_t(δ(θ)) sin2θ dθ,    k' = (2/π) ∫_0^π K_t(δ(θ)) sin²θ dθ,
///     d ln W/d ln T = (T/W) · 4[T/K_t(δ − c) − x]
/// by Masing's rule, which builds the loop from the first loading (docs/theory.md, section 8). W is
/// half of Eq. (12)'s theorem for a normal oscillation of amplitude c/2 about δ − c/2 at φ0 = 90°.
///
///     JointLoss loss = joint_loss(law, at_force(100), TangentialForce{20}, 0.5);
///
/// friction_coefficient  μ > 0, finite
/// throws  InvalidInput for a force at which the contact slides (the message says which), for slip
///         that reaches depths below the range of a tabulated law, and as relaxation_damping()
/// cost    some hundred evaluations of the law, ten times as many for a force
JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point,
                     const TangentialOscillation& motion, double friction_coefficient,
                     const DampingOptions& options = {});

/// The same for a surface, with W from contacts solved inside the range of slip, δ − c to δ: half
/// of surface_damping() for a normal oscillation of c/2 about δ − c/2 at φ0 = 90°. The other
/// numbers are those of the law. The depth c at a force, or the force at a displacement, comes from
/// contacts on cells of half the size.
/// W carries the error of surface_damping(); for a force, also d ln W/d ln T times a third of the
/// difference between c and that of the law. W is NaN where it is no larger than its error. A law
/// through loads that are farther apart than the range of slip is interpolated there, and has no
/// error.
/// law      through the curve of this surface and material at `point`
/// throws   NotConverged where a contact did not converge; Interrupted; and as above
/// cost     for each motion some nine contacts on the given cells and three on cells of half the
///          size
std::vector<JointLoss> surface_joint_loss(const Surface& surface, const Material& material,
                                          const ContactLaw& law, const OperatingPoint& point,
                                          const std::vector<TangentialOscillation>& motions,
                                          double friction_coefficient,
                                          const Progress& on_progress = {});

/// The same together with a normal oscillation about δ, followed step by step to the steady state.
/// It is exact for straight steps, and of second order in their length. The exponent comes from
/// ±1 % of the motion.
/// steps    in a period, >= 16
/// throws   NotConverged where a force leads to no steady state within 200 periods; InvalidInput
///          also where the normal force falls so low that the contact slides; Interrupted where
///          on_progress says stop
/// cost     two periods of a displacement, O(steps); for a force some tens of evaluations of the
///          state for each step, and periods until the loss is steady to 1e-9
JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point, const JointMotion& motion,
                     double friction_coefficient, int steps = 2000,
                     const Progress& on_progress = {});

/// Simulates the joint in three dimensions, with Coulomb friction in each cell, until two periods
/// lose the same (simulate_frictional_cycle). Relaxation and slip are separated by cells, not by
/// springs; the exponent is NaN.
/// options    with a finite friction_coefficient > 0
/// converged  every solve converged, and the loss is steady
/// throws     InvalidInput as above
JointLoss simulated_joint_loss(const PressureFields& contact_sets, const Grid2D& grid,
                               const Material& material, double indentation,
                               const JointMotion& motion, const CycleOptions& options);

}  // namespace salebra
