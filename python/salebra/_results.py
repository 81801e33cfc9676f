# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as xarray datasets, whose variables have SI units and a description, and surfaces from labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._calls import in_si, refusal
from ._show import columns, meaning, unit_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray


# Endings of the names of means and of the limits of their 95 % intervals.
_PARTS = ("mean", "low", "high")


def _variable(name: str, dims: tuple[str, ...], values: Any) -> Any:
    stem, _, part = name.rpartition("_")
    units, long_name = _core.quantity(stem if part in _PARTS and stem else name)
    return dims, np.asarray(values), {"units": units, "long_name": f"{long_name}, {part}" if part in _PARTS and stem else long_name}


def _dataset(
    variables: Mapping[str, tuple[tuple[str, ...], Any]],
    coordinates: Mapping[str, Any],
    attributes: Mapping[str, Any],
) -> xarray.Dataset:
    try:
        import xarray
    except ImportError as error:
        raise ImportError("to_xarray needs xarray; install it") from error
    return xarray.Dataset(
        {name: _variable(name, dims, values) for name, (dims, values) in variables.items()},
        {name: _variable(name, (name,), values) for name, values in coordinates.items()},
        dict(attributes) | {"program": "salebra", "version": _core.version()},
    )


# Coordinates, the variables on each of their combinations (none: all other columns of a table), and attributes, by class.
_DATASETS: dict[type, tuple[tuple[str, ...], dict[tuple[str, ...], tuple[str, ...]], tuple[str, ...]]] = {
    _core.Surface: (("x", "y"), {("x", "y"): ("heights",)}, ("size_x", "size_y", "periodic", "origin")),
    _core.NormalContactState: (
        ("x", "y"), {("x", "y"): ("contact_pressure", "gap")},
        ("mean_pressure", "force", "mean_gap", "indentation", "contact_area_fraction", "elastic_energy", "residual", "iterations",
         "contact_modulus", "boundary", "converged"),
    ),
    _core.ForceCurve: (("pressure",), {}, ("model", "nominal_area", "rms_height")),
    _core.LocalDecayLength: (("mean_gap",), {}, ()),
    _core.PowerSpectrum: (("wavenumber_x", "wavenumber_y"), {("wavenumber_x", "wavenumber_y"): ("psd",)}, ("cell",)),
    _core.RadialSpectrum: (("wavenumber",), {}, ()),
    _core.ProfilePsd: (("wavenumber",), {}, ("profiles", "length")),
    _core.Correlation: (("distance",), {}, ()),
    _core.ScaleDependence: (("spacing",), {}, ()),
    _core.HeightHistogram: (("height",), {}, ("width",)),
    _core.DamperMap: (
        ("normal_amplitude", "angular_frequency"), {("normal_amplitude", "angular_frequency"): ("damping_constant",)}, (),
    ),
    _core.FrictionMap: (
        ("friction_number", "phase"), {("friction_number", "phase"): ("loss_ratio", "relaxation_ratio", "slip_ratio")}, (),
    ),
    _core.RegimeMap: (
        ("velocity", "excursion"),
        {("velocity", "excursion"): ("loss_ratio", "slip_ratio", "regime"), ("velocity",): ("no_slip_excursion",)},
        ("no_slip_velocity", "sliding_excursion", "critical_velocity", "full_stick_ratio"),
    ),
    _core.StressMap: (
        ("angle", "radial_position"),
        {("angle", "radial_position"): ("shear", "contact_pressure"), ("angle",): ("contact_radius", "tangential_force")}, (),
    ),
    _core.CycleResult: (("time_in_periods",), {}, ("work_per_cycle", "dissipated", "relaxation_work", "slip_work")),
}  # fmt: skip


def to_xarray(result: Any) -> xarray.Dataset:
    """The result as a dataset."""
    if isinstance(result, _core.StudyResult):
        return _study_dataset(result)
    if isinstance(result, _core.StudySolution):
        return _answer_dataset(result)
    if hasattr(result, "coordinate"):
        return _curve_dataset(result)
    axes, variables, names = _DATASETS[type(result)]
    attributes = {name: getattr(result, name) for name in names}
    table = {} if variables else {name: (axes, column) for name, column in columns(result).items() if name not in axes}
    data = _dataset(
        table | {name: (dims, getattr(result, name)) for dims, of in variables.items() for name in of},
        {axis: points(result.grid, axis) if axis in ("x", "y") else getattr(result, axis) for axis in axes},
        {name: int(value) if isinstance(value, bool) else value for name, value in attributes.items()},
    )
    if isinstance(result, _core.Surface):  # Surface(data.heights) reads them
        data.heights.attrs.update({name: data.attrs[name] for name in ("size_x", "size_y", "periodic", "origin")})
    return data.sortby("wavenumber_x") if "wavenumber_x" in axes else data


def _curve_dataset(curve: Any) -> xarray.Dataset:
    over = curve.coordinate
    variables: dict[str, tuple[tuple[str, ...], Any]] = {
        name: ((over,), column) for name, column in columns(curve).items() if name != over
    }
    attributes = {name: getattr(curve, name) for name in ("validity", "quantity") if hasattr(curve, name)}
    data = _dataset(variables, {over: curve.values}, attributes)
    for name in variables:
        unit = unit_of(curve, name)
        of = attributes.get("quantity")
        text = f"{_core.quantity(of)[1]}, {name}" if of else meaning(type(curve), name)[1].removesuffix(f", {unit}")
        data[name].attrs = {"units": unit or "1", "long_name": text}
    return data


def from_xarray(arguments: tuple[Any, ...], keywords: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """Arguments of a Surface. A DataArray over x and y, in either order, replaces its sizes by those of its coordinates, with units."""
    named = {**dict(zip(("heights", "size_x", "size_y"), arguments)), **keywords}
    array: Any = named.get("heights")
    if set(getattr(array, "dims", ())) != {"x", "y"} or not hasattr(array, "coords") or len(arguments) > 3:
        return arguments, keywords

    def metres(labelled: Any, argument: str) -> float:
        return float(in_si(f"1 {labelled.attrs['units']}", argument)) if labelled.attrs.get("units") else 1.0

    for axis in array.coords.keys() & {"x", "y"}:
        array = array.sortby(axis)
        steps = np.diff(array.coords[axis].values.astype(float))
        if f"size_{axis}" in named or steps.size == 0:
            continue
        if not np.allclose(steps, steps.mean(), rtol=1e-3, atol=0):
            raise refusal(f"heights.{axis}", "", "is not evenly spaced; interpolate the heights to a grid")
        named[f"size_{axis}"] = (steps.size + 1) * float(steps.mean()) * metres(array.coords[axis], f"size_{axis}")
    # to_xarray() writes the size of the whole surface. A part of the surface has another size, and it is not periodic.
    whole = all(np.isclose(array.attrs.get(f"size_{axis}", np.nan), named.get(f"size_{axis}", np.nan)) for axis in "xy")
    if whole and "periodic" in array.attrs:
        named.setdefault("periodic", bool(array.attrs["periodic"]))
    factor = metres(array, "heights")
    heights = array.transpose("x", "y").values
    return (), named | {"heights": heights if factor == 1 else heights * factor}


def points(grid: _core.Grid2D, axis: str) -> Any:
    """Positions of the points of a grid along "x" or "y", m."""
    return np.arange(getattr(grid, f"n{axis}")) * getattr(grid, f"d{axis}")


def _study_dataset(result: _core.StudyResult) -> xarray.Dataset:
    columns: dict[str, tuple[tuple[str, ...], Any]] = {}
    for names, of in ((_core._curve_columns(), result.curve), (_core._damping_columns(), result.damping)):
        for name in (name for name, _, _ in names if name != "pressure"):
            means = [of(name, model) for model in result.models]
            columns |= {f"{name}_{part}": (("model", "pressure"), [getattr(mean, part) for mean in means]) for part in _PARTS}
    return _dataset(columns, {"model": result.models, "pressure": result.pressures}, {})


def _answer_dataset(answer: _core.StudySolution) -> xarray.Dataset:
    columns: dict[str, tuple[tuple[str, ...], Any]] = {}
    for name in ("damping_constant", "work_per_cycle", "damping_constant_without_slip", "thermal_conductance", "electrical_conductance"):
        if means := getattr(answer, name):  # empty if not computed
            columns |= {f"{name}_{part}": (("pressure",), getattr(means, part)) for part in _PARTS}
    columns |= {name: (("pressure",), getattr(answer, name)) for name in ("relaxation_share", "slip_share") if len(getattr(answer, name))}
    attributes = {"slip_followed": int(answer.slip_followed), "unknown": answer.unknown, "validity": answer.validity}
    return _dataset(columns, {"pressure": answer.pressures}, attributes)


def group_to_xarray(reader: _core.ResultReader, group: str) -> xarray.Dataset:
    """A group of a file. One-dimensional datasets without a coordinate are coordinates."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("to_xarray needs xarray; install it") from error
    variables: dict[str, Any] = {}
    names: set[str] = set()
    for name in reader.datasets(group):
        path = f"{group.rstrip('/')}/{name}"
        values = reader[path]
        dims = tuple(reader.coordinates(path))
        if values.ndim == 1 and not dims:
            dims = (name,)
            names.add(name)
        meaning = {key: value for key, value in reader.attributes(path).items() if key in ("units", "long_name")}
        variables[name] = dims, values, meaning
    data = xarray.Dataset(variables, attrs=reader.attributes(group))
    return data.set_coords(sorted(names))
