# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipe of an image calls scripts that are there, copies no build tree, and calls the program as it wants to be called; plotly has one
version: recipes.py ROOT PROGRAM SCRATCH
"""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT, PROGRAM, SCRATCH = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
recipe = (ROOT / "packaging/Dockerfile").read_text()
faults = []

plotly = re.search(r"^plotly==\S+", (ROOT / "report/requirements.txt").read_text(), re.MULTILINE)[0]
if f'"{plotly}"' not in (ROOT / "pyproject.toml").read_text():
    faults.append(f"pyproject.toml builds with another plotly than {plotly}, that of report/requirements.txt")
for script in re.findall(r"/salebra/(scripts/\S+)", recipe):
    if not (ROOT / script).exists():
        faults.append(f"packaging/Dockerfile calls {script}, which is not there")

# Its example of a call does what it says, in a folder with the file that it names.
shutil.rmtree(SCRATCH, ignore_errors=True)
SCRATCH.mkdir(parents=True)
shutil.copy(ROOT / "data/surfaces/afm-scan.txt", SCRATCH / "scan.txt")
calls = re.findall(r"docker run .* salebra (.*)", recipe)
for line in calls:
    run = subprocess.run([PROGRAM, *shlex.split(line)], cwd=SCRATCH, capture_output=True, text=True)
    if run.returncode != 0:
        faults.append(f"packaging/Dockerfile calls salebra {line}, which ends with {run.returncode}: {run.stderr.strip()}")
if not calls:
    faults.append("no call of the program was found: nothing was checked")

ignored = [line for line in (ROOT / ".dockerignore").read_text().splitlines() if line and not line.startswith("#")]
for folder in ("build/release", "out", "dist", "tests/report/node_modules"):
    if not any(pathlib.PurePath(folder).match(pattern.removeprefix("**/")) or pathlib.PurePath(folder.split("/")[0]).match(pattern)
               for pattern in ignored):
        faults.append(f".dockerignore lets {folder} into the image")

print("\n".join(faults) or f"{len(calls)} calls of the program work")
sys.exit(1 if faults else 0)
