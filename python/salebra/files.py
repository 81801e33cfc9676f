# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of surfaces, curves and results, and the report."""

from ._core import (
    ResultReader as ResultReader,
    can_report as can_report,
    read_force_curve as read_force_curve,
    read_surface as read_surface,
    write_force_curve as write_force_curve,
    write_report as write_report,
    write_report_pdf as write_report_pdf,
    write_surface as write_surface,
)
