# SPDX-License-Identifier: GPL-3.0-or-later
"""The bar behind ``progress=True``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._core import ProgressReport


class Bar:
    """A bar of tqdm that shows the fraction done of the current stage."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError(
                "progress=True needs tqdm; install it, or give a function of a ProgressReport"
            ) from error
        self._bar = tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}% |{bar}| {elapsed}{postfix}")

    def tell(self, report: ProgressReport) -> None:
        """Shows a report."""
        self._bar.set_description_str(report.stage, refresh=False)
        if report.residual:
            self._bar.set_postfix_str(f"residual {report.residual:.1e}", refresh=False)
        self._bar.n = min(1.0, max(0.0, report.fraction))
        self._bar.refresh()

    def close(self, done: bool) -> None:
        """Closes the bar, at 100 % if the work was done."""
        if done:
            self._bar.n = 1.0
            self._bar.refresh()
        self._bar.close()
