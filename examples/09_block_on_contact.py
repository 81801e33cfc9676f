# SPDX-License-Identifier: GPL-3.0-or-later
"""09_block_on_contact: uses a contact as a force element in a time integration, as DEM and multibody programs do: a block on a rough
contact rings in the normal and the tangential direction, and slip and relaxation damp it.

Sample runs:  09_block_on_contact.py        09_block_on_contact.py 800 200
"""

import math
import sys

import salebra

steps_in_period = int(sys.argv[1]) if len(sys.argv) > 1 else 200
periods = int(sys.argv[2]) if len(sys.argv) > 2 else 20

# 1. The law of the rough contact is F = F0 exp(δ/l). A TabulatedLaw of a force curve works too.
load, decay_length, mass = 10, 100e-9, 1  # N, m, kg
law = salebra.ExponentialLaw(load, decay_length, salebra.Material(115e9, poisson=0.3).modulus_ratio)
frequency = math.sqrt(law.normal_stiffness(0) / mass) / (2 * math.pi)
dt = 1 / (frequency * steps_in_period)

# 2. The tangential contact stores turning points, not steps, so a step costs the same in a long run. It needs the range of the motion in
#    advance.
extent = 60e-9  # m
contact = salebra.TangentialContact(
    law, -extent, extent, friction_coefficient=0.3, merge_tolerance=1e-12, tangential_range=2 * extent
)

# 3. The block is in equilibrium under its load; then it is lifted by 20 nm and pushed.
indentation, normal_velocity, x, velocity = -20e-9, 0.0, 0.0, 2e-4
contact.start(indentation, x)


def normal_energy() -> float:
    """½mv² plus the potential of F less the potential of the load; 0 at rest."""
    return mass * normal_velocity**2 / 2 + decay_length * (law.force(indentation) - load) - load * indentation


def kinetic() -> float:
    return mass * velocity**2 / 2


pushed, lifted = kinetic(), normal_energy()

# 4. Velocity Verlet: half a step of the velocities, a step of the path, the new forces, and the other half of the velocities.
normal_force, memory = law.force(indentation), 0
print("period  kinetic, nJ  stored, nJ  dissipated, nJ")
for step in range(1, periods * steps_in_period + 1):
    velocity -= dt / 2 * contact.tangential_force / mass
    normal_velocity += dt / 2 * (load - normal_force) / mass
    x += dt * velocity
    indentation += dt * normal_velocity
    contact.move_to(indentation, x)
    normal_force = law.force(indentation)
    velocity -= dt / 2 * contact.tangential_force / mass
    normal_velocity += dt / 2 * (load - normal_force) / mass
    memory = max(memory, contact.memory)
    if step % (2 * steps_in_period) == 0:
        energies = (1e9 * one for one in (kinetic(), contact.stored_energy, contact.dissipated))
        print("{:6d}  {:11.4f}  {:10.4f}  {:14.4f}".format(step // steps_in_period, *energies))

# 5. The initial energy is still present or dissipated. The energy balance of the contact is exact, so the difference from 1 is the error of
#    the time integration.
print(f"the normal oscillation keeps {normal_energy() / lifted:.3f} of its energy")
print(f"history of {periods * steps_in_period} steps: at most {memory} pieces")
print(f"energy balance = {(kinetic() + contact.stored_energy + contact.dissipated) / pushed:.4f}")
