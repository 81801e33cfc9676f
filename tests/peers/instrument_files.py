# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of instruments that SurfaceTopography's public tests read: salebra reads each as SurfaceTopography does, by itself or through
salebra-import, with the same points, sizes and rms height, or says what it lacks. Without the files (scripts/instrument-files) or the
Python package the test is skipped.

Usage: instrument_files.py PROGRAM FOLDER PYTHON-PACKAGE [TABLE.csv]
"""
import contextlib
import csv
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import warnings

import numpy as np

program, folder, package = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
if not folder.is_dir() or not any(folder.iterdir()):
    print("no files of instruments: run scripts/instrument-files")
    sys.exit(77)
if not (package / "salebra" / "_importing.py").exists():
    print("no Python package in the build tree: configure with -D SALEBRA_BUILD_PYTHON=ON")
    sys.exit(77)

import SurfaceTopography  # noqa: E402
from SurfaceTopography import open_topography  # noqa: E402

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6, "um": 1e-6, "nm": 1e-9, "Å": 1e-10, "pm": 1e-12, None: 1.0}
# Of one channel of several, the first of heights: SurfaceTopography's choice.
TOLERANCE = 1e-9


def by_peer(file, way="salebra"):
    """Points, sizes and rms height as SurfaceTopography has them; None where it refuses. Sizes of 1 where the file states none."""
    try:
        with warnings.catch_warnings(), contextlib.redirect_stderr(io.StringIO()):
            warnings.simplefilter("ignore")
            reader = open_topography(str(file))
            channel = reader.default_channel
            sizes = channel.physical_sizes
            missing = sizes is None or any(size is None for size in np.atleast_1d(sizes))
            topography = reader.topography(channel_index=channel.index, **({"physical_sizes": (1.0,) * channel.dim} if missing else {}))
            heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan)
            factor = METRES[topography.unit]
            highest = float(np.nanmax(np.abs(heights))) * factor
            found = {"dim": topography.dim, "points": heights.shape, "missing": missing, "unit": topography.unit}
            if topography.dim == 1:
                x = np.asarray(topography.positions(), dtype=float)
                n = len(x)
                if way == "salebra-import" and topography.unit is None:
                    x = np.linspace(x[0], x[-1], n)  # positions without a unit are not used
                even = x[0] + np.arange(n) * (x[-1] - x[0]) / (n - 1)
                if np.max(np.abs(even - x)) > 0.1 * (even[1] - even[0]):
                    heights = np.interp(even, x, heights)
                x = np.arange(n)
                defined = ~np.isnan(heights)
                line = np.polyfit(x[defined], heights[defined], 1)
                heights = heights - np.polyval(line, x)
                # A profile of salebra is a step longer than from its first point to its last.
                found["sizes"] = ((even[1] - even[0]) * n * factor,)
            else:
                found["sizes"] = tuple(float(size) * factor for size in topography.physical_sizes)
            found["highest"] = highest
            found["rms"] = float(np.nanstd(heights)) * factor
            found["whole"] = not np.isnan(heights).any()
            return found
    except Exception as error:  # a reader of another program may raise anything
        return f"{type(error).__name__}: {' '.join(str(error).split())[:80]}"


def by_salebra(file, path, *options):
    run = subprocess.run([program, "statistics", file, "--json", "--detrend", "none", *options], capture_output=True, text=True,
                         env={**os.environ, "PATH": path})
    message = run.stderr.strip().splitlines()[-1] if run.stderr.strip() else ""
    return (json.loads(run.stdout) if run.returncode == 0 else None), message.removeprefix("salebra: error: "), run.returncode


def difference(answer, peer):
    """What differs; empty where nothing does."""
    notes = []
    # Units in a text's header that SurfaceTopography does not look at.
    scale = next((unit for unit in METRES.values() if abs(answer["size_x"] / peer["sizes"][0] / unit - 1) < TOLERANCE), 1.0)
    scale = scale if peer["unit"] is None else 1.0
    peer = {**peer, "sizes": [scale * size for size in peer["sizes"]], "rms": scale * peer["rms"], "highest": scale * peer["highest"]}
    points = (answer["nx"], answer["ny"]) if "ny" in answer else (answer["nx"],)
    if points != peer["points"]:
        notes.append(f"points {points} and {peer['points']}")
    sizes = [answer["size_x"], answer.get("size_y")][: len(points)]
    if any(abs(mine / other - 1) > TOLERANCE for mine, other in zip(sizes, peer["sizes"])):
        notes.append(f"sizes {sizes} and {peer['sizes']}")
    if (peer["dim"] == 2 or peer["whole"]) and not abs(answer["rms_height"] - peer["rms"]) <= TOLERANCE * peer["rms"] + 1e-15 * peer["highest"]:
        notes.append(f"rms height {answer['rms_height']} and {peer['rms']}")
    return "; ".join(notes)


rows, failures = [], []
with tempfile.TemporaryDirectory() as scratch:
    helper = pathlib.Path(scratch) / "salebra-import"
    helper.write_text(f'#!/bin/sh\nPYTHONPATH="{package}" exec "{sys.executable}" -m salebra import "$@"\n')
    helper.chmod(0o755)
    bare = "/usr/bin:/bin"
    for file in sorted(folder.iterdir()):
        peer = by_peer(file)
        way, asked = "salebra", []
        answer, message, status = by_salebra(file, bare)
        if answer is None and "salebra[formats]" in message:
            way = "salebra-import"
            peer = by_peer(file, way)
            answer, message, status = by_salebra(file, f"{scratch}:{bare}")
        if answer is None and ("--size-x" in message or "--pixel-size" in message) and isinstance(peer, dict):
            asked = [f"--size-x={float(peer['sizes'][0])!r}", *([f"--size-y={float(peer['sizes'][1])!r}"] if peer["dim"] == 2 else [])]
            answer, message, status = by_salebra(file, f"{scratch}:{bare}", *asked)
        if status not in (0, 2):
            failures.append(f"{file.name}: status {status}: {message}")
        kind = "" if not isinstance(peer, dict) else "map" if peer["dim"] == 2 else "profile"
        if answer is None:
            outcome = "refused: " + message.replace(str(file), file.name)
        elif isinstance(peer, dict):
            note = difference(answer, peer)
            outcome = note or "equal" + (", its size being asked for" if asked else "")
            if note:
                failures.append(f"{file.name}: {note}")
        else:
            outcome = f"read; SurfaceTopography: {peer}"
        rows.append((file.name, kind, way if answer else "", outcome))

with contextlib.ExitStack() as stack:
    out = stack.enter_context(open(sys.argv[4], "w", newline="")) if len(sys.argv) > 4 else sys.stdout
    writer = csv.writer(out)
    writer.writerow(("file", "kind", "read by", "outcome"))
    writer.writerows(rows)
equal = sum(row[3].startswith("equal") for row in rows)
print(f"{len(rows)} files, {equal} equal to SurfaceTopography {SurfaceTopography.__version__}, "
      f"{sum(row[3].startswith('refused') for row in rows)} refused, {len(failures)} failed")
for failure in failures:
    print("FAILED", failure)
sys.exit(1 if failures else 0)
