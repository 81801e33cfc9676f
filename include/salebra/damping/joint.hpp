// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/quantities.hpp>
#include <salebra/damping/regime.hpp>

namespace salebra {

/// Energy loss and stiffness of a joint under a tangential oscillation, of the displacement between
/// ±x or of the force between ±T. Below, μ' = μ/ρ is the slope of the friction limit of a spring:
/// the spring at depth ζ slips at the stretch μ'(δ − ζ). ρ = G/F, with G = ∫K_t dζ, is the ratio
/// K_t/K of the whole contact, so that a contact that slides as a whole carries T = μF.
struct JointLoss {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double indentation = unknown;           ///< δ, or the cycle mean of δ, m
  double tangential_force = unknown;      ///< T, half the range of the tangential force, N
  double tangential_amplitude = unknown;  ///< x, half the range of the displacement, m
  double work_per_cycle = unknown;        ///< W, J
  double relaxation_work = unknown;       ///< part of W by springs that open and close, J
  double slip_work = unknown;             ///< part of W by springs that stay closed, J
  /// Error of W, J: for a surface its numerical error; for a table the change of W without every
  /// other sample, and if the table continues exponentially below its lowest one. A W that is no
  /// larger is NaN. NaN: not known.
  double work_error = unknown;
  double secant_stiffness = unknown;   ///< K_s = T/x, N/m
  double loss_factor = unknown;        ///< W/(2π · ½K_s x²)
  double exponent = unknown;           ///< d ln W/d ln T; 3 for small T; NaN where it slides
  double storage_stiffness = unknown;  ///< k': part of T in phase with a harmonic x, over x, N/m
  double loss_stiffness = unknown;     ///< k'' = W/(πx²): part of T 90° ahead of x, over x, N/m
  /// γ = W/(πωx²), N s/m, the coefficient of the viscous damper that loses W in a cycle; NaN where
  /// the frequency is unknown (set_damping_constant()).
  double damping_constant = unknown;
  /// Part of x that only stretches the springs of a contact that slides as a whole, 2μ'∫G dδ/G, m;
  /// 2μ'U/F with U = ∫F dδ if ρ is constant: 0.8 μ'δ for a sphere, 2μ'l for an exponential law. With
  /// it W = 4μF(x − elastic_displacement). NaN with a normal oscillation.
  double elastic_displacement = unknown;
  /// Displacement x at which the contact begins to slide as a whole, μ'(δ − δ_t) with the first
  /// touch δ_t, m; infinite for a law with a force at every δ. NaN with a normal oscillation.
  double knee = unknown;
  double mean_force = unknown;  ///< cycle mean of F, N; NaN without a normal oscillation
  double max_force = unknown;   ///< F at the largest δ, N; NaN without a normal oscillation
  /// Share of the period in which the bodies touch; NaN without a normal oscillation.
  double contact_time = unknown;
  Regime regime = Regime::unknown;
  Hold hold = Hold::indentation;  ///< the mean value that the normal oscillation keeps
  bool converged = false;         ///< whether the quadratures reached the tolerance

  /// Sets damping_constant for the angular frequency ω > 0, rad/s.
  void set_damping_constant(double angular_frequency) {
    damping_constant = loss_stiffness / angular_frequency;
  }
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
  visit(&S::damping_constant, WhereKnown{quantity::damping_constant});
  visit(&S::elastic_displacement,
        Quantity{"elastic_displacement", length,
                 "part of the displacement that stretches a contact that slides as a whole"});
  visit(&S::knee,
        Quantity{"knee", length, "displacement at which the contact begins to slide as a whole"});
  visit(&S::mean_force, WhereKnown{quantity::mean_force});
  visit(&S::max_force, WhereKnown{quantity::max_force});
  visit(&S::contact_time, WhereKnown{quantity::contact_time});
  visit(&S::regime, Kept{"regime", "no slip, partial slip, lifts off, sliding or unknown"});
  visit(&S::hold, Kept{"hold", "mean value that the normal oscillation keeps"});
  visit(&S::converged, Kept{"converged", "false: do not use the numbers"});
}

/// The tangential oscillation, displacement-controlled or force-controlled.
struct TangentialAmplitude {
  double amplitude = 0;  ///< amplitude x > 0 of the displacement, m
};
struct TangentialForce {
  double amplitude = 0;  ///< amplitude T > 0 of the tangential force, N
};
using TangentialOscillation = std::variant<TangentialAmplitude, TangentialForce>;

/// A tangential oscillation x cos(ωt + φ0) or T cos(ωt + φ0) together with a normal oscillation of
/// the indentation, δ + u_z cosωt.
struct JointMotion {
  TangentialOscillation tangential;
  double normal_amplitude = 0;  ///< u_z >= 0, m
  double phase = 0;             ///< φ0, rad
  Hold hold = Hold::automatic;  ///< mean value that the normal oscillation keeps: hold_of()
};

/// Computes partial slip and gross slip under a constant normal force, by superposition of the
/// springs of the law. Springs slip down to the distance c = x/μ' below the indentation δ. With
/// δ(θ) = δ − c(1 − cosθ)/2,
///     T = (x/2) ∫_0^π K_t(δ(θ)) sinθ dθ  ( = μ[F(δ) − F(δ − c)] with K_t = ρK ),
///     W = x² ∫_0^π K_t(δ(θ)) sin2θ dθ,    k' = (2/π) ∫_0^π K_t(δ(θ)) sin²θ dθ,
///     d ln W/d ln T = (T/W) · 4[T/K_t(δ − c) − x]
/// by Masing's rule, which builds the friction loop from the curve of first tangential loading
/// (docs/theory.md, section 8). W equals half of relaxation_damping() for a normal oscillation of
/// amplitude c/2 about δ − c/2 with u_x = x at φ0 = 90°. From x = knee on every spring slips, and
///     T = μF,  W = 4μF(x − elastic_displacement).
///
///     JointLoss loss = joint_loss(law, at_force(100), TangentialForce{20}, 0.5);
///
/// friction_coefficient  μ > 0, finite
/// throws  InvalidInput for a tangential force at which the contact slides (the message states the
///         force), for a table whose loss comes from springs below its lowest sample, and wherever
///         relaxation_damping() does
/// cost    some hundred evaluations of the law, ten times as many for a TangentialForce
JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point,
                     const TangentialOscillation& motion, double friction_coefficient,
                     const DampingOptions& options = {});

/// Computes the partial slip of a surface under a constant normal force. Springs slip at depths
/// between δ − c and δ. W comes from contacts solved at indentations in this range: it is half of
/// surface_damping() for a normal oscillation of amplitude c/2 about δ − c/2 at φ0 = 90°. All other
/// numbers are those of joint_loss() for the law. For a given tangential force, c comes from
/// contacts on cells of half the size; so does the force for a given displacement. work_error is
/// the error of surface_damping(); for a given force it also contains d ln W/d ln T times a third
/// of the difference between this c and the c of the law. W is NaN where it is no larger than its
/// error. Where the contact slides as a whole, W = 4μF(x − elastic_displacement) needs no further
/// contacts: U = ∫F dδ is the elastic energy, here on cells of half the size, and work_error is the
/// difference from the U of the law. (joint_loss() for a law whose loads are farther apart than c interpolates within the
/// range of slip and states no error.)
/// body     a Material, or any Body under a periodic surface
/// law      a law through a force curve of this surface and body that contains `point`
/// direction  of the tangential motion and of the K_t of the law, from the x axis, rad
/// throws   NotConverged if a contact did not converge; Interrupted; InvalidInput wherever
///          joint_loss() throws it
/// cost     for each motion some nine contacts on the given cells and three on cells of half the
///          size
std::vector<JointLoss> surface_joint_loss(const Surface& surface, const Body& body,
                                          const ContactLaw& law, const OperatingPoint& point,
                                          const std::vector<TangentialOscillation>& motions,
                                          double friction_coefficient,
                                          const Progress& on_progress = {}, double direction = 0);

/// Computes the loss of a tangential oscillation together with a normal oscillation about the
/// indentation δ, or about the indentation at which the mean force is held. The motion is followed
/// step by step to the steady state, through lift-off too: a spring is anchored at the x at which it
/// touches, and has lost its stretch by slip where it opens. The result is exact for a path of
/// straight steps; for the harmonic motion the error is of second order in the step length. The
/// exponent d ln W/d ln T comes from a change of the tangential motion by ±1 %.
///
///     JointLoss loss =
///         joint_loss(law, at_force(10), {TangentialAmplitude{1e-6}, 2e-6, 0.5, Hold::force}, 0.3);
///
/// steps    in a period, >= 16
/// throws   NotConverged if a TangentialForce leads to no steady state within 200 periods;
///          InvalidInput wherever joint_loss() without a normal oscillation does, and for a
///          TangentialForce if the normal force falls so low that the contact slides or lifts off;
///          Interrupted if on_progress says stop
/// cost     for a TangentialAmplitude two periods of `steps` steps; for a TangentialForce some tens
///          of trial steps for each step, and as many periods as it takes until the loss is steady
///          to 1e-9; twice as much if springs slip below the lowest sample of a table
JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point, const JointMotion& motion,
                     double friction_coefficient, int steps = 2000,
                     const Progress& on_progress = {});

/// Simulates the joint in three dimensions, with Coulomb friction in each cell, until two periods
/// lose the same (simulate_frictional_cycle). relaxation_work is the loss of cells that open and
/// close (not of springs), slip_work that of the remaining cells; the exponent is NaN.
/// options    must have a finite friction_coefficient > 0
/// converged  in the result: every solve converged, and the loss is steady
/// throws     InvalidInput wherever joint_loss() does
JointLoss simulated_joint_loss(const PressureFields& contact_sets, const Grid2D& grid,
                               const Body& body, double indentation, const JointMotion& motion,
                               const CycleOptions& options);

}  // namespace salebra
