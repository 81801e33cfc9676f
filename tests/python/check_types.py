# SPDX-License-Identifier: GPL-3.0-or-later
"""check_types.py CONFIGURATION CACHE PATH…: mypy --strict over files and packages in Python and over the Python blocks of pages, in one run,
since most of its time is the types of numpy. Exits with 77 without mypy."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def scripts_of(page: Path) -> list[str]:
    """Its blocks; one without an import continues the one before."""
    scripts: list[str] = []
    for block in re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE):
        if re.search(r"^(import|from) ", block, re.MULTILINE) or not scripts:
            scripts.append(block)
        else:
            scripts[-1] += block
    return scripts


def main(configuration: str, cache: str, *paths: str) -> int:
    if importlib.util.find_spec("mypy") is None:
        print("SKIPPED: no mypy; run scripts/test-environment")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for page in (Path(path) for path in paths if path.endswith(".md")):
            for number, script in enumerate(scripts_of(page), 1):
                file = Path(folder) / f"{page.stem}_{number}.py"
                file.write_text(script, encoding="utf-8")
                files.append(str(file))
        if not files:
            print("the pages have no Python blocks")
            return 1
        command = [sys.executable, "-m", "mypy", "--config-file", configuration, "--strict", "--cache-dir", cache]
        return subprocess.run([*command, *files, *(path for path in paths if not path.endswith(".md"))], check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
