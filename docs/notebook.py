# SPDX-License-Identifier: GPL-3.0-or-later
"""A script with cells ("# %%", text in "# %% [markdown]") as an executed notebook and as a page of the site. The script is the one source; nothing
but Python and matplotlib is needed to run it."""

import base64
import contextlib
import io
import json
import os
import pathlib
import re
import sys


def cells_of(script):
    """[(kind, text)] of a script: "markdown" or "code". What stands before the first cell, the license, is left out."""
    parts = re.split(r"^# %%(.*)\n", script, flags=re.M)[1:]
    for mark, text in zip(parts[::2], parts[1::2]):
        if "[markdown]" in mark:
            yield "markdown", re.sub(r"^# ?", "", text, flags=re.M).strip()
        else:
            yield "code", text.strip()


def run(script, folder, dpi=100):
    """Executes the cells in order, in the folder, as `python SCRIPT` would. [(kind, text, what was printed, pictures as PNG)]"""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    names, done, before, arguments = {"__name__": "__main__"}, [], os.getcwd(), sys.argv
    try:
        os.chdir(folder)
        sys.argv = [str(script)]
        for number, (kind, text) in enumerate(cells_of(script.read_text()), 1):
            printed, pictures = io.StringIO(), []
            if kind == "code":
                # A cell that draws shows its picture at its end, also without plt.show(), which agg ignores.
                with contextlib.redirect_stdout(printed):
                    exec(compile(text, f"{script.name}, cell {number}", "exec"), names)
                if "plt.show()" in text:
                    for figure in map(plt.figure, plt.get_fignums()):
                        picture = io.BytesIO()
                        figure.savefig(picture, format="png", dpi=dpi, metadata={"Software": None})
                        pictures.append(picture.getvalue())
                    plt.close("all")
            done.append((kind, text, printed.getvalue(), pictures))
    finally:
        os.chdir(before)
        sys.argv = arguments
    return done


def as_notebook(cells):
    """JSON of nbformat 4.5."""
    result, count = [], 0
    for number, (kind, text, printed, pictures) in enumerate(cells):
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": text.splitlines(keepends=True)}
        if kind == "code":
            count += 1
            outputs = [{"output_type": "stream", "name": "stdout", "text": printed.splitlines(keepends=True)}] if printed else []
            outputs += [{"output_type": "display_data", "metadata": {}, "data": {"image/png": base64.b64encode(picture).decode()}} for picture in pictures]
            cell |= {"execution_count": count, "outputs": outputs}
        result.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return json.dumps({"cells": result, "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}}, "nbformat": 4, "nbformat_minor": 5}, indent=1)


def as_page(name, cells, folder):
    """Markdown of the site; its pictures are written to the folder."""
    text = ""
    for kind, source, printed, pictures in cells:
        if kind == "markdown":
            text += source + "\n\n"
            if source.startswith("# ") and "download" not in text:
                text += f"{{download}}`This page as a notebook <{name}.ipynb>`\n\n"
            continue
        text += f"```python\n{source}\n```\n\n"
        if printed:
            text += f"```text\n{printed}```\n\n"
        for picture in pictures:
            file = f"{name}-{text.count('![')}.png"
            (folder / file).write_bytes(picture)
            text += f"![]({file})\n\n"
    return text


def make(script, root, folder):
    """Writes NAME.ipynb, NAME.md and pictures to the folder, unless they are newer than the script and this file; returns their paths."""
    name = script.stem
    notebook = folder / f"{name}.ipynb"
    if not notebook.exists() or notebook.stat().st_mtime < max(script.stat().st_mtime, pathlib.Path(__file__).stat().st_mtime):
        folder.mkdir(parents=True, exist_ok=True)
        cells = run(script, root)
        (folder / f"{name}.md").write_text(as_page(name, cells, folder))
        notebook.write_text(as_notebook(cells))
    return [notebook, folder / f"{name}.md", *folder.glob(f"{name}-*.png")]
