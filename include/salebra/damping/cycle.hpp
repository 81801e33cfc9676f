// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra {

/// The frictionless normal contact at one indentation.
struct ContactLevel {
  ContactSet contact;
  double force = 0;  ///< F, N
  bool converged = true;
};

/// The normal contact as a function of the indentation δ, m. Deterministic: it is asked once for each δ.
using ContactLevels = std::function<ContactLevel(double indentation)>;

/// The levels of a surface by boundary elements; the boundary of `options` must be that of the stick solves.
/// No contact for δ <= 0. The function keeps a copy of the surface.
ContactLevels boundary_element_levels(Surface surface, double contact_modulus,
                                      const NormalContactOptions& options = {});

/// A closed motion, or one that is closed up to a constant tangential advance, over t = 0 … 1.
struct Trajectory {
  std::function<double(double t)> indentation;  ///< δ, m
  std::function<double(double t)> tangential;   ///< x, m
};

/// One period of an oscillation about a mean indentation, from one least indentation to the next.
Trajectory trajectory_of(const Oscillation& motion, double mean_indentation);

/// The state between two moves.
struct CycleSample {
  double t = 0;
  double indentation = 0;           ///< δ, m
  double tangential = 0;            ///< x since the start, m
  double tangential_force = 0;      ///< F_x, N
  double normal_force = 0;          ///< F, N
  double work = 0;                  ///< ∫F_x dx since the start of the period, J
  double released_energy = 0;       ///< since the start of the period, J
  double contact_area = 0;          ///< m²
  double tangential_stiffness = 0;  ///< K_t of the contact set in full stick, along the motion, N/m
};

/// All that a simulated cycle remembers at one of its steps: from it the simulation goes on to the same bits.
struct CycleState {
  int period = 0;                     ///< periods finished
  int step = 0;                       ///< 0 … steps, of the last sample
  ContactSet contact;                 ///< now
  ContactSet smallest, largest;       ///< of the steps so far
  TangentialField displacement;       ///< of the cells in contact, m; 0 elsewhere
  TangentialField traction;           ///< Pa
  TangentialField unit_traction;      ///< stick traction of a unit move, Pa/m
  double tangential = 0;              ///< x of the trajectory, m
  double period_start = 0;            ///< x at the start of the period, m
  double work = 0;                    ///< of the period, J
  double released_energy = 0;         ///< of the period, J
  double energy_at_period_start = 0;  ///< stored, J
  double last_work = 0;               ///< W of the period before, J
  std::vector<CycleSample> samples;   ///< of the period
  long iterations = 0;
  long fft_count = 0;
  bool converged = true;
};

struct CycleOptions {
  int steps = 64;  ///< changes of the contact in a period, >= 4
  int max_periods =
      4;  ///< at most, until a period repeats the last one; 1 suffices from the least indentation
  double direction = 0;  ///< of the tangential motion against x, rad
  /// Of each solve, on the scale of the tangential motion; work and released energy agree to about its size.
  StickOptions stick = {.tolerance = 1e-8};
  Progress on_progress = {};
  /// Told the state at each step after its sample was taken, for checkpoints and fields; valid during the call.
  std::function<void(const CycleState&)> on_state = {};
  /// Goes on from this state instead of the start. It must come from the same levels, grid, material, trajectory and options.
  const CycleState* resume = nullptr;
};

/// A simulated period of a stuck contact.
struct CycleResult {
  double work_per_cycle = 0;  ///< ∮F_x dx less the change of the stored energy, J
  double released_energy =
      0;  ///< ½∫τ·[u] over the cells that leave the contact, as they leave it; an independent sum, J
  /// Estimated error of work_per_cycle that the steps leave, J; see simulate_cycle. That of the cells is not in it.
  double step_error = 0;
  double stored_energy_change =
      0;  ///< of ½∫τ·u over the period, J; not 0 where the contact advances
  double contact_area_min = 0;       ///< m²
  double contact_area_max = 0;       ///< m²
  ContactSet smallest, largest;      ///< cells that are in contact at least, at most
  std::vector<CycleSample> samples;  ///< after each step of the last period
  int periods = 0;
  long iterations = 0;  ///< of all stick solves
  long fft_count = 0;   ///< pairs of scalar fields
  bool steady = false;  ///< the period repeats
  bool converged =
      false;  ///< every contact and every stick solve did; otherwise do not use the numbers
  bool interrupted = false;
};

/// Direct three-dimensional simulation of a contact with infinite friction that moves along a trajectory.
/// A period is divided into steps t_k. The contact set is A(δ(t_k)) while x goes from its value at t_{k−1/2} to that at t_{k+1/2}:
/// the set changes at the middle time, without which φ0 is shifted by half a step.
///     move         the cells of A move with the body: Δτ = Δx · (stick traction of A)
///     release      cells that leave have τ = 0; the others are solved again with their displacements held
///     entry        cells enter with the displacement that they have at that time, and keep it relative to the body
/// From a trajectory that starts, stress-free, at its least indentation the first period is already the steady one.
/// Levels are asked at indentations rounded to 1e-9 of the sweep, each once: a cycle meets the levels of its way up again going down.
/// The error of the steps is of second order, −h²/24 of W, h = 2π/steps, for K_t' = const and equal frequencies; beside it stands what
/// the steps cannot tell, at which time between two of them each cell enters. step_error has both, from W = ½∮s² dK_t with the K_t of the
/// same contact sets (no further solve): with Δ the change of this W to every second set, and σ its standard deviation if each cell
/// entered at any time of its step, it is max(|Δ|, |Δ|/3 + 2σ), and how far this W is from the simulated one. It is the error against
/// infinitely many steps on the same cells; cells that are too large for the contact change both alike.
/// cost    per step a stick solve, and another where cells leave
/// memory  that of the stick solves, and half a byte a cell for each step
CycleResult simulate_cycle(const ContactLevels& levels, const Grid2D& grid,
                           const Material& material, const Trajectory& trajectory,
                           const CycleOptions& options = {});

}  // namespace salebra
