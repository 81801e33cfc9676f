# SPDX-License-Identifier: GPL-3.0-or-later
"""The twin of several scans: what Python, the program and its list of scans make of the same files is the same."""

from __future__ import annotations

import copy
import pickle
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import salebra

GRID = salebra.Grid2D(256, 256, 1e-4, 1e-4)
LAW = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2e-5, short_cutoff=2e-6, rms_height=2e-7)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("scans")
    names = [folder / f"scan-{seed}.h5" for seed in (1, 2, 3)]
    for seed, name in enumerate(names):
        salebra.write_surface(name, salebra.filtered_noise(GRID, LAW, seed))
    return names


@pytest.fixture(scope="module")
def twin(files: list[Path]) -> salebra.SurfaceTwin:
    return salebra.SurfaceTwin([salebra.scan_spectrum(salebra.read_surface(file), "ideal") for file in files]).fit()


def test_a_twin_holds_the_law_of_its_scans(twin: salebra.SurfaceTwin) -> None:
    for name, truth in {"hurst": 0.8, "rolloff": 2e-5, "short_cutoff": 2e-6, "rms_height": 2e-7}.items():
        parameter = getattr(twin, name)
        assert parameter.seen and parameter.low < parameter.value < parameter.high
        # Periodic surfaces have no wave longer than themselves; else 95 % limits, widened by half.
        assert parameter.low / 1.05 < truth < 1.05 * parameter.high
    middle = len(twin.spectrum.wavenumber) // 2
    assert twin.spectrum.low[middle] < twin.spectrum.psd[middle] < twin.spectrum.high[middle]
    assert pickle.loads(pickle.dumps(twin)) == twin
    other = copy.copy(twin)
    assert other == twin
    # The object itself has the numbers, as it is returned.
    assert other.fit(seed=2) is other and other != twin and other.hurst.value == pytest.approx(twin.hurst.value, rel=0.1)


def test_a_draw_is_the_spectrum_of_a_surface(twin: salebra.SurfaceTwin) -> None:
    draw = twin.draw(3)
    assert draw == twin.draw(3) and draw in twin.draws
    q = np.array([1e5, 1e6])
    # The table is straight between its points to 1e-4.
    spectrum = draw.tabulated(np.pi / GRID.lx)
    assert [spectrum.density(value, 0.0) for value in q] == pytest.approx(draw.density(q), rel=2e-4)
    surface = salebra.filtered_noise(GRID, spectrum, 1)
    # Of 25 correlation lengths in the area the rms height scatters by some 10 %.
    assert salebra.height_statistics(surface).rms_height == pytest.approx(draw.rms_height, rel=0.3)


def test_the_list_that_init_writes_gives_the_same_twin(
    twin: salebra.SurfaceTwin, files: list[Path], program: Callable[..., Any]
) -> None:
    folder = files[0].parent
    made = program("twin", "init", folder / "scans.toml", "--files", *files)
    assert made["scans"] == 3
    text = (folder / "scans.toml").read_text(encoding="utf-8")
    assert 'file = "scan-1.h5"  # 256 x 256 points, 100 µm x 100 µm, rms height' in text
    with pytest.raises(subprocess.CalledProcessError) as untold:
        program("twin", folder / "scans.toml")
    assert "measurement.instrument: is missing" in untold.value.stderr
    told = re.sub(r"^# (instrument = \"ideal\")", r"\1", text, flags=re.MULTILINE)
    (folder / "scans.toml").write_text(told, encoding="utf-8")
    said = program("twin", folder / "scans.toml", "-o", folder / "said.h5")
    again = salebra.SurfaceTwin(folder / "scans.toml").fit()
    for name in ("hurst", "rolloff", "short_cutoff", "rms_height", "rms_slope"):
        here, other = getattr(again, name), getattr(twin, name)
        # Files of a list are detrended once more, so that rounding moves the draws within their chance.
        assert abs(other.value - here.value) < 0.1 * (here.high - here.low)
        assert [here.value, here.low, here.high] == pytest.approx([said[name][key] for key in ("value", "low", "high")], rel=1e-12)
        assert said[name]["seen"] == here.seen
    again.write(folder / "part.h5")
    ours, theirs = (salebra.ResultReader(folder / name)["twin/draws/rms_slope"] for name in ("part.h5", "said.h5"))
    assert np.array_equal(ours, theirs)


def test_every_key_of_the_list_is_one_that_is_read(files: list[Path], program: Callable[..., Any]) -> None:
    folder = files[0].parent
    program("twin", "init", folder / "keys.toml", "--files", files[0])
    text = (folder / "keys.toml").read_text(encoding="utf-8")
    body = text[text.index("[[measurement]]") :]
    for kind in ("optical", "afm", "ideal"):
        # Each choice made, but for those of other instruments.
        mine = re.sub(r"^# ?(\w+ = )", r"\1", body, flags=re.MULTILINE)
        mine = re.sub(rf"^instrument = \"(?!{kind})\w+\".*\n", "", mine, flags=re.MULTILINE)
        # The file states its unit, which no option replaces.
        mine = re.sub(r"^height_unit.*\n", "", mine, flags=re.MULTILINE)
        if kind != "optical":
            mine = re.sub(r"^resolution.*\n", "", mine, flags=re.MULTILINE)
        if kind != "afm":
            mine = re.sub(r"^tip_radius.*\n", "", mine, flags=re.MULTILINE)
        (folder / f"{kind}.toml").write_text(mine, encoding="utf-8")
        with pytest.warns(UserWarning):  # the sizes of the list are not those of the file
            twin = salebra.SurfaceTwin(folder / f"{kind}.toml")
        assert twin.measurements[0].instrument.kind == kind
        assert twin.measurements[0].instrument.noise == pytest.approx(3e-10)


def test_a_line_is_a_scan_and_bad_scans_are_refused() -> None:
    heights = salebra.filtered_noise(GRID, LAW, 1).heights
    line = salebra.Surface(np.ascontiguousarray(heights[:, :1]), 1e-4, 1e-4)
    assert salebra.scan_spectrum(line, "stylus", tip_radius="2um").profile
    with pytest.raises(salebra.InvalidInput, match="resolution: 0 must be a finite number > 0"):
        salebra.scan_spectrum(salebra.filtered_noise(GRID, LAW, 1), "optical")
    with pytest.raises(salebra.InvalidInput, match="scans: none given"):
        salebra.SurfaceTwin([]).fit()
    with pytest.raises(salebra.InvalidInput, match="draws: are missing"):
        salebra.SurfaceTwin([]).draw(1)


def test_the_plain_average_has_the_power_of_the_profiles() -> None:
    scans = [salebra.plain_spectrum(salebra.filtered_noise(GRID, LAW, seed)) for seed in (1, 2)]
    mean = salebra.plain_average(scans)
    assert np.array_equal(mean.scans, np.full(len(mean.bin), 2))
    assert mean.psd == pytest.approx((scans[0].psd + scans[1].psd) / 2, rel=1e-14)
