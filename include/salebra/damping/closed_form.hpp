// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/damping/oscillation.hpp>

/// Equations (6)–(16) of Popov, Popov, Pohrt, "Relaxation damping in oscillating contacts", by
/// their numbers, and closed forms beyond them.
///
///     double work = closed_form::work_per_cycle_rough(0.8, 1, 30e-9, Drag{1e-9, 1e-6, 1e5});
///
/// All assume infinite friction, quasi-static motion and no coupling of normal and tangential
/// motion. `level` is z0, the distance of a point of the indenter from first touch at the mean
/// position (Fig. 2), modulus_ratio is G*/E*, force_curvature is F'' = ∂²F/∂δ². Units are SI. These
/// functions do not check their arguments, and outside its validity a formula returns what it
/// returns; dissipation.hpp checks its input.
namespace salebra::closed_form {

/// Eq. (6): slope c = 2E*/F'' of the one-dimensional profile at the edge of the contact, for every
/// axisymmetric contact.
double edge_slope(double contact_modulus, double force_curvature);

/// Eq. (7): distance by which a spring at `level` is released, 2u_x √(1 − (z0/u_z)²) sin φ0.
/// (x2 − x1 has the other sign; s enters squared.) Valid at any amplitude; 0 where Eq. (9) does not
/// hold.
double released_distance(double spring_depth, const EqualFrequency& motion);

/// Eq. (13): the same in case (b), 2(v/ω) arccos(z0/u_z). Valid at any amplitude while v is
/// constant over a normal cycle.
double released_distance(double spring_depth, const Drag& motion);

/// Eq. (8): energy ½G*s²Δx of one spring, J.
double spring_energy(double tangential_modulus, double released_distance, double spring_width);

/// Eq. (9): −|u_z| < z0 < |u_z|, the points that touch during a part of the cycle only; all others
/// lose nothing.
bool intermittent_contact(double spring_depth, double normal_amplitude);

/// Eq. (10): W = (G*/c) ∫ s² dz0 over the interval of Eq. (9), both edges of the contact, by
/// adaptive quadrature; J. Valid while the profile is straight over the sweep, u_z c'/c² ≪ 1, exact
/// for the cone.
double work_per_cycle(double tangential_modulus, double edge_slope, double normal_amplitude,
                      const std::function<double(double spring_depth)>& released_distance);

/// Eq. (11): W = (16/3)(G*/c) u_x²|u_z| sin²φ0, J. Valid as Eq. (10).
double work_per_cycle_by_slope(double tangential_modulus, double edge_slope,
                               const EqualFrequency& motion);

/// Eq. (14): W = 4(π² − 4)(G*/c)|u_z|(v/ω)², J. Valid as Eq. (10).
double work_per_cycle_by_slope(double tangential_modulus, double edge_slope, const Drag& motion);

/// Eq. (12): W = (8/3)(G*/E*)F''u_x²|u_z| sin²φ0, J. The limit u_z → 0 for every contact with K_t =
/// (G*/E*)K; exact for F'' = const (the cone). The first correction is of order (u_z F''')²/F''²
/// and u_z² F''''/F'': +k²/10 for the exponential law, k = u_z/l.
double work_per_cycle(double modulus_ratio, double force_curvature, const EqualFrequency& motion);

/// Eq. (15): W = 2(π² − 4)(G*/E*)F''|u_z|(v/ω)², J. Validity as Eq. (12), but the first correction
/// is linear in u_z F'''/F'': −0.42k for the exponential law.
double work_per_cycle(double modulus_ratio, double force_curvature, const Drag& motion);

/// Eq. (16): Eq. (15) with F'' = F/l², nominally flat rough surfaces; J. Valid where F ∝ exp(−ū/l)
/// holds over the sweep and u_z ≪ l.
double work_per_cycle_rough(double modulus_ratio, double force, double decay_length,
                            const Drag& motion);

/// P = Wω/2π, W. NaN where ω is not known (0).
double power(double work_per_cycle, const Oscillation& motion);

/// γ = P/⟨ẋ²⟩ of the equivalent viscous damper, N s/m: P/v² in case (b), 2P/(u_x ω)² in case (a).
/// NaN where ω or the velocity is 0.
double damping_constant(double work_per_cycle, const Oscillation& motion);

/// Finite amplitude on the exponential law F = F0 exp(δ/l), mean indentation held; reference_force
/// is F0 = F at the mean indentation, k = u_z/l. Valid for any k >= 0 with a finite peak force F0
/// e^k; relative accuracy about 1e-14.
///     (a) W = 8(G*/E*)(F0/l²) u_x² u_z sin²φ0 (k cosh k − sinh k)/k³
///     (b) W = 2(G*/E*)(F0/l²) u_z (v/ω)² J(k)
double work_per_cycle_exponential(double modulus_ratio, double reference_force, double decay_length,
                                  const Oscillation& motion);

/// The same with the mean force held (a dead weight): F0 = mean_force/I_0(k), for any k >= 0.
double work_per_cycle_exponential_held_force(double modulus_ratio, double mean_force,
                                             double decay_length, const Oscillation& motion);

/// Change of the mean indentation, −l ln I_0(k) <= 0, m, when an oscillation starts under a dead
/// weight on the exponential law.
double indentation_shift_at_held_force(double normal_amplitude, double decay_length);

/// Force-controlled normal oscillation F = F0 + F_a cos ωt, 0 <= F_a <= F0, on the exponential law:
/// Eqs (12), (15) with F''u_z → F_a/l, exact at every F_a. motion.normal_amplitude is not used.
double work_per_cycle_force_controlled(double modulus_ratio, double force_amplitude,
                                       double decay_length, const Oscillation& motion);

/// Ratio of finite to small amplitude in case (a) on the exponential law, 3(k cosh k − sinh
/// k)/k³ = 1 + k²/10 + …, times e^{−k}.
double equal_frequency_ratio_scaled(double k);

/// e^{−k} J(k) for k >= 0, with J(k) = ∫_0^π θ² sinθ e^{k cosθ}
/// dθ = (π²/k)(I_0(k) − e^{−k}) − (8/k) Σ_{n odd} I_n(k)/n² and J(0) = π² − 4. It is computed by a
/// power series for k < 1, the Bessel sum in between, and an asymptotic series from k = 20, each to
/// about 1e-15.
double drag_integral_scaled(double k);

/// e^{−k} I_0(k): cycle mean of the force over its peak on the exponential law.
double mean_force_ratio_scaled(double k);

/// I(r) of a normal and a tangential motion at two frequencies, r = ω_x/ω_z >= 0, F'' = const:
///     W = 2(G*/E*)F'' u_x² u_z S I(r) over the common period,
///     I(r) = 1 − (1 + cos 2πr)/(2(1 − 4r²)).
/// I(1) = 4/3; I → (π² − 4)r² as r → 0.
double frequency_ratio_integral(double ratio);

/// S for r = q/p in lowest terms: p sin²φ0 for p <= 2, p/2 otherwise; φ0 is the phase of x at a
/// maximum of z.
double frequency_ratio_phase_sum(int normal_cycles, double phase);

}  // namespace salebra::closed_form
