// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/cycle.hpp>

namespace salebra {

struct IntervalQuadratureOptions {
  int intervals = 0;     ///< contacts solved, >= 4; 0: 16 for EqualFrequency, 32 for Drag
  double direction = 0;  ///< angle of the tangential motion against x, rad
  StickOptions stick = {.tolerance = 1e-5};
  Progress on_progress = {};
};

/// The loss of a cycle, computed from a few contact sets.
struct IntervalQuadratureResult {
  /// Loss W with K_t = ρ(δ)(G*/E*)F'(δ), J. F' is fitted to the F and K of the solved contacts, and
  /// ρ to their ratios K_t/((G*/E*)K). K_t and K of a contact use the same cells, so the error from
  /// resolving the contact edge by whole cells cancels in ρ.
  double work_per_cycle = 0;
  double error_estimate =
      0;  ///< error of work_per_cycle, J: scatter of ρ, and F' against the given K of the contacts
  double work_by_intervals = 0;     ///< W from the unfitted K_t of the contacts, J
  double work_by_force = 0;         ///< W with K_t = (G*/E*)F', without tangential solves, J; NaN
                                    ///< for a body that is no half-space
  double small_amplitude_work = 0;  ///< W by Eq. (12) or (15) with F'' of the fit of F, J; likewise
  double force = 0;                 ///< F at the mean indentation, N
  double force_curvature = 0;       ///< F'' at the mean indentation, N/m²
  double stiffness_ratio = 0;       ///< work_per_cycle / work_by_force; likewise
  double direction = 0;             ///< of the tangential motion, from the x axis, rad
  ForceCurve curve;                 ///< the solved contacts, with K_t in the direction of motion
  long iterations = 0;              ///< iterations of all stick and punch solves
  long fft_count = 0;               ///< forward-and-backward transforms of a scalar field
  /// Worst outcome of all contact solves; unless it is `converged`, the numbers must not be used.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<IntervalQuadratureResult>) {
  using enum Dimension;
  using S = IntervalQuadratureResult;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::error_estimate, quantity::error_estimate);
  visit(&S::work_by_intervals,
        Kept{"work_by_intervals",
             "the same from the tangential stiffness of the levels as they are", energy});
  visit(&S::work_by_force,
        Quantity{"work_by_force", energy, "energy dissipated in a cycle by K_t = (G*/E*)K"});
  visit(&S::small_amplitude_work, quantity::small_amplitude_work);
  visit(&S::force, quantity::force);
  visit(&S::force_curvature, quantity::force_curvature);
  visit(&S::stiffness_ratio,
        Quantity{"stiffness_ratio", dimensionless, "work_per_cycle over work_by_force"});
  visit(&S::direction, quantity::direction);
  visit(&S::curve, Kept{"curve", "the contacts"});
  visit(&S::iterations, Kept{"iterations", "of all linear solves on contact sets"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of all solves, in pairs"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "whether every contact converged"});
}

/// The loss of an oscillating contact computed in steps and by interval quadrature, and its ratio
/// to the paper's equations. The numbers of these equations are empty where the equations do not
/// apply: if there is no loss, and if F'' < 0.
struct OscillationLoss {
  double work_per_cycle = 0;           ///< by steps or, without steps, by interval quadrature, J
  double error_estimate = 0;           ///< error of work_per_cycle, J
  double work_by_intervals = 0;        ///< IntervalQuadratureResult::work_per_cycle, J
  double work_by_intervals_error = 0;  ///< error of work_by_intervals, J
  double work_by_whole_cells = 0;      ///< IntervalQuadratureResult::work_by_intervals, J
  std::optional<double> small_amplitude_work = {},
                        ratio = {};         ///< Eq. (12) or (15), J; W over that
  double work_by_force = 0;                 ///< loss with K_t = (G*/E*)K, J
  std::optional<double> ratio_finite = {};  ///< work_per_cycle over work_by_force
  double work_over_elastic_energy = 0;  ///< work_per_cycle over largest tangential elastic energy
  double indentation = 0;               ///< mean indentation, m
  double force = 0;                     ///< at the mean indentation, N
  std::optional<double> force_curvature = {};  ///< F'' at the mean indentation, N/m²
  std::size_t intervals = 0;
  double direction = 0;  ///< of the tangential motion, from the x axis, rad
};

constexpr void describe(auto&& visit, std::type_identity<OscillationLoss>) {
  using enum Dimension;
  using S = OscillationLoss;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::error_estimate, quantity::error_estimate);
  visit(&S::work_by_intervals,
        Quantity{"work_by_intervals", energy, "energy dissipated in a cycle, by intervals"});
  visit(&S::work_by_intervals_error,
        Quantity{"work_by_intervals_error", energy, "estimated error of the energy by intervals"});
  visit(&S::work_by_whole_cells,
        Quantity{"work_by_whole_cells", energy,
                 "energy dissipated in a cycle, by intervals of whole cells"});
  visit(&S::small_amplitude_work, quantity::small_amplitude_work);
  visit(&S::ratio,
        Quantity{"ratio", dimensionless, "energy dissipated in a cycle over small_amplitude_work"});
  visit(&S::work_by_force,
        Quantity{"work_by_force", energy, "energy dissipated in a cycle by K_t = (G*/E*)K"});
  visit(&S::ratio_finite, Quantity{"ratio_finite", dimensionless, "the same over work_by_force"});
  visit(&S::work_over_elastic_energy,
        Quantity{"work_over_elastic_energy", dimensionless,
                 "energy dissipated in a cycle over the largest tangential elastic energy"});
  visit(&S::indentation, quantity::indentation);
  visit(&S::force, quantity::force);
  visit(&S::force_curvature, quantity::force_curvature);
  visit(&S::intervals, Quantity{"intervals", dimensionless, "contacts in the oscillation"});
  visit(&S::direction, quantity::direction);
}

/// The loss predicted by the exponential law F ∝ exp(δ/l) with a given decay length l.
struct ExponentialLoss {
  double decay_length = 0;                       ///< l, m
  double predicted_exponential = 0;              ///< Eq. (12) or (15) with F'' = F/l², J
  std::optional<double> ratio_exponential = {};  ///< work_per_cycle over predicted_exponential
  double predicted_exponential_finite = 0;  ///< exact for the exponential law at this amplitude, J
  /// Computed work_per_cycle over predicted_exponential_finite.
  std::optional<double> ratio_exponential_finite = {};
};

constexpr void describe(auto&& visit, std::type_identity<ExponentialLoss>) {
  using enum Dimension;
  using S = ExponentialLoss;
  visit(&S::decay_length, Quantity{"decay_length", length, "decay length of force with mean gap"});
  visit(&S::predicted_exponential,
        Quantity{"predicted_exponential", energy,
                 "energy dissipated in a cycle, Eq. (12) or (16) with F'' = F/l^2"});
  visit(&S::ratio_exponential,
        Quantity{"ratio_exponential", dimensionless, "the same over predicted_exponential"});
  visit(&S::predicted_exponential_finite,
        Quantity{"predicted_exponential_finite", energy,
                 "energy dissipated in a cycle by the exponential law at this amplitude"});
  visit(&S::ratio_exponential_finite, Quantity{"ratio_exponential_finite", dimensionless,
                                               "the same over predicted_exponential_finite"});
}

/// Computes the relaxation damping of a contact without stepping through the cycle, as W = ½∮ s²
/// dK_t integrated by parts (docs/theory.md, section 7), where s is the released distance of a
/// spring:
///     (a) W = 2u_x² sin²φ0 ∫_0^π K_t(δ(θ)) sin2θ dθ
///     (b) W = 4(v/ω)² ∫_0^π θ [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ
/// for (a) EqualFrequency and (b) Drag, with δ(θ) = δ0 + u_z cosθ. At each Gauss–Legendre node of θ
/// it solves the normal contact, its K_t (a stick solve) and its K (a punch solve).
///
///     ContactSets contacts = boundary_element_contact_sets(surface, material.contact_modulus);
///     auto loss =
///         interval_quadrature(contacts, surface.grid, material, Drag{1e-9, 1e-6, 1e5}, 1e-8);
///
/// cost  intervals + 2 normal contacts, and a stick and a punch solve for all but one of these
///       contacts
IntervalQuadratureResult interval_quadrature(const ContactSets& contact_sets, const Grid2D& grid,
                                             const Body& body, const Oscillation& motion,
                                             double mean_indentation,
                                             const IntervalQuadratureOptions& options = {});

}  // namespace salebra
