# SPDX-License-Identifier: GPL-3.0-or-later
"""Equations (6)–(16) of Popov, Popov and Pohrt, "Relaxation damping in oscillating contacts", doi:10.1038/srep16189, with their
numbers, and further closed forms.

All assume infinite friction, quasi-static motion and no coupling of normal and tangential motion. ``modulus_ratio`` is G*/E*,
``force_curvature`` is F'' = ∂²F/∂δ², ``spring_depth`` is z0, the distance of a point of the indenter from first touch at the mean position.
Units are SI. The formulas do not check their arguments.
"""

from . import _core
from ._core._closed_form import *

__all__ = [name for name in vars(_core._closed_form) if not name.startswith("_")]
