# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of all results with their units and meanings, from the descriptions of the structs and the table of those without one (src/results/quantity.cpp)."""

import pathlib
import re

_ROOT = pathlib.Path(__file__).resolve().parent.parent
_TABLE = ("include/salebra/**/*.hpp", "generators/include/salebra/**/*.hpp", "src/results/quantity.cpp")
_PER_AREA = {"N": "Pa", "J": "J/m^2", "N/m": "Pa/m"}


def names():
    """{name: (unit, meaning)}. Where two structs mean different things by a name, both meanings."""
    units = dict(re.findall(r'About\{(?:Dimension::)?(\w+), "([^"]+)"', (_ROOT / "src/base/units.cpp").read_text()))
    table = {}
    for pattern in _TABLE:
        for source in sorted(_ROOT.glob(pattern)):
            text = re.sub(r"^\s*///.*\n", "", source.read_text(), flags=re.M)
            entries = re.findall(r'(Quantity|Extensive)\{\s*"(\w+)",\s*(?:Dimension::)?(\w+),\s*((?:"[^"]*"\s*)+)\}', text)
            written = len(re.findall(r'(?:Quantity|Extensive)\{\s*"', text))
            if len(entries) != written:
                raise ValueError(f"{source}: {written} quantities, {len(entries)} of them understood; has their form changed?")
            for kind, name, dimension, meaning in entries:
                meaning = "".join(re.findall(r'"([^"]*)"', meaning))
                columns = [(name, units[dimension], meaning)]
                if kind == "Extensive":
                    columns.append((f"{name}_per_area", _PER_AREA[units[dimension]], f"{meaning} over nominal area"))
                for column, unit, text in columns:
                    known, meanings = table.setdefault(column, (unit, []))
                    if known != unit:
                        raise ValueError(f"{column}: {known} and {unit}; one name has one unit")
                    if text not in meanings:
                        meanings.append(text)
    return {name: (unit, "; ".join(meanings)) for name, (unit, meanings) in sorted(table.items(), key=lambda one: one[0].lower())}
