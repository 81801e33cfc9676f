# SPDX-License-Identifier: GPL-3.0-or-later
"""check_glossary.py --program FILE: compares the terms of docs/glossary.md with the program. Every name is in the table of names (docs/names.py) and has
its unit, and every option is one of a command."""

import argparse
import pathlib
import re
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
sys.path.insert(0, str(DOCS))
sys.dont_write_bytecode = True
from names import names as names_of_results  # noqa: E402



def tables_of(page):
    """The rows of every table of a page: a dictionary from the column's heading to the cell."""
    heading = None
    for line in page.read_text().splitlines():
        if not line.startswith("|"):
            heading = None
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if heading is None:
            heading = cells
        elif not set(line) <= set("|-: "):
            yield dict(zip(heading, cells, strict=True))


def in_code(cell):
    return re.findall(r"`([^`]*)`", cell)


def faults_of(rows, known):
    for row in rows:
        names, units = in_code(row["name"]), [unit.strip() for unit in row["unit"].split(",")]
        if len(units) == 1:
            units *= len(names)
        if len(names) > len(units):
            yield f"{names}: {len(names)} names, {len(units)} units"
        for name, unit in zip(names, units):
            if name not in known:
                yield f"{name}: is no name of a result"
            elif known[name] != unit:
                yield f"{name}: the unit is {known[name]}, the page says {unit}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    program = parser.parse_args().program

    def answer(*words):
        return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout

    known = {name: unit for name, (unit, _) in names_of_results().items()}
    commands = re.findall(r"^(?:[A-Z]\w+| +) +([a-z]\w+)  ", answer("--help").split("Which command?")[0], re.M)
    options = set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", "".join(answer("help", command) for command in [*commands, "options"])))

    glossary = list(tables_of(DOCS / "glossary.md"))
    faults = list(faults_of(glossary, known))
    for row in glossary:
        for option in in_code(row["option"]):
            if option.split()[0] not in options:
                faults.append(f"{option}: no command has it")
    if len(glossary) < 40:
        faults.append(f"{len(glossary)} terms: has the form of the tables changed?")
    if faults:
        sys.exit("\n".join(faults))
    print(f"{len(glossary)} terms")


main()
