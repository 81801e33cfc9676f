# SPDX-License-Identifier: GPL-3.0-or-later
"""roughness_pairs.py [PAIRS [SEED]]: the ensemble behind law_of_roughness(), docs/comparison.md, "Pairs of workshop surfaces".

Presses the sum of two surfaces: stretched by 1 to 8 along x, along y or at 0.5 rad, Hurst exponent 0.4 to 0.95, 6 to 16 roll-offs on a side, cut-off
6 cells, rms heights 1 to 1, 1 to 0.5 or 1 to 0.2, and heights cut off, exponential, bent or Weibull's with a skewness of -1.8 to 0.1. Prints, by
skewness of the sum and by load, the 2.5, 50 and 97.5 % quantiles of F/(K h) and of U/(F h) with the elastic energy U.
"""

import sys

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr

import salebra

PAIRS = int(sys.argv[1]) if len(sys.argv) > 1 else 900
rng = np.random.default_rng(int(sys.argv[2]) if len(sys.argv) > 2 else 21)
POINTS, MODULUS = 256, 115e9
LOADS = (5e-4, 2e-3, 8e-3, 3e-2, 0.1)
EDGES = (-2, -1.2, -0.9, -0.7, -0.5, -0.3, -0.1, 0.3)


def gaussian(hurst, rolloff, stretch, angle):
    """Filtered noise with an elliptic power law; rolloff in cells, across the lay."""
    k = np.fft.fftfreq(POINTS, 1 / POINTS)
    x, y = np.meshgrid(k, k, indexing="ij")
    along, across = np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x
    q = np.hypot(along * np.sqrt(stretch), across / np.sqrt(stretch))
    psd = np.where(q > 0, np.maximum(q, POINTS / rolloff), np.inf)**(-2 - 2 * hurst)
    psd[q > POINTS / 6] = 0
    heights = np.fft.ifft2(np.fft.fft2(rng.standard_normal((POINTS, POINTS))) * np.sqrt(psd)).real
    return heights / heights.std()


def shaped(z, kind, parameter, rest):
    """Monotone transform of Gaussian heights, with mean 0 and rms 1."""
    if kind == "cut":
        h = np.minimum(z, parameter) + rest * np.maximum(z - parameter, 0)
    elif kind == "exponential":
        h = -np.exp(-parameter * z)
    elif kind == "bent":
        h = np.where(z < 0, z, z * parameter)
    else:
        h = (-np.log1p(-np.clip(ndtr(z), 1e-12, 1 - 1e-12)))**(1 / parameter)
    h = h - h.mean()
    return h / h.std()


def skewness(h):
    return (h**3).mean()


BOUNDS = {"cut": (-1.2, 3.5), "exponential": (1e-4, 0.7), "bent": (0.05, 1), "weibull": (3.6, 60)}


def side():
    """Heights of one side, rms 1."""
    z = gaussian(rng.uniform(0.4, 0.95), POINTS / rng.uniform(6, 16), rng.choice([1, 2, 4, 8]), rng.choice([0, np.pi / 2, 0.5]))
    kind, rest = rng.choice(list(BOUNDS)), rng.choice([0.02, 0.05, 0.1, 0.2])
    wanted = rng.uniform(-1.8, 0.1)
    try:
        return shaped(z, kind, brentq(lambda p: skewness(shaped(z, kind, p, rest)) - wanted, *BOUNDS[kind], xtol=1e-3), rest)
    except ValueError:  # this kind does not reach the skewness
        return z


def elastic_energy(state):
    """U of the half-space under the pressures of a state, J."""
    pressure, grid = np.asarray(state.contact_pressure), state.grid
    k = 2 * np.pi * np.fft.fftfreq(POINTS, grid.lx / POINTS)
    q = np.hypot(*np.meshgrid(k, k))
    q[0, 0] = np.inf
    return (abs(np.fft.fft2(pressure) / pressure.size)**2 / (MODULUS * q)).sum() * grid.area


rows = []
for _ in range(PAIRS):
    h = side() + rng.choice([1, 1, 0.5, 0.2]) * side()
    h /= h.std()
    surface = salebra.Surface(1e-7 * h, size_x=256e-6, size_y=256e-6, periodic=True)
    for load in LOADS:
        pressure = load * MODULUS * surface.moments.rms_slope
        state = salebra.press(surface, MODULUS, pressure=pressure)
        force = pressure * surface.grid.area
        rows.append((skewness(h), load, force / salebra.contact.normal_stiffness(state) / 1e-7, elastic_energy(state) / force / 1e-7))

skew, loads, by_stiffness, by_energy = np.array(rows).T
print("skewness of the sum, p/(E*h'), pairs, F/(K h): 2.5 %, median, 97.5 %, U/(F h): 2.5 %, median, 97.5 %")
for low, high in [*zip(EDGES[:-1], EDGES[1:]), (-1.5, 0.3)]:
    for load in LOADS:
        these = (loads == load) & (skew >= low) & (skew < high)
        if these.sum() < 10:
            continue
        print(f"{low:5} … {high:4}  {load:6}  {these.sum():4}", *(f"{x:.3f}" for of in (by_stiffness, by_energy)
                                                                  for x in np.quantile(of[these], (0.025, 0.5, 0.975))))
