# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare salebra's normal contact with its peers on the same surfaces at the same reached accuracy.

Accuracy is e_c = sum p (g - g_min) / (sum p * h_rms), evaluated here in double precision from the tractions that each solver
returns, whatever the solver says of itself. Each peer is run at a tolerance, in its own measure, that reaches at least the target
e_c (found by tightening until it does); salebra is then run at the e_c which that peer reached. Every solver is a process of its
own, pinned to the same cores, and its time includes set-up but not import and file access.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
MODULUS_TIMES_SLOPE = 0.1  # E* h' with E* = 1 and rms slope 0.1: f is the pressure over it

# Tolerances to try, loosest first; the first that reaches the target e_c is used.
PEERS = {
    "tamaas": [1e-8, 1e-9, 1e-10],
    "contact_mechanics": [1e-9, 1e-10, 1e-11, 1e-12],
    "contact_mechanics_dual": [1e-11, 1e-12, 1e-13, 1e-14],
    "slippy": [1e-8, 1e-9, 1e-10],
}


def rough_surface(n, cutoff_cells, seed=1, hurst=0.8, rolloff=8):
    """Self-affine filtered noise, roll-off at L/8, rms slope 0.1; one period of side 1."""
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    qx = 2 * np.pi * np.fft.fftfreq(n, 1 / n)[:, None]
    qy = 2 * np.pi * np.fft.rfftfreq(n, 1 / n)[None, :]
    q = np.hypot(qx, qy)
    rolloff_wave = 2 * np.pi * rolloff
    power = np.maximum(q / rolloff_wave, 1) ** (-2 * (1 + hurst))
    power[q > 2 * np.pi * n / cutoff_cells] = 0
    power[0, 0] = 0
    modes = noise * np.sqrt(power)
    square = sum(np.mean(np.fft.irfft2(1j * wave * modes, (n, n)) ** 2) for wave in (qx, qy))
    return np.fft.irfft2(modes, (n, n)) * (0.1 / np.sqrt(square))


def reached_accuracy(heights, traction):
    n = heights.shape[0]
    q = np.hypot(2 * np.pi * np.fft.fftfreq(n, 1 / n)[:, None],
                 2 * np.pi * np.fft.rfftfreq(n, 1 / n)[None, :])
    q[0, 0] = np.inf
    traction = np.maximum(traction, 0)
    gap = np.fft.irfft2(2 / q * np.fft.rfft2(traction), (n, n)) - heights
    return float(np.sum(traction * (gap - gap.min())) / (traction.sum() * heights.std()))


class Runner:
    def __init__(self, arguments, folder):
        self.arguments = arguments
        self.folder = Path(folder)

    def process(self, command, cores):
        environment = dict(os.environ, OMP_NUM_THREADS=str(cores), OPENBLAS_NUM_THREADS=str(cores),
                           MKL_NUM_THREADS=str(cores), NUMBA_NUM_THREADS=str(cores))
        pinned = ["taskset", "-c", ",".join(map(str, range(cores)))] + list(map(str, command))
        done = subprocess.run(pinned, env=environment, capture_output=True, text=True,
                              timeout=self.arguments.timeout)
        if done.returncode:
            raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr else "failed")
        return json.loads(done.stdout.strip().splitlines()[-1])

    def peer(self, name, pressure, tolerance, cores):
        python = self.arguments.slippy_python if name == "slippy" else self.arguments.python
        out = self.folder / "peer.npy"
        cost = self.process([python, HERE / "peers.py", name, self.folder / "heights.npy", pressure,
                             tolerance, out], cores)
        return cost, np.load(out)

    def salebra(self, n, pressure, tolerance, cores):
        out = self.folder / "salebra.raw"
        runs = [self.process([self.arguments.salebra, self.folder / "heights.raw", n, pressure,
                              tolerance, cores, out], cores)
                for _ in range(self.arguments.repeats)]
        cost = dict(runs[0])
        for figure in ("wall", "cpu", "bytes"):
            cost[figure] = statistics.median(run[figure] for run in runs)
        return cost, np.fromfile(out).reshape(n, n)

    def case(self, n, cutoff, load, cores, skipped):
        heights = rough_surface(n, cutoff)
        np.save(self.folder / "heights.npy", heights)
        heights.tofile(self.folder / "heights.raw")
        pressure = load * MODULUS_TIMES_SLOPE
        rows = []
        for name, tolerances in PEERS.items():
            if name not in self.arguments.peers or (name, load) in skipped:
                continue
            row = {"n": n, "cutoff": cutoff, "load": load, "cores": cores, "peer": name}
            try:
                for tolerance in tolerances:
                    cost, traction = self.peer(name, pressure, tolerance, cores)
                    accuracy = reached_accuracy(heights, traction)
                    if accuracy <= self.arguments.target:
                        break
            except (RuntimeError, subprocess.TimeoutExpired) as failure:
                # A solver that is out of time at this size will be at the next one too.
                skipped.add((name, load))
                row["failure"] = type(failure).__name__ + ": " + str(failure)[-120:]
                rows.append(row)
                self.show(row)
                continue
            own, own_traction = self.salebra(n, pressure, max(accuracy, 1e-13), cores)
            row.update(peer_cost=cost, peer_e_c=accuracy, salebra_cost=own,
                       salebra_e_c=reached_accuracy(heights, own_traction),
                       cpu_ratio=cost["cpu"] / own["cpu"], wall_ratio=cost["wall"] / own["wall"],
                       bytes_per_cell=own["bytes"] / n**2, peer_bytes_per_cell=cost["bytes"] / n**2)
            rows.append(row)
            self.show(row)
        return rows

    def show(self, row):
        head = f"{row['n']:5d} {row['cutoff']:3d} {row['load']:6g} {row['cores']:2d}  {row['peer']:23s}"
        if "failure" in row:
            print(head, row["failure"], flush=True)
            return
        peer, own = row["peer_cost"], row["salebra_cost"]
        print(head, f"{row['peer_e_c']:9.1e} {peer['cpu']:9.2f} {peer['wall']:9.2f} |"
              f"{row['salebra_e_c']:9.1e} {own['cpu']:8.3f} {own['wall']:8.3f} {own['pairs']:4d} |"
              f"{row['cpu_ratio']:7.1f} {row['wall_ratio']:7.1f} |"
              f"{row['peer_bytes_per_cell']:6.0f} {row['bytes_per_cell']:6.0f}", flush=True)


def numbers(kind):
    return lambda text: [kind(part) for part in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--salebra", required=True, help="the program contact_solve")
    parser.add_argument("--python", default=sys.executable, help="Python with Tamaas and ContactMechanics")
    parser.add_argument("--slippy-python", default=sys.executable, help="Python with slippy")
    parser.add_argument("--peers", type=lambda text: text.split(","), default=list(PEERS))
    parser.add_argument("--sizes", type=numbers(int), default=[512, 1024, 2048, 4096])
    parser.add_argument("--cutoffs", type=numbers(int), default=[8, 2], help="cells")
    parser.add_argument("--loads", type=numbers(float), default=[0.005, 0.02, 0.1], help="p/(E* h')")
    parser.add_argument("--cores", type=numbers(int), default=[1, 2])
    parser.add_argument("--target", type=float, default=1e-8, help="e_c that each peer has to reach")
    parser.add_argument("--repeats", type=int, default=3, help="runs of salebra; the median counts")
    parser.add_argument("--timeout", type=float, default=1800, help="seconds for one solve of a peer")
    parser.add_argument("--results", type=Path, default=Path("contact-bench.json"))
    arguments = parser.parse_args()

    machine = {"processor": platform.processor() or platform.machine(), "cores": os.cpu_count(),
               "system": platform.platform()}
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            machine["processor"] = line.split(":")[1].strip()
            break
    print(json.dumps(machine))
    print("    n cut   load th  peer                     e_c(peer)     cpu/s    wall/s |"
          "  e_c(own)    cpu/s   wall/s pairs |  cpu x  wall x | B/cell: peer, salebra")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(arguments, folder)
        for cores in arguments.cores:
            for cutoff in arguments.cutoffs:
                skipped = set()
                for n in arguments.sizes:
                    for load in arguments.loads:
                        rows += runner.case(n, cutoff, load, cores, skipped)
                        arguments.results.write_text(
                            json.dumps({"machine": machine, "rows": rows}, indent=1))
    best = {}
    for row in rows:
        if "failure" not in row:
            key = (row["cores"], row["cutoff"], row["n"], row["load"])
            best[key] = min(best.get(key, (np.inf, "")), (row["wall_ratio"], row["peer"]))
    print("\nAgainst the best peer of each case, wall time, set-up included:")
    for (cores, cutoff, n, load), (ratio, peer) in sorted(best.items()):
        print(f"{n:5d} cut-off {cutoff} f {load:g}, {cores} core(s): {ratio:6.1f} x  ({peer})")
    print("results:", arguments.results)


if __name__ == "__main__":
    main()
