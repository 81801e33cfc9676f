# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # The damping curve of a measured surface
# An atomic-force scan of 256 × 256 points on 10 µm is pressed on steel and oscillates by 1 nm at 20 kHz, while it is sheared slowly.
# Run `python examples/10_damping_of_scan.py` in the root of the tree, or add the name of your own file.

# %%
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

scan = sys.argv[1] if len(sys.argv) == 2 else "data/surfaces/afm-scan.txt"
surface = salebra.read_surface(scan).detrended()
material = salebra.Material("115GPa", poisson=0.3)
motion = salebra.Drag(normal_amplitude=1e-9, drag_velocity=1e-6, angular_frequency=2 * math.pi * 20e3)

# %% [markdown]
# ## Force over mean gap
# Eight loads, from a few contact spots to a tenth of $E^*h'$ ($h'$: rms slope). Is the force an exponential of the mean gap?

# %%
pressures = material.contact_modulus * surface.moments.rms_slope * np.geomspace(5e-3, 0.1, 8)
curve = salebra.sweep_pressures(surface, material, pressures)
fit = salebra.fit_exponential(curve)
test = salebra.test_exponential(curve)
print(
    f"decay length {fit.decay_length * 1e9:.1f} nm; local {test.decay_length_at_min_gap * 1e9:.0f} nm (smallest gap) "
    f"to {test.decay_length_at_max_gap * 1e9:.0f} nm (largest gap)"
)

# %% [markdown]
# ## Damping constant at each load
# Each value is computed from contacts that are solved inside the oscillation, and has an error. Eq. (16) uses the fitted decay length instead.

# %%
damping = salebra.surface_damping(surface, material, motion, curve)
print("force, mN   computed, N s/m   error   Eq. (16), N s/m")
eq16 = []
for force, one in zip(curve.force, damping):
    work = salebra.closed_form.work_per_cycle_rough(material.modulus_ratio, force, fit.decay_length, motion)
    eq16.append(salebra.closed_form.damping_constant(work, motion))
    error = one.damping_constant_error / one.damping_constant
    print(f"{1e3 * force:9.3f} {one.damping_constant:17.3g} {100 * error:6.0f}% {eq16[-1]:17.3g}")
if not all(one.converged for one in damping):
    sys.exit(1)
print(f"at the highest load Eq. (16) gives {eq16[-1] / damping[-1].damping_constant:.2f} of the damping computed")

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
values = [one.damping_constant for one in damping]
axes.errorbar(curve.force, values, [one.damping_constant_error for one in damping], fmt="o", label="computed, with error")
axes.plot(curve.force, eq16, label="Eq. (16)")
axes.set(xscale="log", yscale="log", xlabel="normal force, N", ylabel="damping constant γ, N s/m", title="An AFM scan on steel")
axes.legend()
plt.show()
