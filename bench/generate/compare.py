# SPDX-License-Identifier: GPL-3.0-or-later
"""Time the generation of one self-affine surface by salebra, Tamaas, SurfaceTopography and plain numpy, side by side.

All make n x n points with Hurst exponent 0.8, roll-off at an eighth of the side and the shortest wavelength of eight cells, on one
thread. Times are medians of processor time, which a busy machine disturbs little; the programs take turns.
"""

import argparse
import json
import statistics
import subprocess
import time

import numpy as np


def tamaas(n, cells):
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    spectrum = tm.Isopowerlaw2D()
    spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = 8, 8, int(n / cells), 0.8

    def run(seed):
        generator = tm.SurfaceGeneratorFilter2D([n, n])
        generator.spectrum = spectrum
        generator.random_seed = seed
        return generator.buildSurface()

    return run


def surface_topography(n, cells):
    from SurfaceTopography.Generation import fourier_synthesis

    def run(seed):
        np.random.seed(seed)
        return fourier_synthesis((n, n), (1.0, 1.0), 0.8, rms_slope=0.1, long_cutoff=1 / 8,
                                 short_cutoff=cells / n).heights()

    return run


def plain_numpy(n, cells):
    def run(seed):
        random = np.random.default_rng(seed)
        q = np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.fft.rfftfreq(n, 1 / n)[None, :])
        amplitude = np.where(q < 8, 1.0, (np.maximum(q, 8) / 8) ** -1.8)
        amplitude[(q == 0) | (q > n / cells)] = 0
        noise = random.standard_normal(q.shape) + 1j * random.standard_normal(q.shape)
        return np.fft.irfft2(noise * amplitude, s=(n, n))

    return run


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="the benchmark program `generate`")
    parser.add_argument("--points", type=int, nargs="+", default=[2048, 4096])
    parser.add_argument("--cells", type=float, default=8)
    parser.add_argument("--repeats", type=int, default=5)
    args = parser.parse_args()

    print(f"{'points':>7} {'program':<28} {'seconds':>9} {'over salebra':>13}")
    for n in args.points:
        peers = {"Tamaas": tamaas, "SurfaceTopography": surface_topography, "numpy": plain_numpy}
        makers = {name: make(n, args.cells) for name, make in peers.items()}
        times = {name: [] for name in makers}
        own = []
        for seed in range(1, args.repeats + 1):
            command = [args.program, str(n), str(args.cells), "1", "3"]
            own.append(json.loads(subprocess.run(command, check=True, capture_output=True).stdout))
            for name, make in makers.items():
                start = time.process_time()
                make(seed)
                times[name].append(time.process_time() - start)
        median = {key: statistics.median(run[key] for run in own) for key in own[0]}
        reference = median["filtered_noise"]
        fft = min(median["fft_estimate"], median["fft_measured"])
        rows = {"salebra, filtered noise": reference, "salebra, random phase": median["random_phase"],
                "one c2r FFT (FFTW)": fft, "normal numbers of all modes": median["random_numbers_of_all_modes"]}
        rows |= {name: statistics.median(values) for name, values in times.items()}
        for name, seconds in rows.items():
            print(f"{n:>7} {name:<28} {seconds:>9.4f} {seconds / reference:>13.2f}")
        best = min(makers, key=lambda name: rows[name])
        limit = 1.6 * fft + median["random_numbers_of_all_modes"]
        scaling = max(run["two_threads_over_one"] for run in own)
        print(f"{n:>7} faster than the best peer ({best}): {rows[best] / reference:.1f} times\n"
              f"{n:>7} over 1.6 FFT + random numbers: {reference / limit:.2f}\n"
              f"{n:>7} two threads: {scaling:.2f} times as fast as one\n"
              f"{n:>7} peak memory over the heights: {own[0]['memory_over_heights']:.3f}")


if __name__ == "__main__":
    main()
