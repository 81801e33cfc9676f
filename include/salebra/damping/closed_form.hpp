// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/damping/oscillation.hpp>

/// Equations (6)–(16) of Popov, Popov, Pohrt, "Relaxation damping in oscillating contacts" ("the
/// paper"), with its equation numbers, and further closed forms for the exponential law.
///
///     double work = closed_form::work_per_cycle_rough(0.8, 1, 30e-9, Drag{1e-9, 1e-6, 1e5});
///
/// All assume infinite friction, quasi-static motion and no coupling of normal and tangential
/// motion. `spring_depth` is z0, the distance that a point of the indenter at its mean position
/// must still move to first touch (Fig. 2), modulus_ratio is G*/E*, force_curvature is F'' =
/// ∂²F/∂δ². EqualFrequency is case (a), Drag is case (b). Units are SI. These functions do not
/// check their arguments and return meaningless numbers outside the validity of a formula; the
/// functions of dissipation.hpp check theirs.
namespace salebra::closed_form {

/// Eq. (6): slope c = 2E*/F'' of the one-dimensional profile (method of dimensionality reduction)
/// at the edge of the contact, for every axisymmetric contact.
double edge_slope(double contact_modulus, double force_curvature);

/// Eq. (7): distance by which a spring at `spring_depth` is released, 2u_x √(1 − (z0/u_z)²) sin φ0.
/// Valid at any amplitude; 0 for springs that do not open and close, i.e. where Eq. (9) does not
/// hold. (The paper's x2 − x1 has the opposite sign; only the square is used.)
double released_distance(double spring_depth, const EqualFrequency& motion);

/// Eq. (13): distance by which a spring at `spring_depth` is released in case (b), 2(v/ω)
/// arccos(z0/u_z). Valid at any amplitude while v is constant over a normal cycle.
double released_distance(double spring_depth, const Drag& motion);

/// Eq. (8): energy ½G*s²Δx of one spring, J, with the released distance s and the spring width Δx.
double spring_energy(double tangential_modulus, double released_distance, double spring_width);

/// Eq. (9): true if −|u_z| < z0 < |u_z|, i.e. if the point touches during only a part of the cycle;
/// a point that always or never touches loses no energy.
bool intermittent_contact(double spring_depth, double normal_amplitude);

/// Eq. (10): loss per cycle W = (G*/c) ∫ s² dz0 over −u_z < z0 < u_z, for both edges of the contact
/// together, by adaptive quadrature; J. c is `edge_slope` and s the released distance. Valid while
/// the one-dimensional profile is straight over the range in which the edge moves, u_z c'/c² ≪ 1;
/// exact for the cone.
double work_per_cycle(double tangential_modulus, double edge_slope, double normal_amplitude,
                      const std::function<double(double spring_depth)>& released_distance);

/// Eq. (11): case (a), W = (16/3)(G*/c) u_x²|u_z| sin²φ0, J, with c = edge_slope. Same validity as
/// Eq. (10).
double work_per_cycle_by_slope(double tangential_modulus, double edge_slope,
                               const EqualFrequency& motion);

/// Eq. (14): case (b), W = 4(π² − 4)(G*/c)|u_z|(v/ω)², J, with c = edge_slope. Same validity as Eq.
/// (10).
double work_per_cycle_by_slope(double tangential_modulus, double edge_slope, const Drag& motion);

/// Eq. (12): case (a), W = (8/3)(G*/E*)F''u_x²|u_z| sin²φ0, J. This is the limit u_z → 0 for every
/// contact with K_t = (G*/E*)K, and exact for constant F'' (the cone). The relative error is of the
/// order of (u_z F''')²/F''² and u_z² F''''/F''; for the exponential law with decay length l the
/// exact loss is larger by the fraction k²/10, k = u_z/l.
double work_per_cycle(double modulus_ratio, double force_curvature, const EqualFrequency& motion);

/// Eq. (15): case (b), W = 2(π² − 4)(G*/E*)F''|u_z|(v/ω)², J. Same validity as Eq. (12), but the
/// relative error is linear in u_z F'''/F''; for the exponential law with decay length l the exact
/// loss is smaller by the fraction 0.42k, k = u_z/l.
double work_per_cycle(double modulus_ratio, double force_curvature, const Drag& motion);

/// Eq. (16): Eq. (15) with F'' = F/l² for nominally flat rough surfaces with decay length l; J.
/// Valid where F ∝ exp(−ū/l) holds at all mean gaps ū of the cycle, and u_z ≪ l.
double work_per_cycle_rough(double modulus_ratio, double force, double decay_length,
                            const Drag& motion);

/// Mean dissipated power P = Wω/2π, W, from the loss per cycle. NaN where ω is not known (0).
double power(double work_per_cycle, const Oscillation& motion);

/// Damping constant γ = P/⟨ẋ²⟩ of the viscous damper with the same mean power P, N s/m: 2P/(u_x ω)²
/// in case (a), P/v² in case (b). NaN where ω or the tangential velocity is 0.
double damping_constant(double work_per_cycle, const Oscillation& motion);

/// Loss per cycle at finite amplitude for the exponential law F = F0 exp(δ/l) at a constant mean
/// indentation, J. reference_force is F0, the force at the mean indentation; decay_length is l; k =
/// u_z/l; J(k) is the integral of drag_integral_scaled(). Valid for any k >= 0 with a finite peak
/// force F0 e^k; relative accuracy about 1e-14.
///     (a) W = 8(G*/E*)(F0/l²) u_x² u_z sin²φ0 (k cosh k − sinh k)/k³
///     (b) W = 2(G*/E*)(F0/l²) u_z (v/ω)² J(k)
double work_per_cycle_exponential(double modulus_ratio, double reference_force, double decay_length,
                                  const Oscillation& motion);

/// Loss per cycle of work_per_cycle_exponential() at a constant mean force (a dead weight), i.e.
/// with F0 = mean_force/I_0(k), k = u_z/l, and the modified Bessel function I_0; for any k >= 0.
double work_per_cycle_exponential_held_force(double modulus_ratio, double mean_force,
                                             double decay_length, const Oscillation& motion);

/// Change of the mean indentation, −l ln I_0(u_z/l) <= 0, m, when a normal oscillation starts under
/// a dead weight, for the exponential law with decay length l; I_0 is the modified Bessel function.
double indentation_shift_at_held_force(double normal_amplitude, double decay_length);

/// Force-controlled normal oscillation F = F0 + F_a cos ωt, 0 <= F_a <= F0, for the exponential
/// law: Eq. (12) or (15) with F_a/l in place of F''u_z, exact at every force amplitude F_a.
/// motion.normal_amplitude is not used.
double work_per_cycle_force_controlled(double modulus_ratio, double force_amplitude,
                                       double decay_length, const Oscillation& motion);

/// Loss at finite amplitude over Eq. (12), in case (a) for the exponential law, 3(k cosh k − sinh
/// k)/k³ = 1 + k²/10 + O(k⁴), multiplied by e^{−k}; k = u_z/l.
double equal_frequency_ratio_scaled(double k);

/// e^{−k} J(k) for k = u_z/l >= 0: the integral of case (b) for the exponential law, with J(k) =
/// ∫_0^π θ² sinθ e^{k cosθ} dθ = (π²/k)(I_0(k) − e^{−k}) − (8/k) Σ_{n odd} I_n(k)/n² and J(0) = π²
/// − 4. I_n are modified Bessel functions. It is computed by a power series for k < 1, the Bessel
/// sum for 1 <= k < 20, and an asymptotic series for k >= 20, to a relative accuracy of about
/// 1e-15.
double drag_integral_scaled(double k);

/// e^{−k} I_0(k), k = u_z/l: cycle mean of the normal force over its peak, for the exponential law.
double mean_force_ratio_scaled(double k);

/// Factor I(r) of the loss of a normal and a tangential motion at two frequencies, with r = ω_x/ω_z
/// >= 0, for constant F''. With S of frequency_ratio_phase_sum():
///     W = 2(G*/E*)F'' u_x² u_z S I(r) over the common period,
///     I(r) = 1 − (1 + cos 2πr)/(2(1 − 4r²)).
/// I(1) = 4/3; I → (π² − 4)r² as r → 0.
double frequency_ratio_integral(double ratio);

/// Phase factor S of the loss for the frequency ratio ω_x/ω_z = q/p in lowest terms: p sin²φ0 for p
/// = normal_cycles <= 2, p/2 otherwise. phase is φ0, the phase of x at a maximum of z.
double frequency_ratio_phase_sum(int normal_cycles, double phase);

}  // namespace salebra::closed_form
