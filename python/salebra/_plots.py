# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results. matplotlib is imported when the first one is drawn."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._results import points
from ._show import prefix_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.axes import Axes

# What stands along an axis, with its text and unit: values, or the attribute of a result or the function of it that has them.
_Along = tuple[Any, str, str]


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
    exponent, prefix = prefix_of(float(finite.max()) if finite.size else 0.0, unit)
    return 10.0**-exponent, prefix + unit


def _label(text: str, unit: str) -> str:
    return f"{text} ({unit})" if unit and unit != "1" else text


def _of(result: Any, along: _Along) -> _Along:
    values, text, unit = along
    return (getattr(result, values) if isinstance(values, str) else values(result) if callable(values) else values), text, unit


def _name_axes(drawn: Axes, x: tuple[str, str], y: tuple[str, str], log: str) -> None:
    drawn.set_xlabel(_label(*x))
    drawn.set_ylabel(_label(*y))
    if "x" in log:
        drawn.set_xscale("log")
    if "y" in log:
        drawn.set_yscale("log")


def _line(ax: Axes | None, x: _Along, y: _Along, log: str, keywords: dict[str, Any]) -> Axes:
    drawn = _axes(ax)
    (x_values, x_text, x_unit), (y_values, y_text, y_unit) = x, y
    x_factor, x_shown = _scale(x_values, x_unit)
    y_factor, y_shown = _scale(y_values, y_unit)
    drawn.plot(np.asarray(x_values) * x_factor, np.asarray(y_values) * y_factor, **keywords)
    _name_axes(drawn, (x_text, x_shown), (y_text, y_shown), log)
    if "label" in keywords:
        drawn.legend()
    return drawn


def _map(ax: Axes | None, x: _Along, y: _Along, z: _Along, log: str, keywords: dict[str, Any], equal: bool = False) -> Axes:
    """Colours over two axes; equal: a metre is as long along both."""
    drawn = _axes(ax)
    (x_values, x_text, x_unit), (y_values, y_text, y_unit), (values, text, unit) = x, y, z
    both = [*x_values, *y_values]
    x_factor, x_shown = _scale(both if equal else x_values, x_unit)
    y_factor, y_shown = _scale(both if equal else y_values, y_unit)
    factor, shown = _scale(values, unit)
    options: dict[str, Any] = {"shading": "nearest", "rasterized": True} | keywords
    mesh = drawn.pcolormesh(np.asarray(x_values) * x_factor, np.asarray(y_values) * y_factor, np.asarray(values).T * factor, **options)
    if equal:
        drawn.set_aspect("equal")
    _name_axes(drawn, (x_text, x_shown), (y_text, y_shown), log)
    figure = drawn.get_figure()
    if figure is not None:
        figure.colorbar(mesh, ax=drawn, label=_label(text, shown))
    return drawn


def _steps(values: str, first: int = 1) -> Callable[[Any], npt.NDArray[Any]]:
    """Numbers of the values of that attribute."""
    return lambda result: np.arange(first, first + len(getattr(result, values)))


def _falling_work(result: _core.AsperityDamping) -> npt.NDArray[Any]:
    return np.sort(result.work[result.work > 0])[::-1]


def _window(result: _core.ExponentialFit) -> npt.NDArray[Any]:
    return np.array([result.window.pressure_min, result.window.pressure_max])


_PART = np.linspace(0.0, 1.0, 201)
_GAP, _PRESSURE, _HEIGHT = ("mean_gap", "mean gap ū", "m"), ("pressure", "pressure p", "Pa"), ("heights", "height", "m")
_SPECTRUM = ("wavenumber", "wave number q", "rad/m"), ("psd", "C(q)", "m⁴")
_NORMAL_FORCE = (_steps("force", 0), "step of the path", "1"), ("force", "normal force F", "N")

# Lines: along x and along y, which axes are logarithmic, and how the line looks.
_LINES: dict[type, tuple[_Along, _Along, str, dict[str, Any]]] = {
    _core.ExponentialFit: (
        (lambda fit: fit.decay_length * np.log(fit.reference_pressure / _window(fit)), *_GAP[1:]), (_window, *_PRESSURE[1:]),
        "y", {"linestyle": "--", "label": "exp(−ū/l)"},
    ),
    # The number of spots that are at least as large, and by their size in classes that double.
    _core.ContactSpots: (("area", "area of a spot", "m²"), (_steps("area"), "spots at least as large", "1"), "xy", {"drawstyle": "steps-pre"}),
    _core.SpotStatistics: (
        (lambda spots: 2.0 ** _steps("spots_by_size", 0)(spots), "cells of a spot, at least", "1"), ("spots_by_size", "spots", "1"),
        "x", {"drawstyle": "steps-post"},
    ),
    _core.Profile: ((lambda profile: _steps("heights", 0)(profile) * profile.dx, "x", "m"), _HEIGHT, "", {}),
    # What the summits lose, from the one that loses most.
    _core.AsperityDamping: (
        (lambda loss: np.arange(1, len(_falling_work(loss)) + 1), "summit", "1"), (_falling_work, "loss in a cycle", "J"), "xy", {},
    ),
    _core.SurfacePicture: (*_SPECTRUM, "xy", {}),
    _core.RadialSpectrum: (*_SPECTRUM, "xy", {}),
    _core.ProfilePsd: (_SPECTRUM[0], ("profile_psd", "C₁(q)", "m³"), "xy", {}),
    _core.BearingCurve: (
        (_PART, "part of the surface above", "1"), (lambda curve: curve.height(_PART), "height", "m"), "", {},
    ),
    _core.SampledMotion: (("displacement", "displacement x", "m"), ("indentation", "indentation δ", "m"), "", {}),
    _core.TrajectoryDamping: (
        (_steps("tangential_force", 0), "step of the period", "1"), ("tangential_force", "tangential force F_x", "N"), "", {},
    ),
    _core.CycleResult: (("tangential", "tangential displacement x", "m"), ("tangential_force", "tangential force F_x", "N"), "", {}),
    _core.SliderMotion: (("time", "time t", "s"), ("slider_offset", "distance from the drive x − Vt", "m"), "", {}),
    _core.ViscoelasticDamping: (*_NORMAL_FORCE, "", {}),
    _core.ViscoelasticIndentation: (*_NORMAL_FORCE, "", {}),
    _core.LocalDecayLength: (_GAP, ("local_decay_length", "local decay length l", "m"), "", {"marker": "."}),
    _core.Correlation: (("distance", "distance", "m"), ("autocorrelation", "autocorrelation", "m²"), "", {}),
    _core.ScaleDependence: (("spacing", "distance", "m"), ("profile_slope", "rms slope", "1"), "xy", {}),
    _core.HeightHistogram: (("height", "height", "m"), ("height_density", "density", "1/m"), "", {"drawstyle": "steps-mid"}),
}  # fmt: skip


def _logarithm(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    return np.log10(np.where(values > 0, values, np.nan))


def _shear_limits(result: _core.StressMap) -> dict[str, Any]:
    """Both singularities would take all the colour."""
    finite = np.abs(result.shear[np.isfinite(result.shear)])
    limit = (float(np.quantile(finite, 0.99)) if finite.size else 1.0) * _scale(result.shear, "Pa")[0]
    return {"cmap": "RdBu_r", "vmin": -limit, "vmax": limit}


_OVER_GRID = (lambda of: points(of.grid, "x"), "x", "m"), (lambda of: points(of.grid, "y"), "y", "m")

# Maps: along x and along y, the colours, which axes are logarithmic, and how the map looks.
_MAPS: dict[type, tuple[_Along, _Along, _Along, str, Callable[[Any], dict[str, Any]] | None]] = {
    _core.Surface: (*_OVER_GRID, _HEIGHT, "", None),
    _core.NormalContactState: (*_OVER_GRID, ("contact_pressure", "pressure", "Pa"), "", lambda _: {"cmap": "magma"}),
    _core.PowerSpectrum: (
        (lambda spectrum: np.sort(spectrum.wavenumber_x), "wave number q_x", "rad/m"), ("wavenumber_y", "wave number q_y", "rad/m"),
        (lambda spectrum: _logarithm(spectrum.psd)[np.argsort(spectrum.wavenumber_x)], "log₁₀ C, C in m⁴", "1"), "", None,
    ),
    _core.CorrelationMap: (
        (lambda map: (np.arange(len(map.autocorrelation)) - len(map.autocorrelation) // 2) * map.grid.dx, "distance along x", "m"),
        (lambda map: np.arange(map.autocorrelation.shape[1]) * map.grid.dy, "distance along y", "m"),
        ("autocorrelation", "autocorrelation", "m²"), "", None,
    ),
    _core.StressMap: (("angle", "phase θ", "rad"), ("radial_position", "radius r", "m"), ("shear", "shear stress τ", "Pa"), "", _shear_limits),
    _core.FrictionMap: (
        ("friction_number", "M = μE*u_z/(G*u_x)", "1"), ("phase", "phase φ₀", "rad"), ("loss_ratio", "W(μ)/W(∞)", "1"), "x", None,
    ),
    _core.RegimeMap: (
        ("velocity", "velocity v", "m/s"), ("excursion", "excursion X", "m"),
        (lambda map: np.log10(map.loss_ratio), "log₁₀ W/W(no slip)", "1"), "xy", None,
    ),
    _core.DamperMap: (
        ("normal_amplitude", "normal amplitude u_z", "m"), ("angular_frequency", "angular frequency ω", "rad/s"),
        ("damping_constant", "damping constant γ", "N s/m"), "xy", None,
    ),
}  # fmt: skip

# Results that are drawn as a part of theirs.
_PARTS = {_core.ModelResult: "curve", _core.MonteCarloCurve: "mean", _core.NonGaussianSurface: "surface"}


@singledispatch
def plot(result: Any, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws a result."""
    kind = type(result)
    if kind in _PARTS:
        return plot(getattr(result, _PARTS[kind]), ax, **keywords)
    if kind in _LINES:
        x, y, log, look = _LINES[kind]
        return _line(ax, _of(result, x), _of(result, y), log, look | keywords)
    if kind in _MAPS:
        x, y, z, log, looks = _MAPS[kind]
        look = looks(result) if looks else {}
        return _map(ax, _of(result, x), _of(result, y), _of(result, z), log, look | keywords, x is _OVER_GRID[0])
    raise TypeError(f"{kind.__name__} has no picture")


@plot.register(_core.ForceCurve)
def _(
    result: _core.ForceCurve, ax: Axes | None = None, fit: _core.ExponentialFit | bool = True, **keywords: Any
) -> Axes:
    """The curve, and the exponential law that is fitted to it: fit=False leaves it out, an ExponentialFit is drawn in its place."""
    keywords = {"marker": ".", "label": result.model} | keywords
    if np.isnan(result.mean_gap).any():
        return _line(ax, (result.indentation, "indentation δ", "m"), (result.force, "force F", "N"), "y", keywords)
    drawn = _line(ax, _of(result, _GAP), _of(result, _PRESSURE), "y", keywords)
    if fit is True:
        try:
            fit = _core.fit_exponential(result)
        except _core.Error:  # too few points in the window: there is no line to draw
            fit = False
    if isinstance(fit, _core.ExponentialFit):
        law = fit.reference_pressure * np.exp(-result.mean_gap / fit.decay_length)
        factor, unit = _scale([fit.decay_length], "m")
        drawn.plot(
            result.mean_gap * _scale(result.mean_gap, "m")[0], law * _scale(result.pressure, "Pa")[0], "--",
            label=f"exp(−ū/l), l = {fit.decay_length * factor:.4g} {unit}",
        )  # fmt: skip
        drawn.legend()
    return drawn


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
    _name_axes(drawn, (_GAP[1], x_shown), (_PRESSURE[1], y_shown), "y")
    drawn.legend()
    return drawn


@plot.register(_core.StudyAnswer)
def _(result: _core.StudyAnswer, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Damping constant over pressure with its 95 % intervals, and that without slip."""
    drawn = _axes(ax)
    x_factor, x_shown = _scale(result.pressures, "Pa")
    means = [[one.mean for one in row] for row in (result.damping_constant, result.damping_constant_without_slip)]
    y_factor, y_shown = _scale(means, "N s/m")
    bars = np.array([[one.mean - one.low, one.high - one.mean] for one in result.damping_constant]).T
    drawn.errorbar(
        result.pressures * x_factor, np.array(means[0]) * y_factor, bars * y_factor,
        **({"marker": ".", "label": "as described" if result.slip_followed else "without slip"} | keywords),
    )  # fmt: skip
    if result.slip_followed:
        drawn.plot(result.pressures * x_factor, np.array(means[1]) * y_factor, "--", label="without slip")
    _name_axes(drawn, (_PRESSURE[1], x_shown), ("damping constant γ", y_shown), "xy")
    drawn.legend()
    return drawn


@plot.register(_core.SummitList)
def _(result: _core.SummitList, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    factor, shown = _scale(result.height, "m")
    drawn.hist(result.height * factor, **({"bins": 40} | keywords))
    _name_axes(drawn, ("height of the summit", shown), ("summits", "1"), "")
    return drawn


@plot.register(_core.ContactSetAt)
def _(result: _core.ContactSetAt, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    drawn.imshow(result.contact.T, **({"origin": "lower", "cmap": "Greys"} | keywords))
    _name_axes(drawn, ("cell along x", "1"), ("cell along y", "1"), "")
    return drawn


@plot.register(_core.ConvertedPsd)
def _(result: _core.ConvertedPsd, ax: Axes | None = None, **keywords: Any) -> Axes:
    x, y = (result.wavenumber, "wave number", result.wavenumber_unit), (result.psd, "power spectral density", result.psd_unit)
    return _line(ax, x, y, "xy", keywords)


def plot_law(law: _core.ContactLaw, indentation: npt.ArrayLike, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws F(δ)."""
    return _line(ax, (indentation, "indentation δ", "m"), (law.force(indentation), "force F", "N"), "y", keywords)
