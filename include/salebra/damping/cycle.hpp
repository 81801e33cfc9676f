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

/// Pressure field of the frictionless normal contact at one indentation.
struct PressureAt {
  Field contact_pressure;  ///< (nx, ny), Pa
  double force = 0;        ///< F, N
  bool converged = true;
};

/// The frictionless normal contact as a function of the indentation δ, m: its contact set, or its
/// pressures. The function must be deterministic: it is called once for each δ.
using ContactSets = std::function<ContactSetAt(double indentation)>;
using PressureFields = std::function<PressureAt(double indentation)>;

/// Computes the normal contact of a surface by boundary elements; no contact for δ <= 0.
/// options.boundary must be the boundary used for the tangential solves. The returned function
/// keeps a copy of the surface.
ContactSets boundary_element_contact_sets(Surface surface, const Body& body,
                                          const NormalContactOptions& options = {});
PressureFields boundary_element_pressures(Surface surface, const Body& body,
                                          const NormalContactOptions& options = {});
/// On a half-space.
ContactSets boundary_element_contact_sets(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options = {});
PressureFields boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options = {});

/// One period of a motion over the time t from 0 to 1 (in periods). It returns to its start, except
/// that x may have advanced; every period then advances by the same distance.
struct Trajectory {
  std::function<double(double t)> indentation;  ///< δ, m
  std::function<double(double t)> tangential;   ///< x, m
  /// Prescribed tangential force T, N: the body moves to the x at which F_x = T. It replaces
  /// `tangential`, which is then left empty. Only simulate_frictional_cycle accepts it.
  std::function<double(double t)> tangential_force = {};
};

/// Returns one period of an oscillation about a mean indentation, from one minimum of the
/// indentation to the next.
Trajectory trajectory_of(const Oscillation& motion, double mean_indentation);

/// The state after one step; work and dissipated energy count from the start of the period.
struct CycleSample {
  double t = 0;
  double indentation = 0;       ///< δ, m
  double tangential = 0;        ///< x since the start of the period, m
  double tangential_force = 0;  ///< F_x, N
  double normal_force = 0;      ///< F, N
  double work = 0;              ///< ∫F_x dx, J
  double dissipated = 0;  ///< elastic energy released by leaving cells; with friction ∫τ·ds, J
  double contact_area = 0;  ///< m²
  double slip_area = 0;     ///< area of cells at their friction limit, m²
  /// K_t of the contact set in full stick, in the direction of motion, N/m; NaN with friction.
  double tangential_stiffness = std::numeric_limits<double>::quiet_NaN();
};

/// The first column is the time.
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

/// The history of a contact in full stick: the displacement at which each of its cells is held.
struct StuckState {
  ContactSet contact;             ///< current contact set
  TangentialField displacement;   ///< displacement of cells in contact, m; otherwise 0
  TangentialField traction;       ///< Pa
  TangentialField unit_traction;  ///< stick traction per unit displacement of
                                  ///< the body, Pa/m
  double work = 0;                ///< ∫F_x dx of the period, J
  double released = 0;            ///< energy released in the period, J
  Termination termination = Termination::converged;  ///< worst of all solves
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
  int steps = 64;       ///< steps per period, >= 4
  int max_periods = 6;  ///< fewer if a period loses the same as the previous one
  /// A period counts as steady if its work_per_cycle differs from that of the previous period by
  /// less than this fraction; > 0.
  double steady_tolerance = 1e-5;
  double direction = 0;  ///< angle of the tangential motion against x, rad
  /// β/(πE*) for simulate_coupled_cycle, 1/Pa; default: coupling_constant(material).
  std::optional<double> coupling_constant = {};
  /// Options of the tangential solves. The tolerance is relative to the range of the tangential
  /// motion; work_per_cycle and dissipated agree to about this tolerance.
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
  /// Called after each step with a copy of the state, for restarts.
  std::function<void(CycleState)> on_state = {};
  /// Continues from this state, which the simulation copies before its first step. It must come
  /// from a run of the same function with the same contact, grid, material, trajectory and options.
  const CycleState* resume = nullptr;
};

/// Results of a simulation, for its last period.
struct CycleResult {
  /// Energy lost in the period, J: ∮F_x dx minus the change of the stored elastic energy; with
  /// coupling plus ∮F dδ. A cell that enters the contact during a step does work from the moment it
  /// enters.
  double work_per_cycle = 0;
  /// The loss computed independently as a sum over the cells, J: without slip ½∫τ·[u] dA over cells
  /// that leave the contact, where [u] is the displacement by which a cell snaps back; with
  /// friction the work ∮∫τ·ds dA of the tractions along the slip s.
  double dissipated = 0;
  /// The two parts of `dissipated`, J: relaxation_work is the loss in cells that open and close,
  /// which becomes the paper's relaxation loss as μ → ∞; slip_work is the loss in cells in
  /// permanent contact, which becomes Mindlin's slip loss as u_z → 0. friction_map() assigns the
  /// loss to springs of the method of dimensionality reduction instead of cells: its total agrees,
  /// its two parts differ. Example: for a cone at a phase of 90° and the friction number M =
  /// μE*u_z/(G*u_x) = 0.3, relaxation_work over the loss without slip is 0.50 by cells and 0.32 by
  /// springs.
  double relaxation_work = 0;
  double slip_work = 0;
  double normal_work = 0;  ///< ∮F dδ, part of work_per_cycle, J; 0 without coupling
  /// The part of normal_work that the finite steps assign to gaps closing or opening within one
  /// step, J (CoupledContact::gap_work); 0 without coupling. work_per_cycle = dissipated + gap_work
  /// within the tolerance of the solvers.
  double gap_work = 0;
  /// Estimated error of work_per_cycle due to the finite steps, J, as explained at simulate_cycle;
  /// it does not include the error due to the cell size. NaN with friction.
  double step_error = std::numeric_limits<double>::quiet_NaN();
  double stored_energy_change = 0;  ///< over the period, J; not 0 if the body advances
  double contact_area_min = 0;      ///< smallest of the period, m²
  double contact_area_max = 0;      ///< largest of the period, m²
  Field loss;  ///< frictional energy loss per period and unit area, (nx, ny), J/m²;
               ///< empty without slip
  ContactSet smallest, largest;      ///< cells in contact always, and at some time, of a period
  std::vector<CycleSample> samples;  ///< after each step of the last period
  int periods = 0;
  long iterations = 0;  ///< total of all tangential solves
  long fft_count = 0;   ///< forward-and-backward transforms of a scalar field
  bool steady = false;  ///< whether the last period repeats the one before it
  /// Worst outcome of all solves; unless it is `converged`, the numbers must not be used.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
  /// Relative difference between dissipated + gap_work and work_per_cycle; 0 up to the tolerance of
  /// the solvers.
  double balance() const { return (dissipated + gap_work - work_per_cycle) / work_per_cycle; }
  /// Field (nx, ny): 0 for cells never in contact, 1 for cells in contact during a part of the
  /// cycle, 2 for cells always in contact.
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

/// Effect of slip on a cycle. over_stick is NaN where nothing is lost without slip.
struct SlipEffect {
  double over_stick = 0;  ///< loss per cycle over the loss without slip
  /// Loss per cycle over the distance that a Drag advances per cycle, N; NaN for a motion that
  /// returns to its start.
  double mean_tangential_force = 0;
  double mean_force = 0;  ///< mean normal force, N
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

/// Effect of the normal–tangential coupling on a cycle with friction, relative to the cycle without
/// coupling; NaN where the number without coupling is 0.
struct CouplingEffect {
  double work_change = 0;
  double force_change = 0;             ///< largest change of F over the largest F
  double tangential_force_change = 0;  ///< largest change of F_x over the largest F_x
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

/// Returns one member of every sample of a cycle.
inline std::vector<double> column(const CycleResult& cycle, double CycleSample::*value) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*value);
  return values;
}

/// Returns the mean of one member over the period; NaN without samples. The first sample is left
/// out, because the last one is the same phase one period later.
///     const double force = mean_over_period(cycle, &CycleSample::normal_force);
inline double mean_over_period(const CycleResult& cycle, double CycleSample::*value) {
  double sum = 0;
  for (std::size_t k = 1; k < cycle.samples.size(); ++k) sum += cycle.samples[k].*value;
  return cycle.samples.size() < 2 ? std::numeric_limits<double>::quiet_NaN()
                                  : sum / static_cast<double>(cycle.samples.size() - 1);
}

/// Simulates a cycle with infinite friction.
///
///     ContactSets contacts = boundary_element_contact_sets(surface, material.contact_modulus);
///     CycleResult cycle =
///         simulate_cycle(contacts, surface.grid, material, trajectory_of(motion, 1e-8));
///
/// A period is divided into steps at the times t_k. While x moves from its value at t_{k−1/2} to
/// its value at t_{k+1/2}, the contact set is A(δ(t_k)). (A contact set taken at the start or the
/// end of this interval would shift the phase φ0 by half a step.) Each step consists of three
/// parts:
///     move     the cells of A move with the body: Δτ = Δx · (stick traction of A per unit
///              displacement)
///     release  cells that leave the contact get τ = 0; the tractions of the remaining cells are
///              solved again with their displacements fixed
///     entry    a cell enters with the displacement that it has, and moves with the body from then
///              on
/// If the trajectory starts, stress-free, at its minimum indentation, the first period is already
/// steady. Indentations are rounded to 1e-9 of their range, and each contact is solved once, so
/// that unloading reuses the contacts of loading. The error due to finite steps has two parts. The
/// first is of second order: −h²/24 of W, h = 2π/steps, for constant K_t' and equal frequencies.
/// The second comes from the unknown time within a step at which each cell enters. step_error
/// covers both parts. It uses the loss W_K = ½∮s² dK_t of the springs, computed from the K_t of the
/// same contact sets without further solves. Let Δ be the change of W_K when every second contact
/// set is left out, and σ the standard deviation of W_K if each cell entered at a random time of
/// its step; then step_error is max(|Δ|, |Δ|/3 + 2σ) plus the difference between W_K and the
/// simulated W. It estimates the difference from infinitely many steps on the same cells, and does
/// not include the error due to the cell size.
/// The simulation does not assume nested contact sets, so that it checks the losses of any body.
/// body    a Material, or any Body, which must be under a periodic surface
/// cost    per step a stick solve, and a second one if cells leave the contact
/// memory  that of the stick solves, plus half a byte per cell and step
CycleResult simulate_cycle(const ContactSets& contact_sets, const Grid2D& grid, const Body& body,
                           const Trajectory& trajectory, const CycleOptions& options = {});

/// Simulates a cycle with Coulomb friction, with an error of second order in the step length
/// (SlidingContact). Without drift (x returns to its start) the contact starts stress-free, and the
/// cells in permanent contact reach their steady state within two or three periods. With drift and
/// a finite μ the contact starts from steady sliding at the first indentation: if that is the
/// minimum indentation, the first period is already steady (docs/theory.md, section 8). A
/// prescribed tangential force is reached to 1e-7 of its largest value, by a secant search at each
/// step. Throws InvalidInput where that force is not below μF, because the contact slides as a
/// whole.
/// body  a Material, or any Body, which must be under a periodic surface
/// cost  per step a partial-slip solve, and a second one if cells enter; four to six times as much
///       for a prescribed tangential force
CycleResult simulate_frictional_cycle(const PressureFields& contact_sets, const Grid2D& grid,
                                      const Body& body, const Trajectory& trajectory,
                                      const CycleOptions& options = {});

/// Simulates a cycle with the coupling of normal and tangential directions (Dundurs' β): in each
/// step pressures and tractions are iterated together, and the normal force also does work over a
/// cycle. The difference from simulate_frictional_cycle is the error of neglecting the coupling, as
/// the paper does. The contact is loaded from first touch in steps/4 increments without tangential
/// motion, so it has the radial tractions of first loading. work_per_cycle = dissipated + gap_work
/// within the tolerance of the iteration. gap_work is the part of ∫F dδ, by the trapezoidal rule,
/// of cells that have a gap at one end of a step; it vanishes for small steps and so measures
/// whether the steps are small enough. The indentation δ >= 0 is measured from first touch of the
/// undeformed bodies. contact.boundary and options.stick.boundary must agree.
/// cost  per step 5 to 10 iterations, each with a normal solve and one or two partial-slip solves
CycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                   const Trajectory& trajectory, const CycleOptions& options = {},
                                   const NormalContactOptions& contact = {});

}  // namespace salebra
