# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures as data: what ``result.figure()`` returns, in SI units, before anything draws it."""

from ._core._figures import (
    Axis as Axis,
    Curve as Curve,
    Figure as Figure,
    Image as Image,
    Panel as Panel,
    ReferenceLine as ReferenceLine,
    SecondAxis as SecondAxis,
    ShadedRange as ShadedRange,
)
