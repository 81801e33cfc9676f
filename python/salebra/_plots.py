# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results. The first picture imports matplotlib."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._results import points
from ._show import PREFIXED, columns, shown, unit_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.ticker import Formatter

# The quantity along an axis (values, the name of an attribute of the result, or a function of the result), its text and its unit.
_Along = tuple[Any, str, str]


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("plot needs matplotlib; install it") from error
    return plt.subplots(layout="constrained")[1]


def _label(text: str, unit: str) -> str:
    return text if unit in ("", "1") or unit in PREFIXED else f"{text} ({unit})"


def _formatter(unit: str) -> Formatter | None:
    """Numbers along an axis have prefix and unit, "2 µm". The data stay in SI units, so that curves can share axes."""
    from matplotlib.ticker import EngFormatter

    return EngFormatter(unit) if unit in PREFIXED else None


def _of(result: Any, along: _Along) -> _Along:
    values, text, unit = along
    return (getattr(result, values) if isinstance(values, str) else values(result) if callable(values) else values), text, unit


def _name_axes(drawn: Axes, x: tuple[str, str], y: tuple[str, str], log: str) -> None:
    if "x" in log:
        drawn.set_xscale("log")
    if "y" in log:
        drawn.set_yscale("log")
    for axis, (text, unit) in ((drawn.xaxis, x), (drawn.yaxis, y)):
        axis.set_label_text(_label(text, unit))
        formatter = _formatter(unit)
        if formatter is not None:
            axis.set_major_formatter(formatter)


def _line(ax: Axes | None, x: _Along, y: _Along, log: str, keywords: dict[str, Any]) -> Axes:
    drawn = _axes(ax)
    # A logarithmic axis cannot show negative values, such as tension.
    log = "".join(axis for axis, (values, _, _) in (("x", x), ("y", y)) if axis in log and not np.any(np.asarray(values) < 0))
    drawn.plot(np.asarray(x[0]), np.asarray(y[0]), **keywords)
    _name_axes(drawn, x[1:], y[1:], log)
    if "label" in keywords:
        drawn.legend()
    return drawn


def _map(ax: Axes | None, x: _Along, y: _Along, z: _Along, log: str, keywords: dict[str, Any], equal: bool = False) -> Axes:
    """Draws colours over two axes. equal: a metre has the same length along both."""
    drawn = _axes(ax)
    values, text, unit = z
    options: dict[str, Any] = {"shading": "nearest", "rasterized": True} | keywords
    mesh = drawn.pcolormesh(np.asarray(x[0]), np.asarray(y[0]), np.asarray(values).T, **options)
    if equal:
        drawn.set_aspect("equal")
    _name_axes(drawn, x[1:], y[1:], log)
    figure = drawn.get_figure()
    if figure is not None:
        figure.colorbar(mesh, ax=drawn, label=_label(text, unit), format=_formatter(unit))
    return drawn


def _steps(values: str, first: int = 1) -> Callable[[Any], npt.NDArray[Any]]:
    """The numbers first, first + 1, … of the values of an attribute."""
    return lambda result: np.arange(first, first + len(getattr(result, values)))


def _falling_work(result: _core.AsperityDamping) -> npt.NDArray[Any]:
    return np.sort(result.work[result.work > 0])[::-1]


def _window(result: _core.ExponentialFit) -> npt.NDArray[Any]:
    return np.array([result.window.pressure_min, result.window.pressure_max])


_PART = np.linspace(0.0, 1.0, 201)
_GAP, _PRESSURE, _HEIGHT = ("mean_gap", "mean gap ū", "m"), ("pressure", "pressure p", "Pa"), ("heights", "height", "m")
_SPECTRUM = ("wavenumber", "wave number q", "rad/m"), ("psd", "C(q)", "m⁴")
_NORMAL_FORCE = (_steps("force", 0), "step of the path", "1"), ("force", "normal force F", "N")

# Lines: the quantities along x and y, the logarithmic axes, and the style.
_LINES: dict[type, tuple[_Along, _Along, str, dict[str, Any]]] = {
    _core.ExponentialFit: (
        (lambda fit: fit.decay_length * np.log(fit.reference_pressure / _window(fit)), *_GAP[1:]), (_window, *_PRESSURE[1:]),
        "y", {"linestyle": "--", "label": "exp(−ū/l)"},
    ),
    # Number of spots at least as large, and number in classes of size that double.
    _core.ContactSpots: (("area", "area of a spot", "m²"), (_steps("area"), "spots at least as large", "1"), "xy", {"drawstyle": "steps-pre"}),
    _core.SpotStatistics: (
        (lambda spots: 2.0 ** _steps("spots_by_size", 0)(spots), "cells of a spot, at least", "1"), ("spots_by_size", "spots", "1"),
        "x", {"drawstyle": "steps-post"},
    ),
    _core.Profile: ((lambda profile: _steps("heights", 0)(profile) * profile.dx, "x", "m"), _HEIGHT, "", {}),
    # Losses of the summits in decreasing order.
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
    """Limits of the colours, without which the two singularities would use the whole range."""
    finite = np.abs(result.shear[np.isfinite(result.shear)])
    limit = float(np.quantile(finite, 0.99)) if finite.size else 1.0
    return {"cmap": "RdBu_r", "vmin": -limit, "vmax": limit}


_OVER_GRID = (lambda of: points(of.grid, "x"), "x", "m"), (lambda of: points(of.grid, "y"), "y", "m")

# Maps: the quantities along x and y and in colour, the logarithmic axes, and the style.
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

# Results of which a part is drawn.
_PARTS = {_core.MonteCarloCurve: "mean", _core.NonGaussianSurface: "surface"}


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
    """Draws the curve and an exponential law fitted to it. fit=False draws no law; an ExponentialFit is drawn instead."""
    keywords = {"marker": ".", "label": result.model or "curve"} | keywords
    if np.isnan(result.mean_gap).any():
        return _line(ax, (result.indentation, "indentation δ", "m"), (result.force, "force F", "N"), "y", keywords)
    drawn = _line(ax, _of(result, _GAP), _of(result, _PRESSURE), "y", keywords)
    if fit is True:
        try:
            fit = _core.fit_exponential(result)
        except _core.Error:  # too few points in the window
            fit = False
    if isinstance(fit, _core.ExponentialFit):
        law = fit.reference_pressure * np.exp(-result.mean_gap / fit.decay_length)
        drawn.plot(result.mean_gap, law, "--", label=f"exp(−ū/l), l = {shown(fit.decay_length, 'm')}")
        drawn.legend()
    return drawn


@plot.register(_core.ModelResult)
def _(result: _core.ModelResult, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws the curve with the name of the model in the study."""
    return plot(result.curve, ax, **({"label": result.model} | keywords))


@plot.register(_core.Realisation)
def _(result: _core.Realisation, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    for model in result.models:
        plot(model, drawn, **({"fit": model.model == "bem"} | keywords))
    return drawn


@plot.register(_core.StudyResult)
def _(result: _core.StudyResult, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws pressure over mean gap of each model, as means over the surfaces."""
    drawn = _axes(ax)
    for model in result.models:
        drawn.plot(result.curve("mean_gap", model).mean, result.pressures, **({"marker": ".", "label": model} | keywords))
    _name_axes(drawn, _GAP[1:], _PRESSURE[1:], "y")
    drawn.legend()
    return drawn


def _bars(means: Any) -> npt.NDArray[Any] | None:
    """Lengths of error bars below and above means: to the 95 % limits if there are any, else the numerical errors."""
    limits = np.array([means.mean - means.low, means.high - means.mean])
    errors = np.array([means.error] * 2) if hasattr(means, "error") else limits
    bars = errors if np.isnan(limits).all() else limits
    return None if np.isnan(bars).all() else bars


@plot.register(_core.MeanCurve)
@plot.register(_core.StatedMeanCurve)
def _(result: Any, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws the means with their 95 % limits."""
    drawn = _axes(ax)
    drawn.errorbar(result.values, result.mean, _bars(result), **({"marker": "."} | keywords))
    x, y = (_core.quantity(name)[::-1] for name in (result.coordinate, result.quantity))
    _name_axes(drawn, x, y, "")
    return drawn


@plot.register(_core.SpotCurve)
@plot.register(_core.FlowFactorCurve)
def _(result: Any, ax: Axes | None = None, quantity: str = "", **keywords: Any) -> Axes:
    """Draws a quantity of the curve, by default the first."""
    name = quantity or [name for name in columns(result) if name != result.coordinate][0]
    x, y = ((getattr(result, one), _core.quantity(one)[1], unit_of(result, one)) for one in (result.coordinate, name))
    return _line(ax, x, y, "x", {"marker": "."} | keywords)


@plot.register(_core.StudySolution)
def _(result: _core.StudySolution, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws the damping constant over pressure with its 95 % intervals (numerical errors for one surface), and without slip."""
    drawn = _axes(ax)
    found = result.damping_constant
    drawn.errorbar(
        result.pressures, found.mean, _bars(found),
        **({"marker": ".", "label": "with slip" if result.slip_followed else "without slip"} | keywords),
    )  # fmt: skip
    if result.slip_followed:
        drawn.plot(result.pressures, result.damping_constant_without_slip.mean, "--", label="without slip")
    _name_axes(drawn, _PRESSURE[1:], ("damping constant γ", "N s/m"), "xy")
    drawn.legend()
    return drawn


@plot.register(_core.DampingCurve)
@plot.register(_core.DampingPointCurve)
def _(result: _core.DampingCurve | _core.DampingPointCurve, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws the damping constant with its numerical error, and the damping constant without slip."""
    drawn = _axes(ax)
    slip = not np.isnan(result.slip_work).all()
    error = result.damping_constant_error
    drawn.errorbar(
        result.values, result.damping_constant, None if np.isnan(error).all() else error,
        **({"marker": ".", "label": "as described" if slip else "without slip"} | keywords),
    )  # fmt: skip
    if slip:
        drawn.plot(result.values, result.damping_constant_without_slip, "--", label="without slip")
    unit, name = _core.quantity(result.coordinate)
    _name_axes(drawn, (name, unit), ("damping constant γ", "N s/m"), "xy")
    drawn.legend()
    return drawn


@plot.register(_core.SummitList)
def _(result: _core.SummitList, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    drawn.hist(result.height, **({"bins": 40} | keywords))
    _name_axes(drawn, ("height of the summit", "m"), ("summits", "1"), "")
    return drawn


@plot.register(_core.ContactSetAt)
def _(result: _core.ContactSetAt, ax: Axes | None = None, **keywords: Any) -> Axes:
    drawn = _axes(ax)
    drawn.imshow(result.contact.T, **({"origin": "lower", "cmap": "Greys"} | keywords))
    _name_axes(drawn, ("cell along x", "1"), ("cell along y", "1"), "")
    return drawn


@plot.register(_core.ConvertedPsd)
def _(result: _core.ConvertedPsd, ax: Axes | None = None, **keywords: Any) -> Axes:
    x, y = ((getattr(result, name), text, unit_of(result, name)) for name, text in (("wavenumber", "wave number"), ("psd", "power spectral density")))
    return _line(ax, x, y, "xy", keywords)


def plot_law(law: _core.ContactLaw, indentation: npt.ArrayLike, ax: Axes | None = None, **keywords: Any) -> Axes:
    """Draws F(δ)."""
    return _line(ax, (indentation, "indentation δ", "m"), (law.force(indentation), "force F", "N"), "y", keywords)
