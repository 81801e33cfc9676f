# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests share: surfaces that cost milliseconds, and the folder of measured ones where there is one."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import salebra
from user_script import STUDY as STUDY

ROOT = Path(__file__).resolve().parents[2]


def generated(points: int = 64, seed: int = 7, **changes: float) -> salebra.Surface:
    """A self-affine surface of 1 mm with eight cells in its shortest wave."""
    grid = salebra.Grid2D(points, points, 1e-3, 1e-3)
    parameters = {"hurst": 0.8, "rolloff": 2.5e-4, "short_cutoff": 8 * grid.dx, "rms_height": 1e-6} | changes
    return salebra.random_phase(grid, salebra.SelfAffineSpectrum(**parameters), seed)


@pytest.fixture(scope="session")
def surface() -> salebra.Surface:
    return generated()


@pytest.fixture(scope="session")
def material() -> salebra.Material:
    return salebra.Material(1e9, poisson=0.3)


@pytest.fixture(scope="session")
def measured() -> Path:
    """The AFM scan of the README."""
    return ROOT / "data" / "surfaces" / "afm-scan.txt"


@pytest.fixture(scope="session")
def program() -> Callable[..., Any]:
    """The program of this build: program("fit", "curve.h5") is the object that `salebra fit curve.h5 --json` prints."""
    path = os.environ.get("SALEBRA_PROGRAM", "")
    if not path:
        pytest.skip("no program in this build")

    def run(*arguments: str | Path) -> Any:
        done = subprocess.run([path, *map(str, arguments), "--json"], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    return run
