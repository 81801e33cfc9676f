# SPDX-License-Identifier: GPL-3.0-or-later
"""A contact as a sum of many springs, each followed in time on its own: the reference for losses under any motion. It shares no code
and no quadrature with the package.

A spring of depth z touches at the indentation z. It carries the normal force n (d - z) and the tangential force k s, whose stretch s is
limited to mu n (d - z)/k. On touch it is anchored at the present position; on opening its stretch is lost.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


class Springs:
    """Springs between the indentations of a grid, from K and K_t at its points."""

    def __init__(self, grid: Array, stiffness: Array, tangential: Array) -> None:
        self.depth = 0.5 * (grid[1:] + grid[:-1])
        self.normal = np.diff(stiffness)
        self.tangential = np.diff(tangential)
        # The springs below the grid carry the stiffness of its first point; they are one spring more.
        if stiffness[0] > 0:
            raise ValueError("begin the grid where nothing touches")

    @staticmethod
    def of(stiffness: Callable[[Array], Array], ratio: float, low: float, high: float, count: int = 1200, focus: float | None = None) -> Springs:
        """Springs of a law K(d) that is zero at `low`, finer where the law is small; half of them above `focus`."""
        grid = low + (high - low) * np.linspace(0, 1, count) ** 1.5
        if focus is not None and focus > low:
            below = low + (focus - low) * np.linspace(0, 1, count // 2) ** 1.5
            grid = np.concatenate([below, np.linspace(focus, high, count // 2)[1:]])
        values = stiffness(grid)
        values[0] = 0
        return Springs(grid, values, ratio * values)

    def force(self, indentation: Array | float) -> Array:
        """F at one or several indentations."""
        above = np.maximum(np.atleast_1d(indentation)[:, None] - self.depth, 0)
        return np.asarray(above @ self.normal)

    def mean_force(self, mean: float, amplitude: float) -> float:
        # The mean over the phase: the trapezoidal rule of a periodic function.
        phase = (np.arange(256) + 0.5) * np.pi / 256
        return float(self.force(mean + amplitude * np.cos(phase)).mean())

    def held(self, force: float, amplitude: float) -> float:
        """The mean indentation at which the mean force of a cycle is `force`."""
        low, high = self.depth[0] - amplitude, self.depth[-1] - amplitude
        return float(brentq(lambda mean: self.mean_force(mean, amplitude) - force, low, high, xtol=1e-15))

    def work(self, indentation: Array, displacement: Array, friction: float, lead: int = 0) -> Array:
        """The work of the tangential force along paths of straight steps, counted after `lead` steps. The paths begin where the springs are
        free of stress. Each row of `indentation` is one path; all have the same displacement."""
        stretch = np.zeros((len(indentation), len(self.depth)))
        limited = np.isfinite(friction)
        slope = friction * self.normal / np.where(self.tangential > 0, self.tangential, 1) if limited else np.zeros_like(self.depth)
        work = np.zeros(len(indentation))
        for step in range(1, len(displacement)):
            before, now = indentation[:, step - 1, None], indentation[:, step, None]
            travel = displacement[step] - displacement[step - 1]
            # The part of the step in which each spring touches; all or nothing of a step that goes neither up nor down.
            above = np.maximum(now, before) - self.depth
            part = np.minimum(np.maximum(above / np.maximum(np.abs(now - before), 1e-300), 0), 1)
            moved = stretch + travel * part
            if limited:
                limit = slope * np.maximum(now - self.depth, 0)
                # While the limit falls to zero the spring slips: the mean stretch of the step is that between its ends.
                moved = np.minimum(np.maximum(moved, -limit), limit)
            if step > lead:
                work += 0.5 * travel * (((stretch + moved) * part) @ self.tangential)
            stretch = moved * (now > self.depth)
        return work

    def oscillation(self, mean: float, normal: float, tangential: float, phase: float, friction: float, steps: int = 1200) -> float:
        """W of d = mean + u_z cos wt, x = u_x cos(wt + phase), in the third period."""
        angle = np.pi + 2 * np.pi * np.arange(3 * steps + 1) / steps
        return float(self.work(mean + normal * np.cos(angle)[None], tangential * np.cos(angle + phase), friction, 2 * steps)[0])

    def drag(self, mean: float, normal: float, distance: float, friction: float, cycles: int = 12, steps: int = 240) -> float:
        """W per normal cycle of a drag by `distance` in each cycle, to and fro between turning points, over four phases of turning."""
        count = 2 * cycles * steps
        at = np.arange(2 * count + 1)
        angle = 2 * np.pi * (np.array([[0.125], [0.375], [0.625], [0.875]]) + at / steps)
        x = cycles * distance * (1 - np.abs((at / count % 1) * 2 - 1))
        return float(self.work(mean + normal * np.cos(angle), x, friction, count).mean()) / (2 * cycles)
