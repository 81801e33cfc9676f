# SPDX-License-Identifier: GPL-3.0-or-later
"""Equations (6)–(16) of Popov, Popov and Pohrt, "Relaxation damping in oscillating contacts", doi:10.1038/srep16189, each under
its number, and the closed forms that go beyond them.

All assume infinite friction, quasi-static motion and no coupling of normal and tangential motion. ``modulus_ratio`` is G*/E*,
``force_curvature`` is F'' = ∂²F/∂δ², ``level`` is z0, the distance of a point of the indenter from first touch at the mean position.
Units are SI. Arguments are not checked: they are formulas.
"""

from . import _core  # noqa: F401  (brings its submodule with it)
from ._core._closed_form import (
    damping_constant,
    drag_integral_scaled,
    edge_slope,
    equal_frequency_ratio_scaled,
    frequency_ratio_integral,
    frequency_ratio_phase_sum,
    indentation_shift_at_held_force,
    intermittent_contact,
    mean_force_ratio_scaled,
    power,
    released_distance,
    spring_energy,
    work_per_cycle,
    work_per_cycle_by_quadrature,
    work_per_cycle_by_slope,
    work_per_cycle_exponential,
    work_per_cycle_exponential_held_force,
    work_per_cycle_force_controlled,
    work_per_cycle_rough,
)

__all__ = [
    "damping_constant",
    "drag_integral_scaled",
    "edge_slope",
    "equal_frequency_ratio_scaled",
    "frequency_ratio_integral",
    "frequency_ratio_phase_sum",
    "indentation_shift_at_held_force",
    "intermittent_contact",
    "mean_force_ratio_scaled",
    "power",
    "released_distance",
    "spring_energy",
    "work_per_cycle",
    "work_per_cycle_by_quadrature",
    "work_per_cycle_by_slope",
    "work_per_cycle_exponential",
    "work_per_cycle_exponential_held_force",
    "work_per_cycle_force_controlled",
    "work_per_cycle_rough",
]
