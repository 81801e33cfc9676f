# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of Python over the processes of mpirun: the bits of one process, refusals, stops and failures in one of the processes.

Ends with "N processes agree", or with "skipped: …" where mpi4py is missing. With --alone: one process that starts and ends MPI itself.
With --failing: one process fails outside of salebra, which `python -m mpi4py` makes an end of all.
"""

from __future__ import annotations

import pickle
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

try:
    import mpi4py
except ImportError:
    print(f"skipped: {sys.executable} has no mpi4py; run scripts/test-environment mpi")
    sys.exit(0)
if "--alone" in sys.argv:
    mpi4py.rc.initialize = False
import numpy as np
from mpi4py import MPI

import salebra

ALL = MPI.COMM_WORLD
GRID = salebra.Grid2D(96, 80, 1.2e-3, 1e-3)  # blocks of 16 rows, which three processes cannot share evenly
SPECTRUM = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2.5e-4, short_cutoff=1e-4, rms_height=1e-6)
MATERIAL = salebra.Material(1e9, poisson=0.3)
MOTION = salebra.Drag(normal_amplitude=1e-9, drag_velocity=1e-6, angular_frequency=1e5)


def spread(seed: int = 1) -> salebra.Surface:
    return salebra.filtered_noise(GRID, SPECTRUM, seed, comm=ALL)


def raised(kind: type[BaseException], call: Callable[[], Any]) -> str:
    """The text of the error that the call must end with."""
    try:
        call()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind.__name__}")


def same(mine: Any, whole: Any) -> None:
    """The rows of one process and those of the whole in every bit."""
    assert mine.tobytes() == whole.tobytes(), "other bits"


def test_generators() -> None:
    for make in (salebra.filtered_noise, salebra.random_phase, salebra.exact_rms):
        mine, whole = make(GRID, SPECTRUM, 3, comm=ALL), make(GRID, SPECTRUM, 3)
        assert mine.grid == whole.grid
        assert [row for rows in ALL.allgather(mine.rows) for row in rows] == list(range(GRID.nx))
        assert mine.heights.shape == (len(mine.rows), GRID.ny)
        same(mine.heights, whole.heights[mine.rows])
        same(np.asarray(mine), mine.heights)
    same(salebra.scale_to_rms(mine, "slope", 0.1).heights, salebra.scale_to_rms(whole, "slope", 0.1).heights[mine.rows])
    assert salebra.height_statistics(mine) == salebra.height_statistics(whole)
    for method in ("mean", "plane"):
        same(mine.detrended(method).heights, whole.detrended(method).heights[mine.rows])
    assert salebra.difference_moments(mine) == salebra.difference_moments(whole)
    assert salebra.spectral_moments(mine) == salebra.spectral_moments(whole)
    assert salebra.profile_psd(mine) == salebra.profile_psd(whole)
    part, spectrum = salebra.power_spectrum(mine), salebra.power_spectrum(whole)
    assert ALL.allreduce(len(part.wavenumber_y)) == len(spectrum.wavenumber_y)
    columns = np.isin(spectrum.wavenumber_y, part.wavenumber_y)
    assert np.array_equal(part.psd, spectrum.psd[:, columns])
    assert salebra.radial_spectrum(part) == salebra.radial_spectrum(spectrum)
    own, summits = salebra.find_summits(mine), salebra.find_summits(whole)
    assert [x for rows in ALL.allgather(own.x.tolist()) for x in rows] == summits.x.tolist()
    assert salebra.summit_statistics(own) == salebra.summit_statistics(summits)


def test_gather() -> None:
    whole, mine = salebra.filtered_noise(GRID, SPECTRUM, 1), spread()
    state = salebra.press(mine, MATERIAL, pressure="1 MPa")
    for root in (0, ALL.size - 1):
        surface, contact = mine.gather(root), state.gather(root)
        assert (surface is None) == (contact is None) == (ALL.rank != root)
        if surface is not None and contact is not None:
            assert surface == whole and surface.rows == range(GRID.nx)
            assert contact == salebra.press(whole, MATERIAL, pressure="1 MPa")
    assert whole.gather() is whole
    assert "root" in raised(salebra.InvalidInput, lambda: mine.gather(ALL.size))


def test_contacts() -> None:
    whole, mine = salebra.filtered_noise(GRID, SPECTRUM, 1), spread()
    force = 1e6 * GRID.lx * GRID.ly
    for target in ({"pressure": 1e6}, {"force": force}, {"mean_gap": 1.5e-6}, {"indentation": 1e-6}):
        one, part = salebra.press(whole, MATERIAL, **target), salebra.press(mine, MATERIAL, **target)
        assert part.converged and part.rows == mine.rows
        for name in ("force", "mean_gap", "indentation", "contact_area_fraction", "elastic_energy", "iterations", "fft_count"):
            assert getattr(part, name) == getattr(one, name), name
        same(part.contact_pressure, one.contact_pressure[part.rows])
        same(part.gap, one.gap[part.rows])
        spots = salebra.contact_spots(one)
        assert len(spots) > 0 and salebra.contact_spots(part) == spots
    assert salebra.normal_stiffness(part) == salebra.normal_stiffness(one)
    contact = part.contact_pressure > 0
    assert salebra.stick_stiffness(contact, GRID, MATERIAL, comm=ALL) == salebra.stick_stiffness(one.contact_pressure > 0, GRID, MATERIAL)
    again = salebra.press(mine, MATERIAL, indentation=1e-6, initial_pressure=part.contact_pressure)
    assert again.iterations < part.iterations
    pressures = [3e5, 1e6]
    curve = salebra.sweep_pressures(mine, MATERIAL, pressures, stick=True)
    assert curve == salebra.sweep_pressures(whole, MATERIAL, pressures, stick=True)
    assert salebra.surface_damping(mine, MATERIAL, MOTION, curve) == salebra.surface_damping(whole, MATERIAL, MOTION, curve)


def test_files() -> None:
    folder = Path(ALL.bcast(tempfile.mkdtemp() if ALL.rank == 0 else None))
    mine = spread()
    salebra.write_surface(folder / "rough.h5", mine)
    whole = salebra.read_surface(folder / "rough.h5")
    same(mine.heights, whole.heights[mine.rows])
    again = salebra.read_surface(folder / "rough.h5", comm=ALL)
    assert again.rows == mine.rows and again.grid == GRID and again.periodic
    same(again.heights, mine.heights)
    if ALL.rank == 0:
        salebra.write_surface(folder / "rough.npy", whole)
    ALL.Barrier()
    same(salebra.read_surface(folder / "rough.npy", comm=ALL).heights, mine.heights)
    assert "needs it whole" in raised(salebra.InvalidInput, lambda: salebra.write_surface(folder / "other.npy", mine))
    raised(salebra.MissingFile, lambda: salebra.read_surface(folder / "none.h5", comm=ALL))
    ALL.Barrier()
    if ALL.rank == 0:
        for file in folder.iterdir():
            file.unlink()
        folder.rmdir()


def test_refusals() -> None:
    mine = spread()
    state = salebra.press(mine, MATERIAL, pressure=1e6)
    summits, spectrum = salebra.find_summits(mine), salebra.power_spectrum(mine)
    calls: list[Callable[[], Any]] = [
        lambda: salebra.BearingCurve(mine),
        lambda: salebra.after_first_loading(mine, MATERIAL, 1e6, hardness=1e8),
        lambda: salebra.boundary_element_contact_sets(mine, MATERIAL),
        lambda: salebra.composite_surface(mine, mine),
        lambda: salebra.correlation_map(mine),
        lambda: salebra.crop_surface(mine, 0, 0, 8, 8),
        lambda: salebra.detrended(mine, "lines"),
        lambda: salebra.significant_peaks(mine, 1e-7),
        lambda: salebra.simulate_coupled_cycle(mine, MATERIAL, MOTION, 1e-6, friction_coefficient=0.3),
        lambda: salebra.simulate_frictional_cycle(mine, MATERIAL, MOTION, 1e-6, friction_coefficient=0.3),
        lambda: salebra.simulated_joint_loss(mine, MATERIAL, 1e-6, friction_coefficient=0.3, tangential_amplitude=1e-9),
        lambda: mine.filled(),
        lambda: mine.height_statistics,
        lambda: mine.moments,
        lambda: mine.plot(),
        lambda: state.plot(),
        lambda: mine.to_topography(),
        lambda: mine.to_xarray(),
        lambda: state.to_xarray(),
        lambda: salebra.asperity_damping(summits, MATERIAL, 1e-6, MOTION),
        lambda: salebra.DeterministicSummits(summits, MATERIAL, 1e-6),
        lambda: salebra.InteractingSummits(summits, MATERIAL, GRID),
        lambda: summits.plot(),
        lambda: spectrum.plot(),
        lambda: spectrum.to_xarray(),
        lambda: pickle.dumps(summits),
        lambda: pickle.dumps(spectrum),
        lambda: pickle.dumps(mine),
        lambda: pickle.dumps(state),
    ]
    for number, call in enumerate(calls):
        text = raised(salebra.InvalidInput, call)
        assert f"is spread over {ALL.size} processes" in text and "gather it" in text, f"call {number}: {text}"
    assert "1.2 mm" in repr(mine) and "NormalContactState" in repr(state)
    assert ALL.rank == 0 or "<table>" in mine._repr_html_()  # no call of all processes
    raised(salebra.InvalidInput, lambda: salebra.stick_stiffness(state.contact_pressure > 0, GRID, MATERIAL))
    mine.heights[0, 0] = np.nan if ALL.rank == ALL.size - 1 else 0
    assert "undefined points" in raised(salebra.InvalidInput, lambda: salebra.press(mine, MATERIAL, pressure=1e6))


def test_communicators() -> None:
    generate: Any = salebra.filtered_noise
    assert "comm" in raised(TypeError, lambda: generate(GRID, SPECTRUM, 1, comm=3))
    assert "COMM_NULL" in raised(salebra.InvalidInput, lambda: generate(GRID, SPECTRUM, 1, comm=MPI.COMM_NULL))
    other = ALL.Dup()
    library = MPI.Get_library_version
    try:
        if ALL.rank == 0:  # another library in one process ends all of them
            MPI.Get_library_version = lambda: "MPICH Version: 5.0"  # type: ignore[assignment]
        assert "two MPI libraries, MPICH Version: 5.0 and" in raised(salebra.InvalidInput, lambda: generate(GRID, SPECTRUM, 1, comm=other))
    finally:
        MPI.Get_library_version = library
    # Groups at work on surfaces of their own, which outlive their communicator.
    for _ in range(3):
        group = ALL.Split(ALL.rank % 2, -ALL.rank)
        mine = salebra.filtered_noise(GRID, SPECTRUM, ALL.rank % 2, comm=group)
        group.Free()
    whole = mine.gather()
    assert whole is None or whole == salebra.filtered_noise(GRID, SPECTRUM, ALL.rank % 2)
    other.Free()


def test_stops() -> None:
    """What one process is told to stop, all of them stop, and the next call finds all of them."""
    mine = spread()
    last = ALL.rank == ALL.size - 1

    def stop(_: salebra.ProgressReport) -> bool:
        return not last

    def fail(_: salebra.ProgressReport) -> None:
        if last:
            raise KeyError("mine")

    def interrupt(_: salebra.ProgressReport) -> None:
        if last:
            signal.raise_signal(signal.SIGINT)

    calls: list[Callable[[Any], Any]] = [
        lambda told: salebra.filtered_noise(GRID, SPECTRUM, 1, comm=ALL, progress=told),
        lambda told: salebra.exact_rms(GRID, SPECTRUM, 1, comm=ALL, progress=told),
        lambda told: salebra.press(mine, MATERIAL, pressure=1e6, progress=told),
        lambda told: salebra.sweep_pressures(mine, MATERIAL, [1e5, 1e6], progress=told),
    ]
    for number, call in enumerate(calls):
        if number < 2:
            raised(salebra.Interrupted, lambda: call(stop))
        elif number == 2:
            assert call(stop).termination == "interrupted"
        else:
            assert len(call(stop)) == 0
        raised(KeyError if last else salebra.Interrupted, lambda: call(fail))
        raised(KeyboardInterrupt if last else salebra.Interrupted, lambda: call(interrupt))
    # At the end of the work, where nobody asks any more: a function that is told once.
    state = salebra.press(mine, MATERIAL, pressure=1e6)
    raised(KeyError if last else salebra.Interrupted, lambda: salebra.normal_stiffness(state, progress=fail))
    assert salebra.press(mine, MATERIAL, pressure=1e6) == state


def test_other_threads_run() -> None:
    """A process that waits for another one lets its Python threads run."""
    counted, done = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.wait(0.005):
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    time.sleep(0.3 if ALL.rank == 0 else 0)
    before = counted
    spread()
    after = counted
    done.set()
    thread.join()
    # 60 turns fit into the wait; a process that kept the lock has one at most.
    assert ALL.rank == 0 or after - before >= 5, f"{after - before} turns of another thread"


def start_and_end() -> None:
    assert "MPI.Init_thread()" in raised(salebra.InvalidInput, spread)
    MPI.Init_thread()
    mine = spread()
    assert mine == salebra.filtered_noise(GRID, SPECTRUM, 1)
    MPI.Finalize()
    assert "MPI.Init_thread()" in raised(salebra.InvalidInput, spread)
    print("1 process agrees")


def main() -> None:
    if "--alone" in sys.argv:
        return start_and_end()
    if "--failing" in sys.argv and spread() is not None and ALL.rank == 1:
        raise KeyError("a failure of the user's")
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            start = time.perf_counter()
            test()
            if "--times" in sys.argv and ALL.rank == 0:
                print(f"{name} {time.perf_counter() - start:.2f} s")
    ALL.Barrier()
    if ALL.rank == 0:
        print(f"{ALL.size} processes agree")


if __name__ == "__main__":
    main()
