# SPDX-License-Identifier: GPL-3.0-or-later
"""solve.py CONTACT_SOLVE [N [REPEATS [THREADS]]]: what a contact costs from Python beside the same call from C++.

CONTACT_SOLVE is the benchmark program contact_solve (-D SALEBRA_BUILD_BENCH=ON). One surface of N x N points (4096) is pressed in turn by
both; the least wall and processor times of REPEATS (5) runs are compared, since what else the machine does only adds to them. A Python
thread counts meanwhile, in further runs, to show what is left to others.
"""

import json
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np

import salebra

program = sys.argv[1]
n = int(sys.argv[2]) if len(sys.argv) > 2 else 4096
repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 5
threads = int(sys.argv[4]) if len(sys.argv) > 4 else 1
tolerance = 1e-8

grid = salebra.Grid2D(n, n, 1.0, 1.0)
spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=1 / 8, short_cutoff=8 / n, rms_slope=0.1)
surface = salebra.exact_rms(grid, spectrum, 1, "slope")
pressure = 0.02 * 0.1  # p/(E* h') = 0.02
salebra.set_threads(threads)


def by_python() -> tuple[float, float]:
    wall, cpu = time.perf_counter(), time.process_time()
    state = salebra.press(surface, 1.0, pressure=pressure, tolerance=tolerance)
    spent = time.perf_counter() - wall, time.process_time() - cpu
    assert state.converged
    return spent


def by_cpp(heights: str, out: str) -> tuple[float, float]:
    command = [program, heights, str(n), repr(pressure), repr(tolerance), str(threads), out]
    told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert told["converged"]
    return told["wall"], told["cpu"]


with tempfile.TemporaryDirectory() as folder:
    surface.heights.tofile(f"{folder}/heights.raw")
    python, cpp = [], []
    for _ in range(repeats):
        python.append(by_python())
        cpp.append(by_cpp(f"{folder}/heights.raw", f"{folder}/out.raw"))
    same = np.array_equal(
        salebra.press(surface, 1.0, pressure=pressure, tolerance=tolerance).contact_pressure,
        np.fromfile(f"{folder}/out.raw").reshape(n, n),
    )

counted, stop = 0, threading.Event()


def count() -> None:
    global counted
    while not stop.wait(1e-3):
        counted += 1


counter = threading.Thread(target=count)
counter.start()
start, before = time.perf_counter(), counted
by_python()
during, seconds = counted - before, time.perf_counter() - start
stop.set()
counter.join()

for name, which in (("wall", 0), ("processor", 1)):
    one, other = min(run[which] for run in python), min(run[which] for run in cpp)
    print(f"{name:9} time: Python {one:.3f} s, C++ {other:.3f} s, {100 * (one / other - 1):+.1f} %")
print(f"pressures {'the same to the bit' if same else 'DIFFER'}")
print(f"a Python thread that wakes each millisecond counted to {during} in {seconds:.2f} s of a solve")
