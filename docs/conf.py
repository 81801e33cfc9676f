# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx configuration of the documentation; scripts/docs runs it on the tree that stage.py lays out."""

import importlib.util
import inspect
import pathlib
import re

from docutils import nodes
from latex2mathml.converter import convert
from sphinx import addnodes
from sphinx.util import logging

logger = logging.getLogger(__name__)

_root = pathlib.Path(__file__).resolve().parent.parent
_cmake = (_root / "CMakeLists.txt").read_text()

project = "salebra"
author = "The salebra developers"
copyright = author
release = version = re.search(r"project\(salebra VERSION (\S+)", _cmake)[1]

extensions = ["myst_parser", "breathe", "sphinx_copybutton", "sphinxcontrib.bibtex"]
if importlib.util.find_spec("salebra"):
    extensions += ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
autodoc_member_order = "groupwise"
python_use_unqualified_type_names = True
# What one types is copied of a console block.
copybutton_prompt_text = r"\$ |> "
copybutton_prompt_is_regexp = True
copybutton_line_continuation_character = "\\"
copybutton_selector = "div.highlight:not(.highlight-text *) pre"
root_doc = "docs/index"
exclude_patterns = ["docs/README.md"]  # the index for readers of the tree

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
suppress_warnings = [
    "duplicate_declaration.cpp",  # namespace salebra, which every header opens
]

bibtex_bibfiles = ["references.bib"]

breathe_projects = {"salebra": str(_root / "build/docs/doxygen/xml")}
breathe_default_project = "salebra"
highlight_language = "none"

html_theme = "furo"
html_title = f"salebra {release}"
html_static_path = ["static"]
html_css_files = ["salebra.css"]
html_copy_source = False
html_search_scorer = str(_root / "docs/scorer.js")
html_show_sphinx = False


# The converter leaves out the thin spaces around functions, and takes a bar for an infix operator.
def _spaced(formula):
    name = r"<mi>(?:sin|cos|tan|sinh|cosh|arccos|ln|exp|erf)</mi>"
    thin = '<mspace width="0.17em"/>'

    def around(found):
        return (found[1] + thin if found[1] else "") + found[2] + ("" if found[3] else thin)

    formula = re.sub(rf"(</(?:mi|mn|msub|msup|msubsup|mfrac)>)?({name}|<msup>{name}<mn>\d+</mn></msup>)(?=(<mo|</)?)", around, formula)
    return formula.replace('<mo stretchy="false">&#x0007C;</mo>', '<mo stretchy="false" lspace="0" rspace="0">&#x0007C;</mo>')


# Formulas become MathML in the page: browsers draw it without a script and without a network, and screen readers read it.
# \\tag{12} sets the number of the paper's equation beside a formula, and makes it a target, #eq-12.
def _formula(translator, node, as_block):
    latex = node.astext()
    tag = re.search(r"\\tag\{([^}]*)\}", latex)
    formula = _spaced(convert(latex.replace(tag[0], "") if tag else latex, display="block" if as_block else "inline"))
    if unknown := re.search(r"\\[a-zA-Z]+", formula):
        logger.warning("formula %r: %s is not known", latex, unknown[0], location=node)
    if as_block:
        number = f'<span class="eqno" id="eq-{tag[1]}">({tag[1]})</span>' if tag else ""
        formula = f'<div class="math">{number}{formula}</div>\n'
    translator.body.append(formula)
    raise nodes.SkipNode


# Docstrings are written to be read by help(): |q| there is a modulus and no substitution, F_ no reference.
def _plain_text(app, what, name, subject, options, lines):
    in_math = None
    for i, line in enumerate(lines):
        inset = len(line) - len(line.lstrip())
        if line.lstrip().startswith(".. math::"):
            in_math = inset
        elif in_math is not None and (not line.strip() or inset > in_math):
            continue
        else:
            in_math = None
            pieces = re.split(r"(:math:`[^`]*`|``[^`]*``)", line)
            pieces[::2] = [re.sub(r"(?<!\\)(\||(?<=\w)_(?!\w))", r"\\\1", piece) for piece in pieces[::2]]
            lines[i] = "".join(pieces)


# A type is one of the submodule that documents it, not of the extension that holds it.
def _documented_types(app, what, name, subject, options, signature, returned):
    import salebra

    def documented(found):
        topics = [module for name, module in inspect.getmembers(salebra, inspect.ismodule) if not name.startswith("_")]
        owner = next((topic for topic in topics if hasattr(topic, found[1])), salebra)
        return f"{owner.__name__}.{found[1]}"

    return tuple(text and re.sub(r"salebra\.(\w+)(?![\w.])", documented, text) for text in (signature, returned))


# Functions of the package make their signature when one asks for it, as what they wrap, which autodoc would take for an attribute.
def _make_signatures():
    import salebra

    topics = [module for _, module in inspect.getmembers(salebra, inspect.ismodule)]
    classes = {thing for topic in topics for thing in vars(topic).values() if inspect.isclass(thing)}
    for holder in (salebra, *topics, *classes):
        for function in vars(holder).values():
            function = getattr(function, "__func__", function)
            if inspect.isfunction(function) and hasattr(function, "__wrapped__"):
                function.__signature__ = inspect.signature(function)
                del function.__wrapped__


# The navigation of each page shows the titles of all pages. Sphinx copies every entry of every page first, those of the names in C++
# headers too, and then leaves them out: that took half the time of the site.
_titles = {}


def _navigation_of_titles(app, pagename, templatename, context, doctree):
    toctree = context.get("toctree")
    if not toctree:
        return
    if not _titles:
        for page, contents in app.env.tocs.items():
            _titles[page] = contents.deepcopy()
            for entry in _titles[page].children:
                if len(entry) > 1:
                    entry[1][:] = list(entry.findall(addnodes.toctree))
                    if not entry[1].children:
                        entry.pop(1)

    def of_titles(**options):
        whole, app.env.tocs = app.env.tocs, _titles
        try:
            return toctree(**options)
        finally:
            app.env.tocs = whole

    context["toctree"] = of_titles


def setup(app):
    if "sphinx.ext.autodoc" in extensions:
        _make_signatures()
        app.connect("autodoc-process-docstring", _plain_text, priority=400)
        app.connect("autodoc-process-signature", _documented_types)
    app.connect("html-page-context", _navigation_of_titles, priority=400)
    app.add_html_math_renderer(
        "mathml",
        (lambda translator, node: _formula(translator, node, False), None),
        (lambda translator, node: _formula(translator, node, True), None),
    )


html_math_renderer = "mathml"
