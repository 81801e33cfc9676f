# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx configuration of the documentation; scripts/docs runs it on the tree that stage.py lays out."""

import importlib.util
import inspect
import pathlib
import re

from docutils import nodes
from furo.navigation import get_navigation_tree
from latex2mathml.converter import convert
from sphinx import addnodes
from sphinx.environment.adapters.toctree import global_toctree_for_doc
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


# Half of the references in C++ declarations are to the standard library, which this site does not hold; Sphinx looks for each through all names.
def _no_references_to_std(app, doctree):
    for reference in list(doctree.findall(addnodes.pending_xref)):
        if reference.get("refdomain") == "cpp" and re.match(r"std\b", reference["reftarget"]):
            reference.replace_self(reference.children)


# The navigation of a page shows the titles of all pages. The theme would make it anew for each page, which took a third of the time of the
# site; only the links, which are relative, and the marks of the page and of those above it differ, and are set here in one that it made.
_navigation = []


def _place(entry, deepest):
    """An entry of the navigation, from its class on, that is the page (deepest) or stands above it."""
    entry = ("current-page " if deepest else "") + "current " + entry.replace(' type="checkbox"', ' checked="" type="checkbox"', 1)
    return re.sub(r'href="[^"]*"', 'href="#"', entry, count=1) if deepest else entry


def _navigation_of_titles(app, pagename, templatename, context, doctree):
    toctree = context.get("toctree")
    if toctree and not _navigation:
        tree = global_toctree_for_doc(app.env, "search", app.builder, collapse=False, titles_only=True, maxdepth=-1, includehidden=True)
        _navigation.extend(get_navigation_tree(app.builder.render_partial(tree)["fragment"]).split('<li class="'))
    context["toctree"] = lambda **options: ""


def _navigation_of_page(app, pagename, templatename, context, doctree):
    target, above, path = f'href="{app.builder.get_target_uri(pagename)}"', [], {}
    for number, entry in enumerate(_navigation[1:], 1):
        above.append(number)
        if target in entry:
            path = {place: place == number for place in above}
            break
        del above[len(above) - entry.count("</li>"):]
    entries = [_place(entry, path[number]) if number in path else entry for number, entry in enumerate(_navigation)]
    up = "../" * pagename.count("/")
    context["furo_navigation_tree"] = re.sub(r'href="(?!#)', f'href="{up}', '<li class="'.join(entries))


def setup(app):
    if "sphinx.ext.autodoc" in extensions:
        _make_signatures()
        app.connect("autodoc-process-docstring", _plain_text, priority=400)
        app.connect("autodoc-process-signature", _documented_types)
    app.connect("doctree-read", _no_references_to_std)
    app.connect("html-page-context", _navigation_of_titles, priority=400)
    app.connect("html-page-context", _navigation_of_page, priority=600)
    app.add_html_math_renderer(
        "mathml",
        (lambda translator, node: _formula(translator, node, False), None),
        (lambda translator, node: _formula(translator, node, True), None),
    )


html_math_renderer = "mathml"
