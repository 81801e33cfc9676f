# SPDX-License-Identifier: GPL-3.0-or-later
"""The argument ``comm``: converts a communicator of mpi4py to one of the library.

This module loads the extension for MPI with the first distributed surface, so that `import salebra` needs no MPI.
"""

from __future__ import annotations

import importlib
from typing import Any

from ._calls import refusal

_key: int | None = None


def _objection(comm: Any, mpi: Any) -> str:
    """Why these processes cannot share a surface; "" if they can."""
    if comm.Is_inter():
        return "must be the processes of one group; merge the groups first"
    try:
        bridge: Any = importlib.import_module("salebra._mpi")
    except ModuleNotFoundError:
        return "cannot be used, for this salebra was built without MPI; build it with -D SALEBRA_BUILD_MPI=ON, or leave comm out"
    except ImportError as error:
        return f"cannot be used: {error}"
    theirs, ours = (library.rstrip("\0\n ") for library in (mpi.Get_library_version(), bridge.library_version()))
    if theirs != ours:
        names = " and ".join(library.split("\n")[0] for library in (theirs, ours))
        return f"cannot be used, for mpi4py and salebra have two MPI libraries, {names}; build both with one"
    return ""


def communicator(comm: Any) -> Any:
    """The library's communicator for one of mpi4py. Collective when it is called with a communicator for the first time."""
    global _key
    mpi: Any = importlib.import_module("mpi4py.MPI")
    if not mpi.Is_initialized() or mpi.Is_finalized():
        raise refusal("comm", "", "needs a running MPI; call mpi4py.MPI.Init_thread() first")
    if comm == mpi.COMM_NULL:
        raise refusal("comm", "", "is mpi4py.MPI.COMM_NULL; only its members can call this")
    if _key is None:
        _key = mpi.Comm.Create_keyval()
    ranks = comm.Get_attr(_key)  # cached with `comm`: all processes must free salebra's copy together
    if ranks is None:
        objections = [text for text in comm.allgather(_objection(comm, mpi)) if text]
        if objections:
            raise refusal("comm", "", objections[0])
        ranks = importlib.import_module("salebra._mpi").communicator(comm.py2f())
        comm.Set_attr(_key, ranks)
    return ranks
