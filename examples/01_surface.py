# SPDX-License-Identifier: GPL-3.0-or-later
"""01_surface: makes a self-affine surface and compares its requested roughness with the roughness that the grid can represent and with
that of the surface made.

Sample runs:  01_surface.py        01_surface.py 1024        01_surface.py 512 0.6 3
"""

import math
import sys

import salebra
from salebra import format_quantity

n = int(sys.argv[1]) if len(sys.argv) > 1 else 256
hurst = float(sys.argv[2]) if len(sys.argv) > 2 else 0.8
seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1

# 1. The period is 1 mm, the roll-off half of it, the shortest wave eight cells of the grid, and the rms height 1 µm.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
spectrum = salebra.SelfAffineSpectrum(hurst=hurst, rolloff=grid.lx / 2, short_cutoff=8 * grid.dx, rms_height=1e-6)

# 2. Before any surface is made, the lattice sum predicts its moments on this grid.
expected = salebra.forecast(grid, spectrum)
for warning in expected.warnings:
    print("note:", warning)

# 3. Random phase gives every mode exactly its power, so the surface must have the moments of the lattice sum.
surface = salebra.random_phase(grid, spectrum, seed)
realised = surface.moments
print(f"{'':22} {'continuum':>12} {'lattice':>12} {'realised':>12}")
for name, title in (("rms_height", "rms height"), ("rms_slope", "rms slope"), ("nayak", "Nayak parameter")):
    values = (format_quantity(getattr(moments, name), name) for moments in (expected.target, expected.lattice, realised))
    print(f"{title:22} " + " ".join(f"{value:>12}" for value in values))

# 4. Compare the number of summits with Nayak's density for a Gaussian surface of these moments, m4/(6√3 π m2).
summits = salebra.summit_statistics(salebra.find_summits(surface))
nayak_density = realised.moment4 / (6 * math.sqrt(3) * math.pi * realised.moment2)
print(f"{'summit density':22} {summits.summit_density * 1e-6:.4g} per mm², Nayak: {nayak_density * 1e-6:.4g}")
print(f"{'mean summit radius':22} {format_quantity(summits.mean_radius, 'mean_radius')}")

print(f"realised/lattice rms height = {realised.rms_height / expected.lattice.rms_height:.9f}")
