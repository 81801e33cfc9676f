// SPDX-License-Identifier: GPL-3.0-or-later
// The damping constant with slip that a study states, against the three-dimensional simulation with
// friction: the first surface of data/quickstart.toml on 128 x 128 points, a slow shear to and fro,
// each way over twenty normal cycles.
//   damping_slip CONFIG [points [steps in a normal cycle]]
// One line per motion: excursion, friction, gamma of the study with its error and the share of slip,
// gamma and share of the simulation, and their difference over gamma. The simulation turns back: by
// docs/theory.md, section 8, this alone makes 0.44 w/X = 2.2 % of the relaxation loss.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/study/study_answer.hpp>

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
  const Surface surface =
      filtered_noise(surfaces.grid, SelfAffineSpectrum(surfaces.spectrum), surfaces.seeds.front());
  const double modulus = configuration.material.contact_modulus;
  const Drag described = std::get<Drag>(configuration.motion);
  const double omega = described.angular_frequency;
  std::printf("X/nm   mu   gamma, N s/m   error  by slip   simulated  by slip  difference\n");
  for (const double excursion : {0.5e-9, 5e-9, 50e-9})
    for (const double friction : {0.1, 0.3}) {
      const Drag motion{.normal_amplitude = described.normal_amplitude,
                        .drag_velocity = excursion * omega / (2 * pi) / (normal_cycles / 2),
                        .angular_frequency = omega};
      configuration.motion = motion;
      configuration.known.friction_coefficient = friction;
      configuration.known.excursion = excursion;
      const StudyResult result = run_study(configuration);
      const StudyAnswer answer = answer_of(result);
      const std::size_t k = answer.damping_constant.size() / 2;
      const NormalContactState state = press(surface, modulus, Pressure{result.pressures[k]});
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
      const double simulated = cycle.work_per_cycle / normal_cycles * omega / (2 * pi) /
                               (motion.drag_velocity * motion.drag_velocity);
      std::vector<double> dense;
      for (int i = 0; i <= 150; ++i)
        dense.push_back(result.pressures[k] / 20 * std::pow(40.0, i / 150.0));
      static const TabulatedLaw law(
          sweep_pressures(surface, configuration.material, dense, {.stick = true}),
          configuration.material.modulus_ratio());
      const LossWithSlip by_law =
          loss_with_slip(law, law.indentation_of(result.pressures[k] * surface.grid.area()), motion,
                         friction, excursion);
      std::printf(
          "dense %g %g %g\n",
          by_law.work_per_cycle * omega / 2 / pi / motion.drag_velocity / motion.drag_velocity,
          by_law.slip_share(),
          by_law.full_stick_work * omega / 2 / pi / motion.drag_velocity / motion.drag_velocity);
      const StatedMean& stated = answer.damping_constant[k];
      std::printf("%4.1f  %4.1f  %12.5g  %5.1f %%  %5.1f %%  %10.5g  %5.1f %%  %+.1f %% %d %d %g\n",
                  excursion / 1e-9, friction, stated.mean, 100 * stated.error / stated.mean,
                  100 * answer.slip_share[k], simulated, 100 * cycle.slip_work / cycle.dissipated,
                  100 * (stated.mean / simulated - 1), cycle.steady, cycle.converged,
                  answer.damping_constant_without_slip[k].mean);
      std::fflush(stdout);
    }
}
