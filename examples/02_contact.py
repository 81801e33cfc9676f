# SPDX-License-Identifier: GPL-3.0-or-later
"""02_contact: presses one rough surface at one pressure by boundary elements and compares its contact area with two theories.

Sample runs:  02_contact.py        02_contact.py 512        02_contact.py 512 0.002
"""

import sys

import salebra
from salebra import format_quantity

n = int(sys.argv[1]) if len(sys.argv) > 1 else 256
relative_pressure = float(sys.argv[2]) if len(sys.argv) > 2 else 0.01  # p/(E*h')

# 1. The shortest wave of the periodic surface has eight cells; with fewer cells the contact area is too large.
grid = salebra.Grid2D(n, n, 1e-3, 1e-3)
spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=grid.lx / 4, short_cutoff=8 * grid.dx, rms_slope=0.1)
surface = salebra.random_phase(grid, spectrum, 7)

# 2. p/(E*h') determines the contact area; h' is the rms slope.
contact_modulus = 1e9  # Pa
rms_slope = surface.moments.rms_slope
pressure = relative_pressure * contact_modulus * rms_slope

# 3. Press. If the solver did not converge, its numbers must not be used.
state = salebra.press(surface, contact_modulus, pressure=pressure)
if not state.converged:
    sys.exit(f"not converged: residual {state.residual:.1e} after {state.iterations} iterations")
persson = salebra.persson_area_fraction(pressure, contact_modulus, rms_slope)
bgt = salebra.bgt_area_fraction(pressure, contact_modulus, rms_slope)
print("pressure             ", format_quantity(pressure, "pressure"))
print("mean gap             ", format_quantity(state.mean_gap, "mean_gap"))
print("elastic energy       ", format_quantity(state.elastic_energy, "elastic_energy"))
print(f"contact area fraction {state.contact_area_fraction:.4f}, Persson {persson:.4f}, Bush–Gibson–Thomas {bgt:.4f}")
print(f"solver                {state.iterations} iterations, residual {state.residual:.1e}")

# 4. The fields are NumPy arrays [ix, iy]. They are views, so nothing is copied.
print(f"largest pressure      {format_quantity(state.contact_pressure.max(), 'pressure')}")

# 5. Pressing to the mean gap of this contact must give the same pressure.
back = salebra.press(surface, contact_modulus, mean_gap=state.mean_gap)
print(f"pressure from that mean gap / pressure = {back.mean_pressure / pressure:.7f}")
sys.exit(0 if back.converged else 1)
