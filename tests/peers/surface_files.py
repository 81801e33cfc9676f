# SPDX-License-Identifier: GPL-3.0-or-later
"""SurfaceTopography reads what salebra writes, and salebra what SurfaceTopography writes: the same heights, sizes, units and undefined
points, with x and y the right way round. GSF, which SurfaceTopography does not read, is read by gsffile, and HDF5 by h5py.

Usage: surface_files.py PROGRAM FOLDER of measured surfaces
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import gsffile
import h5py
import numpy as np
import SurfaceTopography

program, measured = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []
lines = []


def salebra(*arguments):
    run = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(f"salebra {arguments[0]}: {run.stderr.strip()}")
    return run.stdout


def heights_of(topography):
    """In metres, NaN where undefined."""
    factor = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "um": 1e-6, "nm": 1e-9}[topography.unit]
    sizes = tuple(factor * size for size in topography.physical_sizes)
    return np.ma.filled(topography.heights().astype(float), np.nan) * factor, sizes


def read_by_peer(file, heights, sizes):
    """Heights, sizes and, where the format has one, the flag of periodicity, as another program reads them."""
    if file.suffix == ".gsf":
        data, notes = gsffile.read_gsf(file)
        assert notes["XYUnits"] == "m" and notes["ZUnits"] == "m", notes
        return data.T.astype(float), (notes["XReal"], notes["YReal"]), None
    if file.suffix == ".h5":
        with h5py.File(file) as content:
            data = content["heights"]
            assert data.attrs["units"] == "m", dict(data.attrs)
            return data[...], (data.attrs["size_x"], data.attrs["size_y"]), bool(data.attrs["periodic"])
    if file.suffix == ".npy":
        notes = json.loads(pathlib.Path(f"{file}.json").read_text())
        sizes = (notes["size_x"], notes["size_y"])
        topography = SurfaceTopography.read_topography(file, physical_sizes=sizes, unit=notes["units"])
        return *heights_of(topography), notes["periodic"]
    topography = SurfaceTopography.read_topography(file)
    assert topography.unit == "m", topography.unit
    return *heights_of(topography), None


def compare(what, found, expected, size_found, size_expected, tolerance):
    """Undefined points must be the same; a NaN on one side only makes the difference NaN, which fails."""
    note = ""
    if found.shape != expected.shape:
        note = f"shape {found.shape} instead of {expected.shape}"
    elif not np.array_equal(np.isnan(found), np.isnan(expected)):
        note = f"{np.isnan(found).sum()} undefined points, not where the {np.isnan(expected).sum()} are"
    else:
        scale = np.nanmax(np.abs(expected))
        off = np.nanmax(np.abs(found - expected)) / scale
        corners = [(0, 0), (-1, 0), (0, -1), (-1, -1)]
        apart = [corner for corner in corners
                 if not np.isnan(expected[corner]) and abs(found[corner] - expected[corner]) > tolerance * scale]
        size_off = max(abs(a / b - 1) for a, b in zip(size_found, size_expected))
        # Steps and positions are rounded once more than sizes.
        if not off <= tolerance or size_off > 4e-16 * max(expected.shape) or apart:
            note = f"heights differ by {off:.1e} of the greatest, sizes by {size_off:.1e}, corners {apart}"
    lines.append(f"{'FAILED' if note else 'ok    '} {what}{': ' if note else ''}{note}")
    if note:
        failures.append(what)


def both_ways(folder, name, heights, sizes, periodic):
    """Array and sidecar -> every format -> the other program; and the other program's files -> salebra."""
    source = folder / f"{name}.npy"
    np.save(source, heights)
    pathlib.Path(f"{source}.json").write_text(
        json.dumps({"size_x": sizes[0], "size_y": sizes[1], "units": "m", "periodic": periodic}))
    complete = not np.isnan(heights).any()
    for suffix in [".npy", ".txt", ".gsf", ".h5", ".xyz"]:
        file = folder / f"{name}-by-salebra{suffix}"
        salebra("convert", source, file)
        found, size, flag = read_by_peer(file, heights, sizes)
        tolerance = 6e-8 if suffix == ".gsf" else 0 if suffix in (".npy", ".h5") else 1e-15
        compare(f"{name}{suffix} by salebra, read by the other", found, heights, size, sizes, tolerance)
        if flag is not None and flag != periodic:
            failures.append(f"{name}{suffix}: periodic is {flag} instead of {periodic}")

    masked = np.ma.masked_invalid(heights)
    topography = SurfaceTopography.Topography(masked if not complete else heights, sizes, unit="m", periodic=periodic)
    written = {}
    for kind in "DFLI":
        written[f"-{kind}.x3p"] = lambda file, kind=kind: topography.to_x3p(file, dtype=kind)
    if complete:
        written[".txt"] = topography.to_matrix
    span = np.nanmax(heights) - np.nanmin(heights)
    # Rounding to float32, to 2^32 and to 2^16 steps of the span.
    tolerances = {"-F.x3p": 6e-8, "-L.x3p": 2**-32 * span / np.nanmax(np.abs(heights)) + 1e-15,
                  "-I.x3p": 2**-16 * span / np.nanmax(np.abs(heights)), ".txt": 1e-15, "-D.x3p": 0}
    for suffix, write in written.items():
        file = folder / f"{name}-by-other{suffix}"
        write(str(file))
        back = folder / f"{name}-by-other{suffix}.npy"
        salebra("convert", file, back)
        notes = json.loads(pathlib.Path(f"{back}.json").read_text())
        size = (notes["size_x"], notes["size_y"])
        # SurfaceTopography writes steps of X3P with 16 digits.
        expected_size = size if all(abs(a / b - 1) <= 1e-15 for a, b in zip(size, sizes)) else sizes
        compare(f"{name}{suffix} by the other, read by salebra", np.load(back), heights, size, expected_size,
                tolerances[suffix])


with tempfile.TemporaryDirectory() as scratch:
    folder = pathlib.Path(scratch)
    x, y = np.meshgrid(np.arange(7), np.arange(4), indexing="ij")
    # No symmetry: mirrored or transposed heights differ, in their corners too.
    heights = 1e-8 * (np.sin(1 + 0.7 * x + 0.3 * y**2) + 0.1 * x - 0.05 * y)
    both_ways(folder, "complete", heights, (1e-6 / 3, 2.1e-6), True)
    holes = heights.copy()
    holes[0, 1] = holes[5, 2] = holes[6, 3] = np.nan
    both_ways(folder, "holes", holes, (3e-6, 2e-6), False)

    for name in ["matrix-3.txt", "x3p-2.x3p", "sur-2.sur"]:
        by_other, sizes = heights_of(SurfaceTopography.read_topography(measured / name))
        file = folder / (name + ".npy")
        salebra("convert", measured / name, file)
        found, size, _ = read_by_peer(file, by_other, sizes)
        # Both sides multiply by the unit, salebra after it and SurfaceTopography before.
        compare(f"{name} -> .npy, read by both", found, by_other, size, sizes, 4e-16)

print("\n".join(lines))
print(f"{len(lines)} comparisons by SurfaceTopography {SurfaceTopography.__version__}, {len(failures)} failed")
for failure in failures:
    print("FAILED", failure)
sys.exit(1 if failures or not lines else 0)
