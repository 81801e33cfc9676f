# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces, their memory and what is measured on them."""

from __future__ import annotations

import gc
import warnings
import weakref
from pathlib import Path

import numpy as np
import pytest

import salebra
from conftest import generated


def test_a_surface_shares_the_memory_of_its_array() -> None:
    heights = np.random.default_rng(1).normal(size=(96, 64))
    surface = salebra.Surface(heights, 3e-3, 2e-3)
    assert np.shares_memory(surface.heights, heights)
    heights[5, 7] = 42.0
    assert surface.heights[5, 7] == 42.0
    # The library sees it too, not only the property.
    assert salebra.height_statistics(surface).maximum == 42.0


def test_an_array_outlives_its_name_in_a_surface_and_is_freed_with_it() -> None:
    class Array(np.ndarray):
        """One that can be watched."""

    heights = np.zeros((32, 32)).view(Array)
    watched = weakref.ref(heights)
    surface = salebra.Surface(heights, 1.0, 1.0)
    del heights
    gc.collect()
    assert salebra.height_statistics(surface).rms_height == 0.0
    view = surface.heights
    del surface
    gc.collect()
    assert view[0, 0] == 0.0
    del view
    gc.collect()
    assert watched() is None


@pytest.mark.parametrize("array", [
    np.arange(12.0, dtype=np.float32).reshape(3, 4), np.asfortranarray(np.arange(12.0).reshape(3, 4)),
    np.arange(24.0).reshape(3, 8)[:, ::2], np.arange(12).reshape(3, 4), [[0.0, 1.0], [2.0, 3.0]],
])  # fmt: skip
def test_whatever_numpy_understands_is_taken_with_x_first(array: object) -> None:
    surface = salebra.Surface(array, 1.0, 1.0)
    assert np.array_equal(surface.heights, np.asarray(array))
    assert not np.shares_memory(surface.heights, np.asarray(array))


def test_an_array_that_is_not_aligned_is_copied_and_right() -> None:
    memory = np.zeros(16 * 16 * 8 + 8, dtype=np.uint8)
    start = 8 if memory.ctypes.data % 16 == 0 else 0
    heights = memory[start : start + 16 * 16 * 8].view(np.float64).reshape(16, 16)
    heights[:] = np.random.default_rng(2).normal(size=(16, 16))
    surface = salebra.Surface(heights, 1.0, 1.0)
    assert np.isclose(salebra.height_statistics(surface).rms_height, heights.std(), rtol=1e-14)


def test_a_read_only_array_stays_read_only() -> None:
    heights = np.zeros((8, 8))
    heights.flags.writeable = False
    surface = salebra.Surface(heights, 1.0, 1.0)
    assert np.shares_memory(surface.heights, heights)
    assert not surface.heights.flags.writeable


def test_heights_of_a_generated_surface_are_a_view_that_keeps_it() -> None:
    surface = generated()
    heights = surface.heights
    rms = heights.std()
    del surface
    gc.collect()
    assert heights.std() == rms


def test_the_shape_is_checked_and_named() -> None:
    with pytest.raises(TypeError):
        salebra.Surface(np.zeros(8), 1.0, 1.0)
    with pytest.raises(salebra.InvalidInput, match="size_x: -1 must be"):
        salebra.Surface(np.zeros((8, 8)), -1.0, 1.0)


def test_random_phase_has_the_rms_height_of_its_lattice() -> None:
    grid = salebra.Grid2D(64, 48, 1e-3, 0.75e-3)
    spectrum = salebra.SelfAffineSpectrum(hurst=0.7, rolloff=4e-4, short_cutoff=1.3e-4, rms_height=1e-6)
    surface = salebra.random_phase(grid, spectrum, 3)
    expected = spectrum.lattice_moments(grid)
    # Both are sums over the same modes: rounding alone.
    assert np.isclose(surface.heights.std(), expected.rms_height, rtol=1e-12)
    assert np.isclose(surface.moments.rms_slope, expected.rms_slope, rtol=1e-12)


def test_seeds_give_the_same_bits_whatever_the_threads() -> None:
    before = salebra.threads()
    try:
        salebra.set_threads(1)
        one = generated(seed=5).heights.copy()
        salebra.set_threads(2)
        assert np.array_equal(generated(seed=5).heights, one)
    finally:
        salebra.set_threads(before)


def test_the_power_spectrum_sums_to_the_mean_square_height(surface: salebra.Surface) -> None:
    spectrum = salebra.power_spectrum(surface)
    weights = np.full(spectrum.psd.shape[1], 2.0)
    weights[0] = weights[-1] = 1.0
    assert np.isclose((spectrum.psd * weights).sum() * spectrum.cell, surface.heights.var(), rtol=1e-12)


def test_a_plane_is_subtracted_and_undefined_points_are_kept() -> None:
    x, y = np.meshgrid(np.arange(16.0), np.arange(16.0), indexing="ij")
    heights = 2e-6 * x - 1e-6 * y
    heights[3, 4] = np.nan
    flat = salebra.Surface(heights, 1e-3, 1e-3).detrended("plane")
    assert flat.undefined_points == 1
    assert np.nanmax(np.abs(flat.heights)) < 1e-18
    with pytest.raises(salebra.InvalidInput, match="method: 'plan' is none of none, mean, plane, quadratic, lines"):
        flat.detrended("plan")


def test_a_wave_of_the_cut_off_keeps_half_of_its_amplitude() -> None:
    x = np.arange(128) / 128
    heights = np.sin(2 * np.pi * 4 * x)[:, None] * np.ones(16)
    wave = salebra.Surface(heights, 1.0, 1.0, periodic=True)
    # Round-off of the transforms.
    np.testing.assert_allclose(wave.filtered(s_filter=0.25).heights, heights / 2, atol=1e-14)
    np.testing.assert_allclose(salebra.filtered(wave, l_filter=0.25).heights, heights / 2, atol=1e-14)
    with pytest.raises(salebra.InvalidInput, match="l_filter"):
        wave.filtered(l_filter=2.0)


def test_profiles_of_a_sine_have_its_parameters() -> None:
    x = np.arange(1000) / 1000
    surface = salebra.Surface(np.sin(2 * np.pi * (10 * x + 0.01))[:, None] * np.array([1.0, 3.0]), 1.0, 1.0)
    along = salebra.profile_parameters(surface, "x")
    # Sums over 100 points per wave differ from integrals by (2π/100)²/12.
    assert along.Ra == pytest.approx(2 * 2 / np.pi, rel=5e-4)
    assert along.Rz == pytest.approx(4, rel=5e-4)
    assert along.Rsm == pytest.approx(0.1, rel=1e-6)
    assert along.Ra_deviation == pytest.approx(2 / np.pi * 2**0.5, rel=5e-4)
    assert (along.profiles, along.sections) == (2, 1)
    assert salebra.profile_parameters(surface, "x", l_filter=0.2).sections == 5


def test_a_file_keeps_heights_size_and_period(tmp_path: Path, surface: salebra.Surface) -> None:
    for name in ("s.h5", "s.npy"):
        salebra.write_surface(tmp_path / name, surface)
        back = salebra.read_surface(tmp_path / name)
        assert np.array_equal(back.heights, surface.heights)
        assert back.grid == surface.grid
        assert back.periodic
    with pytest.raises(salebra.InvalidInput, match="exists"):
        salebra.write_surface(tmp_path / "s.h5", surface)
    salebra.write_surface(tmp_path / "s.h5", surface, overwrite=True)


def test_the_scan_of_the_readme_has_its_rms_height(measured: Path) -> None:
    surface = salebra.read_surface(measured).detrended()
    # README: 35.22 nm, slope 0.1924.
    assert np.isclose(surface.height_statistics.rms_height, 35.22e-9, atol=0.005e-9)
    assert not surface.periodic


def test_surfacetopography_and_back() -> None:
    topography = pytest.importorskip("SurfaceTopography")
    heights = np.random.default_rng(3).normal(size=(24, 16))
    surface = salebra.Surface.from_topography(topography.Topography(heights, (3.0, 2.0), unit="um", periodic=True))
    assert np.allclose(surface.heights, heights * 1e-6, rtol=1e-15)
    assert (surface.size_x, surface.size_y) == pytest.approx((3e-6, 2e-6), rel=1e-15)
    assert surface.periodic
    back = surface.to_topography()
    assert np.array_equal(back.heights(), surface.heights)
    assert np.isclose(back.rms_height_from_area(), surface.height_statistics.rms_height, rtol=1e-12)
    with pytest.raises(salebra.InvalidInput, match="has no unit"):
        salebra.Surface.from_topography(topography.Topography(heights, (3.0, 2.0)))


def test_summits_are_columns_without_copies(surface: salebra.Surface) -> None:
    summits = salebra.find_summits(surface)
    assert summits.height.shape == (len(summits),)
    assert summits.height.base is not None
    assert summits[0].height == summits.height[0]
    statistics = salebra.summit_statistics(summits)
    assert np.isclose(statistics.mean_height, summits.height.mean(), rtol=1e-12)


def test_heights_that_are_complex_or_infinite_are_refused() -> None:
    heights = np.zeros((8, 8))
    with pytest.raises(TypeError, match="heights: wanted real numbers, got an array of shape .* and type complex128"):
        salebra.Surface(heights.astype(complex), 1e-3, 1e-3)
    with pytest.raises(TypeError, match="heights: wanted real numbers"):
        salebra.Surface(np.ma.masked_array(heights.astype(complex)), 1e-3, 1e-3)
    heights[2, 3] = -np.inf
    with pytest.raises(salebra.InvalidInput, match="heights: infinity is no height; NaN is an undefined point"):
        salebra.Surface(heights, 1e-3, 1e-3)
    heights[2, 3] = np.nan
    assert salebra.Surface(heights, 1e-3, 1e-3).undefined_points == 1


def test_a_labelled_array_has_its_axes_sizes_and_units() -> None:
    xarray = pytest.importorskip("xarray")
    rows_are_y = np.arange(12.0).reshape(3, 4)
    x = xarray.DataArray(1.1 * np.arange(4), dims="x", attrs={"units": "um"})
    y = xarray.DataArray(2e-6 * np.arange(3)[::-1], dims="y")  # pictures begin at the top; without units it is m
    labelled = xarray.DataArray(rows_are_y, dims=("y", "x"), coords={"x": x, "y": y}, attrs={"units": "nm"})
    surface = salebra.Surface(labelled)  # type: ignore[call-arg, unused-ignore]
    assert np.allclose(surface.heights, 1e-9 * rows_are_y[::-1].T, rtol=1e-15)
    assert np.allclose([surface.size_x, surface.size_y], [4.4e-6, 6e-6], rtol=1e-12)
    assert salebra.Surface(labelled, 1e-3, 2e-3).size_y == 2e-3
    again = salebra.Surface(surface.to_xarray().heights)  # type: ignore[call-arg, unused-ignore]
    assert np.array_equal(again.heights, surface.heights)
    with pytest.raises(salebra.InvalidInput, match=r"heights.x: is not evenly spaced"):
        salebra.Surface(labelled.assign_coords(x=[0.0, 1.0, 2.0, 4.0]))  # type: ignore[call-arg, unused-ignore]


def test_heights_whose_unit_was_forgotten_are_doubted_once(surface: salebra.Surface, tmp_path: Path) -> None:
    with pytest.warns(UserWarning, match=r"Surface: rms slope \S+ is above 1; are the heights in nm\? Then the rms slope would be 0\.0") as told:
        wrong = salebra.Surface(surface.heights * 1e9, surface.size_x, surface.size_y)
        salebra.press(wrong, 1e9, pressure=1e6)
    assert len(told) == 1
    assert told[0].filename == __file__
    holed = surface.heights * 1e9
    holed[:, 3] = np.nan  # in every row
    with pytest.warns(UserWarning, match=r"Surface: rms slope \S+ is above 1; are the heights in nm\?"):
        salebra.Surface(holed, surface.size_x, surface.size_y)
    np.savetxt(tmp_path / "scan.txt", surface.heights.T * 1e6)
    sizes = {"size_x": surface.size_x, "size_y": surface.size_y}
    with pytest.warns(UserWarning, match=r"scan.txt: rms slope \S+ is above 1; are the heights in µm\?") as told:
        salebra.read_surface(tmp_path / "scan.txt", **sizes)
    assert len(told) == 1
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        salebra.Surface(surface.heights, surface.size_x, surface.size_y)
        salebra.read_surface(tmp_path / "scan.txt", height_unit="um", **sizes)
