# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as text, as HTML for notebooks and as tables. The classes describe their properties."""

from __future__ import annotations

import html as _html
from collections import namedtuple
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pandas

PREFIXED = {"m", "Pa", "N", "J", "W", "N/m", "N s/m", "s", "Hz", "rad/s"}
_PREFIX = {-15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def properties(kind: type) -> list[str]:
    """Names of the public properties of a class in the order of their definition, those of its bases first."""
    names: dict[str, None] = {}
    for base in reversed(kind.__mro__):
        for name, value in vars(base).items():
            if isinstance(value, property) and not name.startswith("_"):
                names[name] = None
    return list(names)


def meaning(kind: type, name: str) -> tuple[str, str]:
    """Unit ("" for pure numbers) and meaning of a property."""
    return _core._unit_of_property(kind, name), (getattr(kind, name).__doc__ or "").strip().rstrip(".")


def unit_of(result: Any, name: str) -> str:
    """Unit of a column, "" for pure numbers. Converted spectra and curves of means have units of their own."""
    if name in ("mean", "low", "high", "error") and (quantity := getattr(result, "quantity", "")):
        name = quantity
    return getattr(result, f"{name}_unit", None) or _core._unit_of_property(type(result), name)


def prefix_of(value: float, unit: str) -> tuple[int, str]:
    """Power of ten and SI prefix that suit a value."""
    if unit not in PREFIXED or value == 0 or not np.isfinite(value):
        return 0, ""
    exponent = int(np.clip(3 * np.floor(np.log10(abs(value)) / 3), -15, 12))
    return exponent, _PREFIX[exponent]


def _number(value: float, unit: str) -> str:
    if value != value:
        return "n/a"
    exponent, prefix = prefix_of(value, unit)
    return f"{value / 10.0**exponent:.4g}" + (f" {prefix}{unit}" if unit else "")


def shown(value: Any, unit: str) -> str:
    """A value in a few characters."""
    if isinstance(value, np.ndarray):
        return f"array{value.shape}"
    if isinstance(value, (bool, np.bool_, int, np.integer)):
        return str(value)
    if isinstance(value, (float, np.floating)):
        return _number(float(value), unit)
    if isinstance(value, str):
        return repr(value) if len(value) < 60 else repr(value[:57] + "…")
    if isinstance(value, (list, tuple)):
        return f"[{len(value)}]" if len(value) > 3 or any(not isinstance(item, (str, float, int)) for item in value) else str(value)
    return repr(value)


def _arrays(kind: type) -> list[str]:
    """Names of the properties that are arrays, by their signatures: a table does not read the others, of which verdicts take long."""
    return [name for name in properties(kind) if "numpy." in getattr(kind, name).fget.__nb_signature__[0][0]]


def _values(result: Any, names: list[str] | None = None) -> list[tuple[str, Any, str, str]]:
    """Name, value, unit and meaning of every property that has a value; of these names only, if some are given."""
    found = []
    for name in properties(type(result)) if names is None else names:
        try:
            value = getattr(result, name)
        except (_core.Error, TypeError):  # unknown value, or an object whose constructor failed
            continue
        found.append((name, value, unit_of(result, name), meaning(type(result), name)[1]))
    return found


def text(result: Any) -> str:
    """repr()."""
    call = getattr(result, "__dict__", {}).get("_call")
    if call:
        name, arguments, keywords = call
        parts = [shown(value, "") for value in arguments]
        parts += [f"{key}={shown(value, _core._unit_of_property(type(result), key))}" for key, value in keywords.items()]
        return f"{name}({', '.join(parts)})"
    parts = [f"{name}={shown(value, unit)}" for name, value, unit, _ in _values(result)]
    return f"{type(result).__name__}({', '.join(parts)})"


def _picture(result: Any) -> str:
    """The figure of a result as SVG; empty without matplotlib, and for a result that has nothing to draw."""
    if isinstance(result, _core.ContactLaw):  # drawn over the indentations that it is given
        return ""
    try:
        from . import _plots

        return _plots.svg(result if isinstance(result, _core._figures.Figure) else result.figure())
    except (AttributeError, ImportError, _core.Error):
        return ""


def html(result: Any) -> str:
    """The picture, and a table of names, values and what they mean."""
    rows = "".join(
        f"<tr><td>{_html.escape(name)}</td><td>{_html.escape(shown(value, unit))}</td><td>{_html.escape(said)}</td></tr>"
        for name, value, unit, said in _values(result)
    )
    return f"{_picture(result)}<table><caption>{_html.escape(type(result).__name__)}</caption><tbody>{rows}</tbody></table>"


def columns(result: Any) -> dict[str, Any]:
    """The one-dimensional arrays of a result that have the length of the first, without arrays that are all NaN."""
    found: dict[str, Any] = {}
    if (coordinate := getattr(result, "coordinate", None)) is not None:  # first, by its name
        found[coordinate] = result.values
    for name, value, _, _ in _values(result, _arrays(type(result))):
        if name == "values":
            continue
        if value.ndim == 1 and (not found or len(value) == len(next(iter(found.values())))):
            found[name] = value
    return {name: value for name, value in found.items() if value.dtype.kind != "f" or not np.isnan(value).all()} or found


def length(result: Any) -> int:
    """len() of a result with columns."""
    return len(next(iter(columns(result).values())))


def rows(result: Any) -> Iterator[Any]:
    """The rows of a result with columns."""
    table = columns(result)
    row = namedtuple(type(result).__name__ + "Row", list(table))  # type: ignore[misc]
    return (row(*(value.item() for value in values)) for values in zip(*table.values()))


def to_dataframe(result: Any) -> pandas.DataFrame:
    """The columns as a pandas.DataFrame."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_dataframe needs pandas; install it") from error
    table = columns(result)
    frame = pandas.DataFrame({name: np.array(value) for name, value in table.items()})
    frame.attrs["units"] = {name: unit_of(result, name) or "1" for name in table}
    return frame
