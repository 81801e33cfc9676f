# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A huge surface
# `python examples/14_huge_surface.py 16384` makes and presses 268 million points in one process: the contact has three decades of wavelengths. The default is small.

# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

n = int(sys.argv[1]) if len(sys.argv) == 2 else 256

# %% [markdown]
# ## Forecast of the memory

# %%
size = 1e-3  # m
grid = salebra.Grid2D(n, n, size, size)
spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=size / 8, short_cutoff=8 * size / n, rms_height=1e-6)
forecast = salebra.forecast(grid, spectrum)
print(f"{n} x {n} points: {forecast.memory / 2**20:.0f} MiB to make them, about {60 * n * n / 2**20:.0f} MiB to press them")

# %%
surface = salebra.filtered_noise(grid, spectrum, 1)
material = salebra.Material("1GPa", poisson=0.3)
contact = salebra.press(surface, material, pressure=0.02 * material.contact_modulus * surface.moments.rms_slope)
if not contact.converged:
    sys.exit(1)
spots = salebra.contact_spots(contact)
print(f"{100 * contact.contact_area_fraction:.1f} % of the area touches, {contact.iterations} iterations")

# %% [markdown]
# ## A picture that fits a screen
# The picture shows mean pressures of square blocks of cells.

# %%
block = max(1, n // 256)
pressure = np.asarray(contact.contact_pressure)[: n // block * block, : n // block * block]
means = pressure.reshape(n // block, block, n // block, block).mean(axis=(1, 3))
figure, axes = plt.subplots(figsize=(4.5, 3.8), layout="constrained")
image = axes.imshow(means.T, origin="lower", extent=(0, 1, 0, 1), cmap="magma", vmax=np.quantile(means[means > 0], 0.98))
axes.set(xlabel="x, mm", ylabel="y, mm", title=f"Contact pressure, {n} x {n} points")
figure.colorbar(image, label="Pa")
plt.show()
