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

# Names whose meaning depends on where they stand, with what they mean there.
_SPECIAL = {
    "wavenumber": ("rad/m", "wave number"),
    "wavenumber_x": ("rad/m", "wave number along x"),
    "wavenumber_y": ("rad/m", "wave number along y"),
    "distance": ("m", "distance"),
    "spacing": ("m", "distance of the finite difference"),
    "autocorrelation": ("m^2", "autocorrelation of heights"),
    "structure": ("m^2", "structure function"),
    "pairs": ("1", "number of pairs"),
    "modes": ("1", "number of modes"),
    "rms_curvature": ("1/m", "root mean square curvature"),
    "least_curvature": ("1/m", "least curvature: the sharpest peak"),
    "stencils": ("1", "number of stencils"),
    "height": ("m", "height"),
    "gap": ("m", "gap"),
    "angle": ("rad", "phase of the normal oscillation"),
    "radius": ("m", "distance from the axis"),
    "time": ("1", "time over the period"),
    "tangential": ("m", "tangential displacement"),
    "dissipated": ("J", "energy dissipated since the start of the period"),
    "normal_force": ("N", "normal force"),
    "contact_area": ("m^2", "contact area"),
    "slip_area": ("m^2", "area of cells that slip"),
    "loss": ("J/m^2", "energy dissipated in a period by unit area"),
    "contact": ("1", "whether the cell is in contact"),
    "converged": ("1", "whether the solver converged"),
}


def _variable(name: str, dims: tuple[str, ...], values: Any, meaning: tuple[str, str] | None = None) -> Any:
    units, long_name = meaning or _SPECIAL.get(name) or _core.quantity(name)
    return dims, np.asarray(values), {"units": units, "long_name": long_name}


def _dataset(
    variables: Mapping[str, tuple[tuple[str, ...], Any]],
    coordinates: Mapping[str, Any],
    attributes: Mapping[str, Any],
    meanings: dict[str, tuple[str, str]] | None = None,
) -> xarray.Dataset:
    try:
        import xarray
    except ImportError as error:
        raise ImportError("to_xarray needs xarray; install it") from error
    meanings = meanings or {}
    return xarray.Dataset(
        {name: _variable(name, dims, values, meanings.get(name)) for name, (dims, values) in variables.items()},
        {name: _variable(name, (name,), values, meanings.get(name)) for name, values in coordinates.items()},
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
    fields = {name: (("x", "y"), getattr(result, name)) for name in ("pressure", "gap")}
    return _dataset(fields, _points(result.grid), attributes, {"pressure": ("Pa", "contact pressure")})


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
    return _dataset({"decay_length": (("mean_gap",), result.decay_length)}, {"mean_gap": result.mean_gap}, {})


@to_xarray.register(_core.PowerSpectrum)
def _(result: _core.PowerSpectrum) -> xarray.Dataset:
    order = np.argsort(result.wavenumber_x)
    return _dataset(
        {"density": (("wavenumber_x", "wavenumber_y"), result.density[order])},
        {"wavenumber_x": result.wavenumber_x[order], "wavenumber_y": result.wavenumber_y},
        {"cell": result.cell},
        {"density": ("m^4", "power spectral density C, h_rms^2 = integral of C d^2q")},
    )


@to_xarray.register(_core.RadialSpectrum)
def _(result: _core.RadialSpectrum) -> xarray.Dataset:
    columns = {name: (("wavenumber",), getattr(result, name)) for name in ("density", "modes")}
    meaning = {"density": ("m^4", "power spectral density C, h_rms^2 = 2 pi integral of q C dq")}
    return _dataset(columns, {"wavenumber": result.wavenumber}, {}, meaning)


@to_xarray.register(_core.ProfilePsd)
def _(result: _core.ProfilePsd) -> xarray.Dataset:
    columns = {name: (("wavenumber",), getattr(result, name)) for name in ("density", "modes")}
    meaning = {"density": ("m^3", "power spectral density C1 of profiles, h_rms^2 = integral of C1 dq over all q")}
    return _dataset(columns, {"wavenumber": result.wavenumber}, {"profiles": result.profiles, "length": result.length}, meaning)


@to_xarray.register(_core.Correlation)
def _(result: _core.Correlation) -> xarray.Dataset:
    columns = {name: (("distance",), getattr(result, name)) for name in ("autocorrelation", "structure", "pairs")}
    return _dataset(columns, {"distance": result.distance}, {})


@to_xarray.register(_core.ScaleDependence)
def _(result: _core.ScaleDependence) -> xarray.Dataset:
    names = ("rms_slope", "rms_curvature", "least_curvature", "stencils")
    return _dataset({name: (("spacing",), getattr(result, name)) for name in names}, {"spacing": result.spacing}, {})


@to_xarray.register(_core.HeightHistogram)
def _(result: _core.HeightHistogram) -> xarray.Dataset:
    meaning = {"density": ("1/m", "part of the points in the bin over its width"), "points": ("1", "points in the bin")}
    columns = {name: (("height",), getattr(result, name)) for name in ("density", "points")}
    return _dataset(columns, {"height": result.height}, {"width": result.width}, meaning)


@to_xarray.register(_core.DamperMap)
def _(result: _core.DamperMap) -> xarray.Dataset:
    dims = ("normal_amplitude", "angular_frequency")
    return _dataset({"damping_constant": (dims, result.damping_constant)}, {name: getattr(result, name) for name in dims}, {})


@to_xarray.register(_core.FrictionMap)
def _(result: _core.FrictionMap) -> xarray.Dataset:
    dims = ("friction_number", "phase")
    names = ("loss", "relaxation", "slip")
    meanings = {name: ("1", f"{name} over the loss in full stick") for name in names}
    return _dataset(
        {name: (dims, getattr(result, name)) for name in names}, {name: getattr(result, name) for name in dims}, {}, meanings
    )


@to_xarray.register(_core.StressMap)
def _(result: _core.StressMap) -> xarray.Dataset:
    fields = {name: (("angle", "radius"), getattr(result, name)) for name in ("shear", "pressure")}
    curves = {name: (("angle",), getattr(result, name)) for name in ("contact_radius", "tangential_force")}
    meaning = {"pressure": ("Pa", "contact pressure")}
    return _dataset({**fields, **curves}, {"angle": result.angle, "radius": result.radius}, {}, meaning)


@to_xarray.register(_core.CycleResult)
def _(result: _core.CycleResult) -> xarray.Dataset:
    names = (
        "indentation", "tangential", "tangential_force", "normal_force", "work", "contact_area", "slip_area",
        "tangential_stiffness",
    )  # fmt: skip
    attributes = {name: getattr(result, name) for name in ("work_per_cycle", "dissipated", "relaxation_work", "slip_work")}
    return _dataset({name: (("time",), getattr(result, name)) for name in names}, {"time": result.time}, attributes)


@to_xarray.register(_core.StudyResult)
def _(result: _core.StudyResult) -> xarray.Dataset:
    columns: dict[str, tuple[tuple[str, ...], Any]] = {}
    meanings: dict[str, tuple[str, str]] = {}

    for described, of in ((_core._curve_columns(), result.curve), (_core._damping_columns(), result.damping)):
        for name, units, long_name in described:
            if name == "pressure":
                continue
            means = [of(name, model) for model in result.models]
            for part in ("mean", "low", "high"):
                columns[f"{name}_{part}"] = ("model", "pressure"), [[getattr(mean, part) for mean in row] for row in means]
                meanings[f"{name}_{part}"] = units, f"{long_name}, {part}"
    meanings["model"] = "1", "contact model"
    return _dataset(columns, {"model": result.models, "pressure": result.pressures}, {}, meanings)


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
