# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit that `salebra export --to fmu` makes, run by FMPy: its forces and its loss against ContactElement and a closed form."""

from __future__ import annotations

import os
import shutil
import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import salebra

fmpy = pytest.importorskip("fmpy")

DECAY, FORCE, FRICTION, SPRINGS = 100e-9, 10.0, 0.3, 256
LAW = ["--law", "exponential", "--decay-length", "100nm", "--normal-force", "10N", "--poisson", "0.3"]
UNIT = [*LAW, "--friction-coefficient", "0.3", "--to", "fmu", "--sliders", str(SPRINGS), "--units", "mm,t,s"]
MM = 1e-3  # the unit of length of the FMU, m; its forces are in N


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = os.environ.get("SALEBRA_PROGRAM", "")
    if not path:
        pytest.skip("no program in this build")
    if not shutil.which("cc"):
        pytest.skip("no C compiler cc")
    file = tmp_path_factory.mktemp("fmu") / "contact.fmu"
    subprocess.run([path, "export", *UNIT, "-o", file], check=True, capture_output=True)
    return file


@pytest.fixture
def unit(archive: Path, tmp_path: Path) -> Any:
    description = fmpy.read_model_description(archive, validate=True, validate_model_structure=True)
    unit = fmpy.instantiate_fmu(fmpy.extract(archive, tmp_path), description, fmi_type="CoSimulation")
    yield unit
    unit.terminate()
    unit.freeInstance()


def ratio() -> float:
    return salebra.Material(1e9, poisson=0.3).modulus_ratio


def start(unit: Any, place: np.ndarray) -> None:
    unit.enterInitializationMode()
    unit.setFloat64([1, 2, 3], list(place / MM))
    unit.exitInitializationMode()


def step(unit: Any, time: float, place: np.ndarray) -> np.ndarray:
    unit.setFloat64([1, 2, 3], list(place / MM))
    unit.doStep(currentCommunicationPoint=time, communicationStepSize=1.0)
    return np.array(unit.getFloat64([4, 5, 6, 7]))


def test_every_step_has_the_forces_and_the_work_of_a_contact_element(unit: Any) -> None:
    # The springs cover forces from 0.001 F to 100 F. The motion lifts off and slides.
    law = salebra.ExponentialLaw(FORCE, DECAY, ratio())
    springs = salebra.LawSprings(law, DECAY * np.log(1e-3), DECAY * np.log(100), friction_coefficient=FRICTION, springs=SPRINGS)
    element = salebra.ContactElement(springs)
    phase = np.linspace(0, 4 * np.pi, 401)
    path = np.array([-1.4e-6 + 1.5e-6 * np.cos(phase), 8e-8 * np.sin(phase), 3e-8 * np.sin(2 * phase)]).T
    element.start(*path[0])
    start(unit, path[0])
    work, before = 0.0, np.zeros(2)
    found, expected = [], []
    for time, (last, place) in enumerate(zip(path, path[1:])):
        found.append(step(unit, time, place))
        forces = element.move_to(*place)
        after = np.array(forces.tangential_force)
        work += 0.5 * (before + after) @ (place - last)[1:]
        before = after
        expected.append([forces.normal_force, *after, work / MM])
    found, expected = np.array(found), np.array(expected)
    assert (found[:, 0] == 0).any() and (np.hypot(found[:, 1], found[:, 2]) > 0.999 * FRICTION * found[:, 0])[found[:, 0] > 0].any()
    # Round-off: sums over the springs, whose range ends are computed twice, relative to the largest number of each column.
    assert (np.abs(found - expected).max(axis=0) < 1e-11 * np.abs(expected).max(axis=0)).all()


def test_the_work_of_a_cycle_is_the_loss_of_a_joint_in_closed_form(unit: Any) -> None:
    # With Y = X/λ and λ = µl/ρ: W = 4µFλ[(Y − 2) + (Y + 2) exp(−Y)], from T(x) = µF[1 − exp(−x/λ)] and Masing's rule.
    reach = FRICTION * DECAY / ratio()
    amplitude, steps = 1.5 * reach, 400
    start(unit, np.zeros(3))
    work = []
    for time in range(1, 2 * steps + 1):
        work.append(step(unit, time, np.array([0, amplitude * np.sin(2 * np.pi * time / steps), 0]))[3] * MM)
    y = amplitude / reach
    expected = 4 * FRICTION * FORCE * reach * ((y - 2) + (y + 2) * np.exp(-y))
    # 256 springs are accurate to 0.15 % (force_law.md). The trapezoidal rule at 400 steps errs by less than 0.1 %.
    assert work[-1] - work[steps - 1] == pytest.approx(expected, rel=2.5e-3)


def test_a_stored_state_gives_the_same_step_again(unit: Any) -> None:
    there, elsewhere = np.array([-1e-8, -5e-8, 2e-8]), np.array([3e-8, 9e-8, -4e-8])
    start(unit, np.zeros(3))
    step(unit, 0, np.array([1e-8, 5e-8, 0]))
    state = unit.getFMUState()
    stored = unit.serializeFMUState(state)
    first = step(unit, 1, there)
    step(unit, 2, elsewhere)
    assert (step(unit, 3, there) != first).any()
    unit.setFMUState(state)
    assert (step(unit, 1, there) == first).all()
    unit.freeFMUState(state)
    step(unit, 2, elsewhere)
    again = unit.deserializeFMUState(stored)
    unit.setFMUState(again)
    assert (step(unit, 1, there) == first).all()
    unit.freeFMUState(again)


def test_a_simulation_program_runs_the_unit_by_itself(archive: Path) -> None:
    time = np.linspace(0, 1, 101)
    signal = np.empty(101, dtype=[("time", float), ("indentation", float), ("displacement_x", float)])
    signal["time"], signal["indentation"], signal["displacement_x"] = time, 0, 4e-8 / MM * time
    result = fmpy.simulate_fmu(archive, stop_time=1.0, output_interval=0.01, input=signal)
    # The operating point lies between two nodes of the springs.
    assert result["normal_force"] == pytest.approx(FORCE, rel=1e-6)
    # µF[1 − exp(−x/λ)] at the last displacement; FMPy holds the displacement of the beginning of a step during the step.
    reach = FRICTION * DECAY / ratio()
    at = 4e-8 * np.clip(result["time"][-1] - 0.01, 0, 1)
    assert result["tangential_force_x"][-1] == pytest.approx(FRICTION * FORCE * (1 - np.exp(-at / reach)), rel=2e-3)


def test_without_a_compiler_the_unit_has_its_sources_and_the_program_says_so(archive: Path, tmp_path: Path) -> None:
    run = subprocess.run(
        [os.environ["SALEBRA_PROGRAM"], "export", *UNIT, "-o", tmp_path / "sources.fmu"], env={"PATH": str(tmp_path)}, capture_output=True, text=True, check=True
    )
    assert "its sources only" in run.stderr
    with zipfile.ZipFile(archive) as whole, zipfile.ZipFile(tmp_path / "sources.fmu") as sources:
        names = set(whole.namelist())
        assert names - set(sources.namelist()) == {name for name in names if name.startswith("binaries/")} != set()
        assert whole.testzip() is None and sources.testzip() is None
        sources.extractall(tmp_path)
    for extra in [], ["-DFMI3_FUNCTION_PREFIX=contact_"]:
        command = ["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", *extra, "-c", "contact.c", "-o", "contact.o"]
        subprocess.run(command, cwd=tmp_path / "sources", check=True)


def test_an_fmu_needs_a_name_of_a_file(program: Callable[..., Any]) -> None:
    with pytest.raises(subprocess.CalledProcessError) as refused:
        program("export", *UNIT)
    assert refused.value.returncode == 2 and "--output" in refused.value.stderr
    with pytest.raises(salebra.InvalidInput, match="format"):
        salebra.ExponentialLaw(FORCE, DECAY, 0.8).export("fmu")
