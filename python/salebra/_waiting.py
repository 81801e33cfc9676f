# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the extension so that its threads sleep, after a thousand looks, while they wait for each other.

By default OpenMP's threads spin, which makes a solve on two cores more than ten times slower as soon as another program runs on one
of them, and gains nothing on a quiet machine. OpenMP reads the choice from the environment when it is loaded; a choice of the user
stands, and the environment is left as it was. A forked child has one thread.
"""

import os

_CHOICE = {"OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "1000"}

if _CHOICE.keys() & os.environ.keys():
    from . import _core as _core
else:
    os.environ.update(_CHOICE)
    try:
        from . import _core as _core
    finally:
        for _name in _CHOICE:
            del os.environ[_name]

# The threads that OpenMP keeps are not there in a forked child, which would wait for them without end.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _core.set_threads(1))
