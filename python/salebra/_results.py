# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as xarray datasets: every variable with SI units and a description."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

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


def _points(grid: _core.Grid2D) -> dict[str, Any]:
    return {"x": np.arange(grid.nx) * grid.dx, "y": np.arange(grid.ny) * grid.dy}


@singledispatch
def to_xarray(result: Any) -> xarray.Dataset:
    """The result as a dataset."""
    raise TypeError(f"{type(result).__name__} has no form as a dataset")


@to_xarray.register(_core.Surface)
def _(result: _core.Surface) -> xarray.Dataset:
    attributes = {"size_x": result.size_x, "size_y": result.size_y, "periodic": int(result.periodic), "origin": result.origin}
    return _dataset({"heights": (("x", "y"), result.heights)}, _points(result.grid), attributes)


@to_xarray.register(_core.NormalContactState)
def _(result: _core.NormalContactState) -> xarray.Dataset:
    numbers = (
        "mean_pressure", "force", "mean_gap", "indentation", "contact_area_fraction", "elastic_energy", "residual", "iterations",
        "contact_modulus", "boundary",
    )  # fmt: skip
    attributes = {name: getattr(result, name) for name in numbers} | {"converged": int(result.converged)}
    fields = {name: (("x", "y"), getattr(result, name)) for name in ("contact_pressure", "gap")}
    return _dataset(fields, _points(result.grid), attributes)


@to_xarray.register(_core.ForceCurve)
def _(result: _core.ForceCurve) -> xarray.Dataset:
    names = (
        "force", "mean_gap", "indentation", "separation", "contact_area_fraction", "normal_stiffness", "tangential_stiffness",
        "converged",
    )  # fmt: skip
    columns = {name: (("pressure",), getattr(result, name)) for name in names}
    known = {name: column for name, column in columns.items() if not np.all(np.isnan(column[1]))}
    attributes = {"model": result.model, "nominal_area": result.nominal_area, "rms_height": result.rms_height}
    return _dataset(known, {"pressure": result.pressure}, attributes)


@to_xarray.register(_core.LocalDecayLength)
def _(result: _core.LocalDecayLength) -> xarray.Dataset:
    return _dataset({"local_decay_length": (("mean_gap",), result.local_decay_length)}, {"mean_gap": result.mean_gap}, {})


@to_xarray.register(_core.PowerSpectrum)
def _(result: _core.PowerSpectrum) -> xarray.Dataset:
    order = np.argsort(result.wavenumber_x)
    return _dataset(
        {"psd": (("wavenumber_x", "wavenumber_y"), result.psd[order])},
        {"wavenumber_x": result.wavenumber_x[order], "wavenumber_y": result.wavenumber_y},
        {"cell": result.cell},
    )


@to_xarray.register(_core.RadialSpectrum)
def _(result: _core.RadialSpectrum) -> xarray.Dataset:
    columns = {name: (("wavenumber",), getattr(result, name)) for name in ("psd", "modes")}
    return _dataset(columns, {"wavenumber": result.wavenumber}, {})


@to_xarray.register(_core.ProfilePsd)
def _(result: _core.ProfilePsd) -> xarray.Dataset:
    columns = {name: (("wavenumber",), getattr(result, name)) for name in ("profile_psd", "modes")}
    return _dataset(columns, {"wavenumber": result.wavenumber}, {"profiles": result.profiles, "length": result.length})


@to_xarray.register(_core.Correlation)
def _(result: _core.Correlation) -> xarray.Dataset:
    columns = {name: (("distance",), getattr(result, name)) for name in ("autocorrelation", "structure", "pairs")}
    return _dataset(columns, {"distance": result.distance}, {})


@to_xarray.register(_core.ScaleDependence)
def _(result: _core.ScaleDependence) -> xarray.Dataset:
    names = ("profile_slope", "profile_curvature", "min_curvature", "stencils")
    return _dataset({name: (("spacing",), getattr(result, name)) for name in names}, {"spacing": result.spacing}, {})


@to_xarray.register(_core.HeightHistogram)
def _(result: _core.HeightHistogram) -> xarray.Dataset:
    columns = {name: (("height",), getattr(result, name)) for name in ("height_density", "points")}
    return _dataset(columns, {"height": result.height}, {"width": result.width})


@to_xarray.register(_core.DamperMap)
def _(result: _core.DamperMap) -> xarray.Dataset:
    dims = ("normal_amplitude", "angular_frequency")
    return _dataset({"damping_constant": (dims, result.damping_constant)}, {name: getattr(result, name) for name in dims}, {})


@to_xarray.register(_core.FrictionMap)
def _(result: _core.FrictionMap) -> xarray.Dataset:
    dims = ("friction_number", "phase")
    names = ("loss_ratio", "relaxation_ratio", "slip_ratio")
    return _dataset({name: (dims, getattr(result, name)) for name in names}, {name: getattr(result, name) for name in dims}, {})


@to_xarray.register(_core.RegimeMap)
def _(result: _core.RegimeMap) -> xarray.Dataset:
    dims = ("velocity", "excursion")
    fields = {name: (dims, getattr(result, name)) for name in ("loss_ratio", "slip_ratio", "regime")}
    curves = {"no_slip_excursion": (("velocity",), result.no_slip_excursion)}
    names = ("no_slip_velocity", "sliding_excursion", "critical_velocity", "full_stick_ratio")
    return _dataset({**fields, **curves}, {name: getattr(result, name) for name in dims}, {name: getattr(result, name) for name in names})


@to_xarray.register(_core.StressMap)
def _(result: _core.StressMap) -> xarray.Dataset:
    fields = {name: (("angle", "radial_position"), getattr(result, name)) for name in ("shear", "contact_pressure")}
    curves = {name: (("angle",), getattr(result, name)) for name in ("contact_radius", "tangential_force")}
    return _dataset({**fields, **curves}, {"angle": result.angle, "radial_position": result.radial_position}, {})


@to_xarray.register(_core.CycleResult)
def _(result: _core.CycleResult) -> xarray.Dataset:
    names = (
        "indentation", "tangential", "tangential_force", "normal_force", "work", "contact_area", "slip_area",
        "tangential_stiffness",
    )  # fmt: skip
    attributes = {name: getattr(result, name) for name in ("work_per_cycle", "dissipated", "relaxation_work", "slip_work")}
    return _dataset({name: (("time_in_periods",), getattr(result, name)) for name in names}, {"time_in_periods": result.time_in_periods}, attributes)


@to_xarray.register(_core.StudyResult)
def _(result: _core.StudyResult) -> xarray.Dataset:
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
