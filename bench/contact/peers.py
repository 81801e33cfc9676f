# SPDX-License-Identifier: GPL-3.0-or-later
"""Solve one contact with one of the peers and print what it cost as one JSON object.

usage: peers.py SOLVER HEIGHTS.npy PRESSURE TOLERANCE BOUNDARY PRESSURE_OUT.npy

HEIGHTS.npy   float64 (n, n), side 1; E* = 1; a hill is positive
PRESSURE      nominal pressure over E*
TOLERANCE     in the solver's own measure, lengths over the rms height, forces over the load; compare.py finds the one that counts
BOUNDARY      periodic (one period) or free (one patch on an infinite half-space)
Set-up and solution are timed apart, both without import and file access; memory is the growth of the process's peak.
"""

import importlib.util
import json
import os
import re
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np


@contextmanager
def errors_to(file):
    """Libraries that log from C++ write to the descriptor, not to sys.stderr."""
    saved = os.dup(2)
    os.dup2(file.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


def tamaas(heights, pressure, tolerance, boundary):
    import tamaas as tm

    yield
    tm.set_log_level(tm.LogLevel.info)  # its only word on iterations is the last line of the log
    n = heights.shape[0]
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, heights, tolerance)
    if boundary == "free":
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    solver.max_iter = 100_000
    solver.dump_freq = 1_000_000
    yield
    with tempfile.TemporaryFile("w+") as log:
        with errors_to(log):
            solver.solve(pressure)
        log.seek(0)
        iterations = re.findall(r"^\s+(\d+)\s+[-+.\de]+\s+[-+.\de]+\s*$", log.read(), re.MULTILINE)
    yield np.array(model.traction), 2 * int(iterations[-1]) if iterations else None


def contact_mechanics_system(heights, boundary):
    """System and the number of transforms it has made."""
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    periodic = boundary == "periodic"
    half_space = PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace
    substrate = half_space(heights.shape, 1.0, (1.0, 1.0))
    pairs = [0]

    def counted(method):
        def call(*arguments, **options):
            pairs[0] += 1
            return method(*arguments, **options)
        return call

    substrate.evaluate_disp = counted(substrate.evaluate_disp)
    system = make_system(substrate=substrate, surface=Topography(heights, (1.0, 1.0), periodic=periodic))
    return system, pairs


def contact_mechanics(heights, pressure, tolerance, boundary):
    """ContactMechanics as it comes: Polonsky-Keer with restarts."""
    import ContactMechanics  # noqa: F401  (imported before the clock starts)

    yield
    system, pairs = contact_mechanics_system(heights, boundary)
    yield
    result = system.minimize_proxy(external_force=pressure, pentol=tolerance * heights.std(),
                                   forcetol=tolerance * pressure / heights.size,
                                   thermotol=tolerance, maxiter=100_000)
    if not result.success:
        raise RuntimeError("not converged: " + str(result.message))
    yield np.asarray(result.jac).reshape(heights.shape) * heights.size, pairs[0]


def earlier_numpi():
    """The release of NuMPI in the folder EARLIER_NUMPI, under another name.

    Later ones (0.12 to 0.18.1 were looked at) meet the mean pressure by a bisection of 60 passes in each iteration, which takes most
    of the time, and in a bracket of absolute size, so that high loads stall at e_c = 1e-7. 0.7.3 scales once.
    """
    spec = importlib.util.spec_from_file_location(
        "NuMPI_earlier", Path(os.environ["EARLIER_NUMPI"]) / "NuMPI" / "__init__.py")
    sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules[spec.name])
    return importlib.import_module("NuMPI_earlier.Optimization.CCGWithoutRestart")


def contact_mechanics_dual(heights, pressure, tolerance, boundary):
    """Bugnicourt's dual conjugate gradients without restart, at given mean pressure."""
    import ContactMechanics  # noqa: F401

    solver = earlier_numpi().constrained_conjugate_gradients
    yield
    system, pairs = contact_mechanics_system(heights, boundary)
    start = np.full(heights.shape, pressure / heights.size)
    system.init_force = start
    yield
    result = solver(
        system.dual_objective(0.0, gradient=True), system.dual_hessian_product, x0=start,
        mean_val=pressure / heights.size, gtol=tolerance * heights.std(), maxiter=20_000)
    if not result.success:
        raise RuntimeError("not converged: " + str(result.message))
    yield np.asarray(result.x).reshape(heights.shape) * heights.size, pairs[0]


def slippy(heights, pressure, tolerance, boundary):
    import slippy as package

    package.CUDA = False
    from slippy.core import elastic_influence_matrix_spatial
    from slippy.core.influence_matrix_utils import plan_convolve, polonsky_and_keer

    yield
    n = heights.shape[0]
    start = np.ones(heights.shape)
    if boundary == "periodic":
        wave = 2 * np.pi * np.fft.fftfreq(n, 1 / n)
        with np.errstate(divide="ignore"):
            symbol = 2 / np.hypot(wave[:, None], wave[None, :])
        symbol[0, 0] = 0
        convolve = plan_convolve(start, symbol, circular=True, fft_im=True)
    else:
        # G = 1/2 and nu = 0 give E* = 1.
        response = elastic_influence_matrix_spatial("zz", (2 * n, 2 * n), (1 / n, 1 / n), 0.5, 0.0)
        convolve = plan_convolve(start, response, circular=False, fft_im=False)
    pairs = [0]

    def counted(loads):
        pairs[0] += 1
        return convolve(loads)

    yield
    failed, traction, _ = polonsky_and_keer(counted, start, heights.max() - heights, pressure, 1 / n,
                                            eps_0=tolerance, max_it=100_000)
    if failed:
        raise RuntimeError("slippy did not converge")
    yield traction, pairs[0]


def aspher(heights, pressure, tolerance, boundary):
    import aspher as package

    yield
    yield  # its one call contains the set-up
    result = package.solve_nested(
        grid_size=heights.shape[0], gap=-heights.ravel(), p_nominal=pressure, tol=tolerance,
        backend="periodic" if boundary == "periodic" else "fft", precision="float_then_double", max_iter=100_000)
    if not result.converged:
        raise RuntimeError("not converged")
    yield np.asarray(result.pressure), None


def peak_bytes():
    """Largest resident memory. Not getrusage's: that one begins with the size of the process which started this one."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return 1024 * int(line.split()[1])
    return 0


SOLVERS = {solver.__name__: solver
           for solver in (tamaas, contact_mechanics, contact_mechanics_dual, slippy, aspher)}


def main():
    name, heights_file, pressure, tolerance, boundary, out = sys.argv[1:]
    heights = np.ascontiguousarray(np.load(heights_file))
    stages = SOLVERS[name](heights, float(pressure), float(tolerance), boundary)
    next(stages)  # imports
    before = peak_bytes()
    wall, cpu = time.perf_counter(), time.process_time()
    next(stages)
    setup = time.perf_counter() - wall
    traction, pairs = next(stages)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    peak = peak_bytes()
    np.save(out, traction)
    print(json.dumps({"wall": wall, "setup": setup, "cpu": cpu, "bytes": peak - before,
                      "pairs": pairs}))


if __name__ == "__main__":
    main()
