# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipes of packaging/ name the libraries that CMake looks for and plotly's version, copy what the build needs and no build tree, and
call the program as it wants to be called: recipes.py ROOT PROGRAM SCRATCH
"""

import ast
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT, PROGRAM, SCRATCH = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])

# What cmake/SalebraFind.cmake and SalebraDependencies.cmake look for → what conda-forge and Spack call it; None: comes with the compiler, or is not for every recipe.
NAMES = {
    "Threads": None, "OpenMP": None, "PkgConfig": "pkg-config|pkgconfig", "Eigen3": "eigen", "fmt": "fmt", "fftw3": "fftw", "fftw3f": "fftw",
    "RANDOM123_INCLUDE_DIR": "random123", "GSL": "gsl", "HDF5": "hdf5", "libzip": "libzip", "ZLIB": "zlib|libzlib|zlib-api", "pugixml": "pugixml",
    "tomlplusplus": "tomlplusplus", "nlohmann_json": "nlohmann_json|nlohmann-json", "CLI11": "cli11",
    "MPI": None,  # for salebra-mpi alone, which only Spack's recipe makes
    "Catch2": None,  # for the tests alone
}

cmake = "".join((ROOT / "cmake" / name).read_text() for name in ("SalebraFind.cmake", "SalebraDependencies.cmake"))
wanted = re.findall(r"find_package\((\w+)", cmake) + re.findall(r"salebra_need_module\(\w+ (\w+) \"", cmake)
wanted += re.findall(r"find_path\((\w+)", cmake)
faults = [f"NAMES lacks {name}, which CMake looks for" for name in wanted if name not in NAMES]

plotly = re.search(r"^plotly==\S+", (ROOT / "report/requirements.txt").read_text(), re.MULTILINE)[0]
if f'"{plotly}"' not in (ROOT / "pyproject.toml").read_text():
    faults.append(f"pyproject.toml builds with another plotly than {plotly}, that of report/requirements.txt")
version = re.search(r"project\(salebra VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
conda = (ROOT / "packaging/conda/recipe.yaml").read_text()
spack = (ROOT / "packaging/spack/package.py").read_text()
ast.parse(spack)
in_conda = set(re.findall(r"^ +- ([\w-]+)(?: [<>=].*)?$", conda, re.MULTILINE)) | set(re.findall(r"target_directory: (\w+)", conda))
in_spack = set(re.findall(r'depends_on\("([\w-]+)', spack))
for name in wanted:
    spellings = (NAMES.get(name) or "").split("|")
    for recipe, known in (("conda/recipe.yaml", in_conda), ("spack/package.py", in_spack)):
        if spellings != [""] and not known & set(spellings):
            faults.append(f"packaging/{recipe} lacks {name}")
if f'version: "{version}"' not in conda or f'version("{version}")' not in spack:
    faults.append(f"a recipe has another version than {version}")
for recipe in ("Dockerfile", "salebra.def"):
    for script in re.findall(r"/salebra/(scripts/\S+)", (ROOT / "packaging" / recipe).read_text()):
        if not (ROOT / script).exists():
            faults.append(f"packaging/{recipe} calls {script}, which is not there")

# Every line that calls the program does what it says, in a folder with the file that it names.
shutil.rmtree(SCRATCH, ignore_errors=True)
(SCRATCH / "calls").mkdir(parents=True)
shutil.copy(ROOT / "data/surfaces/afm-scan.txt", SCRATCH / "calls/scan.txt")
# A command of the program or an option follows its name; in an image its entry point stands for it.
commands = re.findall(r"^(?:[A-Z][a-z]+ +| {9})([a-z0-9]+)  ", subprocess.run([PROGRAM, "--help"], check=True, capture_output=True, text=True).stdout, re.MULTILINE)
call = re.compile(rf"(?:^|[ /])salebra(?:[.]sif)? ((?:--version|--help|(?:{'|'.join(commands)})\b).*)", re.MULTILINE)
calls = 0
for recipe in sorted(path for path in (ROOT / "packaging").rglob("*") if path.is_file() and "wheel" not in path.parts):
    for line in call.findall(recipe.read_text()):
        arguments = shlex.split(line)
        calls += 1
        run = subprocess.run([PROGRAM, *arguments], cwd=SCRATCH / "calls", capture_output=True, text=True)
        if run.returncode != 0:
            faults.append(f"{recipe.relative_to(ROOT)} calls salebra {line}, which ends with {run.returncode}: {run.stderr.strip()}")
if calls < 4 or len(commands) < 15:
    faults.append(f"only {calls} calls of the program were found, with {len(commands)} commands: nothing was checked")

# An image is made of what its recipe copies, of a checkout with a build tree that another folder's CMake made.
checkout, image = SCRATCH / "checkout", SCRATCH / "image"
made = ["build/release", "out", "dist", "tests/report/node_modules"]
for folder in made:
    (checkout / folder).mkdir(parents=True)
ignored = [line for line in (ROOT / ".dockerignore").read_text().splitlines() if line and not line.startswith("#")]
for folder in made:
    if not any(pathlib.PurePath(folder).match(pattern.removeprefix("**/")) or pathlib.PurePath(folder.split("/")[0]).match(pattern)
               for pattern in ignored):
        faults.append(f".dockerignore lets {folder} into the image")
files = re.search(r"%files\n((?: +\S+ /salebra/\S+\n)+)", (ROOT / "packaging/salebra.def").read_text())
copied = [line.split() for line in files[1].splitlines()] if files else []
image.mkdir()
for source, target in copied:
    if not (ROOT / source).exists() or target != f"/salebra/{source}" or source.split("/")[0] in {name.split("/")[0] for name in made} - {"tests"}:
        faults.append(f"packaging/salebra.def copies {source}, which is not there or is made by a build, to {target}")
    else:
        os.symlink(ROOT / source, image / source)
configured = subprocess.run(["cmake", "--preset", "package", "-B", SCRATCH / "image-build"], cwd=image, capture_output=True, text=True)
if configured.returncode != 0:
    faults.append(f"what packaging/salebra.def copies cannot be configured: {configured.stderr.strip()}")

try:
    import yaml
except ImportError:
    yaml = None
if yaml:
    for file in ("packaging/conda/recipe.yaml", ".github/workflows/build.yml"):
        yaml.safe_load((ROOT / file).read_text())

print("\n".join(faults) or f"{len(wanted)} libraries are named by every recipe, {calls} calls of the program work")
sys.exit(1 if faults else 0)
