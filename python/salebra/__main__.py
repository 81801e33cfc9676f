# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m salebra import FILE OUT.h5`, the same as `salebra-import FILE OUT.h5`."""

import sys

from ._importing import main

if sys.argv[1:2] != ["import"]:
    print("usage: python -m salebra import FILE OUT.h5", file=sys.stderr)
    sys.exit(2)
sys.exit(main(sys.argv[2:]))
