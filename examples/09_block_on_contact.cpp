// SPDX-License-Identifier: GPL-3.0-or-later
// 09_block_on_contact — uses a contact as a force element in a time integration, as DEM and
// multibody programs do: a block on a rough contact rings in the normal and the tangential
// direction, and slip and relaxation damp it.
// Sample runs:  09_block_on_contact        09_block_on_contact 800 200
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/tangential_contact.hpp>

using namespace salebra;

int main(int argc, char** argv) try {
  const int steps_in_period = argc > 1 ? std::atoi(argv[1]) : 200;
  const int periods = argc > 2 ? std::atoi(argv[2]) : 20;

  // 1. The law of the rough contact is F = F0 exp(δ/l). A TabulatedLaw of a force curve works too.
  const double load = 10, decay_length = 100e-9, mass = 1;  // N, m, kg
  const ExponentialLaw law(load, decay_length,
                           Material::of_contact_modulus(115e9, 0.3).modulus_ratio());
  const double frequency = std::sqrt(law.normal_stiffness(0) / mass) / (2 * std::numbers::pi);
  const double dt = 1 / (frequency * steps_in_period);

  // 2. The tangential contact stores turning points, not steps, so a step costs the same in a long
  //    run. It needs the range of the motion in advance.
  const double range = 60e-9;  // m
  TangentialContact contact(
      law, -range, range,
      {.friction_coefficient = 0.3, .merge_tolerance = 1e-12, .tangential_range = 2 * range});

  // 3. The block is in equilibrium under its load; then it is lifted by 20 nm and pushed.
  double indentation = -20e-9, normal_velocity = 0, x = 0, velocity = 2e-4;
  contact.start(indentation, x);
  // ½mv² plus the potential of F less the potential of the load; 0 at rest.
  const auto normal_energy = [&] {
    return mass * normal_velocity * normal_velocity / 2 +
           decay_length * (law.force(indentation) - load) - load * indentation;
  };
  const auto kinetic = [&] { return mass * velocity * velocity / 2; };
  const double pushed = kinetic(), lifted = normal_energy();

  // 4. Velocity Verlet: half a step of the velocities, a step of the path, the new forces, and the
  //    other half of the velocities.
  double normal_force = law.force(indentation);
  std::size_t memory = 0;
  std::printf("period  kinetic, nJ  stored, nJ  dissipated, nJ\n");
  for (int step = 1; step <= periods * steps_in_period; ++step) {
    velocity -= dt / 2 * contact.tangential_force() / mass;
    normal_velocity += dt / 2 * (load - normal_force) / mass;
    x += dt * velocity;
    indentation += dt * normal_velocity;
    contact.move_to(indentation, x);
    normal_force = law.force(indentation);
    velocity -= dt / 2 * contact.tangential_force() / mass;
    normal_velocity += dt / 2 * (load - normal_force) / mass;
    memory = std::max(memory, contact.memory());
    if (step % (2 * steps_in_period) == 0)
      std::printf("%6d  %11.4f  %10.4f  %14.4f\n", step / steps_in_period, 1e9 * kinetic(),
                  1e9 * contact.stored_energy(), 1e9 * contact.dissipated());
  }

  // 5. The initial energy is still present or dissipated. The energy balance of the contact is
  //    exact, so the difference from 1 is the error of the time integration.
  std::printf("the normal oscillation keeps %.3f of its energy\n", normal_energy() / lifted);
  std::printf("history of %d steps: at most %zu pieces\n", periods * steps_in_period, memory);
  std::printf("energy balance = %.4f\n",
              (kinetic() + contact.stored_energy() + contact.dissipated()) / pushed);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
