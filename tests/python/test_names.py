# SPDX-License-Identifier: GPL-3.0-or-later
"""Names: a property is called what files, answers and options call it, with the same unit; messages name arguments."""

from __future__ import annotations

import contextlib
import inspect
import pathlib
import re

import pytest

import salebra
from salebra import _core

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# Properties that have the name of a quantity and are another thing: an interval's or a sample's mean, statistics of heights, a part
# of the mean square slope, spectra in units of their convention, the error of a force, a loss in each cell.
OTHERS = {
    ("EnsembleMean", "mean"), ("MonteCarloCurve", "mean"), ("Realisation", "heights"), ("RoughnessShell", "power"),
    ("ConvertedPsd", "wavenumber"), ("ConvertedPsd", "psd"), ("PlainSpectrum", "psd"), ("SteadySliding", "error_estimate"), ("SlidingContact", "loss"),
}  # fmt: skip
OLD = re.compile(r"curvature|customary|density_unit|law_density|(least|greatest)_.*|released_work")


def properties() -> list[tuple[str, str, str]]:
    found = []
    for class_name, cls in vars(_core).items():
        if inspect.isclass(cls):
            for name, member in vars(cls).items():
                if not name.startswith("_") and isinstance(member, property):
                    found.append((class_name, name, member.__doc__ or ""))
    return found


def spellings(unit: str) -> set[str]:
    """1/m^2 and 1/m²."""
    digits = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
    return {unit, re.sub(r"\^(\d)", lambda match: match.group(1).translate(digits), unit)}


def test_properties_have_the_unit_of_the_quantity_of_their_name() -> None:
    checked = 0
    for class_name, name, text in properties():
        assert not OLD.fullmatch(name), f"{class_name}.{name}"
        unit, long_name = salebra.quantity(name)
        if long_name == name or (class_name, name) in OTHERS:
            continue
        checked += 1
        assert unit == "1" or any(spelling in text for spelling in spellings(unit)), f"{class_name}.{name}: '{text}' is not in {unit}"
    assert checked > 200


def test_dir_lists_what_the_documentation_uses() -> None:
    used = set()
    for page in ("README.md", "docs/python.md"):
        for block in re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL):
            used |= set(re.findall(r"\bsalebra\.(\w+)", block))
    assert {"surface_damping", "run_ensembles"} <= used <= set(dir(salebra))
    assert all(hasattr(salebra, name) for name in dir(salebra))


def test_a_misspelt_name_is_answered_with_the_nearest() -> None:
    with pytest.raises(AttributeError, match="no attribute 'surface_dampin'; did you mean surface_damping\\?"):
        getattr(salebra, "surface_dampin")  # noqa: B009
    with pytest.raises(AttributeError, match="no attribute 'qqq'$"):
        getattr(salebra, "qqq")  # noqa: B009


def test_messages_name_arguments_of_python() -> None:
    callables = [value for value in vars(salebra).values() if callable(value)]
    for cls in vars(_core).values():
        if inspect.isclass(cls):
            callables += [member for member in vars(cls).values() if callable(member)]
    arguments = set()
    for value in callables:
        with contextlib.suppress(TypeError, ValueError):  # what has no signature takes no argument of ours
            arguments |= set(inspect.signature(value).parameters)
    named = set()
    for file in (ROOT / "src").rglob("*.cpp"):
        if file.name == "surface_formats.cpp" or file.parent.name == "questions":
            continue  # a table for docs/formats.md; questions are not asked from Python yet
        for literal in re.findall(r'"(?:[^"\\]|\\.)*"', file.read_text(encoding="utf-8")):
            named |= set(re.findall(r"`([a-z_]+)`", literal))
    assert {"overwrite", "size_x", "steps"} <= named
    assert named <= arguments
