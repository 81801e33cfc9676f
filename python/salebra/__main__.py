# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program `salebra` of this package: `python -m salebra statistics scan.txt`. `python -m salebra import FILE OUT.h5` runs
`salebra-import FILE OUT.h5`."""

from __future__ import annotations

import os
import pathlib
import sys
import sysconfig


def main() -> int:
    if sys.argv[1:2] == ["import"]:
        from ._importing import main as import_file

        return import_file(sys.argv[2:])
    program = pathlib.Path(__file__).resolve().parent / "_program" / "salebra"
    if not program.exists():
        print("salebra: error: this Python package was built without the program (SALEBRA_BUILD_APPS)", file=sys.stderr)
        return 2
    # Where salebra-import lies, which the program calls for formats of instruments.
    path = os.pathsep.join((sysconfig.get_path("scripts"), os.environ.get("PATH", os.defpath)))
    os.execve(program, ["salebra", *sys.argv[1:]], {**os.environ, "PATH": path})


if __name__ == "__main__":
    sys.exit(main())
