# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of rough-surface contact and its relaxation damping.

The package generates or reads surfaces, presses them by boundary elements and by the Greenwood–Williamson model, and computes the energy
that they lose when they oscillate: Popov, Popov and Pohrt, "Relaxation damping in oscillating contacts", doi:10.1038/srep16189. The C++
library salebra computes every number; functions and keywords have its names, units are SI, and arrays are heights[ix, iy], x first.

Submodules sort the names: `surfaces`, `generators`, `contact`, `models`, `damping`, `studies`, `figures`, `files`, `session` and
`closed_form`. All names except the formulas and figures are attributes of `salebra` too. dir(salebra) lists the submodules and the names that most scripts need.
"""

import difflib as _difflib
import functools as _functools
import typing as _typing

from . import _waiting as _waiting  # isort: skip  (before anything that loads the extension)
from . import _calls as _calls

_calls.answer()

from . import closed_form as closed_form
from . import contact as contact
from . import damping as damping
from . import figures as figures
from . import files as files
from . import generators as generators
from . import models as models
from . import session as session
from . import studies as studies
from . import surfaces as surfaces
from ._calls import ConvergenceWarning as ConvergenceWarning
from ._calls import MissingFile as MissingFile
from ._citations import Citation as Citation
from ._citations import citations as citations
from ._core import *
from ._core import version as version

__version__ = version()

_COMMON = (
    "Grid2D", "Surface", "Material", "ForceCurve", "SelfAffineSpectrum", "EqualFrequency", "Drag", "TabulatedLaw", "ExponentialLaw",
    "IndenterLaw", "GreenwoodWilliamsonLaw", "ContactParameters", "StudyConfiguration", "ResultReader",
    "read_surface", "write_surface", "random_phase", "filtered_noise", "exact_rms", "paraboloid_surface", "off_grid_center",
    "power_spectrum", "scan_spectrum", "SurfaceTwin", "after_first_loading", "press", "sweep_pressures",
    "boundary_element_contact_sets", "fit_exponential", "test_exponential", "window_sensitivity",
    "surface_damping", "relaxation_damping", "damping_curve", "simulate_cycle", "simulate_frictional_cycle", "simulate_coupled_cycle",
    "read_study_configuration", "parse_study_configuration", "run_study", "run_ensembles", "write_ensembles", "is_result_of",
    "can_report", "write_report", "write_report_pdf", "citations", "set_threads", "threads", "ProgressReport", "version",
    "Error", "InvalidInput", "IoError", "NotConverged", "Interrupted", "MissingFile", "ConvergenceWarning",
)  # fmt: skip


def __dir__() -> list[str]:
    modules = (
        "closed_form", "contact", "damping", "figures", "files", "generators", "models", "session", "studies", "surfaces",
    )  # fmt: skip
    return sorted([*modules, *_COMMON, "__version__", "__doc__", "__name__", "__file__", "__path__"])


if not _typing.TYPE_CHECKING:  # type checkers would accept every name

    def _missing(module: str, present: dict[str, object], name: str) -> object:
        if name in _calls.FORMER and _calls.FORMER[name] in present:
            raise AttributeError(f"{module}.{name} is now {module}.{_calls.FORMER[name]}")
        names = [] if name.startswith("_") else [key for key in present if not key.startswith("_")]
        close = _difflib.get_close_matches(name, names, 1, 0.7)
        raise AttributeError(f"module '{module}' has no attribute '{name}'" + (f"; did you mean {close[0]}?" if close else ""))

    __getattr__ = _functools.partial(_missing, __name__, globals())
    for _module in (closed_form, contact, damping, figures, files, generators, models, session, studies, surfaces):
        _module.__getattr__ = _functools.partial(_missing, _module.__name__, vars(_module))
