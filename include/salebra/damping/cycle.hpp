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
/// period. One engine drives three contacts: a stuck one, one with Coulomb friction, and one whose
/// pressures and tractions are coupled (Dundurs' β).
namespace salebra {

/// The cells of the frictionless normal contact at one indentation.
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

/// The pressures of the same.
struct PressureAt {
  Field contact_pressure;  ///< (nx, ny), Pa
  double force = 0;        ///< F, N
  bool converged = true;
};

/// The normal contact as a function of the indentation δ, m. Deterministic: called once for each δ.
using ContactLevels = std::function<ContactSetAt(double indentation)>;
using PressureLevels = std::function<PressureAt(double indentation)>;

/// The normal contact of a surface by boundary elements; the boundary of `options` must be that of
/// the tangential solves. No contact for δ <= 0. The function keeps a copy of the surface.
ContactLevels boundary_element_levels(Surface surface, double contact_modulus,
                                      const NormalContactOptions& options = {});
PressureLevels boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options = {});

/// A closed motion, or one that is closed up to a constant tangential advance, over t = 0 … 1.
struct Trajectory {
  std::function<double(double t)> indentation;  ///< δ, m
  std::function<double(double t)> tangential;   ///< x, m
  /// T, N: the body goes to where F_x is T, in place of `tangential`, which is left empty. Of
  /// simulate_frictional_cycle alone.
  std::function<double(double t)> tangential_force = {};
};

/// One period of an oscillation about a mean indentation, from one minimum of the indentation to
/// the next.
Trajectory trajectory_of(const Oscillation& motion, double mean_indentation);

/// The state between two moves; work and losses count from the start of the period.
struct CycleSample {
  double t = 0;
  double indentation = 0;       ///< δ, m
  double tangential = 0;        ///< x since the start of the period, m
  double tangential_force = 0;  ///< F_x, N
  double normal_force = 0;      ///< F, N
  double work = 0;              ///< ∫F_x dx, J
  double dissipated = 0;  ///< released by cells that leave the contact; with friction ∫τ·ds, J
  double contact_area = 0;  ///< m²
  double slip_area = 0;     ///< of cells at their limit, m²
  /// K_t of the contact set in full stick, along the motion, N/m; NaN with friction.
  double tangential_stiffness = std::numeric_limits<double>::quiet_NaN();
};

/// The time first.
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

/// What a stuck contact remembers: where each of its cells has been drawn to.
struct StuckState {
  ContactSet contact;                                ///< now
  TangentialField displacement;                      ///< of the cells in contact, m; 0 elsewhere
  TangentialField traction;                          ///< Pa
  TangentialField unit_traction;                     ///< stick traction of a unit move, Pa/m
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
  /// μ >= 0 of simulate_frictional_cycle and simulate_coupled_cycle; infinite: full stick.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  int steps = 64;       ///< changes of the contact in a period, >= 4
  int max_periods = 6;  ///< until a period loses the same as the one before it
  /// Relative difference of work_per_cycle between two periods that counts as none; > 0.
  double steady_tolerance = 1e-5;
  double direction = 0;  ///< of the tangential motion against x, rad
  /// β/(πE*) of simulate_coupled_cycle, 1/Pa; default: coupling_constant(material).
  std::optional<double> coupling_constant = {};
  /// The tangential solves, on the scale of the tangential motion; work and dissipation agree to
  /// about this tolerance.
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
  /// Receives a copy of the state at each step after its sample was taken.
  std::function<void(CycleState)> on_state = {};
  /// Continues from this state, which is read before the first step. It must come from the same
  /// function, contact, grid, material, trajectory and options.
  const CycleState* resume = nullptr;
};

/// A simulated period.
struct CycleResult {
  /// ∮F_x dx less the change of the stored energy, J; with coupling ∮F dδ too. Cells that enter in
  /// a step count from their entry.
  double work_per_cycle = 0;
  /// The loss as an independent sum over the cells, J: ½∫τ·[u] of cells as they leave the contact,
  /// or with friction ∮∫τ·ds.
  double dissipated = 0;
  /// Two parts of `dissipated`, J: by cells that open and close, which becomes the relaxation loss
  /// of the paper as μ → ∞, and by slip in cells that are in contact all the time, which becomes
  /// Mindlin's loss as u_z → 0. friction_map splits by the springs of the method of dimensionality
  /// reduction, which are not cells: the totals agree, the parts differ. Cone at 90°, M =
  /// μE*u_z/(G*u_x) = 0.3: relaxation over W(∞) is 0.50 by cells and 0.32 by springs.
  double relaxation_work = 0;
  double slip_work = 0;
  double normal_work = 0;  ///< ∮F dδ, part of work_per_cycle, J; 0 without coupling
  /// The part of normal_work that the steps make of gaps that close and open within one of them, J
  /// (CoupledContact::gap_work); 0 without coupling. work_per_cycle = dissipated + gap_work to the
  /// solvers' tolerance.
  double gap_work = 0;
  /// Estimated error of work_per_cycle due to the steps, J, without that of the cells; see
  /// simulate_cycle. NaN with friction.
  double step_error = std::numeric_limits<double>::quiet_NaN();
  double stored_energy_change = 0;  ///< over the period, J; not 0 where the contact advances
  double contact_area_min = 0;      ///< m²
  double contact_area_max = 0;      ///< m²
  Field loss;  ///< lost in a period by unit area, (nx, ny), J/m²: where friction wears; empty where
               ///< nothing slips
  ContactSet smallest, largest;      ///< cells that are in contact always, at some time
  std::vector<CycleSample> samples;  ///< after each step of the last period
  int periods = 0;
  long iterations = 0;  ///< of all tangential solves
  long fft_count = 0;   ///< pairs of scalar fields
  bool steady = false;  ///< the period repeats
  /// Of all solves; unless converged, do not use the numbers.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
  /// How far the other sum is from work_per_cycle, relative: 0 up to the solvers' tolerance.
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

/// What slip changes of a cycle; NaN where nothing is lost without it.
struct SlipEffect {
  double over_stick = 0;             ///< W over that without slip
  double mean_tangential_force = 0;  ///< W over the way of a drag, N; NaN for a motion that returns
  double mean_force = 0;             ///< over the period, N
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

/// What the coupling changes of a cycle with friction, relative; NaN where that has none of it.
struct CouplingEffect {
  double work_change = 0;
  double force_change = 0;             ///< largest over the cycle, over the largest force
  double tangential_force_change = 0;  ///< likewise
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

/// One quantity over the samples.
inline std::vector<double> column(const CycleResult& cycle, double CycleSample::*value) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*value);
  return values;
}

/// A contact with infinite friction.
/// A period is divided into steps t_k. The contact set is A(δ(t_k)) while x goes from its value at
/// t_{k−1/2} to that at t_{k+1/2}: the set changes at the middle time, without which φ0 is shifted
/// by half a step.
///     move         the cells of A move with the body: Δτ = Δx · (stick traction of A)
///     release      cells that leave have τ = 0; the others are solved again with their
///                  displacements fixed
///     entry        cells enter with the displacement that they have at that time, and keep it
///                  relative to the body
/// From a trajectory that starts, stress-free, at its minimum indentation the first period is
/// already the steady one. Levels are evaluated at indentations rounded to 1e-9 of the sweep, each
/// once: a cycle meets the levels of its way up again on its way down. The error of the steps is of
/// second order, −h²/24 of W, h = 2π/steps, for K_t' = const and equal frequencies. A second term
/// accounts for the unknown time within a step at which each cell enters. step_error has both, from
/// W = ½∮s² dK_t with the K_t of the same contact sets (no further solve): with Δ the change of
/// this W to every second set, and σ its standard deviation if each cell entered at any time of its
/// step, it is max(|Δ|, |Δ|/3 + 2σ), and how far this W is from the simulated one. It is the error
/// against infinitely many steps on the same cells; cells that are too large for the contact change
/// both alike.
/// cost    per step a stick solve, and another where cells leave
/// memory  that of the stick solves, and half a byte a cell for each step
CycleResult simulate_cycle(const ContactLevels& levels, const Grid2D& grid,
                           const Material& material, const Trajectory& trajectory,
                           const CycleOptions& options = {});

/// A contact with Coulomb friction: SlidingContact, from step to step, at second order in them.
/// Without drift it starts stress-free, and the permanent contact settles within two or three
/// periods. With drift and a finite μ it starts from endless sliding at the first indentation:
/// where that is the minimum, the first period is the steady one, as with the springs
/// (docs/theory.md, section 8). A tangential force is met to 1e-7 of its greatest value, by a
/// secant search at each step. Throws InvalidInput where it is not below μF: the contact slides
/// there.
/// cost  per step a partial-slip solve, and another where cells enter; of a force four to six times
///       that
CycleResult simulate_frictional_cycle(const PressureLevels& levels, const Grid2D& grid,
                                      const Material& material, const Trajectory& trajectory,
                                      const CycleOptions& options = {});

/// Simulates a cycle with the coupling of normal and tangential directions (Dundurs' β): in each
/// step the pressures follow the tractions and the tractions the pressures, and F does work over a
/// cycle too. Compared with simulate_frictional_cycle it shows when the coupling, which the paper
/// neglects, may be left out. The contact is made from first touch in steps/4 increments without
/// motion, so that the radial tractions of the first loading are there. work_per_cycle = dissipated
/// + gap_work to the sweeps' tolerance; gap_work, which the trapezoidal ∫F dδ makes of cells that
/// enter or leave with a gap, measures the steps. δ >= 0 counts from the first touch of the
/// undeformed bodies; the boundaries of both solves must agree.
/// cost  per step 5 to 10 sweeps of a normal solve and partial-slip solves
CycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                   const Trajectory& trajectory, const CycleOptions& options = {},
                                   const NormalContactOptions& contact = {});

}  // namespace salebra
