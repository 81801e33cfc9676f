# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare the statistics of measured surfaces by salebra and by SurfaceTopography, as a Markdown table.

Both subtract the least-squares plane of the defined points. Numbers of SurfaceTopography are brought to salebra's conventions:
C = C_2D/(2π)², C₁ = C_1D/(2π), S = 2 A. Curves are compared point by point; the table has the median and the greatest relative
difference, and for the spectra their values at the wave number of a tenth of the scan.
"""

import argparse
import json
import pathlib
import subprocess

import numpy as np
from SurfaceTopography import Topography, read_topography
from SurfaceTopography.FFTTricks import get_window_2D


def salebra(program, file, *options):
    command = [program, "statistics", str(file), "--all", "--json", "--quiet", "--detrend", "plane", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def numbers(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def ring_means(topography, window):
    """Mean of SurfaceTopography's two-dimensional spectrum over salebra's rings, four to the octave."""
    nx, ny = topography.nb_grid_pts
    lx, ly = topography.physical_sizes
    _, _, density = topography.power_spectrum_from_area(window=window, reliable=False, return_map=True)
    qx = 2 * np.pi * np.fft.fftfreq(nx, lx / nx)[:, None]
    qy = 2 * np.pi * np.fft.fftfreq(ny, ly / ny)[None, :]
    q = np.hypot(qx, qy).ravel()
    ring = np.floor(np.log2(np.where(q > 0, q, 1) / (2 * np.pi / max(lx, ly))) * 4 + 0.5).astype(int)
    used = q > 0
    counts = np.bincount(ring[used])
    sums = np.bincount(ring[used], weights=np.ma.filled(density, np.nan).ravel()[used])
    return sums[counts > 0] / counts[counts > 0] / (4 * np.pi**2), counts[counts > 0]


def compare(program, file):
    topography = read_topography(str(file))
    to_metres = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9, "A": 1e-10, "Å": 1e-10}
    topography = topography.to_unit("m") if topography.unit in to_metres else topography
    topography = topography.detrend("height")
    own = salebra(program, file)
    dx, dy = topography.pixel_size
    rows = []

    def scalar(name, ours, theirs, why=""):
        rows.append((name, f"{ours:.6g}", f"{theirs:.6g}", f"{ours / theirs - 1:+.1e}", why))

    def curve(name, ours, theirs, why=""):
        n = min(len(ours), len(theirs))
        difference = np.abs(ours[:n] / theirs[:n] - 1)
        difference = difference[np.isfinite(difference)]
        middle = n // 2
        rows.append((name, f"{ours[middle]:.6g}", f"{theirs[middle]:.6g}",
                     f"{np.median(difference):.1e}, at most {np.max(difference):.1e}", why))

    scalar("rms height, m", own["areal"]["Sq"], topography.rms_height_from_area())
    # Its stencil is a cell of four points, two of which count with a factor of 0: a hole takes more differences away than it need.
    beside_holes = ("SurfaceTopography leaves out a point whose cell has an undefined corner, salebra one whose two differences are "
                    "undefined; the steepest points stand beside holes") if own["undefined_points"] > 0 else ""
    scalar("rms slope, differences", own["differences"]["rms_slope"], topography.rms_gradient(), beside_holes)
    scalar("Sdq", own["areal"]["Sdq"], topography.rms_gradient(),
           "triangles of both diagonals: the edges of each cell, not the points with both differences")
    distance, half = topography.autocorrelation_from_profile(resampling_method=None, reliable=False)
    structure = numbers(own["correlation_x"]["structure"])
    curve("S along x, m²", structure[1:], 2 * np.ma.filled(half, np.nan)[1 : len(structure)])
    spacing = numbers(own["scale_x"]["spacing"])
    root_mean_square = lambda x, y=None: np.sqrt(np.mean(x**2))  # noqa: E731
    few = slice(0, None, 4)
    theirs = topography.scale_dependent_statistical_property(root_mean_square, n=1, distance=spacing[few], reliable=False)[1]
    curve("slope along x over distance", numbers(own["scale_x"]["profile_slope"])[few], theirs,
          "SurfaceTopography leaves out the last rows in y too, so that x and y have the same points")
    theirs = topography.scale_dependent_statistical_property(root_mean_square, n=2, distance=2 * spacing[few], reliable=False)[1]
    curve("curvature along x over distance, 1/m", numbers(own["scale_x"]["profile_curvature"])[few], theirs,
          "as for the slope")
    if own["undefined_points"] > 0:
        rows.append(("spectra", "–", "–", "–", "neither has one with undefined points"))
        return own, rows
    radial = salebra(program, file, "--window", "radial-hann")["psd"]
    density, counts = ring_means(topography, "hann")
    assert np.array_equal(counts, numbers(radial["modes"]).astype(int)), "the rings differ"
    curve("C(q), radial Hann window, m⁴", numbers(radial["psd"]), density,
          "salebra subtracts the weighted mean, so that the window does not spread it into the longest waves")
    window = get_window_2D("hann", *topography.nb_grid_pts, topography.physical_sizes)
    heights = topography.heights()
    centred = Topography(heights - np.sum(window * heights) / np.sum(window), topography.physical_sizes)
    curve("the same, from heights less their weighted mean", numbers(radial["psd"]), ring_means(centred, "hann")[0])
    hann = numbers(own["psd"]["psd"])
    curve("C(q), salebra's window, m⁴", hann, density,
          "product of two Hann windows: sees the corners of the scan; a window of another kind has other scatter")
    q, profile = topography.power_spectrum_from_profile(window="hann", resampling_method=None, reliable=False)
    ours = numbers(own["profile_psd_x"]["psd"])
    n = min(len(ours), len(profile) - 1)
    curve("C₁(q) along x, m³", ours[:n], np.ma.filled(profile, np.nan)[1 : n + 1] / (2 * np.pi),
          "each profile less its weighted mean; SurfaceTopography leaves the mean of a profile in")
    return own, rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="salebra")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    args = parser.parse_args()
    for file in args.files:
        own, rows = compare(args.program, file)
        print(f"**{file.name}**, {own['nx']} × {own['ny']} points, {own['undefined_points']} undefined\n")
        print("| quantity | salebra | SurfaceTopography | relative difference | reason |\n|---|---|---|---|---|")
        for row in rows:
            print("| " + " | ".join(row) + " |")
        print()


if __name__ == "__main__":
    main()
