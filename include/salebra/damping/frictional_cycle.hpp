// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <salebra/damping/cycle.hpp>
#include <vector>

namespace salebra {

/// The frictionless normal contact at one indentation, with its pressures.
struct PressureLevel {
  Field pressure;    ///< (nx, ny), Pa
  double force = 0;  ///< F, N
  bool converged = true;
};

/// The normal contact as a function of the indentation δ, m. Deterministic: it is asked once for each δ.
using PressureLevels = std::function<PressureLevel(double indentation)>;

/// The levels of a surface by boundary elements; the boundary of `options` must be that of the stick solves.
/// No contact for δ <= 0. The function keeps a copy of the surface.
PressureLevels boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options = {});

/// The state between two moves.
struct FrictionalSample {
  double t = 0;
  double indentation = 0;       ///< δ, m
  double tangential = 0;        ///< x since the start of the period, m
  double tangential_force = 0;  ///< F_x, N
  double normal_force = 0;      ///< F, N
  double work = 0;              ///< ∫F_x dx since the start of the period, J
  double dissipated = 0;        ///< ∫τ·ds over the cells since the start of the period, J
  double contact_area = 0;      ///< m²
  double slip_area = 0;         ///< of cells at their limit, m²
};

/// All that a simulated cycle with friction remembers at one of its steps: from it the simulation goes on to the same bits.
struct FrictionalCycleState {
  int period = 0;                          ///< periods finished
  int step = 0;                            ///< 0 … steps, of the last sample
  SlidingState contact;                    ///< now
  ContactSet smallest, largest;            ///< of the steps of the period so far
  double tangential = 0;                   ///< x of the trajectory, m
  double energy_at_period_start = 0;       ///< stored, J
  double work_at_period_start = 0;         ///< ∫F_x dx, J
  double normal_work_at_period_start = 0;  ///< J
  double gap_work_at_period_start = 0;     ///< J
  Field loss_at_period_start;              ///< (nx, ny), J
  double last_work = 0;                    ///< work_per_cycle of the period before, J
  std::vector<FrictionalSample> samples;   ///< of the period
};

struct FrictionalCycleOptions {
  /// μ >= 0; infinite: full stick, simulate_cycle's case.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  int steps = 64;       ///< changes of the pressures in a period, >= 4
  int max_periods = 6;  ///< at most, until a period loses the same as the last one
  /// Relative difference of work_per_cycle between two periods that counts as none; > 0.
  double steady_tolerance = 1e-5;
  double direction = 0;  ///< of the tangential motion against x, rad
  /// Of simulate_coupled_cycle: as CoupledContactOptions::coupling.
  std::optional<double> coupling = {};
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
  /// Told the state at each step after its sample was taken, for checkpoints and fields; valid during the call.
  std::function<void(const FrictionalCycleState&)> on_state = {};
  /// Of simulate_frictional_cycle alone: goes on from this state instead of the start. It must come from the same levels, grid,
  /// material, trajectory and options.
  const FrictionalCycleState* resume = nullptr;
};

/// A simulated period of a contact with finite friction.
struct FrictionalCycleResult {
  /// ∮F_x dx less the change of the stored energy, J; cells that enter in a step count from their entry.
  double work_per_cycle = 0;
  double dissipated = 0;   ///< ∮∫τ·ds over the cells, an independent sum, J
  double normal_work = 0;  ///< ∮F dδ, part of work_per_cycle, J; 0 without coupling
  /// Of normal_work, what the steps make of gaps that close and open within one of them, J (CoupledContact::gap_work); 0 without
  /// coupling. work_per_cycle = dissipated + gap_work to the solvers' tolerance.
  double gap_work = 0;
  /// Of `dissipated`, J: by cells that open and close, which becomes the relaxation loss of the paper as μ → ∞, and by slip in cells
  /// that are in contact all the time, which becomes Mindlin's loss as u_z → 0. friction_map splits by the springs of the method of
  /// dimensionality reduction, which are not cells: the totals agree, the parts differ. Cone at 90°, M = μE*u_z/(G*u_x) = 0.3:
  /// relaxation over W(∞) is 0.50 by cells and 0.32 by springs.
  double relaxation_work = 0;
  double slip_work = 0;
  double stored_energy_change = 0;  ///< over the period, J; not 0 where the contact advances
  double contact_area_min = 0;      ///< m²
  double contact_area_max = 0;      ///< m²
  Field loss;  ///< lost in a period by unit area, (nx, ny), J/m²: where friction wears
  ContactSet smallest, largest;           ///< cells that are in contact always, at some time
  std::vector<FrictionalSample> samples;  ///< after each step of the last period
  int periods = 0;
  long iterations = 0;  ///< of conjugate gradients in all partial-slip solves
  long fft_count = 0;   ///< pairs of scalar fields
  bool steady = false;  ///< the last period lost the same as the one before
  bool converged =
      false;  ///< every contact and every partial-slip solve did; otherwise do not use the numbers
  bool interrupted = false;
};

/// Direct three-dimensional simulation of a contact with Coulomb friction that moves along a trajectory: SlidingContact, from step to
/// step, at second order in them. Started, stress-free, at the least indentation; without drift the permanent contact settles within
/// two or three periods, while a drag goes on until all of it slides: raise max_periods, and look at `steady`.
/// cost  per step a partial-slip solve, and another where cells enter
FrictionalCycleResult simulate_frictional_cycle(const PressureLevels& levels, const Grid2D& grid,
                                                const Material& material,
                                                const Trajectory& trajectory,
                                                const FrictionalCycleOptions& options = {});

/// The same with the coupling of normal and tangential directions (Dundurs' β): in each step the pressures follow the
/// tractions and the tractions the pressures, and F does work over a cycle too. Beside simulate_frictional_cycle it tells when the
/// coupling, which the paper neglects, may be left out. The contact is made from first touch in steps/4 increments without motion, so
/// that the radial tractions of the first loading are there.
/// work_per_cycle = dissipated + gap_work to the sweeps' tolerance; gap_work, which the trapezoidal ∫F dδ makes of cells that enter or
/// leave with a gap, measures the steps. δ >= 0 counts from the first touch of the undeformed bodies; the boundaries of both solves must agree.
/// cost  per step 5 to 10 sweeps of a normal solve and partial-slip solves
FrictionalCycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                             const Trajectory& trajectory,
                                             const FrictionalCycleOptions& options = {},
                                             const NormalContactOptions& contact = {});

}  // namespace salebra
