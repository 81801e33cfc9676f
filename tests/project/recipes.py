# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the libraries that CMake looks for with those that each recipe of packaging/ names, and plotly's versions: recipes.py ROOT"""

import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])

# What cmake/SalebraDependencies.cmake looks for → what conda-forge and Spack call it; None: comes with the compiler, or is not for every recipe.
NAMES = {
    "Threads": None, "OpenMP": None, "PkgConfig": "pkg-config|pkgconfig", "Eigen3": "eigen", "fmt": "fmt", "fftw3": "fftw", "fftw3f": "fftw",
    "RANDOM123_INCLUDE_DIR": "random123", "GSL": "gsl", "HDF5": "hdf5", "libzip": "libzip", "pugixml": "pugixml",
    "tomlplusplus": "tomlplusplus", "nlohmann_json": "nlohmann_json|nlohmann-json", "CLI11": "cli11",
    "MPI": None,  # for salebra-mpi alone, which only Spack's recipe makes
}

cmake = (ROOT / "cmake/SalebraDependencies.cmake").read_text()
wanted = re.findall(r"find_package\((\w+)", cmake) + re.findall(r"pkg_check_modules\(.* (\w+)\)", cmake)
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

try:
    import yaml
except ImportError:
    yaml = None
if yaml:
    for file in ("packaging/conda/recipe.yaml", ".github/workflows/build.yml"):
        yaml.safe_load((ROOT / file).read_text())

print("\n".join(faults) or f"{len(wanted)} libraries are named by every recipe")
sys.exit(1 if faults else 0)
