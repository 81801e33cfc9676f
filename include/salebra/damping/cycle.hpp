// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

/// Direct three-dimensional simulation of a contact that moves along a trajectory, period after
/// period: stuck, with Coulomb friction, or with coupled pressures and tractions (Dundurs' β).
namespace salebra {

/// Contact set of the frictionless normal contact at one indentation.
struct ContactSetAt {
  ContactSet contact;
  double force = 0;  ///< F, N
  bool converged = true;
};

constexpr void describe(auto&& visit, std::type_identity<ContactSetAt>) {
  visit(&ContactSetAt::contact, Kept{"contact", "cells in contact, (nx, ny)"});
  visit(&ContactSetAt::force, quantity::force);
  visit(&ContactSetAt::converged, Kept{"converged", "whether the contact converged"});
}

/// Pressures of the same contact.
struct PressureAt {
  Field contact_pressure;  ///< (nx, ny), Pa
  double force = 0;        ///< F, N
  bool converged = true;
};

/// The normal contact as a function of the indentation δ, m. It must be deterministic: it is called
/// once for each δ.
using ContactSets = std::function<ContactSetAt(double indentation)>;
using PressureFields = std::function<PressureAt(double indentation)>;

/// Computes the normal contact of a surface by boundary elements; no contact for δ <= 0. The
/// boundary of `options` must be that of the tangential solves. The function keeps a copy of the
/// surface.
ContactSets boundary_element_contact_sets(Surface surface, double contact_modulus,
                                      const NormalContactOptions& options = {});
PressureFields boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options = {});

/// A motion over t = 0 … 1, closed except for a constant tangential advance.
struct Trajectory {
  std::function<double(double t)> indentation;  ///< δ, m
  std::function<double(double t)> tangential;   ///< x, m
  /// T, N: the body moves to where F_x is T; replaces `tangential`, which is left empty. Only for
  /// simulate_frictional_cycle.
  std::function<double(double t)> tangential_force = {};
};

/// Returns one period of an oscillation about a mean indentation, between two minima of it.
Trajectory trajectory_of(const Oscillation& motion, double mean_indentation);

/// The state after one step; work and losses count from the start of the period.
struct CycleSample {
  double t = 0;
  double indentation = 0;       ///< δ, m
  double tangential = 0;        ///< x since the start of the period, m
  double tangential_force = 0;  ///< F_x, N
  double normal_force = 0;      ///< F, N
  double work = 0;              ///< ∫F_x dx, J
  double dissipated = 0;    ///< energy of cells that leave the contact; with friction ∫τ·ds, J
  double contact_area = 0;  ///< m²
  double slip_area = 0;     ///< area of cells at their friction limit, m²
  /// K_t of the contact set in full stick, along the motion, N/m; NaN with friction.
  double tangential_stiffness = std::numeric_limits<double>::quiet_NaN();
};

/// The time comes first.
constexpr void describe(auto&& visit, std::type_identity<CycleSample>) {
  using enum Dimension;
  using S = CycleSample;
  visit(&S::t, Quantity{"time_in_periods", dimensionless, "time in periods"});
  visit(&S::indentation, quantity::indentation);
  visit(&S::tangential, Quantity{"tangential", length, "tangential displacement"});
  visit(&S::tangential_force, quantity::tangential_force);
  visit(&S::normal_force, Quantity{"normal_force", force, "normal force"});
  visit(&S::work, Quantity{"work", energy, "work of the tangential force since the start"});
  visit(&S::dissipated, quantity::dissipated);
  visit(&S::contact_area, Quantity{"contact_area", length_squared, "contact area"});
  visit(&S::slip_area, Quantity{"slip_area", length_squared, "area of cells at their limit"});
  visit(&S::tangential_stiffness, quantity::tangential_stiffness);
}

/// The history of a stuck contact: the displacement at which each of its cells is held.
struct StuckState {
  ContactSet contact;                                ///< current contact set
  TangentialField displacement;                      ///< of the cells in contact, m; 0 elsewhere
  TangentialField traction;                          ///< Pa
  TangentialField unit_traction;                     ///< stick traction per unit displacement of
                                                     ///< the body, Pa/m
  double work = 0;                                   ///< of the period, J
  double released = 0;                               ///< of the period, J
  Termination termination = Termination::converged;  ///< of all solves
  long iterations = 0;
  long fft_count = 0;
};

constexpr void describe(auto&& visit, std::type_identity<StuckState>) {
  using enum Dimension;
  using S = StuckState;
  visit(&S::contact, Kept{"contact", "1 in contact"});
  visit(&S::displacement, Kept{"displacement", "displacement of cells in contact", length});
  visit(&S::traction, Kept{"traction", "shear traction", pressure});
  visit(&S::unit_traction,
        Kept{"unit_traction", "shear traction of a unit move", stiffness_per_area});
  visit(&S::work, Kept{"work", "work of the tangential force", energy});
  visit(&S::released, Kept{"released", "energy dissipated by cells as they opened", energy});
  visit(&S::termination, Kept{"termination", "how the solves ended"});
  visit(&S::iterations, Kept{"iterations", "iterations so far"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms so far, in pairs"});
}

struct CycleState;  // cycle_state.hpp

struct CycleOptions {
  /// μ >= 0, for simulate_frictional_cycle and simulate_coupled_cycle; infinite: full stick.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  int steps = 64;       ///< steps in a period, >= 4
  int max_periods = 6;  ///< limit; fewer where a period loses the same as the one before it
  /// A period repeats if work_per_cycle differs by less than this from the previous one;
  /// relative, > 0.
  double steady_tolerance = 1e-5;
  double direction = 0;  ///< angle of the tangential motion against x, rad
  /// β/(πE*) for simulate_coupled_cycle, 1/Pa; default: coupling_constant(material).
  std::optional<double> coupling_constant = {};
  /// Options of the tangential solves, relative to the tangential motion; work and dissipation
  /// agree to about this tolerance.
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
  /// Receives a copy of the state after the sample of each step.
  std::function<void(CycleState)> on_state = {};
  /// Continues from this state, which is read before the first step. It must come from the same
  /// function, contact, grid, material, trajectory and options.
  const CycleState* resume = nullptr;
};

/// A simulated period.
struct CycleResult {
  /// ∮F_x dx minus the change of the stored energy, J; with coupling also ∮F dδ. Cells that enter
  /// during a step count from the moment they enter.
  double work_per_cycle = 0;
  /// The loss as an independent sum over the cells, J: ½∫τ·[u] of cells as they leave the contact,
  /// or with friction ∮∫τ·ds.
  double dissipated = 0;
  /// The two parts of `dissipated`, J: loss in cells that open and close, which becomes the paper's
  /// relaxation loss as μ → ∞, and in cells in permanent contact, which becomes Mindlin's slip loss
  /// as u_z → 0. friction_map() splits by the springs of the method of dimensionality reduction
  /// instead of cells: the totals agree, the parts differ. For a cone at 90° and
  /// M = μE*u_z/(G*u_x) = 0.3, relaxation over W(∞) is 0.50 by cells and 0.32 by springs.
  double relaxation_work = 0;
  double slip_work = 0;
  double normal_work = 0;  ///< ∮F dδ, part of work_per_cycle, J; 0 without coupling
  /// The part of normal_work from gaps that close and open within one step, J
  /// (CoupledContact::gap_work); 0 without coupling. work_per_cycle = dissipated + gap_work to the
  /// solvers' tolerance.
  double gap_work = 0;
  /// Estimated error of work_per_cycle due to the steps, J, without the discretisation error of the
  /// cells; see simulate_cycle. NaN with friction.
  double step_error = std::numeric_limits<double>::quiet_NaN();
  double stored_energy_change = 0;  ///< over the period, J; not 0 where the contact advances
  double contact_area_min = 0;      ///< m²
  double contact_area_max = 0;      ///< m²
  Field loss;  ///< energy lost per period and unit area, (nx, ny), J/m², where friction wears;
               ///< empty without slip
  ContactSet smallest, largest;      ///< cells in contact always, and at some time
  std::vector<CycleSample> samples;  ///< after each step of the last period
  int periods = 0;
  long iterations = 0;  ///< total of all tangential solves
  long fft_count = 0;   ///< pairs of scalar fields
  bool steady = false;  ///< the period repeats
  /// Worst outcome of all solves; unless converged, do not use the numbers.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
  /// Relative difference of the sum over cells from work_per_cycle: 0 up to the solvers' tolerance.
  double balance() const { return (dissipated + gap_work - work_per_cycle) / work_per_cycle; }
  /// (nx, ny): 0 never in contact, 1 during a part of the cycle, 2 always.
  Field contact_map() const { return smallest.cast<double>() + largest.cast<double>(); }
};

constexpr void describe(auto&& visit, std::type_identity<CycleResult>) {
  using enum Dimension;
  using S = CycleResult;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::dissipated,
        Quantity{"dissipated", energy, "energy dissipated in a cycle, as a sum over the cells"});
  visit(&S::relaxation_work, quantity::relaxation_work);
  visit(&S::slip_work, quantity::slip_work);
  visit(&S::normal_work, Quantity{"normal_work", energy, "work of the normal force in a cycle"});
  visit(&S::gap_work,
        Quantity{"gap_work", energy, "work across gaps that close and open within a step"});
  visit(&S::step_error,
        Kept{"step_error",
             "estimated error of work_per_cycle by the steps, without that of the cells; NaN with "
             "friction",
             energy});
  visit(&S::stored_energy_change,
        Quantity{"stored_energy_change", energy, "change of the elastic energy in a cycle"});
  visit(&S::contact_area_min,
        Quantity{"contact_area_min", length_squared, "minimum contact area of a cycle"});
  visit(&S::contact_area_max,
        Quantity{"contact_area_max", length_squared, "maximum contact area of a cycle"});
  visit(&S::loss, Quantity{"loss", energy_per_area, "energy dissipated in a period by unit area"});
  visit(&S::smallest, Kept{"smallest", "cells that are in contact always"});
  visit(&S::largest, Kept{"largest", "cells that are in contact at some time"});
  visit(&S::samples, Table{"samples", "after each step of the last period"});
  visit(&S::periods, Quantity{"periods", dimensionless, "simulated periods"});
  visit(&S::iterations, Kept{"iterations", "of all tangential solves"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of all solves, in pairs"});
  visit(&S::steady, Quantity{"steady", dimensionless, "whether the period repeats"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether every solve converged"});
  visit(&S::balance, Quantity{"balance", dimensionless,
                              "difference of dissipated and work_per_cycle, relative"});
  visit(&S::contact_map, Quantity{"contact_map", dimensionless,
                                  "0 never in contact, 1 during a part of the cycle, 2 always"});
}

/// Effect of slip on a cycle; NaN where nothing is lost without it.
struct SlipEffect {
  double over_stick = 0;             ///< W over W without slip
  double mean_tangential_force = 0;  ///< W over the distance of a drag, N; NaN for a motion that
                                     ///< returns
  double mean_force = 0;             ///< mean normal force, N
};

constexpr void describe(auto&& visit, std::type_identity<SlipEffect>) {
  using enum Dimension;
  using S = SlipEffect;
  visit(&S::over_stick, Quantity{"over_stick", dimensionless,
                                 "energy dissipated in a cycle over that without slip"});
  visit(&S::mean_tangential_force,
        Quantity{"mean_tangential_force", force, "tangential force, mean over a cycle"});
  visit(&S::mean_force, quantity::mean_force);
}

/// Relative effect of the coupling on a cycle with friction; NaN where the reference is 0.
struct CouplingEffect {
  double work_change = 0;
  double force_change = 0;             ///< largest change over the cycle, over the largest force
  double tangential_force_change = 0;  ///< the same for the tangential force
};

constexpr void describe(auto&& visit, std::type_identity<CouplingEffect>) {
  using enum Dimension;
  using S = CouplingEffect;
  visit(&S::work_change, Quantity{"work_change", dimensionless,
                                  "relative change of work_per_cycle by the coupling"});
  visit(&S::force_change, Quantity{"force_change", dimensionless,
                                   "relative change of the normal force by the coupling"});
  visit(&S::tangential_force_change,
        Quantity{"tangential_force_change", dimensionless,
                 "relative change of the tangential force by the coupling"});
}

/// Returns one quantity of all samples.
inline std::vector<double> column(const CycleResult& cycle, double CycleSample::*value) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*value);
  return values;
}

/// Simulates a cycle with infinite friction.
///
///     ContactSets contacts = boundary_element_contact_sets(surface, material.contact_modulus);
///     CycleResult cycle =
///         simulate_cycle(contacts, surface.grid, material, trajectory_of(motion, 1e-8));
///
/// A period is divided into steps t_k. The contact set is A(δ(t_k)) while x goes from its value at
/// t_{k−1/2} to that at t_{k+1/2}; a set changed at either end would shift φ0 by half a step.
///     move     the cells of A move with the body: Δτ = Δx · (stick traction of A)
///     release  cells that leave have τ = 0; the others are solved again with fixed displacements
///     entry    a cell enters with the displacement it has, and moves with the body from then on
/// If the trajectory starts, stress-free, at its minimum indentation, the first period is already
/// the steady one. Contacts are solved at indentations rounded to 1e-9 of the sweep, each once, so
/// the way down reuses those of the way up. The error of the steps is of second order, −h²/24 of W,
/// h = 2π/steps, for K_t' = const and equal frequencies; a second term accounts for the unknown
/// time within a step at which each cell enters. step_error covers both with W = ½∮s² dK_t from the
/// K_t of the same contact sets (no further solve). With Δ the change of this W when every second
/// set is left out, and σ its standard deviation if each cell entered at any time of its step,
/// step_error is max(|Δ|, |Δ|/3 + 2σ) plus the difference of this W from the simulated one. It is
/// the error against infinitely many steps on the same cells; cells that are too large change both
/// alike.
/// cost    per step a stick solve, and another where cells leave
/// memory  that of the stick solves, and half a byte per cell and step
CycleResult simulate_cycle(const ContactSets& contact_sets, const Grid2D& grid,
                           const Material& material, const Trajectory& trajectory,
                           const CycleOptions& options = {});

/// Simulates a cycle with Coulomb friction, at second order in the steps (SlidingContact). Without
/// drift it starts stress-free, and the permanent contact settles within two or three periods. With
/// drift and a finite μ it starts from steady sliding at the first indentation: where that is the
/// minimum, the first period is the steady one, as for the springs (docs/theory.md, section 8). A
/// tangential force is met to 1e-7 of its largest value, by a secant search at each step. Throws
/// InvalidInput where it is not below μF: the contact slides there.
/// cost  per step a partial-slip solve, and another where cells enter; four to six times that for a
///       force
CycleResult simulate_frictional_cycle(const PressureFields& contact_sets, const Grid2D& grid,
                                      const Material& material, const Trajectory& trajectory,
                                      const CycleOptions& options = {});

/// Simulates a cycle with the coupling of normal and tangential directions (Dundurs' β): in each
/// step pressures and tractions are iterated together, and F does work over a cycle too. The
/// difference from simulate_frictional_cycle is the error of neglecting the coupling, as the paper
/// does. The contact is loaded from first touch in steps/4 increments without tangential motion, so
/// it has the radial tractions of first loading. work_per_cycle = dissipated + gap_work to the
/// sweeps' tolerance; gap_work comes from the trapezoidal ∫F dδ of cells that enter or leave with a
/// gap, and measures the steps. δ >= 0 counts from first touch of the undeformed bodies; the
/// boundaries of both solves must agree.
/// cost  per step 5 to 10 sweeps of a normal solve and partial-slip solves
CycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                   const Trajectory& trajectory, const CycleOptions& options = {},
                                   const NormalContactOptions& contact = {});

}  // namespace salebra
