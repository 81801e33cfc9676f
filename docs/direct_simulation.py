#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rewrites the tables of direct_simulation.md from runs of the program.

Usage: docs/direct_simulation.py PROGRAM [--tables shapes,convergence,rough,cells,mindlin,slip,sliding] [--jobs N] [--measured FILE --measured-name TEXT]
Each table stands between a line `<!-- NAME -->` and a line `<!-- end of NAME -->`. Only Python's own library is needed.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import subprocess
import tempfile

PAGE = pathlib.Path(__file__).with_name("direct_simulation.md")
SWEEP = {"cylinder": 6e-6, "paraboloid": 6e-6, "pyramids": 1.8e-6, "sinusoids": 1.35e-6}  # u_z, m
ROUGH_MODULUS, ROUGH_SLOPE = 1e9, 0.1  # E* in Pa and h' of the generated surfaces


class Runs:
    def __init__(self, program, jobs):
        self.program = program
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)

    def answer(self, *arguments):
        command = [self.program, *map(str, arguments), "--json", "--quiet", "--progress", "never", "--threads", "1"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
        return json.loads(done.stdout)

    def all(self, function, arguments):
        return list(self.pool.map(lambda a: function(*a), arguments))


def motion(case, amplitude):
    if case == "b":
        return ["--mode", "drag", "--normal-amplitude", amplitude, "--drag-velocity", "1nm/s", "--frequency", "100Hz"]
    return ["--normal-amplitude", amplitude, "--tangential-amplitude", amplitude, "--phase", case]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def percent(value):
    return f"{100 * value:+.2f} %"


ROUTES = ["levels against steps", "stated by the levels", "stated by the steps", "agree"]


def routes(a):
    w = a["work_per_cycle"]
    return [percent(a["work_by_levels"] / w - 1), f"{100 * a['work_by_levels_error'] / w:.2f} %",
            f"{100 * a['error_estimate'] / w:.2f} %", "yes" if a["routes_agree"] else "**no**"]


def shapes(runs, _):
    """Ratios of Fig. 3's shapes."""
    cases = [("90deg", 128), ("45deg", 128), ("b", 256)]
    keys = [(s, c, n, nu) for s in SWEEP for c, n in cases for nu in (0, 0.3, 0.5)]

    def run(shape, case, points, poisson):
        return runs.answer("oscillate", "--shape", shape, "--points", points, "--contact-modulus", "1GPa",
                           "--poisson", poisson, *motion(case, SWEEP[shape]))

    rows = []
    for (shape, case, points, poisson), a in zip(keys, runs.all(run, keys)):
        w = a["work_per_cycle"]
        lost = a["ratio_finite"] is not None
        rows.append([shape, "(b)" if case == "b" else f"(a) {case[:2]}°", f"{points}²", str(poisson),
                     f"{a['ratio']:.4f}" if lost else "no loss", f"{a['ratio_finite']:.4f}" if lost else "no loss",
                     *(routes(a) if lost else [""] * 4),
                     f"{abs(a['dissipated'] / w - 1):.0e}" if lost else "",
                     f"{a['work_over_elastic_energy']:.0e}" if not lost else ""])
    return table(["shape", "case", "cells", "ν", "W over Eq. (12), (15)", "W over finite amplitude", *ROUTES,
                  "released energy off by", "W/(½K_t u²)"], rows)


def with_error(answer, work, error, exact):
    return f"{percent(answer[work] / exact - 1)[:-2]} ± {100 * answer[error] / exact:.2f} %"


def paraboloid(case, ratio):
    """Exact loss of R = 4 mm at δ = 20 ± 6 µm: K_t = 2G*√(Rδ), by parts, with the midpoint rule on 20000 points."""
    radius, depth, u, n = 4e-3, 20e-6, 6e-6, 20000
    modulus = 1e9 * ratio
    theta = [math.pi * (k + 0.5) / n for k in range(n)]
    stiffness = [2 * modulus * math.sqrt(radius * (depth + u * math.cos(t))) for t in theta]
    step = math.pi / n
    if case == "b":
        s = sum(t * k for t, k in zip(theta, stiffness)) * step
        least = 2 * modulus * math.sqrt(radius * (depth - u))
        return 2 * (1e-9 / (2 * math.pi * 100)) ** 2 * (2 * s - math.pi**2 * least)
    phase = math.radians(float(case[:2]))
    s = sum(math.sin(2 * t) * k for t, k in zip(theta, stiffness)) * step
    return 2 * (u * math.sin(phase)) ** 2 * s


def convergence(runs, _):
    """Paraboloid against its exact loss, over cells and steps."""
    poisson, ratio = 0.3, 2 * 0.7 / 1.7
    points, steps = [32, 64, 128, 256], [16, 32, 64, 128]
    keys = [(c, n, k) for c in ("45deg", "b") for n in points for k in steps]

    def run(case, n, k):
        return runs.answer("oscillate", "--shape", "paraboloid", "--points", n, "--steps", k, "--contact-modulus", "1GPa",
                           "--poisson", poisson, *motion(case, 6e-6))

    answers = dict(zip(keys, runs.all(run, keys)))
    rows = []
    for case in ("45deg", "b"):
        exact = paraboloid(case, ratio)
        for n in points:
            row = ["(b)" if case == "b" else "(a) 45°", f"{n}²"]
            row += [with_error(answers[case, n, k], "work_per_cycle", "error_estimate", exact) for k in steps]
            rows.append(row + [with_error(answers[case, n, 128], "work_by_levels", "work_by_levels_error", exact)])
    return table(["case", "cells", *(f"{k} steps" for k in steps), "levels"], rows)


def generated(runs, folder, seed, points):
    """One of the generated surfaces of the rough tables; its long waves do not depend on the points."""
    file = f"{folder}/{seed}-{points}.h5"
    runs.answer("generate", "--points", points, "--size-x", "10um", "--hurst", 0.8, "--rolloff", "1.25um",
                "--short-cutoff", "0.625um", "--rms-slope", ROUGH_SLOPE, "--seed", seed, "-o", file)
    return file


def decay_length(runs, surface, scale, curve):
    runs.answer("contact", surface, "--pressure", f"{5e-4 * ROUGH_MODULUS * scale}:{0.2 * ROUGH_MODULUS * scale}:20",
                "--contact-modulus", ROUGH_MODULUS, "--poisson", 0.3, "-o", curve)
    return runs.answer("fit", curve)["decay_length"]


def cells(runs, _):
    """What half the cells change of W on generated surfaces, by levels."""
    seeds, cases, points = (1, 2), ("45deg", "b"), (256, 512)
    with tempfile.TemporaryDirectory() as folder:
        files = {(s, n): generated(runs, folder, s, n) for s in seeds for n in points}
        lengths = {s: decay_length(runs, files[s, 256], ROUGH_SLOPE, f"{folder}/{s}-curve.h5") for s in seeds}
        rows_of = [(load, k) for load in (0.01, 0.05) for k in (0.1, 0.25, 0.5)]
        keys = [(s, load, k, case, n) for load, k in rows_of for s in seeds for case in cases for n in points]

        def run(seed, load, k, case, n):
            return runs.answer("oscillate", "--surface", files[seed, n], "--pressure", load * ROUGH_MODULUS * ROUGH_SLOPE,
                               "--contact-modulus", ROUGH_MODULUS, "--poisson", 0.3, "--method", "levels",
                               "--levels", 64, *motion(case, k * lengths[seed]))["work_by_levels"]

        work = dict(zip(keys, runs.all(run, keys)))
        rows = [[str(load), str(k), *(percent(work[s, load, k, c, 512] / work[s, load, k, c, 256] - 1) for s in seeds for c in cases)]
                for load, k in rows_of]
    return table(["p/(E*h')", "u_z/l", *(f"seed {s}, {'(b)' if c == 'b' else '(a) 45°'}" for s in seeds for c in cases)], rows)


def rough(runs, arguments):
    """Generated and measured surfaces: both routes against Eq. (16) and against the curve."""
    with tempfile.TemporaryDirectory() as folder:
        surfaces = [(f"seed {seed}", [generated(runs, folder, seed, 256)], ROUGH_SLOPE) for seed in (1, 2, 3)]
        if arguments.measured:
            found = runs.answer("statistics", arguments.measured)
            surfaces.append((arguments.measured_name, [arguments.measured, "--boundary", "periodic"],
                             found["rms_slope"]))

        def fit(name, surface, scale):
            return decay_length(runs, surface[0], scale, f"{folder}/{name.replace(' ', '_')}-curve.h5")

        lengths = runs.all(fit, surfaces)
        keys = [(name, surface, scale, l, load, k, case)
                for (name, surface, scale), l in zip(surfaces, lengths)
                for load in (0.01, 0.05) for k in (0.1, 0.25, 0.5) for case in ("45deg", "b")]

        def run(_, surface, scale, l, load, k, case):
            return runs.answer("oscillate", "--surface", *surface, "--pressure", load * ROUGH_MODULUS * scale,
                               "--contact-modulus", ROUGH_MODULUS, "--poisson", 0.3, "--decay-length", l,
                               "--steps", 128, "--levels", 64, *motion(case, k * l))

        rows = []
        for (name, _, _, _, load, k, case), a in zip(keys, runs.all(run, keys)):
            w = a["work_per_cycle"]
            rows.append([name, str(load), str(k), "(b)" if case == "b" else "(a) 45°",
                         percent(a["work_by_whole_cells"] / w - 1), *routes(a), percent(a["work_by_force"] / w - 1), percent(a["small_amplitude_work"] / w - 1),
                         percent(a["predicted_exponential"] / w - 1),
                         percent(a["predicted_exponential_finite"] / w - 1),
                         f"{abs(a['dissipated'] / w - 1):.0e}"])
        return table(["surface", "p/(E*h')", "u_z/l", "case", "theorem with K_t", *ROUTES, "levels with (G*/E*)K",
                      "Eqs (12), (15) with F''", "Eq. (16) with l", "exponential law, finite u_z",
                      "released energy"], rows)


def mindlin(runs, _):
    """A sphere under constant load against Mindlin's loop, by what is left of it at u_z = 1e-6 of the indentation."""
    modulus, radius, friction, depth = 1e9, 4e-3, 0.4, 20e-6
    keys = [(n, k) for n in (32, 64, 128) for k in (16, 32, 64)]
    amplitude = 0.7 * friction * depth

    def run(n, k):
        return runs.answer("oscillate", "--shape", "paraboloid", "--points", n, "--steps", k, "--levels", 4,
                           "--contact-modulus", modulus, "--poisson", 0, "--friction", friction, "--phase", "90deg",
                           "--normal-amplitude", 1e-6 * depth, "--tangential-amplitude", amplitude)

    rows = []
    for (n, k), a in zip(keys, runs.all(run, keys)):
        f = a["friction"]
        force = a["force"]
        contact = (3 * force * radius / (4 * modulus)) ** (1 / 3)
        q = amplitude / (friction * contact**2 / radius)  # G* = E* at ν = 0

        def initial(s):
            return friction * force * (1 - (1 - s) ** 1.5)

        # Masing's rule for the way back; the loop is the area between it and its mirror image.
        pieces = 4000
        loop = 0
        for i in range(pieces):
            part = (i + 0.5) / pieces
            loop -= 2 * (initial(q) - 2 * initial(q * part)) * 2 * amplitude / pieces
        greatest = max(abs(x) for x in f["tangential_force"])
        rows.append([f"{n}²", str(k), percent(f["dissipated"] / loop - 1), percent(greatest / initial(q) - 1),
                     f"{abs(f['balance']):.0e}"])
    return table(["cells", "steps", "loop against Mindlin's", "maximum F_x", "balance"], rows)


def slip(runs, _):
    """A rough surface from sliding to full stick."""
    modulus, slope, points = 1e9, 0.1, 64
    with tempfile.TemporaryDirectory() as folder:
        file = f"{folder}/1.h5"
        runs.answer("generate", "--points", points, "--size-x", "10um", "--hurst", 0.8, "--rolloff", "2.5um",
                    "--short-cutoff", f"{8 * 10 / points}um", "--rms-slope", slope, "--seed", 1, "-o", file)
        keys = [(m, k) for m in (0.01, 0.1, 0.3, 1, 3, 10) for k in (32, 64)]
        modulus_ratio = 2 * 0.7 / 1.7

        def run(number, k):
            return runs.answer("oscillate", "--surface", file, "--pressure", 0.05 * modulus * slope, "--contact-modulus",
                               modulus, "--poisson", 0.3, "--phase", "90deg", "--normal-amplitude", "6nm",
                               "--tangential-amplitude", "6nm", "--friction", number * modulus_ratio, "--steps", k,
                               "--max-periods", 20)

        rows = []
        for (number, k), a in zip(keys, runs.all(run, keys)):
            f = a["friction"]
            sliding = number * modulus_ratio * a["force"] * 4 * 6e-9
            rows.append([str(number), str(k), f"{f['over_stick']:.4f}", f"{f['dissipated'] / sliding:.4f}",
                         f"{f['relaxation_work'] / f['dissipated']:.3f}", f"{abs(f['balance']):.0e}",
                         str(f["periods"]) + ("" if f["steady"] else ", not steady")])
        return table(["M = μE*u_z/(G*u_x)", "steps", "W over no slip", "W over μF·4u_x", "part by cells that open",
                      "balance", "periods"], rows)


def sliding(runs, _):
    """A rough surface that slides under a normal oscillation, against the springs of its own curve."""
    amplitude, frequency, friction, pressure = 4e-9, 100, 0.3, 0.05 * ROUGH_MODULUS * ROUGH_SLOPE
    with tempfile.TemporaryDirectory() as folder:
        surface = {(seed, n): generated(runs, folder, seed, n) for seed in (1, 2) for n in (128, 256)}
        cases = [(seed, n, nu, part) for seed, n in ((1, 256), (2, 256)) for nu in (0, 0.3) for part in (0.1, 0.3, 0.6)]
        cases += [(1, 128, nu, 0.3) for nu in (0, 0.3)]
        cases.sort(key=lambda case: (case[0], -case[1]))

        def run(seed, n, poisson, part):
            ratio = 2 * (1 - poisson) / (2 - poisson)
            velocity = part * friction / ratio * amplitude * 2 * math.pi * frequency
            material = ["--contact-modulus", ROUGH_MODULUS, "--poisson", poisson]
            motion = ["--normal-amplitude", amplitude, "--frequency", frequency]
            simulated = {k: runs.answer("oscillate", "--surface", surface[seed, n], "--pressure", pressure, *material,
                                        *motion, "--mode", "drag", "--drag-velocity", velocity, "--friction", friction,
                                        "--steps", k, "--levels", 4)["friction"] for k in (32, 64)}
            law = ["--friction-coefficient", friction, *motion, "--velocities", velocity, *material]
            springs = runs.answer("sliding", "--surface", surface[seed, n], "--pressure", pressure, *law)
            curve = f"{folder}/{seed}-{n}-{poisson}-{part}.h5"
            runs.answer("contact", surface[seed, n], "--pressure", f"{pressure / 6}:{6 * pressure}:50", "--stick",
                        "--stiffness", *material, "-o", curve)
            finer = runs.answer("sliding", "--curve", curve, "--pressure", pressure, *law)
            return simulated, springs, finer

        rows = []
        for (seed, n, poisson, part), (simulated, springs, finer) in zip(cases, runs.all(run, cases)):
            exact = simulated[64]["mean_tangential_force"] / simulated[64]["mean_force"]
            coarse = simulated[32]["mean_tangential_force"] / simulated[32]["mean_force"]
            of = springs["friction_coefficient"][0]
            slip = simulated[64]["slip_work"] / simulated[64]["dissipated"]
            rows.append([str(seed), f"{n}²", str(poisson), f"{springs['velocity'][0] / springs['critical_velocity']:.3f}",
                         f"{exact:.4f}", f"{of:.4f}", percent(of / exact - 1), f"{100 * abs(coarse / exact - 1) / 3:.2f} %",
                         f"{100 * abs(finer['friction_coefficient'][0] / of - 1):.2f} %", f"{slip:.2f}",
                         str(simulated[64]["periods"])])
        return table(["seed", "cells", "ν", "v/v_c", "T̄/F̄ in 3-D", "by the springs", "springs against 3-D",
                      "stated by the steps", "stated by the levels", "part by slip", "periods"], rows)


TABLES = {"shapes": shapes, "convergence": convergence, "rough": rough, "cells": cells, "mindlin": mindlin, "slip": slip,
          "sliding": sliding}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--tables", default="shapes,convergence,rough,cells,mindlin,slip,sliding")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--measured")
    parser.add_argument("--measured-name", default="measured")
    arguments = parser.parse_args()
    runs = Runs(arguments.program, arguments.jobs)
    for name in arguments.tables.split(","):
        lines = TABLES[name](runs, arguments)
        text = PAGE.read_text(encoding="utf-8")
        begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        before, rest = text.split(begin)
        after = rest.split(end)[1]
        PAGE.write_text(before + begin + "\n".join(lines) + "\n" + end + after, encoding="utf-8")


if __name__ == "__main__":
    main()
