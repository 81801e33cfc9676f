# SPDX-License-Identifier: GPL-3.0-or-later
"""06_mdr_oscillation: sums the loss spring by spring, as the paper argues: an axisymmetric indenter on its one-dimensional foundation
oscillates in both directions. The sum is compared with Eq. (12) and with the theorem for finite amplitudes.

Sample runs:  06_mdr_oscillation.py cone        06_mdr_oscillation.py paraboloid        06_mdr_oscillation.py paraboloid 0.9
"""

import math
import sys

import numpy as np

import salebra
from salebra import closed_form

shape = sys.argv[1] if len(sys.argv) > 1 else "cone"
relative_amplitude = float(sys.argv[2]) if len(sys.argv) > 2 else 0.3  # u_z/δ

# 1. Make the indenter with its image g(x), Eqs (3) to (5); one body is elastic with ν = 0.3.
profile = salebra.cone_profile(0.1) if shape == "cone" else salebra.paraboloid_profile(10e-3)
material = salebra.Material(1e9, poisson=0.3)
law = salebra.IndenterLaw(profile, material)

# 2. The mean indentation is 1 µm, and both oscillations are in phase quadrature.
indentation = 1e-6  # m
motion = salebra.EqualFrequency(
    normal_amplitude=relative_amplitude * indentation, tangential_amplitude=200e-9, phase=math.pi / 2
)

# 3. The springs of the foundation are Δx apart, each at its distance z0 = g(x) − δ from first touch. Eq. (9) says whether a spring loses
#    energy, Eq. (7) gives the distance by which it is released, and Eq. (8) the energy that it loses.
springs = 100_000  # on one side
width = law.contact_radius(indentation + motion.normal_amplitude) / springs
by_springs = 0.0
for depth in profile.image((np.arange(springs) + 0.5) * width) - indentation:
    if closed_form.intermittent_contact(depth, motion.normal_amplitude):
        released = closed_form.released_distance(depth, motion)
        by_springs += 2 * closed_form.spring_energy(material.tangential_modulus, released, width)

# 4. Eq. (12) uses only F'' at the mean indentation; the theorem uses the whole law.
small = closed_form.work_per_cycle(material.modulus_ratio, law.force_curvature(indentation), motion)
exact = salebra.relaxation_damping(law, motion, indentation=indentation)
if not exact.converged:
    sys.exit(1)
work = exact.work_per_cycle
print(f"{shape}, u_z = {relative_amplitude:.2f} δ")
print(f"springs     {by_springs:.6e} J")
print(f"theorem     {work:.6e} J   springs/theorem {by_springs / work:.5f}")
print(f"Eq. (12)    {small:.6e} J   Eq. (12)/theorem {small / work:.5f}")

# 5. For the cone F'' is constant, and Eq. (12) is exact at any amplitude; for the paraboloid Eq. (12) is the limit u_z → 0.
