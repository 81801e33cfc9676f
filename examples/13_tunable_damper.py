# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A tunable damper
# A mass on a spring touches a rough contact, which oscillates in the normal direction. The amplitude of that oscillation sets the damping.

# %%
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

law = salebra.ExponentialLaw(1.0, 100e-9, salebra.Material("115GPa", poisson=0.3).modulus_ratio)
mass, spring_stiffness, angular_frequency = 1.0, 1e3, 2 * math.pi * 20e3  # kg, N/m, rad/s

# %%
amplitudes = np.geomspace(1e-9, 100e-9, 25)
ratios = {}
for hold in ("indentation", "force"):
    decays = [
        salebra.oscillator_decay(
            law, normal_amplitude=amplitude, angular_frequency=angular_frequency, mass=mass, spring_stiffness=spring_stiffness, force=1.0, hold=hold
        )
        for amplitude in amplitudes
    ]
    ratios[hold] = np.array([one.damping_ratio for one in decays])
if not all(np.all(np.isfinite(one)) for one in ratios.values()):
    sys.exit(1)
small = ratios["force"][0] / amplitudes[0] * amplitudes
print(f"damping ratio {ratios['force'][0]:.2e} at 1 nm, {ratios['force'][-1]:.2e} at 100 nm")
print(f"proportional to the amplitude within {100 * np.max(np.abs(ratios['force'][:10] / small[:10] - 1)):.1f} % up to {amplitudes[9] * 1e9:.1f} nm")

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
axes.loglog(amplitudes, ratios["indentation"], label="mean indentation held")
axes.loglog(amplitudes, ratios["force"], label="mean force held (dead weight)")
axes.loglog(amplitudes, small, ":", color="grey", label="proportional to u_z")
axes.set(xlabel="normal amplitude u_z, m", ylabel="damping ratio", title="Damping set by an amplitude")
axes.legend()
plt.show()
