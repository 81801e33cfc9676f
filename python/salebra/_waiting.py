# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the extension with OpenMP threads that spin only a thousand times, and then sleep, while they wait for each other.

By default the threads spin. A solve on two cores is then more than ten times slower when another program runs on one of them, without
any gain on an idle machine. OpenMP reads the setting from the environment when it is loaded. A setting of the user has priority, and the
environment does not change. A forked child has one thread.
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

# A forked child does not have the threads of OpenMP and would wait for them for ever.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _core.set_threads(1))
