# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A law of your own
# This example computes damping from your data: from the profile of an indenter, and from a measured force–indentation curve. Both give a contact law, and a law is all that the damping functions need.

# %%
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

material = salebra.Material("1GPa", poisson=0.3)
motion = salebra.Drag(normal_amplitude=50e-9, drag_velocity=1e-6, angular_frequency=2 * math.pi * 20e3)
force = 0.05  # N

# %% [markdown]
# ## An indenter from its profile
# The table lists heights over the radius, here of a ball of 1 mm with a worn cap; a profilometer gives such a table. The method of dimensionality reduction solves the contact exactly, so the only error is
# the error of the table.

# %%
radii = np.linspace(0, 100e-6, 41)
heights = np.where(radii < 30e-6, 0.5 * radii**2, radii**2 - 0.5 * 30e-6**2) / 2e-3
indenter = salebra.IndenterLaw(salebra.TabulatedProfile(radii, heights), material)
worn = salebra.relaxation_damping(indenter, motion, force=force)
ball = salebra.relaxation_damping(salebra.IndenterLaw(salebra.paraboloid_profile(1e-3), material), motion, force=force)
print(f"damping constant {worn.damping_constant:.4g} N s/m of the worn ball, {ball.damping_constant:.4g} N s/m of a new one")

# %% [markdown]
# ## A curve from a load cell
# The curve gives force over indentation. Here it is computed from the new ball, so the result is known. The curve needs at least four samples around the range of the oscillation.

# %%
depth = np.geomspace(0.3e-6, 6e-6, 40)
forces = np.asarray(salebra.IndenterLaw(salebra.paraboloid_profile(1e-3), material).force(depth))
curve = salebra.ForceCurve(1e-6, indentation=depth, force=forces)
law = salebra.TabulatedLaw(curve, material.modulus_ratio)
measured = salebra.relaxation_damping(law, motion, force=force)
print(f"from the curve {measured.damping_constant / ball.damping_constant:.3f} of that of the ball")

# %% [markdown]
# ## Which assumptions does the result need?

# %%
parameters = salebra.ContactParameters(friction_coefficient=0.3, hardness=1e9, density=1200, excursion=1e-9)
judged = salebra.relaxation_damping(indenter, motion, force=force, parameters=parameters)
print(judged.assumptions.validity)
for one in judged.assumptions.verdicts():
    print(one.verdict, one.assumption, one.here, one.remedy, sep="; ")
if not (worn.converged and ball.converged and measured.converged):
    sys.exit(1)

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.5), layout="constrained")
left.plot(radii * 1e6, heights * 1e6)
left.set(xlabel="radius, µm", ylabel="height, µm", title="Profile")
right.loglog(depth * 1e6, forces, label="new ball")
right.loglog(depth * 1e6, indenter.force(depth), label="worn ball")
right.set(xlim=(0.1, 10), xlabel="indentation, µm", ylabel="force, N", title="Law")
right.legend()
plt.show()
