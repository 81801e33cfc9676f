# SPDX-License-Identifier: GPL-3.0-or-later
"""Names: a property is called what files, answers and options call it, with the same unit; messages name arguments."""

from __future__ import annotations

import contextlib
import inspect
import pathlib
import re
from typing import Any

import numpy as np
import pytest

import salebra
from salebra import _calls, _core, _show

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
    with pytest.raises(AttributeError, match="salebra.StudyAnswer is now salebra.StudySolution"):
        getattr(salebra, "StudyAnswer")  # noqa: B009


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
        if file.name == "surface_formats.cpp" or file.parent.name == "analysis":
            continue  # a table for docs/formats.md; problems are not posed from Python yet
        for literal in re.findall(r'"(?:[^"\\]|\\.)*"', file.read_text(encoding="utf-8")):
            named |= set(re.findall(r"`([a-z_]+)`", literal))
    assert {"overwrite", "size_x", "steps"} <= named
    assert named <= arguments


# Arguments of type float that are pure numbers, and those whose unit depends on another argument: of a power law, and pairs, states and
# values of several units.
PLAIN = {
    "across", "along", "area_fraction", "contact", "contact_area_fraction", "despike", "dundurs", "energy_factor", "exponent", "friction_coefficient",
    "friction_numbers", "height_calibration", "hurst", "kurtosis", "layers", "level", "merge_tolerance", "modulus_ratio", "poisson", "precision",
    "pressure_over_modulus", "relative_error", "rms_slope", "rms_slopes", "safety_factor", "scan_calibration", "shape", "skewness", "skewnesses", "steady_tolerance", "table_tolerance",
    "tabor_parameter", "threshold", "tolerance", "u", "weight",
}  # fmt: skip
WITHOUT_UNIT = {
    "coefficient", "direction", "in_plane", "normal", "uniform_normal", "uniform_tangential", "standard_deviation", "state", "step", "stiffness", "table", "terms", "value",
}  # fmt: skip


def arguments_that_take_numbers() -> list[tuple[str, str, str]]:
    """Function, argument and annotation."""
    callables = [(name, value) for name, value in vars(salebra).items() if not name.startswith("_") and callable(value)]
    for name, cls in list(callables):
        if inspect.isclass(cls):
            callables += [(f"{name}.{key}", value) for key, value in vars(cls).items() if not key.startswith("_") and callable(value)]
    found = []
    for name, value in callables:
        with contextlib.suppress(TypeError, ValueError):  # what has no signature takes no argument of ours
            for parameter in inspect.signature(value).parameters.values():
                annotation = str(parameter.annotation)
                if "Callable" not in annotation and ("float" in annotation or "ArrayLike" in annotation):
                    found.append((name, parameter.name, annotation))
    return found


def test_every_argument_with_a_dimension_takes_a_text_with_its_unit() -> None:
    asked = 0
    for function, name, annotation in arguments_that_take_numbers():
        if name in PLAIN | WITHOUT_UNIT or annotation.startswith("salebra.Material") or annotation.startswith("Material"):
            continue
        unit = salebra.quantity(_calls._like(name))[0]
        assert unit != "1", f"{function}: {name} refuses texts with a unit"
        assert np.ravel(_calls._from_text([f"2 {unit}"] if "float" not in _calls._parts(annotation) else f"2 {unit}", name, annotation)) == 2
        asked += 1
    assert asked > 200
    # An argument of a constructor has the unit of the property of its name.
    for function, name, _ in arguments_that_take_numbers():
        cls = getattr(_core, function, None)
        if inspect.isclass(cls) and isinstance(getattr(cls, name, None), property) and getattr(cls, name).__doc__ and name not in WITHOUT_UNIT:
            assert spellings(salebra.quantity(_calls._like(name))[0]) & spellings(_show.meaning(cls, name)[0] or "1"), f"{function}: {name}"
    parameters = salebra.ContactParameters(first_load="2 mN", max_pressure="3 GPa", loaded_size="1 mm")  # type: ignore[arg-type, unused-ignore]
    assert (parameters.first_load, parameters.max_pressure, parameters.loaded_size) == (2e-3, 3e9, 1e-3)
    assert salebra.Adhesion("0.05 J/m^2", "2 nm").range == 2e-9  # type: ignore[arg-type, unused-ignore]


class Quantity:
    """As those of pint: numbers with a unit, which numpy takes for plain ones."""

    def __init__(self, magnitude: object, units: str) -> None:
        self.magnitude, self.units = magnitude, units

    def __array__(self, dtype: object = None, copy: object = None) -> object:
        return np.asarray(self.magnitude, dtype=dtype)  # type: ignore[call-overload]

    def to(self, units: str) -> Quantity:
        if (self.units, units) != ("mm", "m"):
            raise TypeError(f"cannot convert from {self.units} to {units}")
        return Quantity(np.multiply(self.magnitude, 1e-3), units)


def test_quantities_of_other_packages_are_converted() -> None:
    size: Any = Quantity(2.0, "mm")
    assert salebra.Grid2D(4, 4, size, size).lx == pytest.approx(2e-3)
    law = salebra.ExponentialLaw(1.0, 1e-3, 0.8)
    assert law.force(Quantity([1.0], "mm")) == pytest.approx([law.force(1e-3)])  # type: ignore[arg-type, unused-ignore]
    assert salebra.Surface(Quantity(np.zeros((4, 4)) + 3, "mm"), 1.0, 1.0).heights[0, 0] == pytest.approx(3e-3)  # type: ignore[arg-type, unused-ignore]
    with pytest.raises(salebra.InvalidInput, match="pressure: .* is not in Pa: cannot convert from mm"):
        salebra.press(salebra.Surface(np.zeros((4, 4)), 1.0, 1.0), 1e9, pressure=size)


def test_texts_of_objects_have_the_unit_of_each_number() -> None:
    assert repr(salebra.Adhesion(0.05, 1e-9)) == "Adhesion(potential='exponential', work=0.05 J/m^2, range=1 nm)"
    units = {"m", "Pa", "1/Pa", "N", "N/m", "N s/m", "J", "J/m^2", "J/m²", "W", "s", "m/s", "Hz", "rad/s", "rad/m", "1/m", "kg"}
    for class_name, name, text in properties():
        said = text.rstrip(".").rpartition(", ")[2]
        if said in units and (class_name, name) != ("PronySeries", "terms"):  # pairs
            assert _show.meaning(getattr(_core, class_name), name)[0] == said, f"{class_name}.{name}: {text}"


def test_tables_of_converted_spectra_have_their_units() -> None:
    pytest.importorskip("pandas")
    psd = salebra.profile_psd(salebra.Surface(np.random.default_rng(1).normal(size=(32, 32)) * 1e-3, 1.0, 1.0))
    converted = salebra.converted(psd, "gwyddion")
    units = converted.to_dataframe().attrs["units"]
    assert units == {"wavenumber": converted.wavenumber_unit, "psd": converted.psd_unit}
