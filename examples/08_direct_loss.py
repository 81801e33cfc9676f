# SPDX-License-Identifier: GPL-3.0-or-later
"""08_direct_loss: repeats the paper's simulation in three dimensions: a paraboloid on a grid goes through one cycle, cell by cell, and
loses the energy that the theorem predicts.

Sample runs:  08_direct_loss.py        08_direct_loss.py 128 64
"""

import math
import sys

import salebra
from salebra import closed_form

n = int(sys.argv[1]) if len(sys.argv) > 1 else 64
steps = int(sys.argv[2]) if len(sys.argv) > 2 else 32

# 1. The paraboloid is isolated. Its axis lies off the grid points, because a symmetric contact would grow by many cells at a time.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
radius, indentation = 4e-3, 20e-6  # m
surface = salebra.paraboloid_surface(grid, radius, salebra.off_grid_center(grid))
material = salebra.Material(1e9, poisson=0.3)

# 2. The phase is 45°, because a scheme that shifts the phase would change the loss there.
motion = salebra.EqualFrequency(normal_amplitude=0.3 * indentation, tangential_amplitude=1e-6, phase=math.pi / 4)

# 3. Each step solves the normal contact and then the tangential contact in full stick; cells that separate lose the tangential energy that
#    they hold.
contact_sets = salebra.boundary_element_contact_sets(surface, material, tolerance=1e-8, boundary="free")
cycle = salebra.simulate_cycle(contact_sets, material, motion, indentation, steps=steps, boundary="free")
if not cycle.converged:
    sys.exit(1)

# 4. Compute the same loss from the law of the paraboloid alone, and from Eq. (12).
law = salebra.IndenterLaw(salebra.paraboloid_profile(radius), material)
exact = salebra.relaxation_damping(law, motion, indentation=indentation).work_per_cycle
small = closed_form.work_per_cycle(material.modulus_ratio, law.force_curvature(indentation), motion)
print(f"contact area          {cycle.contact_area_min * 1e6:.4g} … {cycle.contact_area_max * 1e6:.4g} mm²")
print(f"work of F_x           {cycle.work_per_cycle:.5e} J")
print(f"energy dissipated     {cycle.dissipated:.5e} J")
print(f"direct/theorem = {cycle.work_per_cycle / exact:.3f}, direct/Eq. (12) = {cycle.work_per_cycle / small:.3f}")
