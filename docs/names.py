# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of all results with their units and meanings, from the descriptions of the structs."""

import pathlib
import re

_ROOT = pathlib.Path(__file__).resolve().parent.parent
_TABLE = ("include/salebra/**/*.hpp", "generators/include/salebra/**/*.hpp", "src/**/*.hpp", "apps/salebra/*.hpp")
_KINDS = ("Quantity", "Extensive", "WhereKnown")
_PER_AREA = {"N": "Pa", "J": "J/m^2", "N/m": "Pa/m"}


def names():
    """{name: (unit, meaning)}. Where two structs mean different things by a name, both meanings."""
    units = dict(re.findall(r'About\{(?:Dimension::)?(\w+), "([^"]+)"', (_ROOT / "src/base/units.cpp").read_text()))
    declared = r'(\w+)\{\s*"\1",\s*Dimension::(\w+),\s*"([^"]*)"\}'
    shared = {name: line for source in _ROOT.glob(_TABLE[0]) for name, *line in re.findall(declared, source.read_text())}
    table = {}
    for pattern in _TABLE:
        for source in sorted(_ROOT.glob(pattern)):
            text = re.sub(r"^\s*///.*\n", "", source.read_text(), flags=re.M)
            begin = r'(\w+)\{\s*"(\w+)",\s*(?:Dimension::)?(\w+),'
            text = re.sub(r'WhereKnown\{\{("[^{}]*")\}\}', r"WhereKnown{\1}", text)
            text = re.sub(r"Extensive\{quantity::(\w+)\}", lambda found: 'Extensive{"%s", %s, "%s"}' % (found[1], *shared[found[1]]), text)
            entries = [one for one in re.findall(begin + r'\s*((?:"[^"]*"\s*)+)\}', text) if one[0] in (*_KINDS, one[1])]
            written = sum(kind in (*_KINDS, name) for kind, name, _ in re.findall(begin, text))
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
