# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures by matplotlib, which the first picture imports. Nothing here knows what a figure shows."""

from __future__ import annotations

import io
import math
import re
import textwrap
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np

from . import _core
from ._calls import refusal
from ._show import PREFIXED

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# As the pictures of the program: the colours of Okabe and Ito, grey and wine, each with a marker; lines across a panel differ by dashes.
_COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#808080", "#882255")
_TURN = 7  # grey and wine only on request
_MARKERS = ("o", "s", "^", "D", "v", "p", "x", "+", "*")
_DASHES = {"dashed": "--", "dotted": ":", "points": "none"}
_LINES = ((0, (1, 2)), (0, (6, 3)), (0, (6, 2, 1, 2)), (0, (4, 2, 1, 2, 1, 2)), (0, (12, 3)), (0, (3, 1)))
_ACROSS = "#404040"
_PALETTES = {"sequential": "viridis", "diverging": "RdBu_r", "grey": "gray_r"}
_PREFIXED = PREFIXED | {"m/s", "J/m", "N/m²", "N/m^2"}
_EDITABLE: Any = {"svg.fonttype": "none", "pdf.fonttype": 42}  # text remains text
# A figure for a journal, whose width is given.
_JOURNAL: Any = {"font.size": 7, "axes.titlesize": 7, "lines.linewidth": 1, "lines.markersize": 3, "axes.linewidth": 0.6}
_PANEL, _PAGE, _NARROW = 0.079, 0.16, 0.12  # narrowest panel, height of a page and width of more than one column of a journal, m
_PLACES: WeakKeyDictionary[Axes, Any] = WeakKeyDictionary()  # of axes of the user, without a legend below


def _plain(markup: str) -> str:
    """Text without markup, as long as it is drawn."""
    return re.sub(r"\\(.)|[_^{}]", r"\1", markup)


def _text(markup: str) -> str:
    """Subscripts and powers in mathtext, in the font of the text."""

    def drawn(found: re.Match[str]) -> str:
        token = found[0]
        if token[0] in "_^" and len(token) > 1:
            inside = re.sub(r"([ %#$])", r"\\\1", _plain(token[1:]))
            return rf"${token[0]}{{\mathregular{{{inside}}}}}$"
        return r"\$" if token[-1] == "$" else token[-1]

    return re.sub(r"\\.|[_^](?:\{[^{}]*\}|\\.|.)|.", drawn, markup)


def _wrapped(markup: str, length: float, size: float) -> str:
    """Text in lines of a length, both in points."""
    # A number stays with its unit, and a symbol with its value.
    joined = re.sub(r"(?<=\d) (?=\S)|(?<=[=−+±…]) | (?=[=±…])|(?<=\b[A-Z]) (?=[A-Z])|(?<=N) (?=s/m)| (?=[^{}]*\})", "\u00a0", markup)
    lines = textwrap.wrap(joined, max(16, int(length / (0.55 * size))), break_long_words=False, break_on_hyphens=False)
    return "\n".join(map(_text, lines))


def _color(number: int) -> Any:
    """A colour of the user's cycle, if matplotlib's was replaced, or else of the palette."""
    from matplotlib import rcParams, rcParamsDefault

    cycle = rcParams["axes.prop_cycle"]
    if number >= _TURN or cycle == rcParamsDefault["axes.prop_cycle"]:
        return _COLORS[number]
    own = cycle.by_key().get("color", _COLORS)
    return own[number % len(own)]


def _number(value: float, _: object = None) -> str:
    digits, _, power = f"{value:.4g}".replace("-", "−").partition("e")
    if not power:
        return digits
    return ("" if digits == "1" else f"{digits}·") + rf"10$^{{\mathregular{{{power[0].strip('+')}{power[1:].lstrip('0')}}}}}$"


def _prefixed(unit: str, value: float) -> tuple[str, float]:
    """The unit with the prefix that suits a value, and the factor to it. The prefix of 1/m belongs to the metre."""
    inverse = unit in ("1/m", "rad/m")
    if not (inverse or unit in _PREFIXED) or not 0 < value < math.inf:
        return unit, 1.0
    thousands = math.floor(math.log10(value * (1 + 5e-4)) / 3)
    power = min(max(-thousands if inverse else thousands, -6), 3)
    prefix = ("a", "f", "p", "n", "µ", "m", "", "k", "M", "G")[power + 6]
    return (f"{unit[:-1]}{prefix}m", 10.0 ** (3 * power)) if inverse else (prefix + unit, 10.0 ** (-3 * power))


def _scale(axis: Any, described: Any, points: float, main: Any = None) -> None:
    """Names an axis with the prefix that suits it: the data stay in SI units, so that results can share axes."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

    label = axis.label.get_fontsize() * 0.55
    many = max(1, int(points / ((9 if axis.axis_name == "x" else 4) * label)))
    ends = [abs(end) * getattr(described, "factor", 1) for end in (main or axis).get_view_interval()]
    largest = math.sqrt(ends[0] * ends[1]) if (main or axis).get_scale() == "log" else max(ends)
    unit, factor = _prefixed(described.unit, getattr(described, "prefix_of", None) or largest)
    axis.set_label_text(_wrapped(described.label + (f" ({unit})" if unit else ""), points, axis.label.get_fontsize()))
    formatter: Any = FuncFormatter(lambda value, _: _number(value * factor))
    formatter.unit = described.unit  # which results on the same axes have to share
    axis.set_major_formatter(formatter)
    if (main or axis).get_scale() == "log":
        low, high = (end * factor * getattr(described, "factor", 1) for end in sorted((main or axis).get_view_interval()))
        few = high < 50 * low or math.floor(math.log10(high)) - math.ceil(math.log10(low)) < 1  # less than two powers of ten
        named = [digit * 10.0**decade for decade in range(math.floor(math.log10(low)), math.ceil(math.log10(high))) for digit in (1, 2, 5)]
        if few and sum(low <= value <= high for value in named) < 2:
            axis.set_major_locator(MaxNLocator(4))
        else:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,), numticks=many))
        axis.set_minor_formatter(NullFormatter())
    else:
        axis.set_major_locator(MaxNLocator(min(many, 8), steps=[1, 2, 2.5, 5, 10]))


def _shape(image: Any) -> float:
    """Height over width of a map with equal scales."""
    return float((image.y[-1] - image.y[0]) / (image.x[-1] - image.x[0]))


def _image(ax: Axes, image: Any, equal: bool, keywords: dict[str, Any]) -> None:
    from matplotlib.colors import LogNorm

    values, scale = np.asarray(image.values).T, image.scale
    limits = [scale.low, scale.high]
    if image.palette == "diverging" and limits == [None, None]:
        most = float(np.nanmax(np.abs(values)))
        limits = [-most, most]
    # A scale begins at 0, as that of a contact pressure, unless all values are far from it.
    if limits[0] is None and not scale.logarithmic and np.isfinite(values).any() and 0 <= 2 * np.nanmin(values) < np.nanmax(values):
        limits[0] = 0.0
    if scale.logarithmic:
        values = np.where(values > 0, values, np.nan)
    look: dict[str, Any] = {"cmap": _PALETTES[image.palette], "shading": "nearest", "rasterized": True} | keywords
    if "norm" not in look:
        look |= {"norm": LogNorm(*limits)} if scale.logarithmic else {"vmin": limits[0], "vmax": limits[1]}
    mesh = ax.pcolormesh(np.asarray(image.x), np.asarray(image.y), values, **look)
    if len(image.contours):
        lines = ax.contour(np.asarray(image.x), np.asarray(image.y), values, sorted(image.contours), colors="#202020", linewidths=0.8)
        placed: list[Any] = []
        for text in ax.clabel(lines, fmt=_number, fontsize="small"):
            place = text.get_window_extent()
            if any(place.overlaps(other) for other in placed):  # lines close together
                text.remove()
            else:
                placed.append(place)
    if image.color_bar:
        # The bar of a map stands at its edge, however narrow it is, so that the map stays in the middle.
        high = _shape(image) if equal else 0.0
        bar = ax.figure.colorbar(mesh, cax=ax.inset_axes((1 + 0.04 * high, 0, 0.05 * high, 1)) if equal else None, ax=None if equal else ax)
        _scale(bar.ax.yaxis, scale, _points(ax, 1))


def _curve(ax: Axes, curve: Any, number: int, keywords: dict[str, Any]) -> None:
    from matplotlib import rcParams

    points = curve.style in ("points", "line_and_points")
    look = {
        "color": _color(number), "linestyle": _DASHES.get(curve.style, "-"), "marker": _MARKERS[number] if points else "none",
        "label": _text(curve.name) or "_", "markersize": rcParams["lines.markersize"] * (0.5 if len(curve.x) > 25 else 0.8), "rasterized": len(curve.x) > 5000,
    } | keywords  # fmt: skip
    x, y, low, high = (np.asarray(values, dtype=float) for values in (curve.x, curve.y, curve.low, curve.high))
    if low.size and curve.style == "points":
        ax.errorbar(x, y, [y - low, high - y], **look)
        return
    drawn = ax.plot(x, y, **look)[0]
    if low.size:
        ax.fill_between(x, low, high, color=drawn.get_color(), alpha=0.2, linewidth=0)


def _points(ax: Axes, direction: int) -> float:
    """Width (0) or height (1) of axes in points."""
    return float((ax.bbox.width, ax.bbox.height)[direction]) * 72 / ax.figure.dpi


def _columns(labels: list[str], wide: float, size: float) -> int:
    """Columns of a legend of this width, in points."""
    longest = max(len(re.sub(r"\$.*?regular\{(.*?)\}\}\$", r"\1", label)) for label in labels)
    return min(len(labels), max(1, int(wide / ((0.58 * longest + 4) * size))))


def _legend(ax: Any) -> None:
    """Names the curves below the axes, outside the data. Without a layout the axes become smaller, so that it has room there."""
    handles, labels = ax.get_legend_handles_labels()
    if not labels:
        return
    from matplotlib import rcParams
    from matplotlib.font_manager import FontProperties

    size = FontProperties(size=rcParams["legend.fontsize"]).get_size_in_points()
    wide = _points(ax, 0)
    columns = _columns(labels, wide, size)
    labels = [textwrap.fill(label, max(20, int(wide / (0.55 * size)))) if "$" not in label else label for label in labels]
    title = ax.xaxis.label.get_fontsize() * (1.4 * ax.get_xlabel().count("\n") + 1.3)
    ticks = ax.xaxis.get_major_ticks()[0].label1.get_fontsize() * 1.2
    legend = ax.legend(
        handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=(title + ticks + 13) / size, ncols=columns, frameon=False,
        borderpad=0,
    )  # fmt: skip
    figure: Any = ax.figure
    if figure.get_layout_engine() is None:
        figure.draw_without_rendering()
        high = (legend.get_window_extent().height + 0.6 * size * figure.dpi / 72) / figure.bbox.height
        box = _PLACES.setdefault(ax, ax.get_position())
        ax.set_position((box.x0, box.y0 + high, box.width, max(box.height - high, 0.2 * box.height)))
        ax.set_in_layout(True)


def _second(ax: Axes, panel: Any, fresh: bool, scales: Any) -> None:
    """A second scale along the top or the right. Results on the same axes keep it only if it holds for all of them."""
    for way, second in zip("xy", scales):
        name = f"{way} times {second.factor!r} {second.unit}" if second else ""
        for old in [child for child in ax.child_axes if str(child.get_label()).startswith(f"{way} times ") and child.get_label() != name]:
            old.remove()
        if second and fresh:
            functions: Any = (lambda value, f=second.factor: value * f, lambda value, f=second.factor: value / f)
            child: Any = ax.secondary_xaxis("top", functions) if way == "x" else ax.secondary_yaxis("right", functions)
            child.set_label(name)
            main = ax.xaxis if way == "x" else ax.yaxis
            _scale(child.xaxis if way == "x" else child.yaxis, second, _points(ax, way == "y"), main)


def _panel(ax: Any, panel: Any, keywords: dict[str, Any], legend: bool = True, scales: Any = None, letter: bool = True, names: list[str] | None = None) -> None:
    """Draws a panel, on axes that may have one already. keywords: style of its map or first curve. names: of the lines of all panels with one legend."""
    drawn = [line for line in ax.lines if line.get_transform().contains_branch(ax.transData)]
    fresh = not drawn and not ax.collections
    for axis, described in ((ax.xaxis, panel.x), (ax.yaxis, panel.y)):
        known = getattr(axis.get_major_formatter(), "unit", described.unit)
        if not fresh and known != described.unit:
            raise refusal("ax", "", f"has {known or 'plain numbers'} along {axis.axis_name}, and this panel has {described.unit or 'plain numbers'}")
    # A logarithmic axis cannot show negative values, such as tension.
    for set_scale, described in ((ax.set_xscale, panel.x), (ax.set_yscale, panel.y)):
        if fresh and described.logarithmic:
            set_scale("log")
    if panel.image:
        _image(ax, panel.image, panel.equal_scales, keywords)
    if panel.equal_scales:
        ax.set_aspect("equal")
    turn = len(drawn)
    for shown, curve in enumerate(panel.curves):
        number = (turn if curve.color < 0 else curve.color + len(drawn)) % _TURN if curve.color < _TURN else curve.color
        turn += curve.color < 0
        _curve(ax, curve, number, keywords if shown == 0 and not panel.image else {})
    for place, line in enumerate(panel.lines):
        dashes = _LINES[(names.index(line.name) if names else place) % len(_LINES)]
        along = panel.x if line.vertical else panel.y
        seen = along.low is None or along.high is None or along.low <= line.at <= along.high
        (ax.axvline if line.vertical else ax.axhline)(line.at, color=_ACROSS, linestyle=dashes, linewidth=0.8, label=seen and _text(line.name) or "_")
    for shade in panel.ranges:
        (ax.axvspan if shade.vertical else ax.axhspan)(shade.low, shade.high, color="#808080", alpha=0.15, lw=0, label=_text(shade.name) or "_")
    if fresh:
        for limit, described in ((ax.set_xlim, panel.x), (ax.set_ylim, panel.y)):
            limit(described.low, described.high)
    else:
        ax.autoscale()
    wide, high = _points(ax, 0), _points(ax, 1)
    if panel.equal_scales and panel.image:  # which leave a part of the axes empty
        wide, high = min(wide, high / _shape(panel.image)), min(high, wide * _shape(panel.image))
    _scale(ax.xaxis, panel.x, wide)
    _scale(ax.yaxis, panel.y, high)
    _second(ax, panel, fresh, scales or (panel.second_x, panel.second_y))
    title = panel.title if letter else re.sub(r"^\([a-z]\) ?", "", panel.title)
    if title and fresh:
        ax.set_title(_wrapped(title, _points(ax, 0), ax.title.get_fontsize()))
    if legend:
        _legend(ax)


def _new(pyplot: bool) -> Figure:
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("plot needs matplotlib; install it") from error
    make = matplotlib.pyplot.figure if pyplot else matplotlib.figure.Figure
    return make(layout="constrained")


def plot(result: Any, ax: Axes | None = None, panel: int | str = 0, **keywords: Any) -> Axes:
    """Draws a panel of the figure of a result. fit: of a force curve, whether its fit is drawn, or the fit."""
    figure = result.figure(fit=keywords.pop("fit")) if "fit" in keywords else result.figure()
    return _plot_panel(figure, ax, panel, keywords)


def plot_law(law: _core.ContactLaw, indentation: Any, ax: Axes | None = None, panel: int | str = 0, **keywords: Any) -> Axes:
    """Draws a panel of the figure of a law over indentations."""
    return _plot_panel(law.figure(indentation), ax, panel, keywords)


def _plot_panel(figure: Any, ax: Axes | None, panel: int | str, keywords: dict[str, Any]) -> Axes:
    panels = figure.panels
    named = [one.y.quantity or (one.image.scale.quantity if one.image else "") for one in panels]
    number = named.index(panel) if panel in named else panel
    if not isinstance(number, int) or not 0 <= number < len(panels):
        names = ", ".join(f"{k} {name}".strip() for k, name in enumerate(named))
        raise refusal("panel", repr(panel), f"is none of the panels of this figure: {names}")
    drawn = _new(True).add_subplot() if ax is None else ax
    _panel(drawn, panels[number], keywords, letter=False)
    return drawn


def plot_figure(figure: Any, width: float | None = None, pyplot: bool = True, caption: bool = True) -> Figure:
    """Draws all panels in a new figure of matplotlib. width: of a figure for a journal, m; one column has no room for details."""
    drawn = _new(pyplot)
    from matplotlib import rc_context, rcParams

    if width is not None and not 0.06 <= width <= 1:
        raise refusal("width", f"{width:g}", "must be >= 0.06 and <= 1 m")
    panels, text = list(figure.panels), figure.caption if caption else ""
    if width and width < _NARROW:
        panels = [panel for panel in panels if not panel.detail]
        text = text.split(f" ({'abcdefghijklmnopqrstuvwxyz'[len(panels)]}) ")[0]
    count = len(panels)
    columns = wanted = min(count, figure.columns or math.ceil(math.sqrt(len(figure.panels))))
    if width:
        columns = min(wanted, max(1, int(width / _PANEL)))
        small = panels[0].image and not panels[0].image.color_bar
        if count > (3 if small else 5) * columns:  # many small panels, such as the maps of several contacts, stay beside each other
            columns = min(wanted, 2 * columns)
    with rc_context(_JOURNAL) if width else nullcontext():
        across = width / 0.0254 if width else rcParams["figure.figsize"][0] * math.sqrt(columns)
        rows = math.ceil(count / columns)
        # Many rows are lower, so that they come closer to the height of a page.
        high = max(max(0.45 * across / columns, 1.4) * rows, min(0.78 * across / columns * rows, _PAGE / 0.0254 if width else math.inf))
        drawn.set_size_inches(across, high)
        if figure.title:
            drawn.suptitle(_wrapped(figure.title, 72 * across, rcParams["font.size"] * 1.2))
        grid = drawn.add_gridspec(rows, 2 * columns)
        names = list(dict.fromkeys(line.name for panel in panels for line in panel.lines)) if figure.one_legend else None
        for k, panel in enumerate(panels):
            row, column = divmod(k, columns)
            left = 2 * column + max(0, (row + 1) * columns - count)  # a last row that is not full is in the middle
            # A journal has no room for a second scale beside a panel, and one column only for that at the top.
            scales = (panel.second_x if k == 0 or not width or width >= _NARROW else None, None if width else panel.second_y)
            _panel(drawn.add_subplot(grid[row, left : left + 2]), panel, {}, not figure.one_legend, scales, names=names)
        axes = [ax for ax in drawn.axes if ax.get_subplotspec()]
        for upper, panel, lower in zip(axes, panels, panels[1:] if columns == 1 else []):
            ends = [(one.x.label, one.x.low, one.x.high) for one in (panel, lower)]
            if ends[0] == ends[1] and not (panel.image or lower.image or upper.get_legend()):
                upper.tick_params(labelbottom=False)  # the panel below has the same axis
                upper.set_xlabel("")
        entries: dict[str, Any] = {}
        for ax in axes if figure.one_legend else []:
            for handle, name in zip(*ax.get_legend_handles_labels()):
                entries.setdefault(name, handle)
        # Room for what is below the panels.
        drawn.draw_without_rendering()
        size = rcParams["font.size"]
        legends = [ax.get_legend() for ax in axes]
        tall = [legend.get_window_extent().height / drawn.dpi if legend else 0.0 for legend in legends]
        high += sum(max(tall[row : row + columns]) for row in range(0, count, columns))
        below = 0.0
        words = _wrapped(text, 72 * across - 2 * size, size) if text else ""
        if words:
            below = (1.3 * words.count("\n") + 2.3) * size / 72
        rest = below
        if entries:
            in_row = _columns(list(entries), 72 * across, size)
            below += (1.5 * math.ceil(len(entries) / in_row) + 0.5) * size / 72
        high += below
        drawn.set_size_inches(across, high)
        if words:
            drawn.text(0.5 * size / 72 / across, 0.5 * size / 72 / high, words, va="bottom", linespacing=1.15)
        if entries:
            drawn.legend(entries.values(), entries.keys(), loc="lower center", bbox_to_anchor=(0.5, rest / high), ncols=in_row, frameon=False, borderpad=0, borderaxespad=0)
        if below:
            layout: Any = drawn.get_layout_engine()
            layout.set(rect=(0, below / high, 1, 1 - below / high))
    return drawn


def save_figure(figure: Any, file: Any, width: float | None = None, overwrite: bool = False, caption: bool = True) -> None:
    """Writes a picture, whose suffix is that of its format, or the numbers as .json."""
    path = Path(file)
    if path.exists() and not overwrite:
        raise refusal("file", str(path), "exists; overwrite it with overwrite=True")
    if path.suffix == ".json":
        path.write_text(figure.json(), encoding="utf-8")
        return
    if path.suffix not in (".png", ".svg", ".pdf"):
        raise refusal("file", str(path), "must end in .png, .svg, .pdf or .json")
    from matplotlib import rc_context

    with rc_context(_EDITABLE):
        plot_figure(figure, width, False, caption).savefig(path, dpi=300)


def svg(figure: Any) -> str:
    """The figure as an element of a page, with text as text."""
    drawn = plot_figure(figure, None, False)
    from matplotlib import rc_context

    with rc_context(_EDITABLE), io.StringIO() as file:
        drawn.savefig(file, format="svg", dpi=72, metadata={"Date": None})
        text = file.getvalue()
    return text[text.index("<svg") :].replace("<svg ", '<svg style="max-width:100%;height:auto" ', 1)
