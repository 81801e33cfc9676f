# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of all results with their units and meanings, from the table that the program is built with (src/results/quantity.cpp and the descriptions of the structs)."""

import pathlib
import re

_ROOT = pathlib.Path(__file__).resolve().parent.parent
_TABLE = ("include/salebra/results/*.hpp", "include/salebra/study/*.hpp", "src/results/quantity.cpp")


def names():
    """{name: (unit, meaning)}. Where two structs mean different things by a name, both meanings."""
    units = dict(re.findall(r'About\{(?:Dimension::)?(\w+), "([^"]+)"', (_ROOT / "src/base/units.cpp").read_text()))
    table = {}
    for pattern in _TABLE:
        for source in sorted(_ROOT.glob(pattern)):
            text = re.sub(r"^\s*///.*\n", "", source.read_text(), flags=re.M)
            entries = re.findall(r'Quantity\{\s*"(\w+)",\s*(?:Dimension::)?(\w+),\s*((?:"[^"]*"\s*)+)\}', text)
            written = len(re.findall(r'Quantity\{\s*"', text))
            if len(entries) != written:
                raise ValueError(f"{source}: {written} quantities, {len(entries)} of them understood; has their form changed?")
            for name, dimension, meaning in entries:
                meaning = "".join(re.findall(r'"([^"]*)"', meaning))
                known, meanings = table.setdefault(name, (units[dimension], []))
                if known != units[dimension]:
                    raise ValueError(f"{name}: {known} and {units[dimension]}; one name has one unit")
                if meaning not in meanings:
                    meanings.append(meaning)
    return {name: (unit, "; ".join(meanings)) for name, (unit, meanings) in sorted(table.items(), key=lambda one: one[0].lower())}
