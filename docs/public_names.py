#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""public_names.py PROGRAM [--write]: lists every public name with the page that explains it, as docs/public_names.tsv holds them. Without
--write it compares with that file and ends with status 1 where they differ: a name that came, went or changed its unit is to be seen and
decided (docs/promises.md). Each must have a sentence. Needs the Python package."""

import difflib
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile

import names

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "docs/public_names.tsv"
FACADE = ROOT / "include/salebra/salebra.hpp"


def first_sentence(text):
    """Up to the first full stop that ends a sentence, on one line."""
    text = re.sub(r"\s+", " ", text).strip()
    return re.split(r"(?<=[^.][.])(?= [A-Z`(])", text)[0]


def commands(program):
    """Commands and their options, from what a shell is told of them."""
    script = subprocess.run([program, "completion", "zsh"], capture_output=True, text=True, check=True).stdout
    listed = re.search(r"commands=\(\n(.*?)\n  \)", script, re.S)[1]
    options = {}
    for command, about in re.findall(r"'(\w+):(.*)'", listed):
        yield "command", command, "docs/cli.md", about.replace("\\:", ":")
        block = re.search(rf"\n      {command}\) _arguments(.*?);;", script, re.S)[1]
        options[command] = set(re.findall(r"'\*(--[\w-]+)\[(.*?)\](?=[:'])", block))
    every = set.intersection(*options.values())
    for command, own in [("", every), *((command + " ", own - every) for command, own in options.items())]:
        for name, about in own:
            yield "option", command + name, "docs/cli.md", about.replace("\\:", ":")


def study_keys(program):
    """Keys of a study file, from the one that is written with a remark for each."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "study.toml"
        subprocess.run([program, "init", "-o", file], capture_output=True, check=True)
        table = None
        for line in file.read_text().splitlines():
            if found := re.match(r"(?:# )?\[(\w+)\] *(?:# *(.*))?", line):
                table = found[1]
                yield "study key", f"[{table}]", "data/README.md", found[2] or f"settings of the {table}"
            elif table and (found := re.match(r"(?:# )?(\w+) = [^#]+(?:# *(.*))?", line)):
                yield "study key", f"{table}.{found[1]}", "data/README.md", found[2] or ""


def results():
    """Names in JSON, HDF5 and columns of tables."""
    for name, (unit, meaning) in names.names().items():
        yield "result", f"{name} [{unit}]", "docs/names.md", meaning


def python_names():
    """Names of the submodules, and the public members of classes."""
    import salebra

    for module, holds in sorted(vars(salebra).items()):
        if module.startswith("_") or not inspect.ismodule(holds):
            continue
        page = f"docs/python/{module}"
        for name in sorted(name for name in dir(holds) if not name.startswith("_")):
            thing = getattr(holds, name)
            yield "python", f"salebra.{name}", page, first_sentence(re.sub(r"^\w+\(.*?\)( -> \S+)?\n", "", inspect.getdoc(thing) or ""))
            if not inspect.isclass(thing) or issubclass(thing, BaseException):
                continue
            for member in sorted(vars(thing)):
                if not member.startswith("_"):
                    text = re.sub(r"^\w+\(.*?\)( -> [^\n]+)?\n", "", inspect.getdoc(getattr(thing, member)) or "", flags=re.S)
                    yield "python", f"salebra.{name}.{member}", page, first_sentence(text)


def cpp_names():
    """What the headers of the facade declare in namespace salebra."""
    for header in re.findall(r"#include <(salebra/.*\.hpp)>", FACADE.read_text()):
        source = next(above / header for above in (ROOT / "include", ROOT / "generators/include") if (above / header).exists())
        page = f"docs/cpp/{header.removeprefix('salebra/').removesuffix('.hpp')}"
        known = {}
        comment = []
        for line in source.read_text().splitlines():
            if line.startswith("///"):
                comment.append(line[3:].strip())
                continue
            # How names and columns are described is how the library is made, not what it offers.
            found = re.match(r"(?:template <.*> ?)?(?:struct|class|enum class) (\w+)\b(?!;)", line) or re.match(r"(?!namespace|using|#)[A-Za-z][\w:<>,&* ]*?\b(\w+)\(", line)
            if found and found[1] not in ("EnumNames", "describe") and (comment or found[1] not in known):
                known.setdefault(found[1], first_sentence(" ".join(comment)))
            if not line.startswith("template"):
                comment = []
        for name, text in sorted(known.items()):
            yield "c++", f"salebra::{name}", page, text


def main(program, *arguments):
    rows = sorted({(kind, name): (page, text) for kind, name, page, text in
                   (*commands(program), *study_keys(program), *results(), *python_names(), *cpp_names())}.items())
    silent = [f"{kind} {name}" for (kind, name), (_, text) in rows if not text]
    if silent:
        sys.exit("public names without a sentence:\n  " + "\n  ".join(silent))
    lines = ["kind\tname\tpage\n"] + ["\t".join((kind, name, page)) + "\n" for (kind, name), (page, _) in rows]
    if "--write" in arguments:
        LIST.write_text("".join(lines))
        return
    before = LIST.read_text().splitlines(keepends=True)
    changed = [line for line in difflib.unified_diff(before, lines, "in the tree", "now", n=0)]
    if changed:
        sys.exit("".join(changed[:60]) + f"public names changed; if that is meant: docs/public_names.py {program} --write")


if __name__ == "__main__":
    main(*sys.argv[1:])
