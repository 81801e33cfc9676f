# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user who checks types writes; mypy --strict and pyright must find nothing, and it must run."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import salebra
from salebra import closed_form

if TYPE_CHECKING:
    from mpi4py import MPI
    from salebra import no_such_name  # type: ignore[attr-defined]  # which a check with warn_unused_ignores must need

STUDY = """
[surface]
points = 64
size_x = "1mm"
hurst = 0.8
rolloff = "250um"
short_cutoff = "125um"
rms_height = "1um"
seeds = [1, 2]
[material]
contact_modulus = "1GPa"
poisson = 0.3
[contact]
relative_pressures = "1e-3:0.1:10"
tolerance = 1e-6
[damping]
mode = "drag"
normal_amplitude = "1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
"""


def decay_lengths(surface: salebra.Surface, material: salebra.Material, pressures: npt.NDArray[np.float64]) -> list[float]:
    """Decay length of boundary elements and of Greenwood–Williamson's model."""
    curves: list[salebra.ForceCurve] = [salebra.sweep_pressures(surface, material, pressures, boundary="periodic")]
    model: salebra.AsperityModel = salebra.DeterministicSummits(salebra.find_summits(surface), material, surface.area)
    curves.append(salebra.curve_at_pressures(model, pressures))
    return [salebra.fit_exponential(curve, (float(pressures[0]), float(pressures[-1]))).decay_length for curve in curves]


def mean_gap(grid: salebra.Grid2D, spectrum: salebra.Spectrum, comm: MPI.Intracomm | None) -> float:
    """Of a surface over the processes of a communicator, or of this one alone."""
    surface = salebra.random_phase(grid, spectrum, 1, comm=comm)
    rows: range = surface.rows
    whole: salebra.Surface | None = surface.gather(root=0)
    print(len(rows), whole is not None and whole.nx)
    return salebra.press(surface, 1e9, pressure=1e6).mean_gap


def told(report: salebra.ProgressReport) -> bool:
    return report.fraction <= 1.0


def main() -> None:
    grid = salebra.Grid2D(64, 64, 1e-3, 1e-3)
    spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2.5e-4, short_cutoff=1.25e-4, rms_height=1e-6)
    surface = salebra.filtered_noise(grid, spectrum, seed=1)
    heights: npt.NDArray[np.float64] = surface.heights
    again = salebra.Surface(heights, grid.lx, grid.ly, periodic=True, origin="user")
    material = salebra.Material.of_bodies(salebra.ElasticBody(210e9, 0.3))
    pressures = np.geomspace(1e-3, 1e-1, 8) * material.contact_modulus * again.moments.rms_slope
    print(mean_gap(grid, spectrum, None))
    lengths = decay_lengths(again, material, pressures)

    state = salebra.press(again, material.contact_modulus, pressure=float(pressures[3]), progress=told)
    field: npt.NDArray[np.float64] = state.contact_pressure
    spots = salebra.contact_spots(state)
    stick = salebra.stick_stiffness(field > 0, state.grid, material)
    print(len(spots), stick.xx, state.converged)

    law: salebra.ContactLaw = salebra.ExponentialLaw(0.1, lengths[0], material.modulus_ratio)
    motion = salebra.EqualFrequency(normal_amplitude=1e-9, tangential_amplitude=1e-9, phase=math.pi / 2)
    result = salebra.relaxation_damping(law, motion, force=0.1, hold="force")
    small = closed_form.work_per_cycle(law.modulus_ratio, float(law.force_curvature(0.0)), motion)
    print(result.work_per_cycle / small, Path(__file__).name)

    study: salebra.StudyConfiguration = salebra.parse_study_configuration(STUDY).with_models(["gw_deterministic"])
    study_result: salebra.StudyResult = salebra.run_study(study)
    equal = salebra.fit_exponential(study_result.realisations[0].bem.curve, weights="equal")
    print(study.models, equal.decay_length, study_result.decay_length("gw_deterministic").mean)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "study.h5"
        study_result.write(file)
        reader = salebra.ResultReader(file)
        constants: npt.NDArray[np.float64] = reader["damping/damping_constant"]
        version: float | str = reader.attributes()["version"]
        print(constants.shape, reader.units("damping/damping_constant"), version, "damping" in reader)
        if salebra.can_report():
            salebra.write_report(file, Path(folder) / "study.html", title="A study", direct=[])

    try:
        salebra.read_surface("nowhere.h5")
    except salebra.InvalidInput as error:
        print(error)
    for citation in salebra.citations():
        print(citation.doi or citation.text)


if __name__ == "__main__":
    main()
