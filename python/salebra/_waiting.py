# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the extension so that its threads sleep while they wait for each other.

By default OpenMP's threads spin, which makes a solve on two cores more than ten times slower as soon as another program runs on one
of them, and gains nothing on a quiet machine. OpenMP reads the choice from the environment when it is loaded; a choice of the user
stands, and the environment is left as it was.
"""

import os

_NAME = "OMP_WAIT_POLICY"

if _NAME in os.environ:
    from . import _core as _core
else:
    os.environ[_NAME] = "passive"
    try:
        from . import _core as _core
    finally:
        del os.environ[_NAME]
