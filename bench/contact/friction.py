# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare one loop of partial slip with ASPHER, at equal error of the loss.

The same rough surface of side 1 is pressed to one load (E* = 1, free boundary: ASPHER has friction with no other), moved along x by
a quarter of a period and then over one period; both programs follow the same positions. The reference is salebra's loss with tight
tolerances, and its agreement with ASPHER's at the tightest tolerance is an independent check of both. For each number of steps each
program runs at its loosest tangential tolerance with which the error of the loss is at most --error, on larger grids from that of the
smaller one on; where no tolerance is enough, the table has the errors. Processor time on one thread includes the normal contact, but neither import nor file access; medians.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import compare

HERE = Path(__file__).resolve().parent
NORMAL_TOLERANCE = 1e-8
TOLERANCES = [3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5]
WORTH_REPEATING = 30  # seconds


def positions(amplitude, steps):
    quarter = max(steps // 4, 1)
    return [amplitude * np.sin(np.pi / 2 * k / quarter) for k in range(1, quarter + 1)] + [
        amplitude * np.cos(2 * np.pi * k / steps) for k in range(1, steps + 1)]


def aspher_loop(heights_file, pressure, amplitude, steps, friction, poisson, tolerance, tangential_tolerance):
    """Run by the Python that has ASPHER."""
    import aspher

    heights = np.load(heights_file)
    n = heights.shape[0]
    start = time.process_time()
    solver = aspher.FrictionSolver(grid_size=n, nu=poisson, model=aspher.CoulombFriction(friction))
    solver.set_gap(np.ascontiguousarray(-heights.T).ravel())  # its x is the last index
    pressed = solver.step(p_bar=pressure, tol_normal=tolerance)
    assert pressed.converged, "normal contact not converged"
    normal = time.process_time() - start
    losses, force, iterations = [], 0, 0
    for x in positions(amplitude, steps):
        step = solver.step(delta_t=(x, 0.0), tol_tangential=tangential_tolerance, tol_kkt=1.0)
        assert step.converged, step.status_reason
        losses.append(step.dissipation)
        force = max(force, step.q_mean[0])
        iterations += step.tangential_iters
    spent = time.process_time() - start
    print(json.dumps({"cpu": spent, "cpu_normal": normal, "loss": sum(losses[-steps:]), "area": pressed.contact_area,
                      "force_ratio": force / (friction * pressure), "iterations": iterations}))


class Case:
    def __init__(self, arguments, n, poisson, folder):
        self.arguments = arguments
        heights = compare.rough_surface(n, 8)
        self.numpy_file, self.raw_file = Path(folder) / "heights.npy", Path(folder) / "heights.raw"
        np.save(self.numpy_file, heights)
        heights.tofile(self.raw_file)
        self.n, self.poisson = n, poisson
        self.pressure = arguments.load * compare.MODULUS_TIMES_SLOPE
        self.amplitude = arguments.amplitude * arguments.friction * heights.std()

    def run(self, program, steps, tolerance):
        of_both = [self.pressure, self.amplitude, steps, self.arguments.friction, self.poisson, NORMAL_TOLERANCE, tolerance]
        command = ([self.arguments.salebra, self.raw_file, self.n, *of_both] if program == "salebra" else
                   [self.arguments.aspher_python, HERE / "friction.py", "loop", self.numpy_file, *of_both])
        done = subprocess.run(["taskset", "-c", str(self.arguments.cpu), *map(str, command)], capture_output=True, text=True,
                              env=dict(os.environ, OMP_NUM_THREADS="1"), timeout=self.arguments.limit)
        if done.returncode:
            raise RuntimeError((done.stderr.strip().splitlines() or ["failed"])[-1])
        return json.loads(done.stdout)

    def loosest(self, program, steps, reference, first):
        """Median cost of the first tolerance that is enough, from `first` on, or why there is none."""
        reached = []
        for tolerance in [t for t in TOLERANCES if t <= first]:
            try:
                runs = [self.run(program, steps, tolerance)]
            except (RuntimeError, subprocess.TimeoutExpired) as failure:
                return f"{type(failure).__name__} at {tolerance:g}; errors before: {reached}"
            reached.append(f"{runs[0]['loss'] / reference - 1:+.2%}")
            if abs(runs[0]["loss"] / reference - 1) <= self.arguments.error:
                while len(runs) < self.arguments.repeats and runs[0]["cpu"] < WORTH_REPEATING:
                    runs.append(self.run(program, steps, tolerance))
                cost = dict(runs[0], tolerance=tolerance)
                for figure in ("cpu", "cpu_normal"):
                    cost[figure] = statistics.median(run[figure] for run in runs)
                return cost
        return f"errors: {', '.join(reached)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--salebra", required=True, help="the program contact_loop")
    parser.add_argument("--aspher-python", required=True, help="Python with ASPHER")
    parser.add_argument("--sizes", type=compare.numbers(int), default=[256, 512])
    parser.add_argument("--steps", type=compare.numbers(int), default=[2, 32], help="of a period: 2, or a multiple of 4")
    parser.add_argument("--poisson", type=compare.numbers(float), default=[0.0, 0.3])
    parser.add_argument("--load", type=float, default=0.02, help="p/(E* h')")
    parser.add_argument("--friction", type=float, default=0.3)
    parser.add_argument("--amplitude", type=float, default=0.6, help="over the product of friction coefficient and rms height")
    parser.add_argument("--error", type=float, default=0.01, help="of the loss")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--limit", type=float, default=600, help="seconds for one loop")
    parser.add_argument("--cpu", type=int, default=0)
    arguments = parser.parse_args()
    print("    N   nu steps  program  tolerance     loss  error   T/(mu F)    area   cpu s  of it normal")
    needed = {}  # tolerances on the largest grid so far
    for n in arguments.sizes:
        for poisson in arguments.poisson:
            with tempfile.TemporaryDirectory() as folder:
                case = Case(arguments, n, poisson, folder)
                reference = case.run("salebra", 64, 1e-9)["loss_at_end"]
                for steps in arguments.steps:
                    for program in ("salebra", "aspher"):
                        what = poisson, steps, program
                        found = case.loosest(program, steps, reference, needed.get(what, TOLERANCES[0]))
                        line = f"{n:5d} {poisson:4g} {steps:5d}  {program:8s}"
                        if isinstance(found, dict):
                            needed[what] = found["tolerance"]
                            line += (f"{found['tolerance']:9g} {found['loss']:.3e} {found['loss'] / reference - 1:+6.2%}"
                                     f" {found['force_ratio']:9.5f} {found['area']:8.5f} {found['cpu']:7.3f} {found['cpu_normal']:.3f}")
                        else:
                            line += " " + found
                        print(line, flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["loop"]:
        heights, pressure, amplitude, steps, *others = sys.argv[2:]
        aspher_loop(heights, float(pressure), float(amplitude), int(steps), *map(float, others))
    else:
        main()
