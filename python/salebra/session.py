# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors, units, threads, progress and versions."""

from ._calls import ConvergenceWarning as ConvergenceWarning
from ._calls import MissingFile as MissingFile
from ._citations import Citation as Citation
from ._citations import citations as citations
from ._core import (
    Error as Error,
    Interrupted as Interrupted,
    InvalidInput as InvalidInput,
    IoError as IoError,
    NotConverged as NotConverged,
    ProgressReport as ProgressReport,
    format_quantity as format_quantity,
    library_versions as library_versions,
    parse_quantity as parse_quantity,
    quantity as quantity,
    set_threads as set_threads,
    threads as threads,
    version as version,
)
