# SPDX-License-Identifier: GPL-3.0-or-later
"""05_measured_surface: presses a measured surface, computes force against mean gap, and checks whether the curve has one decay length.

Sample runs:  05_measured_surface.py data/surfaces/afm-scan.txt        05_measured_surface.py scan.x3p 70e9
"""

import sys

import numpy as np

import salebra
from salebra import format_quantity

if len(sys.argv) < 2:
    sys.exit("usage: 05_measured_surface.py FILE [CONTACT_MODULUS]")
contact_modulus = float(sys.argv[2]) if len(sys.argv) > 2 else 115e9  # Pa

# 1. Read the heights from any format and subtract the tilt of the stage.
raw = salebra.read_surface(sys.argv[1])
surface = raw.detrended(salebra.default_detrend(raw))
moments = surface.moments
print(
    f"{surface.nx} x {surface.ny} points, {format_quantity(surface.size_x, 'size_x')} x {format_quantity(surface.size_y, 'size_y')}, "
    f"rms height {format_quantity(moments.rms_height, 'rms_height')}, rms slope {moments.rms_slope:.4f}"
)

# 2. Press at sixteen loads, from the contact of a few summits to a fifth of full contact, E*h'. The scan is continued periodically.
pressures = contact_modulus * moments.rms_slope * np.geomspace(5e-4, 0.2, 16)
curve = salebra.sweep_pressures(surface, salebra.Material(contact_modulus), pressures, stiffness=False)
print(f"{'pressure':>12} {'mean gap':>12} {'area':>10}")
for pressure, mean_gap, area in zip(curve.pressure, curve.mean_gap, curve.contact_area_fraction):
    print(f"{format_quantity(pressure, 'pressure'):>12} {format_quantity(mean_gap, 'mean_gap'):>12} {100 * area:8.2f} %")

# 3. Fit the exponential law and test it. If it does not hold, use the curve itself, as in example 04.
fit = salebra.fit_exponential(curve)
test = salebra.test_exponential(curve)
parts = salebra.window_sensitivity(curve)
low, high = (format_quantity(value, "decay_length") for value in (parts.decay_length_min, parts.decay_length_max))
print(f"decay length {format_quantity(fit.decay_length, 'decay_length')}; parts of the window give {low} … {high}")
closest, farthest = (
    format_quantity(value, "decay_length") for value in (test.decay_length_at_min_gap, test.decay_length_at_max_gap)
)
print(f"over the window l runs from {closest} (smallest gap) to {farthest} (largest gap)")
