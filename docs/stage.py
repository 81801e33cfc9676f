# SPDX-License-Identifier: GPL-3.0-or-later
"""stage.py PROGRAM DOXYGEN-XML FOLDER: lays out what Sphinx reads: the pages at the places that they have in the tree, so that a link between
two of them holds in both, the reference of the commands from the program's own help, the names of results from the table in the sources, a page for
each C++ header and each submodule of the Python package, and the notebooks, which are scripts of examples/ that it executes."""

import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys

import names
import notebook

root = pathlib.Path(__file__).resolve().parent.parent

MODULES = {
    "base": "errors, units, grid and fields, transforms, random numbers, parallel sums",
    "generators": "rough surfaces and analytic shapes",
    "surface": "what is measured on a surface",
    "contact": "material, boundary elements, Greenwood–Williamson, dimensionality reduction, the law",
    "damping": "what moves, the loss, the paper's closed forms, direct simulation",
    "io": "files and pictures",
    "results": "what each result is called, with unit and meaning; files of curves",
    "study": "the whole path for an ensemble",
    "analysis": "problems that several interfaces pose, as data, and their solutions",
    "figures": "figures of results as data",
    "export": "laws as input of other programs",
    "report": "the results of a study as a page",
}
NOTEBOOKS = ("10_damping_of_scan", "12_joint", "13_tunable_damper", "15_own_law", "18_design")
# The submodules of the Python package.
TOPICS = {
    "surfaces": "surfaces and what is measured on them",
    "generators": "rough surfaces and analytic shapes",
    "contact": "boundary elements, force curves, exponential law",
    "models": "Greenwood–Williamson, dimensionality reduction, theories, laws",
    "damping": "what moves, losses with and without slip, direct simulation",
    "closed_form": "formulas of the paper",
    "studies": "the whole path for an ensemble",
    "figures": "what is drawn of results, as data",
    "files": "files of surfaces, curves and results",
    "session": "threads, versions, errors, quantities",
}


def python_pages():
    """docs/python/<submodule>.rst: the names of each submodule, and docs/python_reference.rst, which lists the submodules."""
    import salebra

    modules = {name for name in dir(salebra) if type(getattr(salebra, name)).__name__ == "module"}
    if modules != set(TOPICS):
        sys.exit(f"stage.py: TOPICS and the submodules of the Python package differ by {modules ^ set(TOPICS)}; list all of them in TOPICS")
    for name, about in TOPICS.items():
        title = f"salebra.{name}: {about}"
        yield f"python/{name}", f"""{title}
{"=" * len(title)}

.. automodule:: salebra.{name}
   :members:
   :imported-members:
"""
    yield "python_reference", """Python reference
================

.. automodule:: salebra

.. toctree::
   :maxdepth: 1

""" + "".join(f"   python/{name}\n" for name in TOPICS)


def put(target, text):
    """Writes a page if it changed, so that Sphinx reads again only what did."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.exists() or target.read_text() != text:
        target.write_text(text)
    return target


def one_title(text):
    """A page with every heading after its first title one level down, where it has several titles: the index shows titles."""
    parts = re.split(r"(^```.*?^```)", text, flags=re.M | re.S)
    titles = 0
    for i in range(0, len(parts), 2):

        def demoted(found):
            nonlocal titles
            titles += found[1] == "#"
            return found[0] if titles < 2 else "#" + found[0]

        parts[i] = re.sub(r"^(#+) ", demoted, parts[i], flags=re.M)
    return "".join(parts)


def copy(source, target):
    if source.suffix == ".md":
        return put(target, one_title(source.read_text()))
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.exists() or source.read_bytes() != target.read_bytes():
        shutil.copyfile(source, target)
    return target


def help_of(program, *command):
    done = subprocess.run([program, "help", *command], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def command_reference(program):
    """docs/cli.md: --help of the program and of each command that it lists."""
    overview = help_of(program)
    # Commands stand behind the headings of their kinds, and the chart of commands comes after them.
    names = re.findall(r"^(?:[A-Z]\w+| +) +([a-z]\w+)  ", overview.split("Which command?", 1)[0], re.M)
    if len(names) < 10:
        sys.exit(f"stage.py: the help of {program} lists {len(names)} commands; has its form changed?")
    text = "# Commands\n\nWhat `salebra help`, `salebra help COMMAND` and `salebra help options` print.\n\n"
    for name, page in [("salebra", overview)] + [(n, help_of(program, n)) for n in [*names, "options"]]:
        title = name if name == "salebra" else f"salebra {name}"
        text += f"## {title}\n\n```text\n{page}\n```\n\n"
    return text


def preamble(header):
    """What a header says of itself, before it opens its namespace, as reStructuredText."""
    found = re.search(r"((?:^///.*\n)+)\s*namespace salebra \{", header.read_text(), re.M)
    text = ""
    literal = False
    for line in found[1].splitlines() if found else []:
        line = line.removeprefix("///")
        inset = line.startswith("    ")
        if inset and not literal:
            text += "\n::\n\n"
        elif literal and not inset:
            text += "\n"
        literal = inset
        text += (line if inset else re.sub(r"([*`|_\\\\])", r"\\\1", line.strip())) + "\n"
    return text + "\n"


def header_pages():
    """docs/cpp/<module>.rst lists the public headers of a module, docs/cpp/<module>/….rst is what one of them declares."""
    modules = {folder.name for above in ("include", "generators/include") for folder in (root / above / "salebra").iterdir() if folder.is_dir()}
    if modules != set(MODULES):
        sys.exit(f"stage.py: MODULES and the folders of headers differ by {modules ^ set(MODULES)}; list all of them in MODULES")
    for module, about in MODULES.items():
        above = root / ("generators/include" if module == "generators" else "include")
        headers = sorted(p.relative_to(above) for p in (above / "salebra" / module).rglob("*.hpp"))
        title = f"salebra/{module}: {about}"
        text = f"{title}\n{'=' * len(title)}\n\n.. toctree::\n   :maxdepth: 1\n\n"
        for header in headers:
            page = header.relative_to("salebra").with_suffix("")
            text += f"   {page}\n"
            name = str(page.relative_to(module))
            yield page, (f"{name}\n{'=' * len(name)}\n\n.. code-block:: cpp\n\n   #include <{header}>\n\n" + preamble(above / header)
                         + f".. doxygenfile:: {header}\n   :project: salebra\n")
        yield module, text


def names_of_results():
    """docs/names.md: the table of names of results."""
    text = "# Names of results\n\nNames in files, JSON and Python, with SI unit and meaning. The [glossary](glossary.md) explains the terms.\n\n"
    text += "| name | unit | meaning |\n|---|---|---|\n"
    return text + "".join(f"| `{name}` | {unit} | {meaning.replace('*', chr(92) + '*')} |\n" for name, (unit, meaning) in names.names().items())


def suit_breathe(doxygen):
    """Changes in Doxygen's XML that Breathe needs: it looks a header up by the name in the index, which is the last part of its
    path only, and does not know designated initialisers."""
    for page in doxygen.glob("*.xml"):
        text = page.read_text()
        shorter = re.sub(r"<initializer>= ?\{\..*?</initializer>", "", text)
        if shorter != text:
            page.write_text(shorter)
    # What stands before `namespace salebra` in a header would stand under that namespace in all of them; header_pages shows it.
    namespace = doxygen / "namespacesalebra.xml"
    text = namespace.read_text()
    head, members = text.rsplit("</sectiondef>", 1)
    namespace.write_text(head + "</sectiondef>" + re.sub(r"<(brief|detailed)description>.*</\1description>", "", members, flags=re.S))
    index = doxygen / "index.xml"

    def full(found):
        header = (doxygen / f"{found[1]}.xml").read_text()
        return found[0].replace(found[2], re.findall(r'<location file="([^"]+)"', header)[-1])

    index.write_text(re.sub(r'<compound refid="(\w+)" kind="file"><name>([^<]+)', full, index.read_text()))


def main(program, doxygen, folder):
    folder = pathlib.Path(folder)
    suit_breathe(pathlib.Path(doxygen))
    kept = set()
    for pattern in ("docs/**/*.md", "docs/*.bib", "docs/**/*.png", "docs/**/*.svg", "docs/static/*", "data/*.md", "examples/*.cpp", "examples/*.py",
                    "examples/cluster/*", "tests/fuzz/README.md", "src/contact/README.md", "tests/docs/*.py", "CHANGELOG.md", "CONTRIBUTING.md"):
        for source in root.glob(pattern):
            kept.add(copy(source, folder / source.relative_to(root)))
    if importlib.util.find_spec("salebra"):
        for page, text in python_pages():
            kept.add(put(folder / f"docs/{page}.rst", text))
        if importlib.util.find_spec("matplotlib"):
            for name in NOTEBOOKS:
                kept.update(notebook.make(root / f"examples/{name}.py", root, folder / "docs/notebooks"))
            gallery = folder / "docs/examples.md"
            text = re.sub(rf"\(\.\./examples/({'|'.join(NOTEBOOKS)})\.py\)", r"(notebooks/\1.md)", gallery.read_text())
            put(gallery, text + "\n```{toctree}\n:hidden:\n" + "".join(f"notebooks/{name}\n" for name in NOTEBOOKS) + "```\n")
    # Pages that not every tree has.
    index = folder / "docs/index.md"
    missing = [name for name in ("python", "python_reference", "report") if name not in {page.stem for page in kept}]
    put(index, re.sub(rf"^({'|'.join(missing)})\n" if missing else "$^", "", index.read_text(), flags=re.M))
    kept.add(put(folder / "docs/cli.md", command_reference(program)))
    kept.add(put(folder / "docs/names.md", names_of_results()))
    for page, text in header_pages():
        kept.add(put(folder / f"docs/cpp/{page}.rst", text))
    for old in folder.rglob("*"):
        if old.is_file() and old not in kept:
            old.unlink()


main(*sys.argv[1:])
