# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces from files: what is done to their heights, and formats that SurfaceTopography reads."""

from __future__ import annotations

import math
import multiprocessing
import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import salebra
from conftest import generated
from salebra import _importing

# ISO 5436-2, which salebra does not read itself.
SDF = """aISO-1.0
ManufacID = Test
CreateDate = 040120100853
ModDate = 050320101353
NumPoints = 5
NumProfiles = 3
Xscale = 1.0E-6
Yscale = 2.0E-6
Zscale = 1.0E-6
Zresolution = 1.0E-9
Compression = 0
DataType = 7
CheckType = 0
*
0.01 0.02 0.03 0.02 0.01
0.02 0.03 0.01 0.02 0.01
0.03 0.01 0.02 0.02 0.04
*
"""


def test_spikes_are_undefined_and_what_is_undefined_is_cropped_or_filled(tmp_path: Path) -> None:
    clean = generated()
    heights = np.array(clean.heights)
    heights[5, 7] += 1e-4
    heights[30:40, 20:64] = np.nan
    dirty = salebra.Surface(heights, clean.size_x, clean.size_y)
    cleaned = dirty.despiked()
    assert math.isnan(cleaned.heights[5, 7])
    assert cleaned.undefined_points == 441
    assert salebra.Surface(heights, clean.size_x, clean.size_y).despiked(1e6).undefined_points == 440
    part = cleaned.cropped(*(cleaned.max_defined_part or ()))
    assert part.undefined_points == 0
    assert part.nx * part.ny >= 24 * 64

    salebra.write_surface(tmp_path / "scan.h5", dirty)
    with pytest.warns(UserWarning, match="1 point is isolated"):
        salebra.read_surface(tmp_path / "scan.h5")
    with pytest.warns(UserWarning, match="1 point far from its neighbours"):
        read = salebra.read_surface(tmp_path / "scan.h5", despike=6, crop=(0, 0, "0.4mm", "1mm"), fill=True)
    assert read.undefined_points == 0
    assert read.nx == 26
    # Filled by the smoothest surface: its own height to a part of the rms height of 1 µm.
    assert abs(read.heights[5, 7] - clean.heights[5, 7]) < 5e-7
    with pytest.raises(salebra.InvalidInput, match="crop: 3 numbers"):
        salebra.read_surface(tmp_path / "scan.h5", crop=(0, 0, 1))


def test_distances_units_and_axes_are_given_where_a_file_has_none(tmp_path: Path) -> None:
    heights = 1e-3 * np.arange(20.0).reshape(5, 4)
    np.savetxt(tmp_path / "scan.txt", heights)
    surface = salebra.read_surface(tmp_path / "scan.txt", pixel_size=("1um", "2um"), transpose=True, height_unit="um")
    assert surface.heights.shape == (5, 4)
    np.testing.assert_allclose(surface.heights, 1e-6 * heights, rtol=1e-15)
    assert (surface.size_x, surface.size_y) == pytest.approx((5e-6, 8e-6))
    assert salebra.read_surface(tmp_path / "scan.txt", pixel_size=1.0).size_x == pytest.approx(4.0)


def test_formats_of_instruments_are_read_by_surfacetopography(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography")
    (tmp_path / "scan.sdf").write_text(SDF)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        surface = salebra.read_surface(tmp_path / "scan.sdf")
    assert (surface.size_x, surface.size_y) == pytest.approx((5e-6, 6e-6), rel=1e-12)
    assert surface.heights[4, 2] == pytest.approx(4e-8, rel=1e-12)
    assert surface.heights[0, 1] == pytest.approx(2e-8, rel=1e-12)
    (tmp_path / "noise.bin").write_bytes(bytes(range(256)))
    with pytest.raises(salebra.InvalidInput, match=r"noise.bin: .*NUL bytes.*SurfaceTopography"):
        salebra.read_surface(tmp_path / "noise.bin")


def test_the_helper_writes_what_salebra_reads_and_refuses_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    h5py = pytest.importorskip("h5py")
    pytest.importorskip("SurfaceTopography")
    (tmp_path / "scan.sdf").write_text(SDF)
    (tmp_path / "noise.bin").write_bytes(bytes(range(256)))

    command = [sys.executable, "-m", "salebra", "import", "scan.sdf", "out.h5"]
    subprocess.run(command, cwd=tmp_path, check=True)
    with h5py.File(tmp_path / "out.h5") as document:
        assert dict(document.attrs)["units"] == "m"
        assert document.attrs["source_format"] == "sdf"
        assert document.attrs["origin"] == "scan.sdf"
    assert salebra.read_surface(tmp_path / "out.h5").heights.shape == (5, 3)
    assert subprocess.run(command, cwd=tmp_path, stderr=subprocess.DEVNULL).returncode == 2
    # In this process, since each import of SurfaceTopography takes seconds; a process is confined for good.
    monkeypatch.setattr(_importing, "_confine", lambda *_: None)
    monkeypatch.chdir(tmp_path)
    for arguments, reason in [
        (("scan.sdf", "out.h5"), "out.h5: exists"),
        (("absent.sdf", "new.h5"), "absent.sdf: does not exist"),
        (("noise.bin", "new.h5"), "noise.bin: is of no format"),
        (("scan.sdf", "new.h5", "--channel", "9"), "scan.sdf: has no channel 9"),
    ]:
        assert _importing.main(arguments) == 2
        said = capfd.readouterr().err
        assert said.startswith("salebra-import: error: " + reason)
        assert said.count("\n") == 1
    assert sorted(os.listdir(tmp_path)) == ["noise.bin", "out.h5", "scan.sdf"]


def test_the_helper_refuses_hdf5_what_is_no_file_and_its_own_input_as_output(tmp_path: Path) -> None:
    scan, link, pipe = tmp_path / "scan.sdf", tmp_path / "link.sdf", tmp_path / "pipe"
    scan.write_text(SDF)
    link.symlink_to(scan)
    os.mkfifo(pipe)
    for place in (0, 512, 4096):
        (tmp_path / "hidden.bin").write_bytes(bytes(place) + b"\x89HDF\r\n\x1a\n" + bytes(100))
        with pytest.raises(_importing.ImportRefusal, match="is HDF5"):
            _importing.import_surface(tmp_path / "hidden.bin", tmp_path / "new.h5")
    for file in (pipe, "/dev/zero", tmp_path):
        with pytest.raises(_importing.ImportRefusal, match="is no regular file"):
            _importing.import_surface(file, tmp_path / "new.h5")
    for out in (pipe, "/dev/null", tmp_path):
        with pytest.raises(_importing.ImportRefusal, match="is no regular file"):
            _importing.import_surface(scan, out)
    for out in (scan, link):
        with pytest.raises(_importing.ImportRefusal, match="is the file to write too"):
            _importing.import_surface(scan, out)
    assert scan.read_text() == SDF


def _slope(seed: int) -> float:
    return float(generated(32, seed).moments.rms_slope)


def test_a_forked_child_computes() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of forking a process with threads
        here = [_slope(seed) for seed in (1, 2)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            assert pool.map_async(_slope, (1, 2)).get(timeout=60) == here


def test_an_oscillation_takes_its_frequency_and_losses_are_a_table() -> None:
    by_frequency = salebra.Drag(normal_amplitude=1e-8, drag_velocity=1e-6, frequency="20kHz")
    assert by_frequency.angular_frequency == pytest.approx(2 * math.pi * 2e4, rel=1e-15)
    assert salebra.Drag(normal_amplitude=1e-8, drag_velocity=1e-6, frequency=2e4) == by_frequency
    with pytest.raises(salebra.InvalidInput, match="frequency: was given beside angular_frequency"):
        salebra.Drag(normal_amplitude=1e-8, drag_velocity=1e-6, frequency=1, angular_frequency=1)
    pytest.importorskip("pandas")
    surface, material = generated(32), salebra.Material(1e9, poisson=0.3)
    curve = salebra.sweep_pressures(surface, material, np.geomspace(1e6, 5e6, 4))
    answers = salebra.surface_damping(surface, material, by_frequency, curve)
    frame = answers.to_dataframe()
    assert list(frame["damping_constant"]) == [answer.damping_constant for answer in answers]
    assert frame.attrs["units"]["damping_constant"] == "N s/m"
