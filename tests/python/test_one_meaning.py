# SPDX-License-Identifier: GPL-3.0-or-later
"""One motion, asked of everything that has an answer: `damping_constant` is the loss as described, with slip, and the number without
slip is `damping_constant_without_slip`."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import salebra

STUDY = """
[surface]
points = 64
size_x = "1mm"
hurst = 0.8
rolloff = "250um"
short_cutoff = "125um"
rms_height = "1um"
method = "random-phase"
seeds = [7]
[material]
contact_modulus = "1GPa"
poisson = 0.3
friction_coefficient = 0.3
[contact]
pressures = "1MPa:5MPa:5"
tangential_stiffness = "proportional"
[damping]
mode = "drag"
normal_amplitude = "20nm"
drag_velocity = "1um/s"
excursion = "20nm"
frequency = "20kHz"
"""


def means(values: Any) -> list[float]:
    return [one.mean for one in values]


def test_every_face_gives_one_number_under_one_name(tmp_path: Path, program: Callable[..., Any]) -> None:
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    configuration = salebra.read_study_configuration(file)
    result = salebra.run_study(configuration)
    answer = result.solution()
    for name in ("damping_constant", "work_per_cycle", "damping_constant_without_slip"):
        expected = means(getattr(answer, name))
        assert np.isfinite(expected).sum() >= 3
        found = {
            "StudyResult.damping": means(result.damping(name)),
            "DampingPoint": [getattr(one, name) for one in result.realisations[0].bem.damping],
        }
        curve = result.realisations[0].bem.curve
        parameters = salebra.ContactParameters(friction_coefficient=0.3, excursion=20e-9)
        motion = salebra.Drag(normal_amplitude=20e-9, drag_velocity=1e-6, frequency=20e3)
        surface = salebra.random_phase(
            salebra.Grid2D(64, 64, 1e-3, 1e-3),
            salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2.5e-4, short_cutoff=1.25e-4, rms_height=1e-6), 7,
        )  # fmt: skip
        material = salebra.Material(1e9, poisson=0.3)
        # The function gives a number beside an error that exceeds it, the study does not.
        losses = salebra.surface_damping(surface, material, motion, curve, parameters=parameters)
        found["surface_damping"] = [value if np.isfinite(number) else number for value, number in zip(getattr(losses, name), expected)]
        printed = program("study", file)["damping"]
        found["study --json"] = printed[name]["mean"]
        compared = program("compare", file, "--models", "persson", "-o", tmp_path / f"{name}.h5")
        found["compare --json"] = compared["damping"][name]["mean"]
        found["compare --json, models"] = compared["models"]["bem"]["damping"][name]["mean"]
        reader = salebra.ResultReader(tmp_path / f"{name}.h5")
        found["HDF5 /solution"] = reader[f"solution/{name}_mean"]
        found["HDF5 /damping, mean"] = reader[f"damping/ensemble_{name}_mean"][0]
        found["HDF5 /damping"] = reader[f"damping/{name}"][0, 0]
        for face, numbers in found.items():
            shown = [np.nan if number is None else number for number in numbers]
            assert shown == pytest.approx(expected, rel=1e-6, nan_ok=True), f"{name} of {face}"
    # Pressures are swept with a periodic surface, and a free one beside them would be another contact.
    with pytest.raises(salebra.InvalidInput, match="boundary: 'free' needs a `curve`"):
        salebra.surface_damping(surface, material, motion, pressures=[1e6], boundary="free")
    # Slip is a large part here: neither name can stand for the other.
    assert min(a / b for a, b in zip(means(answer.damping_constant), means(answer.damping_constant_without_slip)) if a == a and b == b) > 1.2
    if salebra.can_report():
        salebra.write_report(tmp_path / "damping_constant.h5", tmp_path / "page.html")
        page = (tmp_path / "page.html").read_text()
        block = re.search(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.DOTALL)
        assert block
        point = json.loads(block[1])["points"][0]
        assert point["solution"]["damping_constant"]["mean"] == pytest.approx(means(answer.damping_constant), rel=1e-6)
        assert point["damping"]["curve"]["damping_constant"]["bem"]["mean"] == pytest.approx(means(answer.damping_constant_without_slip), rel=1e-6)


def test_a_law_and_a_single_case_have_the_same_meaning(program: Callable[..., Any]) -> None:
    law = salebra.ExponentialLaw(1.0, 1e-7, salebra.Material(1e9, poisson=0.3).modulus_ratio)
    motion = salebra.Drag(normal_amplitude=1e-8, drag_velocity=1e-6, frequency=20e3)
    parameters = salebra.ContactParameters(friction_coefficient=0.3, excursion=1e-8)
    slip = salebra.relaxation_damping(law, motion, force=1.0, parameters=parameters)
    stuck = salebra.relaxation_damping(law, motion, force=1.0)
    loss = salebra.loss_with_slip(law, motion, slip.indentation, friction_coefficient=0.3, excursion=1e-8)
    printed = program(
        "damping", "--law", "exponential", "--decay-length", "100nm", "--poisson", "0.3", "--normal-force", "1N",
        "--normal-amplitude", "10nm", "--drag-velocity", "1um/s", "--frequency", "20kHz", "--friction-coefficient", "0.3", "--excursion", "10nm",
    )  # fmt: skip
    for name in ("damping_constant", "work_per_cycle", "relaxation_work", "slip_work", "slip_share"):
        assert getattr(slip, name) == pytest.approx(getattr(loss, name), rel=1e-9)
        assert getattr(slip, name) == pytest.approx(printed[name], rel=1e-9)
    for name in ("damping_constant", "work_per_cycle"):
        assert getattr(slip, f"{name}_without_slip") == getattr(stuck, name) == getattr(stuck, f"{name}_without_slip")
        assert printed[f"{name}_without_slip"] == pytest.approx(getattr(stuck, name), rel=1e-12)
    curve = salebra.damping_curve(law, [motion], force=[0.5, 1.0], parameters=parameters)
    assert curve.damping_constant[1] == slip.damping_constant
    assert list(curve.force) == [0.5, 1.0] and curve.regime == ["partial slip"] * 2
    with pytest.warns(UserWarning, match="excursion"):
        unknown = salebra.relaxation_damping(law, motion, force=1.0, parameters=salebra.ContactParameters(friction_coefficient=0.3))
    assert np.isnan(unknown.damping_constant) and unknown.damping_constant_without_slip == stuck.damping_constant


def test_an_error_of_several_surfaces_is_the_same_everywhere(program: Callable[..., Any], tmp_path: Path) -> None:
    # Noise of cells is less in a mean over surfaces, so the stated error is not the mean of the errors of the surfaces.
    file = tmp_path / "study.toml"
    file.write_text(
        """
[surface]
points = 16
size_x = "1um"
rms_height = "5nm"
hurst = 0.8
rolloff = "0.5um"
short_cutoff = "0.25um"
seeds = [1, 2]
[material]
contact_modulus = "10GPa"
poisson = 0.3
[contact]
pressures = ["20MPa", "40MPa", "80MPa", "160MPa"]
[damping]
mode = "drag"
normal_amplitude = "0.1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
"""
    )
    printed = program("study", file, "-o", tmp_path / "study.h5")["damping"]
    compared = program("compare", file, "--models", "persson")["models"]["bem"]
    reader = salebra.ResultReader(tmp_path / "study.h5")
    for name in ("damping_constant_error", "damping_constant_without_slip_error", "work_per_cycle_error"):
        stored = np.array(reader[f"damping/ensemble_{name}_mean"][0])
        assert np.isfinite(stored).any()
        for numbers in (printed[name]["mean"], compared["damping"][name]["mean"]):
            assert [np.nan if one is None else one for one in numbers] == pytest.approx(stored, rel=1e-6, nan_ok=True), name
    # A model over itself is 1, with and without slip.
    for name in ("work_per_cycle", "work_per_cycle_without_slip"):
        ratios = [one for one in compared["over_bem"][name]["mean"] if one is not None]
        assert ratios == pytest.approx([1.0] * len(ratios)) and ratios
