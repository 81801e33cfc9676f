# SPDX-License-Identifier: GPL-3.0-or-later
"""07_gw_against_bem: compares Greenwood and Williamson's summits with boundary elements on the same surface: area, gap, stiffness and
damping constant, up to loads at which independent summits fail.

Sample runs:  07_gw_against_bem.py        07_gw_against_bem.py 512        07_gw_against_bem.py 512 11
"""

import math
import sys

import numpy as np

import salebra

n = int(sys.argv[1]) if len(sys.argv) > 1 else 256
seed = int(sys.argv[2]) if len(sys.argv) > 2 else 7

# 1. Make surface and material as in example 03, with loads from 2e-4 to 0.2 E*h'.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=grid.lx / 8, short_cutoff=8 * grid.dx, rms_height=1e-6)
surface = salebra.random_phase(grid, spectrum, seed)
moments = surface.moments
material = salebra.Material(1e9, poisson=0.3)
full = material.contact_modulus * moments.rms_slope
pressures = full * np.geomspace(2e-4, 0.2, 16)

# 2. Compute two curves of the same surface: solved by boundary elements, and summed over its own summits.
elements = salebra.sweep_pressures(surface, material, pressures)
own_summits = salebra.DeterministicSummits(
    salebra.find_summits(surface), material, grid.area, rms_height=moments.rms_height
)
summits = salebra.curve_at_pressures(own_summits, pressures)

# 3. Put both laws under the same motion. Damping depends on F'', which magnifies small differences of F.
element_law = salebra.TabulatedLaw(elements, material.modulus_ratio)
summit_law = salebra.TabulatedLaw(summits, material.modulus_ratio)
motion = salebra.Drag(
    normal_amplitude=0.02 * moments.rms_height, drag_velocity=1e-6, angular_frequency=2 * math.pi * 20e3
)
print(f"summits over boundary elements\n{'p/(E*h)':>12} {'gap/h_rms':>9} {'area':>8} {'K':>8} {'damping':>8}")
stiffness = summits.normal_stiffness / elements.normal_stiffness
area = summits.contact_area_fraction / elements.contact_area_fraction
shown = range(2, len(pressures) - 2, 2)  # at the first and the last load the cycle would leave the curves
for i in shown:
    by_elements = salebra.relaxation_damping(element_law, motion, force=elements.force[i])
    by_summits = salebra.relaxation_damping(summit_law, motion, force=elements.force[i])
    if not (elements.converged[i] and by_elements.converged and by_summits.converged):
        sys.exit(1)
    print(
        f"{pressures[i] / full:12.5f} {elements.mean_gap[i] / moments.rms_height:9.2f} {area[i]:8.3f} {stiffness[i]:8.3f} "
        f"{by_summits.damping_constant / by_elements.damping_constant:8.3f}"
    )

# 4. Contact patches that are far apart do not interact. At high loads they do, and independent summits are too soft.
first, last = stiffness[shown[0]], stiffness[shown[-1]]
print(f"K of the summits falls from {first:.2f} to {last:.2f} of that of the boundary elements")
