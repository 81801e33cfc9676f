# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # The surface for a number
# A study answers which damping constant a roughness has. Here the question is turned: which waves of the surface decide, and which roughness has
# a wanted damping constant?

# %%
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import salebra

folder = Path(tempfile.mkdtemp())
(folder / "pads.toml").write_text("""
[surface]
points = 64
size_x = "400um"
hurst = 0.8
rolloff = "25um"
short_cutoff = "12.5um"
rms_height = "200nm"
seeds = [1, 2, 3, 4, 5, 6, 7, 8]
[material]
contact_modulus = "115GPa"
poisson = 0.3
[contact]
pressures = "50MPa:200MPa:4"
[damping]
normal_amplitude = "5nm"
drag_velocity = "1um/s"
frequency = "10kHz"
""")

# %% [markdown]
# ## What decides
# The response $d\ln\gamma/d\ln\theta$ to the rms height, and to the amplitudes of each octave of wavelengths, with the 95 % intervals of eight
# surfaces.

# %%
found = salebra.study_sensitivity(salebra.read_study_configuration(folder / "pads.toml"))
to_height = found.find("rms_height", "damping_constant")[-1]
print(f"d ln γ/d ln h_rms = {to_height.mean:.2f} ({to_height.low:.2f} to {to_height.high:.2f})")
print(found.sentence("damping_constant", len(found.pressures) - 1))
bands = [one for one in found.parameters if one.parameter == "waves"]
of_band = [next(out for out in band.outputs if out.output == "damping_constant").at_pressures[-1] for band in bands]

# %% [markdown]
# ## The roughness for a damping constant
# The target is 50 N s/m within 30 % around a force of 20 N; the rms height is free.

# %%
(folder / "damper.toml").write_text("""
study = "pads.toml"
[target]
output = "damping_constant"
value = "50N s/m"
tolerance = "30%"
force = ["18N", "22N"]
[free]
rms_height = ["50nm", "1um"]
""")
design = salebra.design(folder / "damper.toml")
if not design.met:
    sys.exit(1)
height = design.parameters[0]
print(f"h_rms = {height.value * 1e9:.0f} nm after {design.studies} studies; largest deviation {100 * design.deviation:.0f} %")
for point in design.points:
    one = point.surface
    print(f"{point.force:.1f} N: {point.output.mean:.1f} N s/m, one more surface {one.low:.1f} to {one.high:.1f}")

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
means = np.array([one.mean for one in of_band])
errors = np.array([[one.mean - one.low, one.high - one.mean] for one in of_band]).T
axes.bar([f"to {band.longest * 1e6:.0f} µm" for band in bands], means, yerr=errors, capsize=3)
axes.axhline(0, color="grey", linewidth=0.8)
axes.set(ylabel="d ln γ/d ln amplitude", title="Which waves decide on the damping")
plt.show()
