# SPDX-License-Identifier: GPL-3.0-or-later
"""03_force_gap_fit: computes force against mean gap by three models and tests for each how well F ∝ exp(−ū/l) holds.

Sample runs:  03_force_gap_fit.py        03_force_gap_fit.py 512        03_force_gap_fit.py 512 0.5 11
"""

import sys

import numpy as np

import salebra

n = int(sys.argv[1]) if len(sys.argv) > 1 else 256
hurst = float(sys.argv[2]) if len(sys.argv) > 2 else 0.8
seed = int(sys.argv[3]) if len(sys.argv) > 3 else 7

# 1. Make a surface and a material: one elastic body, ν = 0.3, against a rigid one.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
spectrum = salebra.SelfAffineSpectrum(hurst=hurst, rolloff=grid.lx / 4, short_cutoff=8 * grid.dx, rms_height=1e-6)
surface = salebra.random_phase(grid, spectrum, seed)
material = salebra.Material(1e9, poisson=0.3)
moments = surface.moments

# 2. The pressures reach from the contact of a few summits to a twentieth of E*h'.
pressures = material.contact_modulus * moments.rms_slope * np.geomspace(5e-4, 5e-2, 16)

# 3. The models are boundary elements, Greenwood–Williamson with summits from the moments, and Greenwood–Williamson with the surface's own
#    summits.
from_moments = salebra.StatisticalSummits(salebra.summit_ensemble(moments), material, grid.area)
own_summits = salebra.DeterministicSummits(
    salebra.find_summits(surface), material, grid.area, rms_height=moments.rms_height
)
curves = {
    "boundary elements": salebra.sweep_pressures(surface, material, pressures),
    "summits from the moments": salebra.curve_at_pressures(from_moments, pressures),
    "the surface's summits": salebra.curve_at_pressures(own_summits, pressures),
}

# 4. Print for each the decay length over rms height, its range over parts of the window, and its change along the window.
print(f"{'model':26} {'l/h_rms':>8} {'parts of window':>18} {'closest … farthest':>22}")
h = moments.rms_height
for name, curve in curves.items():
    fit = salebra.fit_exponential(curve)
    test = salebra.test_exponential(curve)
    parts = salebra.window_sensitivity(curve)
    print(
        f"{name:26} {fit.decay_length_over_rms_height:8.3f}    "
        f"{parts.decay_length_min / h:.3f} … {parts.decay_length_max / h:.3f}        "
        f"{test.decay_length_at_min_gap / h:.3f} … {test.decay_length_at_max_gap / h:.3f}"
    )
