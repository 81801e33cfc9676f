# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts surfaces to and from SurfaceTopography, which reads about a hundred instrument formats."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._calls import refusal
from ._core import Surface

# SurfaceTopography's names of lengths, in metres.
_METRES = {
    "km": 1e3, "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9, "Å": 1e-10, "A": 1e-10,
    "pm": 1e-12, "fm": 1e-15,
}  # fmt: skip


def metres_in(unit: str) -> float | None:
    """Metres in one of SurfaceTopography's units of length; None for any other."""
    return _METRES.get(unit)


def from_topography(topography: Any) -> Surface:
    """See :meth:`salebra.Surface.from_topography`."""
    if getattr(topography, "dim", None) != 2:
        raise refusal("topography", "", "not two-dimensional; salebra's surfaces are maps, not line scans")
    unit = topography.unit
    if unit is None:
        raise refusal("topography", "", "has no unit; give it one with to_unit or scale it to metres")
    if str(unit) not in _METRES:
        raise refusal("topography", f"unit '{unit}'", "is no length that salebra knows; call to_unit('m') before")
    factor = _METRES[str(unit)]
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if factor != 1.0:
        heights = heights * factor
    size_x, size_y = (float(size) * factor for size in topography.physical_sizes)
    info = getattr(topography, "info", {})
    return Surface(
        np.ascontiguousarray(heights),
        size_x,
        size_y,
        periodic=bool(topography.is_periodic),
        origin=str(info.get("data_source", {}).get("name", "SurfaceTopography")) if isinstance(info, dict) else "",
    )


def to_topography(surface: Surface) -> Any:
    """See :meth:`salebra.Surface.to_topography`."""
    try:
        from SurfaceTopography import Topography
    except ImportError as error:
        raise ImportError("to_topography needs SurfaceTopography; install it") from error
    heights = surface.heights
    if np.isnan(heights).any():
        heights = np.ma.masked_invalid(heights)
    return Topography(heights, (surface.size_x, surface.size_y), unit="m", periodic=surface.periodic)
