# SPDX-License-Identifier: GPL-3.0-or-later
"""The plain average of several scans, equal weights and no instruments, is SurfaceTopography's average power spectrum: for a container
made here of maps of several sizes, and for the containers among its test files where scripts/instrument-files has fetched them.

Usage: container_average.py FOLDER PYTHON-PACKAGE
"""
import pathlib
import sys
import warnings

import numpy as np

folder, package = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
if not (package / "salebra" / "surfaces.py").exists():
    print("no Python package in the build tree: configure with -D SALEBRA_BUILD_PYTHON=ON")
    sys.exit(77)
sys.path.insert(0, str(package))

from SurfaceTopography import Topography, read_container  # noqa: E402
from SurfaceTopography.Container.SurfaceContainer import InMemorySurfaceContainer  # noqa: E402

import salebra  # noqa: E402

TOLERANCE = 1e-6


def made_here():
    """Maps of 100, 40 and 10 µm, of other shapes and an odd number of points among them."""
    maps = []
    for seed, (nx, ny, lx, ly) in enumerate([(128, 128, 1e-4, 1e-4), (96, 65, 4e-5, 3e-5), (200, 100, 1e-5, 1e-5)]):
        spectrum = salebra.SelfAffineSpectrum(hurst=0.7, rolloff=lx / 2, short_cutoff=4 * lx / nx, rms_height=1e-7)
        noise = 1e-9 * np.random.default_rng(seed).normal(size=(nx, ny))  # without it rounding alone is beyond the cut-off
        surface = salebra.filtered_noise(salebra.Grid2D(nx, ny, lx, ly), spectrum, seed)
        maps.append(Topography(surface.heights + noise, (lx, ly), unit="m", periodic=False))
    return InMemorySurfaceContainer(maps)


def difference(container):
    """Largest relative difference of wave number and spectrum, and the numbers of maps, of lines, and of uneven or incomplete scans."""
    whole = [scan for scan in container if scan.is_uniform and not scan.has_undefined_data]
    left_out = len(container) - len(whole)
    container = InMemorySurfaceContainer(whole)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        # The window is named: that of periodic maps would be none.
        q, psd = container.power_spectrum("m", reliable=False, window="hann")
    there = ~np.ma.getmaskarray(q)
    scans, maps, lines = [], 0, 0
    for topography in container:
        inside = topography.to_unit("m")
        heights = np.ascontiguousarray(np.asarray(inside.heights(), dtype=float).reshape(inside.nb_grid_pts[0], -1))
        size = inside.physical_sizes
        scans.append(salebra.plain_spectrum(salebra.Surface(heights, size[0], size[-1])))
        maps, lines = maps + (inside.dim == 2), lines + (inside.dim == 1)
    mean = salebra.plain_average(scans)
    if len(mean.bin) != there.sum():
        return np.inf, maps, lines, left_out
    # Its spectrum is 2π that of salebra.
    off_q = np.max(np.abs(mean.wavenumber / q[there].data - 1))
    off_psd = np.max(np.abs(2 * np.pi * mean.psd / psd[there].data - 1))
    return max(off_q, off_psd), maps, lines, left_out


failed = False
containers = {"made here": [made_here()]}
for file in sorted(folder.glob("*.zip")) if folder.is_dir() else []:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        containers[file.name] = read_container(str(file))
for name, found in containers.items():
    for container in found:
        off, maps, lines, left_out = difference(container)
        failed |= not off < TOLERANCE
        print(f"{name}: {maps} maps, {lines} lines, {left_out} uneven or incomplete left out, largest difference {off:.1e}{'' if off < TOLERANCE else ' FAILED'}")
sys.exit(failed)
