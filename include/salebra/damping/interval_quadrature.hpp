// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/cycle.hpp>

namespace salebra {

struct IntervalQuadratureOptions {
  int intervals = 0;        ///< contacts; 0: 16 for equal frequencies, 32 for drag; otherwise >= 4
  double direction = 0;  ///< angle of the tangential motion against x, rad
  StickOptions stick = {.tolerance = 1e-5};
  Progress on_progress = {};
};

/// The loss of a cycle from a few contact sets.
struct IntervalQuadratureResult {
  /// W with K_t = ρ(δ)(G*/E*)F'(δ), J: F' comes from F and K of the contacts, and ρ from
  /// K_t/((G*/E*)K) of each. Both stiffnesses of a contact use the same cells, so the resolution of
  /// the contact's edge cancels in ρ.
  double work_per_cycle = 0;
  double error_estimate =
      0;  ///< error of work_per_cycle, J: scatter of ρ, and F' against the given K of the contacts
  double work_by_intervals = 0;        ///< W by parts from the given K_t of the contacts, J
  double work_by_force = 0;         ///< W with K_t = (G*/E*)F', from normal contacts alone, J
  double small_amplitude_work = 0;  ///< Eq. (12) or (15) with F'' of the same fit, J
  double force = 0;                 ///< F at the mean indentation, N
  double force_curvature = 0;       ///< F'' there, N/m²
  double stiffness_ratio = 0;       ///< work_per_cycle / work_by_force
  ForceCurve curve;                 ///< the solved contacts; K_t is that along the motion
  long iterations = 0;              ///< of all linear solves on contact sets
  long fft_count = 0;
  /// Worst outcome of all contacts; unless converged, do not use the numbers.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<IntervalQuadratureResult>) {
  using enum Dimension;
  using S = IntervalQuadratureResult;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::error_estimate, quantity::error_estimate);
  visit(&S::work_by_intervals,
        Kept{"work_by_intervals", "the same from the tangential stiffness of the levels as they are",
             energy});
  visit(&S::work_by_force,
        Quantity{"work_by_force", energy, "energy dissipated in a cycle by K_t = (G*/E*)K"});
  visit(&S::small_amplitude_work, quantity::small_amplitude_work);
  visit(&S::force, quantity::force);
  visit(&S::force_curvature, quantity::force_curvature);
  visit(&S::stiffness_ratio,
        Quantity{"stiffness_ratio", dimensionless, "work_per_cycle over work_by_force"});
  visit(&S::curve, Kept{"curve", "the levels"});
  visit(&S::iterations, Kept{"iterations", "of all linear solves on contact sets"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of all solves, in pairs"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "whether every level converged"});
}

/// The loss of an oscillating contact by steps and by level quadrature, and the paper's equations
/// for it. Those are empty where they do not apply: without a loss, and where F'' < 0.
struct OscillationLoss {
  double work_per_cycle = 0;        ///< by steps, or by level quadrature if there are no steps, J
  double error_estimate = 0;        ///< J
  double work_by_intervals = 0;        ///< IntervalQuadratureResult::work_per_cycle, J
  double work_by_intervals_error = 0;  ///< J
  double work_by_whole_cells = 0;   ///< IntervalQuadratureResult::work_by_intervals, J
  std::optional<double> small_amplitude_work = {}, ratio = {};  ///< Eq. (12) or (15), J; W over it
  double work_by_force = 0;                                     ///< with K_t = (G*/E*)K, J
  std::optional<double> ratio_finite = {};
  double work_over_elastic_energy = 0;
  double indentation = 0;                      ///< mean, m
  double force = 0;                            ///< at the mean indentation, N
  std::optional<double> force_curvature = {};  ///< N/m²
  std::size_t intervals = 0;
};

constexpr void describe(auto&& visit, std::type_identity<OscillationLoss>) {
  using enum Dimension;
  using S = OscillationLoss;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::error_estimate, quantity::error_estimate);
  visit(&S::work_by_intervals,
        Quantity{"work_by_intervals", energy, "energy dissipated in a cycle, by intervals"});
  visit(&S::work_by_intervals_error, Quantity{"work_by_intervals_error", energy,
                                           "estimated error of the energy by intervals"});
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
}

/// The same by the exponential law with a decay length.
struct ExponentialLoss {
  double decay_length = 0;           ///< l, m
  double predicted_exponential = 0;  ///< with F'' = F/l², J
  std::optional<double> ratio_exponential = {};
  double predicted_exponential_finite = 0;  ///< at this amplitude, J
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

/// Computes the relaxation damping of a contact without stepping through the cycle, W = ½∮ s² dK_t
/// by parts (docs/theory.md, section 7):
///     (a) W = 2u_x² sin²φ0 ∫_0^π K_t(δ(θ)) sin2θ dθ
///     (b) W = 4(v/ω)² ∫_0^π θ [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ
/// on Gauss–Legendre nodes of θ, δ(θ) = δ0 + u_z cosθ, with a normal contact, a stick and a punch
/// solve at each.
///
///     ContactSets contacts = boundary_element_contact_sets(surface, material.contact_modulus);
///     auto loss = interval_quadrature(contacts, surface.grid, material, Drag{1e-9, 1e-6, 1e5}, 1e-8);
///
/// cost  levels + 2 normal contacts, and for all but one of them a stick and a punch solve
IntervalQuadratureResult interval_quadrature(const ContactSets& contact_sets, const Grid2D& grid,
                                       const Material& material, const Oscillation& motion,
                                       double mean_indentation,
                                       const IntervalQuadratureOptions& options = {});

}  // namespace salebra
