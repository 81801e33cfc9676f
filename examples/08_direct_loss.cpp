// SPDX-License-Identifier: GPL-3.0-or-later
// 08_direct_loss — repeats the paper's simulation in three dimensions: a paraboloid on a grid goes
// through one cycle, cell by cell, and loses the energy that the theorem predicts.
// Sample runs:  08_direct_loss        08_direct_loss 128 64
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/shapes.hpp>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 64;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 32;

  // 1. The paraboloid is isolated. Its axis lies off the grid points, because a symmetric contact
  //    would grow by many cells at a time.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const double radius = 4e-3, indentation = 20e-6;  // m
  const Surface surface = paraboloid_surface(grid, radius, off_grid_center(grid));
  const Material material = Material::of_contact_modulus(1e9, 0.3);

  // 2. The phase is 45°, because a scheme that shifts the phase would change the loss there.
  const EqualFrequency motion{.normal_amplitude = 0.3 * indentation,
                              .tangential_amplitude = 1e-6,
                              .phase = std::numbers::pi / 4};

  // 3. Each step solves the normal contact and then the tangential contact in full stick; cells
  //    that separate lose the tangential energy that they hold.
  CycleOptions options;
  options.steps = steps;
  options.stick.boundary = Boundary::free;
  const CycleResult cycle =
      simulate_cycle(boundary_element_contact_sets(surface, material.contact_modulus,
                                                   {.tolerance = 1e-8, .boundary = Boundary::free}),
                     grid, material, trajectory_of(motion, indentation), options);
  if (!cycle.converged()) return 1;

  // 4. Compute the same loss from the law of the paraboloid alone, and from Eq. (12).
  const IndenterLaw law(paraboloid_profile(radius), material);
  const double exact = relaxation_damping(law, at_indentation(indentation), motion).work_per_cycle;
  const double small = closed_form::work_per_cycle(material.modulus_ratio(),
                                                   law.force_curvature(indentation), motion);
  std::printf("contact area          %.4g … %.4g mm²\n", cycle.contact_area_min * 1e6,
              cycle.contact_area_max * 1e6);
  std::printf("work of F_x           %.5e J\n", cycle.work_per_cycle);
  std::printf("energy dissipated     %.5e J\n", cycle.dissipated);
  std::printf("direct/theorem = %.3f, direct/Eq. (12) = %.3f\n", cycle.work_per_cycle / exact,
              cycle.work_per_cycle / small);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
