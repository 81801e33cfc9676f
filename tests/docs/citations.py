#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what pages, public headers, docstrings and paper/ cite with docs/references.bib.

  in words    "Author (year)", "Author and Author (year)" or "Author et al. (year)" for three and more; an entry has these authors and year.
              A name of the bibliography before a year in another form is a fault, and so is volume and year in a header or a docstring.
  doi:        belongs to an entry
  paper/      every key, as [@popov2015], has an entry
  Python      what salebra.citations() knows has the key, authors, title, year and DOI of an entry
  entries     each is cited somewhere
"""

import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("*.md", "docs/*.md", "docs/howto/*.md", "data/*.md", "paper/*.md", "src/contact/*.md")
COMMENTS = ("include/**/*.hpp", "generators/include/**/*.hpp", "python/src/*.cpp", "python/salebra/*.py")
CITATIONS = ROOT / "python/salebra/_citations.py"
NAME = r"[^\W\d_a-z][\w’'-]+"
IN_FULL = re.compile(r"\b\d+ \((?:18|19|20)\d\d\)")


def bibliography():
    entries = {}
    text = (ROOT / "docs/references.bib").read_text("utf-8")
    for key, body in re.findall(r"^@\w+\{(\w+),\n(.*?)^\}$", text, re.M | re.S):
        assert key not in entries, f"docs/references.bib: {key} is there twice"
        entries[key] = dict(re.findall(r"^  (\w+) = \{(.*)\},$", body, re.M))
    assert len(entries) == len(re.findall(r"^@", text, re.M)), "docs/references.bib: an entry has another form than its neighbours"
    return entries


def surnames(entry):
    return [author.split(",")[0] for author in entry["author"].split(" and ")]


def in_words(entry):
    names = surnames(entry)
    authors = {1: names[0], 2: " and ".join(names)}.get(len(names), f"{names[0]} et al.")
    return f"{authors} ({entry['year']})"


def main():
    entries, faults, cited = bibliography(), [], set()
    keys = {in_words(entry): key for key, entry in entries.items()}
    assert len(keys) == len(entries), "docs/references.bib: two entries are the same in words"
    dois = {entry["doi"]: key for key, entry in entries.items() if "doi" in entry}
    leads = "|".join(sorted({surnames(entry)[0] for entry in entries.values()}))
    of_known_author = rf"\b(?:{leads})(?:,? (?:and |& )?{NAME}| et al\.)*,? [(\[]?(?:18|19|20)\d\d\b[)\]]?"
    in_form = rf"\b{NAME}(?: and {NAME}| et al\.)? \((?:18|19|20)\d\d\)"
    citation = re.compile(f"{of_known_author}|{in_form}")

    for place in PAGES + COMMENTS:
        for path in sorted(ROOT.glob(place)):
            if path == CITATIONS:
                continue
            text = re.sub(r"\s*\n[ /*]*", " ", path.read_text("utf-8"))
            for words in citation.findall(text):
                if words in keys:
                    cited.add(keys[words])
                else:
                    faults.append(f"{path.relative_to(ROOT)}: '{words}' is not in docs/references.bib, or not in the form 'Author (year)'")
            for doi in re.findall(r"doi(?:\.org/|:)(10\.[^\s\"`\]}]*[^\s\"`.,;:)\]}])", text):
                if doi.count("(") > doi.count(")"):
                    doi += ")"
                if doi in dois:
                    cited.add(dois[doi])
                else:
                    faults.append(f"{path.relative_to(ROOT)}: doi:{doi} is not in docs/references.bib")
            if place in COMMENTS:
                faults += [f"{path.relative_to(ROOT)}: '… {words}' belongs into docs/references.bib; cite it as 'Author (year)'"
                           for words in IN_FULL.findall(text)]
            if path.parts[-2] == "paper":
                for key in re.findall(r"@(\w+)", text):
                    cited.add(key)
                    if key not in entries:
                        faults.append(f"{path.relative_to(ROOT)}: @{key} is not in docs/references.bib")

    # Comments of headers within the library may cite in full.
    for path in sorted((ROOT / "src").rglob("*.hpp")):
        text = re.sub(r"\s*\n[ /*]*", " ", path.read_text("utf-8"))
        cited |= {keys[words] for words in citation.findall(text) if words in keys}

    for call in ast.walk(ast.parse(CITATIONS.read_text("utf-8"))):
        if not isinstance(call, ast.Call) or getattr(call.func, "id", "") != "Citation" or len(call.args) != 3:
            continue
        key, text, doi = (argument.value for argument in call.args)
        cited.add(key)
        entry = entries.get(key, {})
        plain = entry.get("title", "").replace("{", "").replace("}", "").replace("``", '"').replace("''", '"')
        titles = [part for part in text.split(", ") if part and plain.startswith(part.split(" (")[0])]
        if entry.get("doi") != doi or f"({entry.get('year')})" not in text and f", {entry.get('year')})" not in text or not titles:
            faults.append(f"python/salebra/_citations.py: {key} differs from its entry in docs/references.bib")
        elif not all(name in text for name in surnames(entry)):
            faults.append(f"python/salebra/_citations.py: {key} has other authors than its entry in docs/references.bib")
    faults += [f"docs/references.bib: {key} is cited nowhere" for key in entries if key not in cited]
    print("\n".join(faults) or f"{len(entries)} entries, all cited")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
