# SPDX-License-Identifier: GPL-3.0-or-later
"""Solve one periodic contact with one of the peers and print what it cost as one JSON object.

usage: peers.py SOLVER HEIGHTS.npy PRESSURE TOLERANCE PRESSURE_OUT.npy

HEIGHTS.npy   float64 (n, n), one period of side 1; E* = 1; a hill is positive
PRESSURE      nominal pressure over E*
TOLERANCE     in the solver's own measure, which compare.py calibrates
Time is taken around set-up and solution together, without import and file access; memory is the growth of the process's peak.
"""

import json
import resource
import sys
import time

import numpy as np


def tamaas(heights, pressure, tolerance):
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)

    def run():
        n = heights.shape[0]
        model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
        model.E, model.nu = 1.0, 0.0
        solver = tm.PolonskyKeerRey(model, heights, tolerance)
        solver.max_iter = 100_000
        solver.solve(pressure)
        return np.array(model.traction)

    return run


def contact_mechanics_system(heights):
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    substrate = PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0))
    return make_system(substrate=substrate, surface=Topography(heights, (1.0, 1.0), periodic=True))


def contact_mechanics(heights, pressure, tolerance):
    """ContactMechanics as it comes: Polonsky-Keer with restarts."""
    import ContactMechanics  # noqa: F401  (imported before the clock starts)

    def run():
        system = contact_mechanics_system(heights)
        result = system.minimize_proxy(external_force=pressure, pentol=tolerance, thermotol=tolerance,
                                       forcetol=tolerance, maxiter=100_000)
        return np.asarray(result.jac).reshape(heights.shape) * heights.size

    return run


def contact_mechanics_dual(heights, pressure, tolerance):
    """Bugnicourt's dual conjugate gradients without restart, at given mean pressure."""
    import ContactMechanics  # noqa: F401
    from NuMPI.Optimization.CCGWithoutRestart import constrained_conjugate_gradients

    def run():
        system = contact_mechanics_system(heights)
        start = np.full(heights.shape, pressure / heights.size)
        system.init_force = start
        result = constrained_conjugate_gradients(
            system.dual_objective(0.0, gradient=True), system.dual_hessian_product, x0=start,
            mean_val=pressure / heights.size, gtol=tolerance, maxiter=100_000)
        return np.asarray(result.x).reshape(heights.shape) * heights.size

    return run


def slippy(heights, pressure, tolerance):
    import slippy as package

    package.CUDA = False
    from slippy.core.influence_matrix_utils import plan_convolve, polonsky_and_keer

    def run():
        n = heights.shape[0]
        wave = 2 * np.pi * np.fft.fftfreq(n, 1 / n)
        with np.errstate(divide="ignore"):
            symbol = 2 / np.hypot(wave[:, None], wave[None, :])
        symbol[0, 0] = 0
        start = np.ones(heights.shape)
        convolve = plan_convolve(start, symbol, circular=True, fft_im=True)
        failed, traction, _ = polonsky_and_keer(
            convolve, start, heights.max() - heights, pressure, 1 / n, eps_0=tolerance,
            max_it=100_000)
        if failed:
            raise RuntimeError("slippy did not converge")
        return traction

    return run


SOLVERS = {solver.__name__: solver
           for solver in (tamaas, contact_mechanics, contact_mechanics_dual, slippy)}


def main():
    name, heights_file, pressure, tolerance, out = sys.argv[1:]
    heights = np.ascontiguousarray(np.load(heights_file))
    run = SOLVERS[name](heights, float(pressure), float(tolerance))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    wall, cpu = time.perf_counter(), time.process_time()
    traction = run()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    np.save(out, traction)
    print(json.dumps({"wall": wall, "cpu": cpu, "bytes": (peak - before) * 1024}))


if __name__ == "__main__":
    main()
