# SPDX-License-Identifier: GPL-3.0-or-later
"""wheel.py SURFACE: the README's example with an installed wheel, a report, and where each of its libraries comes from."""

import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import salebra

package = Path(salebra.__file__).resolve().parent
if list(package.glob("_mpi*")):
    sys.exit("the wheel has the module for MPI, which needs a library of the system")
if "site-packages" not in package.parts:
    sys.exit(f"{package} is no installed package")

surface = salebra.read_surface(sys.argv[1]).detrended()
material = salebra.Material(115e9, poisson=0.3)
pressures = np.geomspace(5e-4, 0.2, 12) * material.contact_modulus * surface.moments.rms_slope
curve = salebra.sweep_pressures(surface, material, pressures, tolerance=1e-8)
motion = salebra.Drag(normal_amplitude=1e-9, drag_velocity=1e-3, angular_frequency=2 * math.pi * 20e3)
law = salebra.TabulatedLaw(curve, material.modulus_ratio)
damping = salebra.relaxation_damping(law, motion, force=float(curve.force[6]))
if not damping.converged or not damping.damping_constant > 0:
    sys.exit(f"no damping constant: {damping}")

STUDY = """
[surface]
file = '{surface}'
[material]
contact_modulus = "115GPa"
poisson = 0.3
[contact]
relative_pressures = "5e-4:0.2:8"
[damping]
mode = "drag"
normal_amplitude = "1nm"
drag_velocity = "1um/s"
frequency = "20kHz"
"""
if salebra.can_report():
    result = salebra.run_study(salebra.parse_study_configuration(STUDY.format(surface=Path(sys.argv[1]).resolve())))
    with tempfile.TemporaryDirectory() as folder:
        results, page = Path(folder, "scan.h5"), Path(folder, "scan.html")
        result.write(results)
        salebra.write_report(results, page)
        text = page.read_text()
        if "Plotly" not in text or '<script type="application/json" id="data">{"' not in text:
            sys.exit("the report is no page with figures and numbers")

# The program that the package brings, by both of its names, without a library of the system.
program = Path(sys.prefix, "bin", "salebra")
for command in ([sys.executable, "-m", "salebra"], [program]):
    done = subprocess.run([*command, "statistics", sys.argv[1], "--json"], capture_output=True, text=True)
    if done.returncode != 0 or not math.isclose(json.loads(done.stdout)["rms_height"], salebra.height_statistics(surface).rms_height, rel_tol=1e-9):
        sys.exit(f"{command} statistics ends with {done.returncode}: {done.stderr or done.stdout[:200]}")

# Everything that this process has mapped beside the C library and the interpreter comes from the environment.
allowed = re.compile(r"/(ld-linux|libc|libm|libdl|libpthread|librt|libutil|libresolv|libgcc_s|libstdc\+\+|libz|libpython|libexpat|libffi|libssl|libcrypto"
                     r"|libuuid|liblzma|libbz2|libsqlite|libreadline|libtinfo|libncurses|libnss_\w+|libb2)[-.\d]")  # fmt: skip
mapped = {line.split(maxsplit=5)[5].strip() for line in open("/proc/self/maps") if ".so" in line}
foreign = sorted(
    library for library in mapped
    if not library.startswith(str(Path(sys.prefix).resolve())) and "lib-dynload" not in library and not allowed.search(library)
)  # fmt: skip
if foreign:
    sys.exit(f"libraries that the wheel does not bring: {foreign}")
brought = sorted(Path(library).name for library in mapped if "salebra.libs" in library)
if not any(name.startswith("libgomp") for name in brought):
    sys.exit(f"the wheel brings {brought}, no OpenMP among them")
reports = "a report" if salebra.can_report() else "no report: it was built without plotly.js"
print(f"salebra {salebra.__version__}, Python {sys.version_info.major}.{sys.version_info.minor}: "
      f"damping constant {damping.damping_constant:.4g} N s/m, {reports}; libraries of the wheel: {len(brought)}")  # fmt: skip
