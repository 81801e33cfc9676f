# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of rough-surface contact and its relaxation damping.

Surfaces are generated or read, pressed by boundary elements and by Greenwood–Williamson's model, and what they lose when they
oscillate follows from the force curve: Popov, Popov and Pohrt, "Relaxation damping in oscillating contacts",
doi:10.1038/srep16189. Every number comes from the C++ library salebra; names of functions and keywords are its names, units are
SI, and arrays are heights[ix, iy], x first.

The names are sorted into submodules: `surfaces`, `generators`, `contact`, `models`, `damping`, `studies`, `files`, `session` and
`closed_form`. All of them but the formulas are attributes of `salebra` itself too; dir(salebra) lists the submodules and what most
scripts need.
"""

from . import _waiting as _waiting  # isort: skip  (before anything that loads the extension)
from . import _calls as _calls

_calls.answer()

from . import closed_form as closed_form
from . import contact as contact
from . import damping as damping
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
    "read_surface", "write_surface", "random_phase", "filtered_noise", "press_to_pressure", "press_to_indentation",
    "press_to_mean_gap", "sweep_pressures", "fit_exponential", "relaxation_damping", "read_study_configuration",
    "parse_study_configuration", "run_study", "write_report", "citations", "set_threads", "version",
    "Error", "InvalidInput", "IoError", "NotConverged", "Interrupted", "MissingFile", "ConvergenceWarning",
)  # fmt: skip


def __dir__() -> list[str]:
    modules = (
        "closed_form", "contact", "damping", "files", "generators", "models", "session", "studies", "surfaces",
    )  # fmt: skip
    return sorted([*modules, *_COMMON, "__version__", "__doc__", "__name__", "__file__", "__path__"])
