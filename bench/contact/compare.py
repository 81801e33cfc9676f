# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare salebra's normal contact with its peers on the same surfaces at the same reached accuracy.

Accuracy is e_c = sum p (g - g_min) / (sum p * h_rms), evaluated here in double precision from the tractions that each solver
returns, whatever the solver says of itself. Each peer runs at the loosest of its own tolerances that reaches the target e_c;
salebra then runs at the e_c which that peer reached. Every solve is a process of its own, pinned to the same cores; its wall and
CPU time include set-up but not import and file access. Memory is the growth of the process's peak after the heights are read.

Each row is appended to the results file as it comes, and a row that the file holds is not run again: a long table is built up in
pieces, by calling the same command until it has nothing left to do.
"""

import argparse
import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
MODULUS_TIMES_SLOPE = 0.1  # E* h' with E* = 1 and rms slope 0.1: f is the pressure over it

PEERS = ["tamaas", "contact_mechanics", "contact_mechanics_dual", "slippy", "aspher", "polonsky_keer"]
FREE = ["tamaas", "contact_mechanics", "slippy", "aspher"]  # those that also solve on an infinite half-space
# In the measures of peers.py all of them reach about the e_c that they are asked for; the first that is enough counts.
TOLERANCES = [1e-8, 3e-9, 1e-9, 3e-10, 1e-10, 1e-11]
# A solve below this many seconds of CPU time is repeated, and its median counts.
WORTH_REPEATING = 20


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


def periodic_displacement(traction):
    n = traction.shape[0]
    q = np.hypot(2 * np.pi * np.fft.fftfreq(n, 1 / n)[:, None],
                 2 * np.pi * np.fft.rfftfreq(n, 1 / n)[None, :])
    q[0, 0] = np.inf
    return np.fft.irfft2(2 / q * np.fft.rfft2(traction), (n, n))


def free_displacement(traction):
    """In the middle of cells of constant pressure (Love), by a convolution padded with zeros."""
    n = traction.shape[0]
    edge = (np.arange(-n, n + 1) - 0.5) / n
    x, y = edge[:, None], edge[None, :]
    corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    response = np.fft.ifftshift(np.diff(np.diff(corner, axis=0), axis=1)) / np.pi
    return np.fft.irfft2(np.fft.rfft2(response) * np.fft.rfft2(traction, response.shape), response.shape)[:n, :n]


def reached_accuracy(heights, traction, pressure, boundary="periodic"):
    """e_c; infinite for tractions that do not carry the load."""
    traction = np.maximum(traction, 0)
    if not abs(traction.mean() / pressure - 1) < 1e-6:
        return np.inf
    displacement = free_displacement if boundary == "free" else periodic_displacement
    gap = displacement(traction) - heights
    return float(np.sum(traction * (gap - gap.min())) / (traction.sum() * heights.std()))


class OutOfTime(Exception):
    pass


class Results:
    """Rows of a file of JSON lines; the last row of a case counts."""

    def __init__(self, file):
        self.file = file
        self.rows = {}
        if file.exists():
            for line in file.read_text().splitlines():
                row = json.loads(line)
                if "peer" in row:
                    self.rows[self.key(row)] = row

    @staticmethod
    def key(row):
        return row["n"], row["cutoff"], row["load"], row["cores"], row["peer"], row.get("boundary", "periodic")

    def add(self, row):
        if "peer" in row:
            self.rows[self.key(row)] = row
        with self.file.open("a") as out:
            out.write(json.dumps(row) + "\n")

    def earlier(self, *case):
        """Rows of a cut-off, load, peer and boundary."""
        return [row for (_, cutoff, load, _, peer, boundary), row in self.rows.items()
                if (cutoff, load, peer, boundary) == case]

    def out_of_time_below(self, n, *case):
        """A solver that is out of time at one size will be at the next one too."""
        return any(row.get("over_limit") and row["n"] < n for row in self.earlier(*case))

    def tolerance(self, *case):
        """That was needed on the largest grid so far, where there is one."""
        known = [(row["n"], row["tolerance"]) for row in self.earlier(*case) if "tolerance" in row]
        return max(known)[1] if known else TOLERANCES[0]


class Runner:
    def __init__(self, arguments, folder):
        self.arguments = arguments
        self.folder = Path(folder)
        self.on_disk = None

    def process(self, command, cores):
        environment = dict(os.environ, OMP_NUM_THREADS=str(cores), OPENBLAS_NUM_THREADS=str(cores),
                           MKL_NUM_THREADS=str(cores), NUMBA_NUM_THREADS=str(cores),
                           EARLIER_NUMPI=str(self.arguments.earlier_numpi))
        if command[0] == self.arguments.salebra:  # its threads wait as those of the program and of the Python package
            environment.update(OMP_WAIT_POLICY="passive", GOMP_SPINCOUNT="1000")
        pinned = ["taskset", "-c", ",".join(map(str, self.arguments.cpus[:cores])), *map(str, command)]
        try:
            done = subprocess.run(pinned, env=environment, capture_output=True, text=True,
                                  timeout=self.arguments.limit)
        except subprocess.TimeoutExpired:
            raise OutOfTime from None
        if done.returncode:
            raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr.strip()
                               else f"exit status {done.returncode}")
        return json.loads(done.stdout.strip().splitlines()[-1])

    def median(self, command, cores, first):
        """Costs of a solve whose first run is given: of several runs where one is short."""
        runs = [first]
        while len(runs) < self.arguments.repeats and runs[0]["cpu"] < WORTH_REPEATING:
            runs.append(self.process(command, cores))
        cost = dict(runs[0], runs=len(runs))
        for figure in ("wall", "cpu", "setup", "bytes"):
            if figure in cost:
                cost[figure] = statistics.median(run[figure] for run in runs)
        return cost

    def prepare(self, n, cutoff):
        if self.on_disk != (n, cutoff):
            self.heights = rough_surface(n, cutoff)
            np.save(self.folder / "heights.npy", self.heights)
            self.heights.tofile(self.folder / "heights.raw")
            self.on_disk = n, cutoff

    def compiled(self, program, n, pressure, tolerance, cores):
        return [program, self.folder / "heights.raw", n, pressure, tolerance, cores, self.folder / "out.raw"]

    def peer(self, name, n, pressure, tolerance, cores, boundary):
        if name == "polonsky_keer":
            command = self.compiled(self.arguments.reference, n, pressure, tolerance, cores)
            traction = lambda: np.fromfile(self.folder / "out.raw").reshape(n, n)
        else:
            python = {"slippy": self.arguments.slippy_python, "aspher": self.arguments.aspher_python}.get(
                name, self.arguments.python)
            out = self.folder / "out.npy"
            command = [python, HERE / "peers.py", name, self.folder / "heights.npy", pressure, tolerance, boundary, out]
            traction = lambda: np.load(out)
        cost = self.process(command, cores)
        reached = reached_accuracy(self.heights, traction(), pressure, boundary)
        return self.median(command, cores, cost) if reached <= self.arguments.target else cost, reached

    def salebra(self, n, pressure, tolerance, cores, boundary):
        command = [*self.compiled(self.arguments.salebra, n, pressure, tolerance, cores), boundary]
        cost = self.median(command, cores, self.process(command, cores))
        own = np.fromfile(self.folder / "out.raw").reshape(n, n)
        return cost, reached_accuracy(self.heights, own, pressure, boundary)

    def case(self, results, n, cutoff, load, cores, name, boundary):
        self.prepare(n, cutoff)
        pressure = load * MODULUS_TIMES_SLOPE
        row = {"n": n, "cutoff": cutoff, "load": load, "cores": cores, "peer": name, "boundary": boundary,
               "load_average": os.getloadavg()[0]}
        accuracy = self.arguments.target  # of salebra's run beside a peer that gives no answer
        started = time.monotonic()
        if results.out_of_time_below(n, cutoff, load, name, boundary):
            row["over_limit"] = self.arguments.limit
            row["note"] = "over the limit on a smaller grid, not tried"
        else:
            try:
                for tolerance in [t for t in TOLERANCES if t <= results.tolerance(cutoff, load, name, boundary)]:
                    cost, reached = self.peer(name, n, pressure, tolerance, cores, boundary)
                    row.update(peer_cost=cost, peer_e_c=reached, tolerance=tolerance)
                    if reached <= self.arguments.target:
                        break
                    if time.monotonic() - started > self.arguments.limit:
                        raise OutOfTime
                if np.isfinite(row["peer_e_c"]):
                    accuracy = row["peer_e_c"]
                else:
                    del row["tolerance"]
                    row["failure"] = "its answer does not carry the load"
            except OutOfTime:
                # The best that it reached in time stays in the row.
                row["over_limit"] = self.arguments.limit
            except RuntimeError as failure:
                row["failure"] = str(failure)[-200:]
        row["salebra_cost"], row["salebra_e_c"] = self.salebra(
            n, pressure, min(max(accuracy, 1e-13), 1e-2), cores, boundary)
        return row


def seconds(value):
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


HEAD = ("    N cut     f th  peer                      e_c     set-up    wall     cpu pairs B/cell |"
        "  salebra e_c  set-up    wall     cpu pairs B/cell |  wall x   cpu x")


def text_of(row):
    own = row["salebra_cost"]
    peer = row.get("peer_cost")
    name = row["peer"] + (", free" if row.get("boundary") == "free" else "")
    head = f"{row['n']:5d} {row['cutoff']:3d} {row['load']:5g} {row['cores']:2d}  {name:24s}"

    def figures(cost, e_c):
        pairs, setup = cost.get("pairs"), cost.get("setup")
        return (f"{e_c:8.1e} {'–' if setup is None else seconds(setup):>8s} {seconds(cost['wall']):>7s}"
                f" {seconds(cost['cpu']):>7s} {'–' if pairs is None else pairs:>5} {cost['bytes'] / row['n']**2:6.0f}")

    if "over_limit" in row:
        left = f"> {row['over_limit']:g} s"
        if "note" in row:
            left += f" ({row['note']})"
        ratio = f"> {row['over_limit'] / own['wall']:.0f}"
        ratios = f"{ratio:>8s}"
    elif "failure" in row:
        left, ratios = row["failure"], ""
    else:
        left = figures(peer, row["peer_e_c"])
        ratios = f"{peer['wall'] / own['wall']:8.1f}{peer['cpu'] / own['cpu']:8.1f}"
    return f"{head}{left:47s} |    {figures(own, row['salebra_e_c'])} |{ratios}"


def summary(rows):
    """Against the best peer of each case; how two cores compare with one."""
    cases = {}
    for row in rows:
        cases.setdefault((row.get("boundary", "periodic"), row["cutoff"], row["cores"], row["n"], row["load"]),
                         []).append(row)
    lines = ["", "Against the fastest peer of each case, set-up included, each at the e_c which that peer reached:",
             "boundary cut-off cores     N     f    wall x   cpu x  fastest peer (its wall s)   salebra wall s"]
    for (boundary, cutoff, cores, n, load), group in sorted(cases.items()):
        done = [row for row in group if "peer_cost" in row and "over_limit" not in row and "failure" not in row]
        if not done:
            lines.append(f"{boundary:8s} {cutoff:7d} {cores:5d} {n:5d} {load:5g}    no peer came to an end in its time")
            continue
        best = min(done, key=lambda row: row["peer_cost"]["wall"])
        own = best["salebra_cost"]
        # Peers that were not run, or are still to come, cannot be ranked.
        missing = len(FREE if boundary == "free" else PEERS) - len(group)
        lines.append(f"{boundary:8s} {cutoff:7d} {cores:5d} {n:5d} {load:5g}  {best['peer_cost']['wall'] / own['wall']:8.1f}"
                     f"{best['peer_cost']['cpu'] / own['cpu']:8.1f}  {best['peer']} ({seconds(best['peer_cost']['wall'])})"
                     f"   {seconds(own['wall'])}" + (f"   [{missing} peer(s) not run]" if missing else ""))
    pairs = []
    for (boundary, cutoff, cores, n, load), group in sorted(cases.items()):
        other = cases.get((boundary, cutoff, 1, n, load))
        if cores > 1 and other:
            ratio = {row["peer"]: row["salebra_cost"]["wall"] for row in other}
            speedups = [ratio[row["peer"]] / row["salebra_cost"]["wall"] for row in group if row["peer"] in ratio]
            if speedups:
                pairs.append(f"{boundary:8s} {cutoff:7d} {cores:5d} {n:5d} {load:5g}  {statistics.median(speedups):8.2f}")
    if pairs:
        lines += ["", "salebra's wall time on one core over that on several:", "boundary cut-off cores     N     f   speed-up", *pairs]
    return "\n".join(lines)


def command_output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, cwd=HERE, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def machine(arguments):
    facts = {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
             "system": platform.platform(), "cores": os.cpu_count(), "load_average": os.getloadavg(),
             "pinned_to": arguments.cpus}
    cpu = Path("/proc/cpuinfo")
    if cpu.exists():
        lines = [line.split(":", 1) for line in cpu.read_text().splitlines() if ":" in line]
        known = {name.strip(): value.strip() for name, value in lines}
        facts["processor"] = known.get("model name", platform.machine())
        facts["vectors"] = [flag for flag in ("avx2", "avx512f") if flag in known.get("flags", "").split()]
    for index in sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        kind = (index / "type").read_text().strip()
        facts.setdefault("caches", []).append(
            f"L{(index / 'level').read_text().strip()} {kind} {(index / 'size').read_text().strip()}")
    memory = Path("/proc/meminfo")
    if memory.exists():
        facts["memory"] = memory.read_text().splitlines()[0].split(":")[1].strip()
    facts["salebra"] = command_output("git", "describe", "--always", "--dirty")
    packages = []
    for python in {arguments.python, arguments.slippy_python, arguments.aspher_python}:
        packages += command_output(python, "-m", "pip", "list", "--format=freeze").splitlines()
    wanted = ("tamaas", "contactmechanics", "surfacetopography", "numpi", "mugrid", "mufft", "slippy", "aspher", "numpy", "pyfftw")
    facts["packages"] = sorted({line for line in packages if line.lower().startswith(wanted)})
    return facts


def numbers(kind):
    return lambda text: [kind(part) for part in text.split(",")]


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--salebra", required=True, help="the program contact_solve")
    parser.add_argument("--reference", required=True, help="the program contact_reference")
    parser.add_argument("--python", default=sys.executable, help="Python with Tamaas and ContactMechanics")
    parser.add_argument("--slippy-python", default=sys.executable, help="Python with slippy")
    parser.add_argument("--aspher-python", default=sys.executable, help="Python with ASPHER")
    parser.add_argument("--earlier-numpi", help="folder with NuMPI 0.7.3, which the dual solver of peers.py needs")
    parser.add_argument("--peers", type=lambda text: text.split(","), default=PEERS)
    parser.add_argument("--sizes", type=numbers(int), default=[512, 1024, 2048, 4096])
    parser.add_argument("--cutoffs", type=numbers(int), default=[8, 2], help="cells")
    parser.add_argument("--boundaries", type=lambda text: text.split(","), default=["periodic", "free"])
    parser.add_argument("--loads", type=numbers(float), default=[0.005, 0.02, 0.1], help="p/(E* h')")
    parser.add_argument("--cores", type=numbers(int), default=[1, 2], help="numbers of cores to run on")
    parser.add_argument("--cpus", type=numbers(int), default=list(range(os.cpu_count() or 1)), help="which cores, in order")
    parser.add_argument("--target", type=float, default=1e-8, help="e_c that each peer has to reach")
    parser.add_argument("--repeats", type=int, default=3,
                        help=f"runs of a solve of less than {WORTH_REPEATING} s of CPU time; the median counts")
    parser.add_argument("--limit", type=float, default=900, help="seconds of wall time for one solve of a peer")
    parser.add_argument("--budget", type=float, default=float("inf"), help="begin no further case after so many seconds")
    parser.add_argument("--results", type=Path, default=Path("contact-bench.jsonl"), help="appended to, and read to continue")
    parser.add_argument("--quick", action="store_true", help="512 only, cut-off 8, one core, one run each: about two minutes")
    parser.add_argument("--report", action="store_true", help="print the tables of the results file and run nothing")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.sizes, arguments.cutoffs, arguments.cores = [512], [8], [1]
        arguments.repeats, arguments.limit = 1, min(arguments.limit, 60)
    unknown = set(arguments.peers) - set(PEERS)
    if unknown:
        parser.error(f"--peers: {', '.join(sorted(unknown))} unknown; choose among {', '.join(PEERS)}")
    if not set(arguments.boundaries) <= {"periodic", "free"}:
        parser.error("--boundaries: periodic or free, or both")
    if max(arguments.cores) > len(arguments.cpus):
        parser.error(f"--cores: {max(arguments.cores)} exceeds the {len(arguments.cpus)} of --cpus")
    return arguments


def main():
    arguments = parse()
    results = Results(arguments.results)
    if arguments.report:
        print(HEAD)
        for key in sorted(results.rows):
            print(text_of(results.rows[key]))
    else:
        facts = machine(arguments)
        print(json.dumps(facts))
        print(HEAD, flush=True)
        results.add({"machine": facts})
        started = time.monotonic()
        # Small grids first, so that a table which is cut short is complete up to some size.
        cases = [(n, cutoff, load, cores, peer, boundary) for n in arguments.sizes for cutoff in arguments.cutoffs
                 for cores in arguments.cores for boundary in arguments.boundaries for load in arguments.loads
                 for peer in arguments.peers if boundary == "periodic" or peer in FREE]
        with tempfile.TemporaryDirectory() as folder:
            runner = Runner(arguments, folder)
            for case in cases:
                if case not in results.rows:
                    if time.monotonic() - started > arguments.budget:
                        print("The budget is used up: call again to continue.")
                        break
                    results.add(runner.case(results, *case))
                print(text_of(results.rows[case]), flush=True)
    print(summary(results.rows.values()))
    print("\nresults:", arguments.results)


if __name__ == "__main__":
    main()
