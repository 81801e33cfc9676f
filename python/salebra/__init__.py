# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of rough-surface contact and its relaxation damping.

Surfaces are generated or read, pressed by boundary elements and by Greenwood–Williamson's model, and what they lose when they
oscillate follows from the force curve: Popov, Popov and Pohrt, "Relaxation damping in oscillating contacts",
doi:10.1038/srep16189. Every number comes from the C++ library salebra; names of functions and keywords are its names, units are
SI, and arrays are heights[ix, iy], x first.
"""

from . import _waiting as _waiting  # before anything that loads the extension
from . import closed_form as closed_form
from ._citations import Citation as Citation
from ._citations import citations as citations
from ._core import *
from ._core import version as version

__version__ = version()
