# SPDX-License-Identifier: GPL-3.0-or-later
"""The same adhesive contact by salebra and by Tamaas at equal mean gap, in one run: processor time of one thread, the energy of each gap by one
formula, and how many cells are in contact for one of them alone.

usage: adhesive_peers.py PROGRAM [POINTS …]      PROGRAM: salebra; needs numpy, h5py and tamaas

The case of docs/performance.md: H = 0.8, h' = 1, cut-off 16 cells, roll-off a quarter of the side, w = 0.32 E* times the cell, range 1.33
cells, exponential potential. salebra answers for p = 0.01 E*, then at the mean gap that it found, exactly and at its usual tolerance, and
Tamaas's bounded conjugate gradient with its exponential functional there, at the loosest tolerance whose energy is as exact.
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"

import h5py  # noqa: E402
import numpy as np  # noqa: E402

WORK, RANGE = 0.32, 1.33  # over E* times the cell, and the cell; the cell and E* are 1


def salebra(program, folder, heights, *position):
    """Answer, gap and processor seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        [program, "contact", heights, "--contact-modulus", "1", "--work-of-adhesion", str(WORK), "--adhesion-range", str(RANGE), "--detrend", "mean",
         "--threads", "1", "--quiet", "--json", "-o", "out.h5", "--overwrite", *position], cwd=folder, capture_output=True, text=True, check=True)  # fmt: skip
    with h5py.File(folder / "out.h5") as file:
        gap = np.array(file["contact/gap"])
    return json.loads(done.stdout), gap, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def tamaas(heights, mean_gap, tolerance):
    """Gap and processor seconds."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    n = heights.shape[0]
    model = tm.Model(tm.model_type.basic_2d, [n, n], [n, n])
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, heights, tolerance, tm.PolonskyKeerRey.gap, tm.PolonskyKeerRey.gap)
    solver.max_iter, solver.dump_freq = 2_000, 1_000_000
    adhesion = tm.ExponentialAdhesionFunctional(heights)
    adhesion.parameters = {"rho": RANGE, "surface_energy": WORK}
    solver.addFunctionalTerm(adhesion)
    begin = time.process_time()
    solver.solve(mean_gap)
    seconds = time.process_time() - begin
    return np.array(model["gap"] if "gap" in model else model.displacement - heights), seconds


def energy(heights, gap):
    """Elastic, (E*/4) sum of q |u_q|^2, and adhesive, over the cells, of a gap."""
    n = heights.shape[0]
    modes = np.fft.rfft2(gap + heights) / n**2
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None, :])
    twice = np.where((np.arange(n // 2 + 1) == 0) | (np.arange(n // 2 + 1) == n / 2), 1, 2)
    return np.sum(q / 4 * np.abs(modes) ** 2 * twice) - WORK * np.mean(np.exp(-gap / RANGE))


def main(program, *sizes):
    program = Path(program).resolve()
    print("points,salebra s,error of its energy,tamaas s,tolerance,difference of the energies,cells in contact,of one of them alone")
    for n in map(int, sizes or ("256", "512")):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            subprocess.run(
                [program, "generate", "--points", str(n), "--size-x", str(n), "--hurst", "0.8", "--rolloff", str(n / 4), "--short-cutoff", "16",
                 "--rms-slope", "1", "--method", "random-phase", "-o", "s.npy", "--quiet"], cwd=folder, check=True, capture_output=True)  # fmt: skip
            heights = np.load(folder / "s.npy")
            heights -= heights.mean()
            answer, _, _ = salebra(program, folder, "s.npy", "--pressure", "0.01")
            position = ("--mean-gap", repr(answer["mean_gap"]))
            _, gap, _ = salebra(program, folder, "s.npy", *position, "--tolerance", "1e-9")
            exact, touching = energy(heights, gap), gap <= 1e-9
            _, loose, seconds = salebra(program, folder, "s.npy", *position)
            error = abs(energy(heights, loose) / exact - 1)
            # The loosest of its own tolerances that is as exact.
            for tolerance in 10.0 ** -np.arange(0, 13):
                other, other_seconds = tamaas(heights, answer["mean_gap"], tolerance)
                other -= other.min()
                difference = abs(energy(heights, other) / exact - 1)
                if difference <= max(error, 1e-9):
                    break
            print(f"{n},{seconds:.2f},{error:.1e},{other_seconds:.2f},{tolerance:.0e},{difference:.1e},{touching.sum()},"
                  f"{(touching != (other <= 1e-9)).sum()}", flush=True)  # fmt: skip


main(*sys.argv[1:])
