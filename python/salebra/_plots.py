# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results. matplotlib is imported when the first one is drawn."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

_PREFIXES = {-15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("plot needs matplotlib; install it") from error
    return plt.subplots(layout="constrained")[1]


def _scale(values: npt.ArrayLike, unit: str) -> tuple[float, str]:
    """Factor and unit with the SI prefix that suits the values."""
    finite = np.abs(np.asarray(values, dtype=float))
    finite = finite[np.isfinite(finite)]
    largest = float(finite.max()) if finite.size else 0.0
    if largest == 0 or unit not in ("m", "Pa", "N", "J", "N/m", "N s/m", "W"):
        return 1.0, unit
    exponent = int(np.clip(3 * np.floor(np.log10(largest) / 3), -15, 12))
    return 10.0**-exponent, _PREFIXES[exponent] + unit


def _label(text: str, unit: str) -> str:
    return f"{text} ({unit})" if unit and unit != "1" else text


def _image(
    ax: Axes | None, grid: _core.Grid2D, values: npt.NDArray[Any], text: str, unit: str, keywords: dict[str, Any]
) -> Axes:
    drawn = _axes(ax)
    factor, length = _scale([grid.lx, grid.ly], "m")
    by, shown = _scale(values, unit)
    # pcolormesh wants edges; cell (ix, iy) has its point in its middle.
    x = (np.arange(grid.nx + 1) - 0.5) * grid.dx * factor
    y = (np.arange(grid.ny + 1) - 0.5) * grid.dy * factor
    options: dict[str, Any] = {"cmap": "viridis", "rasterized": True} | keywords
    mesh = drawn.pcolormesh(x, y, values.T * by, **options)
    drawn.set_aspect("equal")
    drawn.set_xlabel(_label("x", length))
    drawn.set_ylabel(_label("y", length))
    figure = drawn.get_figure()
    if figure is not None:
        figure.colorbar(mesh, ax=drawn, label=_label(text, shown))
    return drawn


def _line(
    ax: Axes | None,
    x: tuple[npt.ArrayLike, str, str],
    y: tuple[npt.ArrayLike, str, str],
    log: str,
    keywords: dict[str, Any],
) -> Axes:
    drawn = _axes(ax)
    (x_values, x_text, x_unit), (y_values, y_text, y_unit) = x, y
    x_factor, x_shown = _scale(x_values, x_unit)
    y_factor, y_shown = _scale(y_values, y_unit)
    drawn.plot(np.asarray(x_values) * x_factor, np.asarray(y_values) * y_factor, **keywords)
    drawn.set_xlabel(_label(x_text, x_shown))
    drawn.set_ylabel(_label(y_text, y_shown))
    if "x" in log:
        drawn.set_xscale("log")
    if "y" in log:
        drawn.set_yscale("log")
    if "label" in keywords:
        drawn.legend()
    return drawn


@singledispatch
def plot(result: Any, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws a result."""
    raise TypeError(f"{type(result).__name__} has no picture")


@plot.register(_core.Surface)
def _(result: _core.Surface, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _image(ax, result.grid, result.heights, "height", "m", keywords)


@plot.register(_core.NormalContactState)
def _(result: _core.NormalContactState, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _image(ax, result.grid, result.contact_pressure, "pressure", "Pa", {"cmap": "magma"} | keywords)


@plot.register(_core.ForceCurve)
def _(
    result: _core.ForceCurve, ax: Axes | None = None, fit: _core.ExponentialFit | bool = True, **keywords: Any
) -> Axes:
    """The curve, and the exponential law that is fitted to it: fit=False leaves it out, an ExponentialFit is drawn in its place."""
    keywords = {"marker": ".", "label": result.model} | keywords
    if np.isnan(result.mean_gap).any():
        return _line(ax, (result.indentation, "indentation δ", "m"), (result.force, "force F", "N"), "y", keywords)
    drawn = _line(ax, (result.mean_gap, "mean gap ū", "m"), (result.pressure, "pressure p", "Pa"), "y", keywords)
    if fit is True:
        try:
            fit = _core.fit_exponential(result)
        except _core.Error:  # too few points in the window: there is no line to draw
            fit = False
    if isinstance(fit, _core.ExponentialFit):
        _law_of_fit(drawn, fit, result.mean_gap, result.pressure)
    return drawn


def _law_of_fit(drawn: Axes, fit: _core.ExponentialFit, mean_gap: npt.ArrayLike, pressure: npt.ArrayLike) -> None:
    gap = np.asarray(mean_gap)
    x_factor, _ = _scale(gap, "m")
    y_factor, _ = _scale(pressure, "Pa")
    law = fit.reference_pressure * np.exp(-gap / fit.decay_length)
    factor, unit = _scale([fit.decay_length], "m")
    drawn.plot(gap * x_factor, law * y_factor, "--", label=f"exp(−ū/l), l = {fit.decay_length * factor:.4g} {unit}")
    drawn.legend()


@plot.register(_core.ExponentialFit)
def _(result: _core.ExponentialFit, ax: Axes | None = None, **keywords: Any) -> Axes:
    pressure = np.array([result.window.pressure_min, result.window.pressure_max])
    gap = result.decay_length * np.log(result.reference_pressure / pressure)
    keywords = {"linestyle": "--", "label": "exp(−ū/l)"} | keywords
    return _line(ax, (gap, "mean gap ū", "m"), (pressure, "pressure p", "Pa"), "y", keywords)


@plot.register(_core.ModelResult)
def _(result: _core.ModelResult, ax: Axes | None = None, **keywords: Any) -> Axes:
    return plot(result.curve, ax, **keywords)


@plot.register(_core.Realisation)
def _(result: _core.Realisation, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    for model in result.models:
        plot(model.curve, drawn, fit=model.model == "bem", **keywords)
    return drawn


@plot.register(_core.StudyResult)
def _(result: _core.StudyResult, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Pressure over mean gap of each model, means over the surfaces."""
    drawn = _axes(ax)
    every = [[mean.mean for mean in result.curve("mean_gap", model)] for model in result.models]
    x_factor, x_shown = _scale(every, "m")
    y_factor, y_shown = _scale(result.pressures, "Pa")
    for model, gap in zip(result.models, every):
        drawn.plot(np.array(gap) * x_factor, result.pressures * y_factor, **({"marker": ".", "label": model} | keywords))
    drawn.set_xlabel(_label("mean gap ū", x_shown))
    drawn.set_ylabel(_label("pressure p", y_shown))
    drawn.set_yscale("log")
    drawn.legend()
    return drawn


@plot.register(_core.ContactSpots)
def _(result: _core.ContactSpots, ax: Axes | None = None, **keywords: Any) -> Axes:
    """The number of spots that are at least as large."""
    keywords = {"drawstyle": "steps-pre"} | keywords
    count = np.arange(1, len(result) + 1)
    return _line(ax, (result.area, "area of a spot", "m²"), (count, "spots at least as large", "1"), "xy", keywords)


@plot.register(_core.SpotStatistics)
def _(result: _core.SpotStatistics, ax: Axes | None = None, **keywords: Any) -> Axes:
    """The number of spots by their size, in classes that double."""
    cells = 2.0 ** np.arange(len(result.spots_by_size))
    keywords = {"drawstyle": "steps-post"} | keywords
    return _line(ax, (cells, "cells of a spot, at least", "1"), (result.spots_by_size, "spots", "1"), "x", keywords)


@plot.register(_core.SummitList)
def _(result: _core.SummitList, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    factor, shown = _scale(result.height, "m")
    drawn.hist(result.height * factor, **({"bins": 40} | keywords))
    drawn.set_xlabel(_label("height of the summit", shown))
    drawn.set_ylabel("summits")
    return drawn


@plot.register(_core.PowerSpectrum)
def _(result: _core.PowerSpectrum, ax: Axes | None = None, **keywords: Any) -> Axes:
    order = np.argsort(result.wavenumber_x)
    density = np.log10(np.where(result.psd > 0, result.psd, np.nan))[order]
    axes = ((result.wavenumber_x[order], "wave number q_x", "rad/m"), (result.wavenumber_y, "wave number q_y", "rad/m"))
    return _map(ax, axes, density, "log₁₀ C, C in m⁴", "1", keywords)


@plot.register(_core.CorrelationMap)
def _(result: _core.CorrelationMap, ax: Axes | None = None, **keywords: Any) -> Axes:
    rows, columns = result.autocorrelation.shape
    x = (np.arange(rows) - rows // 2) * result.grid.dx
    axes = ((x, "distance along x", "m"), (np.arange(columns) * result.grid.dy, "distance along y", "m"))
    return _map(ax, axes, result.autocorrelation, "autocorrelation", "m²", keywords)


@plot.register(_core.Profile)
def _(result: _core.Profile, ax: Axes | None = None, **keywords: Any) -> Axes:
    x = np.arange(len(result.heights)) * result.dx
    return _line(ax, (x, "x", "m"), (result.heights, "height", "m"), "", keywords)


@plot.register(_core.MonteCarloCurve)
def _(result: _core.MonteCarloCurve, ax: Axes | None = None, **keywords: Any) -> Axes:
    return plot(result.mean, ax, **keywords)


@plot.register(_core.AsperityDamping)
def _(result: _core.AsperityDamping, ax: Axes | None = None, **keywords: Any) -> Axes:
    """What the summits lose, from the one that loses most."""
    work = np.sort(result.work[result.work > 0])[::-1]
    return _line(ax, (np.arange(1, len(work) + 1), "summit", "1"), (work, "loss in a cycle", "J"), "xy", keywords)


@plot.register(_core.ContactSetAt)
def _(result: _core.ContactSetAt, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    drawn.imshow(result.contact.T, **({"origin": "lower", "cmap": "Greys"} | keywords))
    drawn.set_xlabel("cell along x")
    drawn.set_ylabel("cell along y")
    return drawn


@plot.register(_core.SurfacePicture)
def _(result: _core.SurfacePicture, ax: Axes | None = None, **keywords: Any) -> Axes:
    spectrum = (np.asarray(result.wavenumber), "wave number q", "rad/m"), (np.asarray(result.psd), "C(q)", "m⁴")
    return _line(ax, *spectrum, "xy", keywords)


@plot.register(_core.BearingCurve)
def _(result: _core.BearingCurve, ax: Axes | None = None, **keywords: Any) -> Axes:
    part = np.linspace(0.0, 1.0, 201)
    height = np.array([result.height(float(p)) for p in part])
    return _line(ax, (part, "part of the surface above", "1"), (height, "height", "m"), "", keywords)


@plot.register(_core.SampledMotion)
def _(result: _core.SampledMotion, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _line(ax, (result.displacement, "displacement x", "m"), (result.indentation, "indentation δ", "m"), "", keywords)


@plot.register(_core.TrajectoryDamping)
def _(result: _core.TrajectoryDamping, ax: Axes | None = None, **keywords: Any) -> Axes:
    step = np.arange(len(result.tangential_force))
    return _line(ax, (step, "step of the period", "1"), (result.tangential_force, "tangential force F_x", "N"), "", keywords)


@plot.register(_core.SliderMotion)
def _(result: _core.SliderMotion, ax: Axes | None = None, **keywords: Any) -> Axes:
    offset = (result.slider_offset, "distance from the drive x − Vt", "m")
    return _line(ax, (result.time, "time t", "s"), offset, "", keywords)


@plot.register(_core.ViscoelasticDamping)
@plot.register(_core.ViscoelasticIndentation)
def _(result: _core.ViscoelasticDamping | _core.ViscoelasticIndentation, ax: Axes | None = None, **keywords: Any) -> Axes:
    step = np.arange(len(result.force))
    return _line(ax, (step, "step of the path", "1"), (result.force, "normal force F", "N"), "", keywords)


@plot.register(_core.NonGaussianSurface)
def _(result: _core.NonGaussianSurface, ax: Axes | None = None, **keywords: Any) -> Axes:
    return plot(result.surface, ax, **keywords)


@plot.register(_core.ConvertedPsd)
def _(result: _core.ConvertedPsd, ax: Axes | None = None, **keywords: Any) -> Axes:
    x, y = (result.wavenumber, "wave number", result.wavenumber_unit), (result.psd, "power spectral density", result.psd_unit)
    return _line(ax, x, y, "xy", keywords)


@plot.register(_core.LocalDecayLength)
def _(result: _core.LocalDecayLength, ax: Axes | None = None, **keywords: Any) -> Axes:
    keywords = {"marker": "."} | keywords
    return _line(ax, (result.mean_gap, "mean gap ū", "m"), (result.local_decay_length, "local decay length l", "m"), "", keywords)


@plot.register(_core.RadialSpectrum)
def _(result: _core.RadialSpectrum, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _line(ax, (result.wavenumber, "wave number q", "rad/m"), (result.psd, "C(q)", "m⁴"), "xy", keywords)


@plot.register(_core.ProfilePsd)
def _(result: _core.ProfilePsd, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _line(ax, (result.wavenumber, "wave number q", "rad/m"), (result.profile_psd, "C₁(q)", "m³"), "xy", keywords)


@plot.register(_core.Correlation)
def _(result: _core.Correlation, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _line(ax, (result.distance, "distance", "m"), (result.autocorrelation, "autocorrelation", "m²"), "", keywords)


@plot.register(_core.ScaleDependence)
def _(result: _core.ScaleDependence, ax: Axes | None = None, **keywords: Any) -> Axes:
    return _line(ax, (result.spacing, "distance", "m"), (result.profile_slope, "rms slope", "1"), "xy", keywords)


@plot.register(_core.HeightHistogram)
def _(result: _core.HeightHistogram, ax: Axes | None = None, **keywords: Any) -> Axes:
    keywords = {"drawstyle": "steps-mid"} | keywords
    return _line(ax, (result.height, "height", "m"), (result.height_density, "density", "1/m"), "", keywords)


def _map(
    ax: Axes | None,
    axes: Sequence[tuple[npt.NDArray[Any], str, str]],
    values: npt.NDArray[Any],
    text: str,
    unit: str,
    keywords: dict[str, Any],
) -> Axes:
    drawn = _axes(ax)
    (x, x_text, x_unit), (y, y_text, y_unit) = axes
    x_factor, x_shown = _scale(x, x_unit)
    y_factor, y_shown = _scale(y, y_unit)
    factor, shown = _scale(values, unit)
    options: dict[str, Any] = {"shading": "nearest", "rasterized": True} | keywords
    mesh = drawn.pcolormesh(x * x_factor, y * y_factor, values.T * factor, **options)
    drawn.set_xlabel(_label(x_text, x_shown))
    drawn.set_ylabel(_label(y_text, y_shown))
    figure = drawn.get_figure()
    if figure is not None:
        figure.colorbar(mesh, ax=drawn, label=_label(text, shown))
    return drawn


@plot.register(_core.StressMap)
def _(result: _core.StressMap, ax: Axes | None = None, **keywords: Any) -> Axes:
    finite = np.abs(result.shear[np.isfinite(result.shear)])
    limit = float(np.quantile(finite, 0.99)) if finite.size else 1.0
    factor, _ = _scale(result.shear, "Pa")
    keywords = {"cmap": "RdBu_r", "vmin": -limit * factor, "vmax": limit * factor} | keywords
    axes = ((result.angle, "phase θ", "rad"), (result.radial_position, "radius r", "m"))
    return _map(ax, axes, result.shear, "shear stress τ", "Pa", keywords)


@plot.register(_core.FrictionMap)
def _(result: _core.FrictionMap, ax: Axes | None = None, **keywords: Any) -> Axes:
    axes = ((result.friction_number, "M = μE*u_z/(G*u_x)", "1"), (result.phase, "phase φ₀", "rad"))
    drawn = _map(ax, axes, result.loss_ratio, "W(μ)/W(∞)", "1", keywords)
    drawn.set_xscale("log")
    return drawn


@plot.register(_core.RegimeMap)
def _(result: _core.RegimeMap, ax: Axes | None = None, **keywords: Any) -> Axes:
    axes = ((result.velocity, "velocity v", "m/s"), (result.excursion, "excursion X", "m"))
    drawn = _map(ax, axes, np.log10(result.loss_ratio), "log₁₀ W/W(no slip)", "1", keywords)
    drawn.set_xscale("log")
    drawn.set_yscale("log")
    return drawn


@plot.register(_core.DamperMap)
def _(result: _core.DamperMap, ax: Axes | None = None, **keywords: Any) -> Axes:
    axes = ((result.normal_amplitude, "normal amplitude u_z", "m"), (result.angular_frequency, "angular frequency ω", "rad/s"))
    drawn = _map(ax, axes, result.damping_constant, "damping constant γ", "N s/m", keywords)
    drawn.set_xscale("log")
    drawn.set_yscale("log")
    return drawn


def plot_law(law: _core.ContactLaw, indentation: npt.ArrayLike, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws F(δ)."""
    return _line(ax, (indentation, "indentation δ", "m"), (law.force(indentation), "force F", "N"), "y", keywords)


@plot.register(_core.CycleResult)
def _(result: _core.CycleResult, ax: Axes | None = None, **keywords: Any) -> Axes:
    force = (result.tangential_force, "tangential force F_x", "N")
    return _line(ax, (result.tangential, "tangential displacement x", "m"), force, "", keywords)
