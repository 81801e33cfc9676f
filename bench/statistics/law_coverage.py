# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the 95 % limits of the self-affine law of one map hold the truth, with and without a lay.

    law_coverage.py [first seed [end of seeds]] [--isotropic]

Maps are patches of Gaussian fields by numpy, with an elliptic or isotropic spectrum and waves longer than
the patch; half of them are blurred by a lens, half have noise. The page docs/statistics.md has the counts
of seeds 300 to 399 and 500 to 599, and of 420 to 499 with --isotropic.
"""

import argparse
import math

import numpy as np

import salebra
from lay_coverage import Maker, random_law


def laws_of(seed, isotropic):
    """The fitted laws with their truths, by name: (interval, truth in SI units); empty if no lay was found."""
    rng = np.random.default_rng([seed, 77])
    stretch = 1.0 if isotropic else math.exp(rng.uniform(math.log(2), math.log(10)))
    side = math.exp(rng.uniform(math.log(60), math.log(600)))
    law = random_law(rng, stretch)
    maker, points = Maker(rng, [law], None), int(rng.choice([256, 384, 512]))
    blur = 0.0 if rng.uniform() < 0.5 else side / points * rng.uniform(1, 2)
    heights = maker.patch(points, side, blur)
    noise = 0 if rng.uniform() < 0.5 else 1e-3
    heights = heights + noise * rng.standard_normal(heights.shape)
    surface = salebra.detrended(salebra.Surface(np.ascontiguousarray(heights) * 1e-6, side * 1e-6, side * 1e-6), "plane")
    spectrum = salebra.power_spectrum(surface, "hann")
    if isotropic:
        fits = {"": (salebra.fit_self_affine(spectrum), 1.0)}
    else:
        lay = salebra.surface_lay(surface)
        if not lay.has_lay:
            return {}
        both = salebra.fit_self_affine(spectrum, lay)
        fits = {" across": (both.across, 1.0), " along": (both.along, stretch)}
    found = {}
    for way, (fit, factor) in fits.items():
        found["H" + way] = fit.hurst, law.hurst
        found["roll-off" + way] = fit.rolloff, law.rolloff * factor * 1e-6
        found["cut-off" + way] = fit.short_cutoff, law.short_cutoff * factor * 1e-6
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("seeds", nargs="*", type=int, default=[300, 400])
    parser.add_argument("--isotropic", action="store_true")
    arguments = parser.parse_args()
    first, end = arguments.seeds
    tally = {}
    for seed in range(first, end):
        for name, (interval, truth) in laws_of(seed, arguments.isotropic).items():
            given = not math.isnan(interval.value)
            tally.setdefault(name, []).append((given, given and interval.low <= truth <= interval.high))
    for name, results in tally.items():
        print(f"{name:16} {sum(held for _, held in results):3d} of {sum(given for given, _ in results)} given hold, {len(results)} maps")


if __name__ == "__main__":
    main()
