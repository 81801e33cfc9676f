# SPDX-License-Identifier: GPL-3.0-or-later
"""run_page.py PAGE... --program FILE --scratch FOLDER: runs what pages of the documentation show, block after block, in an empty folder
that has the tree's data/ and examples/, a scan.txt, and out/, and ends with 1 and the reason where something fails or prints other than the page says.

  console   commands after "$ ", which go on after "> ", and under each what it prints. Numbers may differ by one in the last digit that the page
            gives, blanks in their number; "…" stands for any text, alone in a line for any lines. A command with nothing under it may print
            what it likes. What an earlier page ran is not run again: a later page that shows it too is compared with what it printed there.
  sh        a script; it must succeed
  python    run where the package can be imported (--python); the blocks of a page share their variables
  cpp, cmake, toml, ini, json   part of a file of the tree that is built or run elsewhere: examples/, tests/project/consumer or data/
  text      not looked at

A comment before a block changes that:
  <!-- not run: REASON -->          neither run nor compared
  <!-- long: REASON -->             the same, of what is right but takes too long for a test
  <!-- small: REASON -->            run with fewer points, steps and values, as docs/make-figures --small
  <!-- file: NAME -->               written to NAME for the blocks that follow
and one at the head of a page holds for all of it: <!-- page not run: REASON -->.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXCERPTS = {
    "cpp": ["examples/*.cpp", "tests/project/consumer/*.cpp"],
    "cmake": ["tests/project/consumer/CMakeLists.txt"],
    "toml": ["data/*.toml"],
}
OTHER = {"text", "json", "ini", "bibtex"}


class PageError(Exception):
    pass


class Block:
    def __init__(self, language, text, line, marks):
        self.language, self.text, self.line, self.marks = language, text, line, marks


def blocks_of(page):
    """The fenced blocks of a page, each with the marks that stand before it; directives such as ```{toctree} are left out."""
    blocks, marks, fence = [], {}, None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if fence is None:
            mark = re.fullmatch(r"\s*<!-- (page not run|not run|long|small|file): (.*\S) -->", line)
            opening = re.fullmatch(r"\s*(```+|~~~+)\s*(\S*).*", line)
            if mark:
                marks[mark[1]] = mark[2]
                if mark[1] == "page not run":
                    return []
            elif opening:
                fence, language, begin, lines = opening[1], opening[2], number, []
            elif line.strip():
                marks = {}
        elif line.strip() == fence:
            if not language.startswith("{"):
                blocks.append(Block(language, "\n".join(lines) + "\n", begin, marks))
            fence, marks = None, {}
        else:
            lines.append(line)
    return blocks


def smaller(text):
    text = re.sub(r"(--points|--map-phases|--map-radii|--steps|--intervals) \d+", r"\1 32", text)
    text = re.sub(r"(:[^ :]+):\d+", r"\1:4", text)

    def direct(found):
        given = found[0]
        added = " --steps 16" if "--steps" not in given else ""
        if "--points" not in given and "--surface" not in given:
            added += " --points 32"
        if "--intervals" not in given and "--surface" in given:
            added += " --intervals 8"
        return f"{found[1]}{added}{given[len(found[1]):]}"

    return re.sub(r"(salebra oscillate\b)(?:[^\n\\]|\\\n)*", direct, text)


NUMBER = re.compile(r"[-+−]?\d+(\.\d+)?([eE][-+]?\d+)?")


def last_digit(text):
    """The size of one in the last digit of a number as it is written."""
    mantissa, _, exponent = text.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def same_line(shown, printed):
    shown, printed = shown.split(), printed.split()
    if any("…" in word for word in shown):
        pieces = " ".join(shown).split("…")
        return re.fullmatch(".*".join(re.escape(piece.strip()) for piece in pieces), " ".join(printed)) is not None
    if len(shown) != len(printed):
        return False
    for left, right in zip(shown, printed):
        if left == right:
            continue
        if NUMBER.sub("#", left) != NUMBER.sub("#", right):
            return False
        for a, b in zip(NUMBER.finditer(left), NUMBER.finditer(right)):
            difference = float(a[0].replace("−", "-")) - float(b[0].replace("−", "-"))
            if abs(difference) > 1.01 * max(last_digit(a[0]), last_digit(b[0])):
                return False
    return True


def compare(shown, printed, where):
    """Lines of the page against lines of the program, a lone … standing for any number of lines."""
    shown = [line for line in shown.splitlines() if line.strip()]
    # Progress depends on the speed of the machine, and a build without the assets of the report says so: neither is on any page.
    beside = r"\w+: \w+ \d+ of \d+ .*|no report was written: this build does not contain .*"
    printed = [line for line in printed.splitlines() if line.strip() and not re.fullmatch(beside, line)]
    if not shown:
        return
    position = 0
    free = False
    for line in shown:
        if line.strip() == "…":
            free = True
            continue
        candidates = range(position, len(printed)) if free else range(position, min(position + 1, len(printed)))
        found = next((i for i in candidates if same_line(line, printed[i])), None)
        if found is None:
            raise PageError(f"{where}: the page shows\n  {line}\nand the program printed\n  " +
                            "\n  ".join(printed[position:position + 12] or ["nothing more"]))
        position, free = found + 1, False
    if position < len(printed) and not free:
        raise PageError(f"{where}: the program also printed\n  " + "\n  ".join(printed[position:position + 12]))


def commands_of(text, where):
    """(command, what is shown under it) of a console block."""
    result = []
    lines = text.splitlines()
    i = 0
    while i < len(lines):
        if lines[i].startswith("$ "):
            command = lines[i][2:]
            while i + 1 < len(lines) and (command.endswith("\\") or lines[i + 1].startswith("> ")):
                i += 1
                command += "\n" + lines[i].removeprefix("> ")
            result.append([command, ""])
        elif not result:
            raise PageError(f"{where}: a console block begins with '$ '")
        else:
            result[-1][1] += lines[i] + "\n"
        i += 1
    return result


def run(command, scratch, environment, where):
    # What stands before `head` in a pipe may still write when it has ended, which pipefail would call a failure.
    command_of_page = 'head() { command head "$@" && cat > /dev/null; }\n' + command
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", command_of_page], cwd=scratch, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise PageError(f"{where}: status {done.returncode} of\n{command}\n{done.stdout[-3000:]}")
    return done.stdout


def is_excerpt(block):
    wanted = [line.rstrip() for line in block.text.splitlines() if line.strip()]
    for pattern in EXCERPTS[block.language]:
        for file in ROOT.glob(pattern):
            lines = [line.rstrip() for line in file.read_text().splitlines() if line.strip()]
            # Indentation may differ as a whole: a piece of a function stands at the margin of the page.
            for first in range(len(lines) - len(wanted) + 1):
                piece = lines[first:first + len(wanted)]
                indent = len(piece[0]) - len(piece[0].lstrip()) - (len(wanted[0]) - len(wanted[0].lstrip()))
                if indent >= 0 and all(p == " " * indent + w for p, w in zip(piece, wanted)):
                    return True
    return False


def make_scratch(folder):
    scratch = pathlib.Path(folder)
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    for folder in ("data", "examples"):
        (scratch / folder).symlink_to(ROOT / folder)
    (scratch / "scan.txt").symlink_to(ROOT / "data/surfaces/afm-scan.txt")
    (scratch / "out").mkdir()
    return scratch


def check(page, scratch, before, arguments):
    """Returns what each command printed; `before`: the same of earlier pages."""
    environment = dict(os.environ, OMP_WAIT_POLICY="passive", COLUMNS="200")
    environment["PATH"] = f"{pathlib.Path(arguments.program).resolve().parent}:{environment['PATH']}"
    printed_by, python_blocks, counts = {}, [], {}
    for block in blocks_of(page):
        where = f"{page.name}:{block.line}"
        counts[block.language] = counts.get(block.language, 0) + 1
        if "file" in block.marks:
            (scratch / block.marks["file"]).write_text(block.text)
        elif "not run" in block.marks or "long" in block.marks or block.language in OTHER:
            continue
        elif block.language == "console":
            for command, shown in commands_of(block.text, where):
                if "small" in block.marks:
                    run(smaller(command), scratch, environment, where)
                    continue
                printed_by[command] = before[command] if command in before else run(command, scratch, environment, where)
                compare(shown, printed_by[command], where)
        elif block.language in ("sh", "bash"):
            run(smaller(block.text) if "small" in block.marks else block.text, scratch, environment, where)
        elif block.language == "python":
            python_blocks.append(f"# {where}\n{block.text}")
        elif block.language in EXCERPTS:
            if not is_excerpt(block):
                raise PageError(f"{where}: this is no part of {' or '.join(EXCERPTS[block.language])}")
        else:
            raise PageError(f"{where}: a block of language '{block.language}'; say what it is (see {pathlib.Path(__file__).name})")
    if python_blocks:
        if not arguments.python:
            print(f"{page.name}: {len(python_blocks)} Python blocks are not run, there is no Python package")
        else:
            script = scratch / "page_blocks.py"
            script.write_text("\n".join(python_blocks))
            run(f"MPLBACKEND=agg {arguments.python} page_blocks.py", scratch, environment, page.name)
    print(f"{page.name}: {sum(counts.values())} blocks, {counts}")
    return printed_by


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("pages", nargs="+", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", required=True)
    parser.add_argument("--python", default="", help="an interpreter that can import the package; empty: Python blocks are not run")
    arguments = parser.parse_args()
    scratch, before = make_scratch(arguments.scratch), {}
    try:
        for page in arguments.pages:
            before |= check(page, scratch, before, arguments)
    except PageError as error:
        sys.exit(str(error))


main()
