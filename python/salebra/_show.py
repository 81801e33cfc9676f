# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as text, as HTML for notebooks and as tables, from the properties of their classes and what these say of themselves."""

from __future__ import annotations

import html as _html
import re
from collections import namedtuple
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pandas

# How a property's text names its unit, at its end: "mean gap, m." or "N/m".
_UNIT = re.compile(
    r"(?:^|, |\s)(m(?:\^?[²³⁴234])?|1/m(?:²|\^2)?|Pa|1/Pa|N|N/m(?:²|\^2)?|N s/m|J|J/m(?:²|\^2)|W|s|m/s|Hz|rad|rad/s|rad/m|kg|°"
    r"|W/\(m² K\)|S/m²)(?:$|[.;,])"
)
PREFIXED = {"m", "Pa", "N", "J", "W", "N/m", "N s/m", "s", "Hz", "rad/s"}
_PREFIX = {-15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def properties(kind: type) -> list[str]:
    """Names of the public properties of a class, those of its bases first, in the order of their definition."""
    names: dict[str, None] = {}
    for base in reversed(kind.__mro__):
        for name, value in vars(base).items():
            if isinstance(value, property) and not name.startswith("_"):
                names[name] = None
    return list(names)


def meaning(kind: type, name: str) -> tuple[str, str]:
    """Unit ("" for pure numbers) and text of a property."""
    said = (getattr(kind, name).__doc__ or "").strip()
    found = _UNIT.search(said)
    unit, long_name = _core.quantity(name)
    if found:
        return found.group(1), said.rstrip(".")
    return ("" if unit == "1" else unit), (said.rstrip(".") or (long_name if long_name != name else ""))


def unit_of(result: Any, name: str) -> str:
    """Unit of a column of a result, which may name it in a property of its own, as converted spectra do; "" for pure numbers."""
    if isinstance(result, _core.DampingCurve) and name == result.coordinate:
        unit = _core.quantity(name)[0]
        return "" if unit == "1" else unit
    return getattr(result, f"{name}_unit", None) or meaning(type(result), name)[0]


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


def _values(result: Any) -> list[tuple[str, Any, str, str]]:
    """Name, value, unit and text of every property that has a value."""
    found = []
    for name in properties(type(result)):
        try:
            value = getattr(result, name)
        except (_core.Error, TypeError):  # unknown, or an object whose constructor failed
            continue
        found.append((name, value, unit_of(result, name), meaning(type(result), name)[1]))
    return found


def text(result: Any) -> str:
    """repr()."""
    call = getattr(result, "__dict__", {}).get("_call")
    if call:
        name, arguments, keywords = call
        parts = [shown(value, "") for value in arguments]
        parts += [f"{key}={shown(value, _unit_of(key))}" for key, value in keywords.items()]
        return f"{name}({', '.join(parts)})"
    parts = [f"{name}={shown(value, unit)}" for name, value, unit, _ in _values(result)]
    return f"{type(result).__name__}({', '.join(parts)})"


def _unit_of(name: str) -> str:
    unit = _core.quantity(name)[0]
    return "" if unit == "1" else unit


def html(result: Any) -> str:
    """A table of names, values and what they mean."""
    rows = "".join(
        f"<tr><td>{_html.escape(name)}</td><td>{_html.escape(shown(value, unit))}</td><td>{_html.escape(said)}</td></tr>"
        for name, value, unit, said in _values(result)
    )
    return f"<table><caption>{_html.escape(type(result).__name__)}</caption><tbody>{rows}</tbody></table>"


def columns(result: Any) -> dict[str, Any]:
    """The one-dimensional arrays of a result, all of the length of the first; those without any number are left out."""
    found: dict[str, Any] = {}
    if isinstance(result, _core.DampingCurve):  # its coordinate first, by its name
        found[result.coordinate] = result.values
    for name, value, _, _ in _values(result):
        if name == "values":
            continue
        if isinstance(value, np.ndarray) and value.ndim == 1 and (not found or len(value) == len(next(iter(found.values())))):
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
