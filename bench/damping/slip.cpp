// SPDX-License-Identifier: GPL-3.0-or-later
// The damping constant with slip that a study states, against the three-dimensional simulation with
// friction: the first surface of a study's configuration, a slow shear to and fro, each way over
// twenty normal cycles.
//   damping_slip CONFIG [points [steps in a normal cycle]]
// A table, one row a motion: excursion, friction, gamma of the study with its error and its part by
// slip; gamma and part by slip of the simulation; gamma of springs by 150 contacts on the cells of
// the simulation, twice as wide as the study's finest, and how far it is off the simulation. The
// simulation turns back a quarter of a normal cycle after the least indentation, which costs what
// the mean over all phases does (src/damping/spring_loss.hpp).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/study/study_solution.hpp>

#include "damping/slip_by_contacts.hpp"

using namespace salebra;

int main(int count, char** arguments) {
  constexpr double pi = std::numbers::pi;
  constexpr int normal_cycles = 40;  // there and back
  if (count < 2) return 2;
  const Index points = count > 2 ? std::atoi(arguments[2]) : 128;
  const int steps = count > 3 ? std::atoi(arguments[3]) : 24;
  StudyConfiguration configuration = read_study_configuration(arguments[1]);
  auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  surfaces.grid = Grid2D(points, points, surfaces.grid.lx, surfaces.grid.ly);
  surfaces.seeds.resize(1);
  const Surface surface = study_surface(configuration, surfaces.seeds.front());
  const double modulus = configuration.material.contact_modulus;
  const Drag described = std::get<Drag>(configuration.motion);
  const double omega = described.angular_frequency;
  const StudyLoads loads = study_loads(configuration);
  const DenseForces dense =
      dense_forces(surface, configuration.material, loads.pressures[loads.pressures.size() / 2],
                   described.normal_amplitude, 48);
  std::puts(
      "| excursion | $\\mu$ | $\\gamma$, N s/m | error | by slip | simulated, N s/m | by slip | "
      "same "
      "cells, N s/m | off by |\n|---|---|---|---|---|---|---|---|---|");
  for (const double excursion : {0.05e-9, 0.5e-9, 5e-9, 50e-9, 500e-9})
    for (const double friction : {0.1, 0.3}) {
      const Drag motion{.normal_amplitude = described.normal_amplitude,
                        .drag_velocity = excursion * omega / (2 * pi) / (normal_cycles / 2),
                        .angular_frequency = omega};
      configuration.motion = motion;
      configuration.known.friction_coefficient = friction;
      configuration.known.excursion = excursion;
      const StudyResult result = run_study(configuration);
      const StudySolution answer = solution_of(result);
      const std::size_t k = answer.damping_constant.size() / 2;
      const StatedMean& stated = answer.damping_constant[k];
      std::printf("| %g nm | %.1f | %.3g | %.1f %% | %.1f %% | ", excursion / 1e-9, friction,
                  stated.mean, 100 * stated.error / stated.mean, 100 * answer.slip_share[k]);
      std::fflush(stdout);
      const NormalContactState state = press(surface, modulus, at_pressure(result.pressures[k]));
      // The turning points lie a quarter of a normal cycle after its least indentation.
      const Trajectory path{[&](double t) {
                              return state.indentation -
                                     motion.normal_amplitude * std::cos(2 * pi * normal_cycles * t);
                            },
                            [&](double t) {
                              const double way = 2 * (t - 0.25 / normal_cycles);
                              return excursion * 2 * std::abs(way / 2 - std::floor(way / 2 + 0.5));
                            }};
      const CycleResult cycle =
          simulate_frictional_cycle(boundary_element_pressures(Surface(surface), modulus),
                                    surface.grid, configuration.material, path,
                                    {.friction_coefficient = friction,
                                     .steps = steps * normal_cycles,
                                     .max_periods = 3,
                                     .steady_tolerance = 1e-3,
                                     .stick = {.tolerance = 1e-5}});
      const double simulated =
          closed_form::damping_constant(cycle.work_per_cycle / normal_cycles, motion);
      const double on_its_cells = closed_form::damping_constant(
          work_with_slip_by_contacts(dense, configuration.material, motion, friction, excursion),
          motion);
      std::printf("%.3g | %.1f %% | %.3g | %+.1f %%%s |\n", simulated,
                  100 * cycle.slip_work / cycle.dissipated, on_its_cells,
                  100 * (on_its_cells / simulated - 1),
                  cycle.steady && cycle.converged() ? "" : ", not steady");
      std::fflush(stdout);
    }
}
