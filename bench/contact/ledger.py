#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Group a profile of contact_ledger by the passes of the solver:
perf record -F 5000 -e cpu-clock -o perf.data contact_ledger contact 1024 80
ledger.py perf.data MILLISECONDS        the median that contact_ledger printed
"""

import re
import subprocess
import sys

PASSES = {  # the first pattern that a symbol or its library matches
    None: r"\] main|exact_rms|synthesise|backward_by_columns",
    "FFTW, float": "libfftw3f",
    "FFTW, double": r"libfftw3\.",
    "residual of all cells": r"::gap<",
    "set-up": r"set_symbol|coarsened|normal_symbol|multilevel_design|gsl|libm\.",
    "rows and columns of the transforms": "interleave|to_columns|to_rows|separate|multiply|::join|split|Passes|dense_gap"
    "|measure_punch",
    "multilevel kernel": "restriction|ascent|fill_halo|list_tiles|append_tiles|RowExchange|Multilevel",
    "preconditioner": "precondition",
    "direction and its image": "::direct<|take_image|displace",
    "step": "::step<",
    "set of free cells": "truncate|change_set|add_displacement|spread_change|::residual<",
    "choice of tiles, copies": "choose_tiles|unpack_pressure|SetSums|clip|hold_punch|mem(move|set|cpy)",
    "coarser grids": "prolong|sampled|interpolation|correct_load",
    "heights and result": "state_of|Depths|require_complete|height_statistics|Power",
    "memory pages, system": r"\[k\]",
    "rest": "",
}

profile, milliseconds = sys.argv[1], float(sys.argv[2])
report = subprocess.run(["perf", "report", "-i", profile, "--no-children", "--sort", "dso,symbol", "-g", "none"],
                        capture_output=True, text=True, check=True).stdout
shares = dict.fromkeys(PASSES, 0.0)
for share, symbol in re.findall(r"^ +([\d.]+)% +(.*)$", report, re.MULTILINE):
    shares[next(name for name, pattern in PASSES.items() if re.search(pattern, symbol))] += float(share)
shares.pop(None)  # not a part of a contact: the surface
for name, share in sorted(shares.items(), key=lambda item: -item[1]):
    part = share / sum(shares.values())
    print(f"{name:36} {100 * part:5.1f} % {milliseconds * part:7.2f} ms")
