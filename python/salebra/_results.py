# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as xarray datasets: every variable with SI units and a description."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._show import columns

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray


def _variable(name: str, dims: tuple[str, ...], values: Any) -> Any:
    units, long_name = _core.quantity(name)
    return dims, np.asarray(values), {"units": units, "long_name": long_name}


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


# Coordinates, the variables on each of their combinations, and attributes, by class.
_DATASETS: dict[type, tuple[tuple[str, ...], dict[tuple[str, ...], tuple[str, ...]], tuple[str, ...]]] = {
    _core.Surface: (("x", "y"), {("x", "y"): ("heights",)}, ("size_x", "size_y", "periodic", "origin")),
    _core.NormalContactState: (
        ("x", "y"), {("x", "y"): ("contact_pressure", "gap")},
        ("mean_pressure", "force", "mean_gap", "indentation", "contact_area_fraction", "elastic_energy", "residual", "iterations",
         "contact_modulus", "boundary", "converged"),
    ),
    _core.ForceCurve: (
        ("pressure",),
        {("pressure",): ("force", "mean_gap", "indentation", "separation", "contact_area_fraction", "normal_stiffness",
                         "tangential_stiffness", "converged")},
        ("model", "nominal_area", "rms_height"),
    ),
    _core.LocalDecayLength: (("mean_gap",), {("mean_gap",): ("local_decay_length",)}, ()),
    _core.PowerSpectrum: (("wavenumber_x", "wavenumber_y"), {("wavenumber_x", "wavenumber_y"): ("psd",)}, ("cell",)),
    _core.RadialSpectrum: (("wavenumber",), {("wavenumber",): ("psd", "modes")}, ()),
    _core.ProfilePsd: (("wavenumber",), {("wavenumber",): ("profile_psd", "modes")}, ("profiles", "length")),
    _core.Correlation: (("distance",), {("distance",): ("autocorrelation", "structure", "pairs")}, ()),
    _core.ScaleDependence: (("spacing",), {("spacing",): ("profile_slope", "profile_curvature", "min_curvature", "stencils")}, ()),
    _core.HeightHistogram: (("height",), {("height",): ("height_density", "points")}, ("width",)),
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
    _core.CycleResult: (
        ("time_in_periods",),
        {("time_in_periods",): ("indentation", "tangential", "tangential_force", "normal_force", "work", "contact_area", "slip_area",
                                "tangential_stiffness")},
        ("work_per_cycle", "dissipated", "relaxation_work", "slip_work"),
    ),
}  # fmt: skip


def to_xarray(result: Any) -> xarray.Dataset:
    """The result as a dataset."""
    if isinstance(result, _core.StudyResult):
        return _study_dataset(result)
    if isinstance(result, _core.StudySolution):
        return _answer_dataset(result)
    if isinstance(result, _core.DampingCurve):
        return _damping_dataset(result)
    axes, variables, names = _DATASETS[type(result)]
    attributes = {name: getattr(result, name) for name in names}
    columns = {name: (dims, getattr(result, name)) for dims, of in variables.items() for name in of}
    if isinstance(result, _core.ForceCurve):  # without what its model does not have
        columns = {name: column for name, column in columns.items() if not np.isnan(column[1]).all()}
    data = _dataset(
        columns,
        {axis: points(result.grid, axis) if axis in ("x", "y") else getattr(result, axis) for axis in axes},
        {name: int(value) if isinstance(value, bool) else value for name, value in attributes.items()},
    )
    if isinstance(result, _core.Surface):  # Surface(heights) of the array alone reads them
        data.heights.attrs.update({name: data.attrs[name] for name in ("size_x", "size_y", "periodic", "origin")})
    return data.sortby("wavenumber_x") if "wavenumber_x" in axes else data


def _damping_dataset(curve: _core.DampingCurve) -> xarray.Dataset:
    over = curve.coordinate
    variables: dict[str, tuple[tuple[str, ...], Any]] = {
        name: ((over,), column) for name, column in columns(curve).items() if name != over
    }
    return _dataset(variables, {over: curve.values}, {"validity": curve.validity})


def points(grid: _core.Grid2D, axis: str) -> Any:
    """Where the points of a grid lie along "x" or "y", m."""
    return np.arange(getattr(grid, f"n{axis}")) * getattr(grid, f"d{axis}")


def _study_dataset(result: _core.StudyResult) -> xarray.Dataset:
    columns: dict[str, tuple[tuple[str, ...], Any]] = {}
    described = {name: (units, long_name) for name, units, long_name in (*_core._curve_columns(), *_core._damping_columns())}
    for names, of in ((_core._curve_columns(), result.curve), (_core._damping_columns(), result.damping)):
        for name, _, _ in names:
            if name == "pressure":
                continue
            means = [of(name, model) for model in result.models]
            for part in ("mean", "low", "high"):
                columns[f"{name}_{part}"] = ("model", "pressure"), [[getattr(mean, part) for mean in row] for row in means]
    data = _dataset(columns, {"model": result.models, "pressure": result.pressures}, {})
    for column in columns:
        name, _, part = column.rpartition("_")
        data[column].attrs = {"units": described[name][0], "long_name": f"{described[name][1]}, {part}"}
    return data


def _answer_dataset(answer: _core.StudySolution) -> xarray.Dataset:
    """Means with the ends of their 95 % intervals, and shares, over the pressure."""
    columns: dict[str, Any] = {}
    texts: dict[str, str] = {}
    for name in ("damping_constant", "work_per_cycle", "damping_constant_without_slip", "thermal_conductance", "electrical_conductance"):
        means = getattr(answer, name)
        if not means:  # not asked for
            continue
        for part in ("mean", "low", "high"):
            columns[f"{name}_{part}"] = ("pressure",), [getattr(mean, part) for mean in means]
            texts[f"{name}_{part}"] = name
    for name in ("relaxation_share", "slip_share"):
        if len(getattr(answer, name)):
            columns[name] = ("pressure",), getattr(answer, name)
    attributes = {"slip_followed": int(answer.slip_followed), "unknown": answer.unknown, "validity": answer.validity}
    data = _dataset(columns, {"pressure": answer.pressures}, attributes)
    for column, name in texts.items():
        units, long_name = _core.quantity(name)
        data[column].attrs = {"units": units, "long_name": f"{long_name}, {column.rpartition('_')[2]}"}
    return data


def group_to_xarray(reader: _core.ResultReader, group: str) -> xarray.Dataset:
    """A group of a file; datasets on no coordinate of theirs are coordinates themselves, or single numbers."""
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
