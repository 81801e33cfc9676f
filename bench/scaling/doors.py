#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program does around a contact, and cycles with friction, by two builds in one run:  bench/scaling/doors.py OLD NEW [ROUNDS [JOB...]]

OLD and NEW are programs `salebra`. A line for each job: medians over ROUNDS (5) of the seconds of processor time of a program and its
children on one thread, start of the program included, their ratio, and the greatest memory of a process in MB. OLD and NEW take turns.
"""

import os
import statistics
import subprocess
import sys
import tempfile

SURFACE = "--hurst 0.8 --size-x 4mm --rolloff 400um --rms-slope 0.1 --overwrite"
OSCILLATION = """--pressure 200MPa --young 210GPa --poisson 0.3 --normal-amplitude 20nm --tangential-amplitude 50nm --phase 45deg
    --friction 0.3"""
JOBS = {
    "start": "--version",
    "contact 1024": "contact s1024.h5 --pressure 230MPa --contact-modulus 115GPa",
    "friction 256": f"oscillate --surface s256.h5 {OSCILLATION}",
    "coupled 128": f"oscillate --surface s128.h5 {OSCILLATION} --coupled --steps 32 --intervals 4",
    "coupled 256": f"oscillate --surface s256.h5 {OSCILLATION} --coupled --steps 32 --intervals 4",
    "generate 4096": f"generate --points 4096 --short-cutoff 16um {SURFACE} -o g.h5",
    "statistics 4096": "statistics s4096.h5 --overwrite -o s.json",
    "h5 to npy 4096": "convert s4096.h5 c.npy --overwrite",
    "txt to npy 2048": "convert s2048.txt c.npy --overwrite",
    "xyz to npy 2048": "convert s2048.xyz c.npy --overwrite",
}


def run(program, arguments):
    """Seconds of processor time, and megabytes."""
    command = [program, *arguments.split(), "--threads=1"]
    started = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = started.stderr.read()
    _, status, usage = os.wait4(started.pid, 0)
    if status:
        sys.exit(f"{arguments}: {errors.decode()}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3


def main():
    programs = [os.path.abspath(program) for program in sys.argv[1:3]]
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    jobs = sys.argv[4:] or list(JOBS)
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR", "/dev/shm")) as folder:
        os.chdir(folder)
        for points in (128, 256, 1024, 2048, 4096):
            cutoff = max(16, 4 * 4000 / points)
            run(programs[1], f"generate --points {points} --short-cutoff {cutoff}um {SURFACE} -o s{points}.h5")
        for form in ("txt", "xyz"):
            run(programs[1], f"convert s2048.h5 s2048.{form}")
        print(f"{'job':<16} {'old, s':>8} {'new, s':>8} {'ratio':>6} {'old, MB':>8} {'new, MB':>8}")
        for job in jobs:
            taken = [[run(program, JOBS[job]) for program in programs] for _ in range(rounds)]
            (old, new), (most, mine) = ([statistics.median(each[k][i] for each in taken) for k in (0, 1)] for i in (0, 1))
            print(f"{job:<16} {old:>8.2f} {new:>8.2f} {old / new:>6.1f} {most:>8.0f} {mine:>8.0f}", flush=True)


if __name__ == "__main__":
    main()
