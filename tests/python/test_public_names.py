# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of public names, docs/public_names.tsv, is that of this program, package and facade, and a name that changes is seen."""

from __future__ import annotations

import os
import pathlib
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "docs"))
public_names = pytest.importorskip("public_names")
PROGRAM = os.environ.get("SALEBRA_PROGRAM", "")

pytestmark = pytest.mark.skipif(not PROGRAM, reason="the program is not built")


def test_public_names_are_those_of_the_list() -> None:
    public_names.main(PROGRAM)


def test_names_that_went_or_changed_are_told(monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> None:
    lines = public_names.LIST.read_text(encoding="utf-8").splitlines(keepends=True)
    for changed in (lines[:50] + lines[51:], [*lines, "result\tgone [m]\tdocs/names.md\n"], [line.replace("work_per_cycle [J]", "work_per_cycle [N]") for line in lines]):
        other = tmp_path / "public_names.tsv"
        other.write_text("".join(changed), encoding="utf-8")
        monkeypatch.setattr(public_names, "LIST", other)
        with pytest.raises(SystemExit, match="public names changed"):
            public_names.main(PROGRAM)


def test_every_page_of_the_list_is_there() -> None:
    made = ("docs/cli.md", "docs/names.md", "docs/python/", "docs/cpp/")  # by docs/stage.py
    pages = {line.rstrip("\n").split("\t")[2] for line in public_names.LIST.read_text(encoding="utf-8").splitlines(keepends=True)[1:]}
    assert pages and all(page.startswith(made) or (ROOT / page).exists() for page in pages)
