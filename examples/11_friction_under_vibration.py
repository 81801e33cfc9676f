# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # Friction under vibration
# A contact slides at constant velocity and oscillates in the normal direction. At low velocity its mean friction is lower than Coulomb's.

# %%
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

friction_coefficient, force, frequency = 0.3, 1.0, 20e3  # –, N, Hz
law = salebra.ExponentialLaw(force, 100e-9, salebra.Material("115GPa", poisson=0.3).modulus_ratio)

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
for amplitude in (5e-9, 20e-9, 50e-9):
    mean_friction, critical_velocity = [], 0.0
    velocities = np.geomspace(1e-6, 1e-2, 33)
    for velocity in velocities:
        motion = salebra.Drag(normal_amplitude=amplitude, drag_velocity=velocity, angular_frequency=2 * math.pi * frequency)
        sliding = salebra.steady_sliding(law, motion, friction_coefficient=friction_coefficient, indentation=0.0)
        if not sliding.converged:
            sys.exit(1)
        mean_friction.append(sliding.friction_coefficient)
        critical_velocity = sliding.critical_velocity
    axes.plot(velocities, mean_friction, label=f"u_z = {amplitude * 1e9:.0f} nm")
    axes.axvline(critical_velocity, color="grey", linewidth=0.5)
    print(
        f"u_z = {amplitude * 1e9:2.0f} nm: friction {mean_friction[0]:.3f} at 1 µm/s, {mean_friction[-1]:.3f} at 10 mm/s, "
        f"critical velocity {critical_velocity * 1e3:.2f} mm/s"
    )

# %% [markdown]
# From the critical velocity on (grey lines) nothing sticks, and friction is Coulomb's.

# %%
axes.set(xscale="log", xlabel="sliding velocity, m/s", ylabel="mean friction coefficient", title="Vibration lowers friction")
axes.legend()
plt.show()
