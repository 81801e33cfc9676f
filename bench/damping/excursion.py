# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/images/excursion.png: the damping constant over the excursion, from relaxation to sliding. Run it in docs/images; it takes a minute."""

import matplotlib.pyplot as plt
import numpy as np
import salebra

spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff="100um", short_cutoff="25um", rms_height="100nm")
surface = salebra.filtered_noise(salebra.Grid2D(256, 256, "800um", "800um"), spectrum, seed=1)
steel = salebra.Material("115GPa", poisson=0.3)
curve = salebra.sweep_pressures(surface, steel, np.geomspace(10e6, 40e6, 5))
motion = salebra.Drag(normal_amplitude=5e-9, drag_velocity=1e-6, angular_frequency=2 * np.pi * 20e3)
excursions = np.geomspace(0.1e-9, 500e-9, 24)

figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6, 6), layout="constrained")
for friction in (0.1, 0.3):
    found = [salebra.surface_damping(surface, steel, motion, curve, friction_coefficient=friction, excursion=x)[2] for x in excursions]
    above.errorbar(
        excursions * 1e9, [one.damping_constant for one in found], [one.damping_constant_error for one in found],
        marker=".", label=f"μ = {friction}",
    )  # fmt: skip
    below.semilogx(excursions * 1e9, [100 * one.slip_share for one in found], marker=".", label=f"slip, μ = {friction}")
above.axhline(found[0].damping_constant_without_slip, linestyle="--", color="grey", label="without slip")
above.set(xscale="log", yscale="log", ylabel="damping constant γ, N s/m")
below.set(xlabel="excursion X, nm", ylabel="dissipated by slip, %")
above.legend()
below.legend()
figure.savefig("excursion.png", dpi=100)
