# SPDX-License-Identifier: GPL-3.0-or-later
"""04_damping_curve: computes the damping constant of a rough contact against amplitude by Eq. (16) with a fitted decay length, by the
same law at finite amplitude, and by the curve without a law.

Sample runs:  04_damping_curve.py        04_damping_curve.py 512        04_damping_curve.py 512 0.003
"""

import math
import sys

import numpy as np

import salebra
from salebra import closed_form

n = int(sys.argv[1]) if len(sys.argv) > 1 else 256
relative_pressure = float(sys.argv[2]) if len(sys.argv) > 2 else 0.01  # p/(E*h')

# 1. Make surface, material and force–gap curve as in example 03.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=grid.lx / 4, short_cutoff=8 * grid.dx, rms_height=1e-6)
surface = salebra.random_phase(grid, spectrum, 7)
material = salebra.Material(1e9, poisson=0.3)
full = material.contact_modulus * surface.moments.rms_slope
curve = salebra.sweep_pressures(surface, material, full * np.geomspace(2e-4, 0.1, 24))

# 2. Make two laws from the curve: the paper's exponential law, and an interpolation of the samples.
force = relative_pressure * full * grid.area
decay_length = salebra.fit_exponential(curve).decay_length
ratio = material.modulus_ratio
exponential = salebra.ExponentialLaw(force, decay_length, ratio)
tabulated = salebra.TabulatedLaw(curve, ratio)

# 3. Shear the contact at 1 µm/s while it vibrates in the normal direction at 20 kHz, and print the damping constant P/v² for each amplitude.
print(f"F = {force:.4g} N, l = {decay_length * 1e9:.4g} nm")
print(f"{'u_z/l':>8} {'Eq. (16)':>16} {'exponential law':>16} {'curve':>16} (N s/m) {'(16)/law':>12} {'(16)/curve':>12}")
for k in (0.02, 0.05, 0.1, 0.2, 0.4):
    motion = salebra.Drag(normal_amplitude=k * decay_length, drag_velocity=1e-6, angular_frequency=2 * math.pi * 20e3)
    small = closed_form.damping_constant(closed_form.work_per_cycle_rough(ratio, force, decay_length, motion), motion)
    law = salebra.relaxation_damping(exponential, motion, force=force)
    measured = salebra.relaxation_damping(tabulated, motion, force=force)
    print(
        f"{k:8.2f} {small:16.6g} {law.damping_constant:16.6g} {measured.damping_constant:16.6g} "
        f"{small / law.damping_constant:20.4f} {small / measured.damping_constant:12.4f}"
    )
    if not (law.converged and measured.converged):
        sys.exit(1)

# 4. The ratio of Eq. (16) to the law shows the effect of the finite amplitude alone, 1 + 0.42 u_z/l + …; the ratio to the curve also
#    contains the error of the fit.
