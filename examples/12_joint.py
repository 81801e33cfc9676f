# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A joint: loop of force and displacement, and the energy lost
# A rough joint under a constant normal force carries a tangential force that oscillates. Parts of it slip long before all of it slides.

# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import salebra

friction_coefficient, force, decay_length = 0.3, 1.0, 100e-9  # –, N, m
ratio = salebra.Material("115GPa", poisson=0.3).modulus_ratio
law = salebra.ExponentialLaw(force, decay_length, ratio)
sliding_force = friction_coefficient * force

# %% [markdown]
# ## Loss over the tangential force
# `joint_loss` computes a quadrature. It is compared with the closed form of the exponential law (page *Theory: friction*, *Joints*):
# $W = \frac{8\mu^2}{g}lF\left[-(1-\frac q2)\ln(1-q)-q\right]$ with $q = T/\mu F$ and $g = G^*/E^*$.

# %%
shares = np.geomspace(0.02, 0.98, 25)
losses = [salebra.joint_loss(law, friction_coefficient=friction_coefficient, tangential_force=q * sliding_force, force=force) for q in shares]
if not all(loss.converged for loss in losses):
    sys.exit(1)
work = np.array([loss.work_per_cycle for loss in losses])
closed_form = 8 * friction_coefficient**2 / ratio * decay_length * force * (-(1 - shares / 2) * np.log1p(-shares) - shares)
print(f"quadrature and closed form differ by {np.max(np.abs(work / closed_form - 1)):.1e} at most")
print(f"d ln W/d ln T rises from {losses[0].exponent:.2f} to {losses[-1].exponent:.2f}")

# %% [markdown]
# ## The loop
# `TangentialContact` follows any path. Here the displacement oscillates for two cycles at the indentation of the load.

# %%
amplitude = losses[-4].tangential_amplitude
contact = salebra.TangentialContact(law, 0.0, 0.0, friction_coefficient=friction_coefficient, tangential_range=2 * amplitude)
path = amplitude * np.sin(np.linspace(0, 4 * np.pi, 401))
contact.start(0.0, 0.0)
loop, lost = [], []
for x in path:
    contact.move_to(0.0, float(x))
    loop.append(contact.tangential_force)
    lost.append(contact.dissipated)
print(f"the second cycle of the loop loses {(lost[-1] - lost[200]) / losses[-4].work_per_cycle:.4f} of the quadrature")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.5), layout="constrained")
left.plot(path * 1e9, loop)
left.set(xlabel="displacement, nm", ylabel="tangential force, N", title="Loop")
right.loglog(shares * sliding_force, work)
right.set(xlabel="tangential force T, N", ylabel="loss in a cycle W, J", title="W(T)")
plt.show()
