# SPDX-License-Identifier: GPL-3.0-or-later
"""What a session lives on: errors, threads, interruption, progress, the names of the package."""

from __future__ import annotations

import inspect
import os
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
import types
from pathlib import Path

import numpy as np
import pytest

import salebra
from conftest import generated
from salebra import _core, _processes


def test_errors_are_those_that_python_users_catch() -> None:
    assert issubclass(salebra.InvalidInput, (salebra.Error, ValueError))
    assert issubclass(salebra.InvalidInput, ValueError) and issubclass(salebra.InvalidInput, salebra.Error)
    assert issubclass(salebra.IoError, OSError) and issubclass(salebra.IoError, salebra.Error)
    assert issubclass(salebra.NotConverged, RuntimeError) and issubclass(salebra.NotConverged, salebra.Error)
    with pytest.raises(ValueError, match="pressure: -1 must be"):
        salebra.press(generated(), 1e9, pressure=-1.0)
    for target in ({}, {"pressure": 1e5, "force": 1.0}):
        with pytest.raises(ValueError, match="exactly one of `pressure`, `mean_gap`, `indentation` and `force`"):
            salebra.press(generated(), 1e9, **target)
    with pytest.raises(ValueError, match=r"\\x1b\[31mred"):
        salebra.read_surface("\x1b[31mred")
    with pytest.raises(ValueError, match="no-such-file"):
        salebra.read_surface("no-such-file.h5")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no full disk at hand")
def test_a_write_that_the_system_refuses_is_an_oserror(tmp_path: os.PathLike[str]) -> None:
    with pytest.raises((OSError, ValueError)):
        salebra.write_surface("/proc/salebra.h5", generated())


def test_threads_sleep_while_they_wait_unless_the_user_wants_otherwise() -> None:
    # OpenMP itself tells how often its threads look before they sleep. (Its OMP_WAIT_POLICY says PASSIVE where nothing was chosen, too.)
    script = "import os, salebra; print(os.environ.get('OMP_WAIT_POLICY'), os.environ.get('GOMP_SPINCOUNT'))"
    clean = {key: value for key, value in os.environ.items() if key not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")}
    choices: list[tuple[dict[str, str], str]] = [
        ({}, "1000"), ({"OMP_WAIT_POLICY": "passive"}, "0"), ({"GOMP_SPINCOUNT": "77"}, "77")]
    for chosen, found in choices:
        run = subprocess.run(
            [sys.executable, "-c", script], env={**clean, **chosen, "OMP_DISPLAY_ENV": "verbose"},
            capture_output=True, text=True, check=True)
        assert re.search(f"GOMP_SPINCOUNT = '{found}'", run.stderr), run.stderr
        assert run.stdout.split() == [str(chosen.get("OMP_WAIT_POLICY")), str(chosen.get("GOMP_SPINCOUNT"))]


FORKS = """
import multiprocessing
import salebra

salebra.set_threads(2)
grid = salebra.Grid2D(256, 256, 1e-3, 1e-3)  # enough points for two threads
spectrum = salebra.SelfAffineSpectrum(rolloff=2.5e-4, short_cutoff=1e-4, rms_height=1e-6)

def area(seed):
    return salebra.press(salebra.random_phase(grid, spectrum, seed), 1e9, pressure=1e6).contact_area_fraction

def refusal(threads):
    try:
        salebra.set_threads(threads)
    except salebra.InvalidInput as error:
        return str(error)

alone = [area(1), area(2)]
with multiprocessing.get_context("fork").Pool(2) as pool:
    print(pool.map(area, [1, 2]) == alone)
    print(pool.map(refusal, [2])[0])
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_pool_that_forks_after_a_call_computes_and_gives_the_same_bits() -> None:
    done = subprocess.run([sys.executable, "-c", FORKS], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == ["True", "threads: 2 must be 1 in a forked process; use the start method spawn for more"]


def test_other_threads_run_during_a_solve() -> None:
    surface = generated(1024, rms_height=1e-6)
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        time.sleep(0.05)
        before = counted
        start = time.perf_counter()
        salebra.press(surface, 1e9, pressure=1e6)
        seconds = time.perf_counter() - start
        during = counted - before
    finally:
        stop.set()
        thread.join()
    # A thread that had to wait for the solve would count a few; one in ten milliseconds is far below what it counts.
    assert during > max(3.0, seconds / 1e-2 * 0.1)


def test_ctrl_c_stops_a_solve_within_a_second() -> None:
    program = textwrap.dedent(
        """
        import threading, time, os, signal
        import salebra
        grid = salebra.Grid2D(1024, 1024, 1e-3, 1e-3)
        spectrum = salebra.SelfAffineSpectrum(rolloff=2.5e-4, short_cutoff=4 * grid.dx, rms_height=1e-6)
        surface = salebra.random_phase(grid, spectrum, 1)
        sent = []
        def interrupt():
            time.sleep(0.3)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt, daemon=True).start()
        try:
            for k in range(10000):
                salebra.sweep_pressures(surface, salebra.Material(1e9, poisson=0.3), [1e6 * 1.1**i for i in range(20)])
        except KeyboardInterrupt:
            print(time.perf_counter() - sent[0])
        """
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    # A second on a machine of one's own; a busy one gets three.
    assert float(done.stdout) < 3.0


LONG = {
    "filtered_noise": "salebra.filtered_noise(salebra.Grid2D(6144, 6144, 1e-3, 1e-3), spectrum(6144), 1, progress=tell)",
    "non_gaussian": """salebra.non_gaussian(salebra.Grid2D(2048, 2048, 1e-3, 1e-3), spectrum(2048), salebra.weibull_heights(2.0), 1,
        tolerance=0.0, progress=tell)""",
    "curve_at_pressures": "salebra.curve_at_pressures(interacting(), [1e4 * 1.1**k for k in range(100)], progress=tell)",
    "at": "[model.at(0.0) for model in [interacting()] for k in range(1000000)]",
    # What reports no progress, or none within an item.
    "damping_curve": "salebra.damping_curve(law, [salebra.Drag(normal_amplitude=1e-9, drag_velocity=1e-3, angular_frequency=1e5)] * 300000, force=1.0)",
    "assumptions_of": "[salebra.damping_curve(law, [motion], force=1.0)[0].assumptions for k in range(1000000)]",
    "regime_map": "salebra.regime_map(law, 0.0, 1e-9, 1e5, [k * 1e-6 for k in range(1, 4000)], [k * 1e-9 for k in range(1, 4000)], friction_coefficient=0.3)",
    "monte_carlo_curve": "salebra.monte_carlo_curve(ensemble, material, 1e-6, [1e-8 * k for k in range(20)], realisations=100000)",
    "curve_at_separations": "salebra.curve_at_separations(deterministic, [1e-12 * k - 1e-7 for k in range(60000)])",
    "fit of a twin": "twin.fit(draws=1000000)",
    "trajectory_damping": "salebra.trajectory_damping(law, salebra.sample(motion, 0.0, 2000000), friction_coefficient=0.3)",
    "joint_loss": """salebra.joint_loss(law, friction_coefficient=0.3, tangential_amplitude=1e-8, force=1.0, normal_amplitude=1e-8,
        steps=2000000)""",
    "threshold_amplitude": """salebra.threshold_amplitude(law, slider, friction_coefficient=0.3, angular_frequency=1.2e5, max_amplitude=2e-8,
        force=0.02, steps=100000)""",
    "viscoelastic_damping": "salebra.viscoelastic_damping(indenter, prony, salebra.sample(motion, 5e-7, 20000))",
    "areal_parameters": "salebra.areal_parameters(salebra.Surface(numpy.random.default_rng(0).normal(size=(3072, 3072)) * 1e-9, 1e-3, 1e-3))",
}


@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_leaves_whatever_takes_long(name: str) -> None:
    program = (
        textwrap.dedent(
            """
            import os, signal, threading, time
            import salebra

            def spectrum(points):
                return salebra.SelfAffineSpectrum(rolloff=2.5e-4, short_cutoff=2e-3 / points, rms_height=1e-6)

            def interacting():
                ensemble = salebra.SummitEnsemble(summit_density=5e10, radius=1e-6, summit_rms=1e-7)
                summits = salebra.draw_summits(ensemble, 50000, 1e-3, 1)
                grid = salebra.Grid2D(4, 4, 1e-3, 1e-3)
                return salebra.InteractingSummits(summits, salebra.Material(1e11, poisson=0.3), grid)

            import numpy
            law = salebra.ExponentialLaw(1.0, 1e-7, 0.8)
            motion = salebra.EqualFrequency(normal_amplitude=1e-8, tangential_amplitude=1e-7, phase=1.0, angular_frequency=1e3)
            material = salebra.Material(1e11, poisson=0.3)
            ensemble = salebra.SummitEnsemble(summit_density=5e10, radius=1e-6, summit_rms=1e-7)
            deterministic = salebra.DeterministicSummits(salebra.draw_summits(ensemble, 50000, 1e-3, 1), material, 1e-6)
            slider = salebra.Slider(mass=0.01, spring_stiffness=1e3, velocity=5e-5, falling_slope=1.0)
            indenter = salebra.IndenterLaw(salebra.sphere_profile(1e-2), salebra.Material(1e6, poisson=0.3))
            prony = salebra.PronySeries(1e6, [(1e6, 1e-3), (1e6, 1e-2)])
            scan = salebra.random_phase(
                salebra.Grid2D(128, 128, 1e-4, 1e-4),
                salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2e-5, short_cutoff=3e-6, rms_height=2e-7), 1)
            twin = salebra.SurfaceTwin([salebra.scan_spectrum(scan, "ideal")])

            fractions = [0.0]
            def tell(report):
                fractions.append(report.fraction)

            sent = []
            def interrupt():
                time.sleep(0.3)
                sent.append(time.process_time())
                os.kill(os.getpid(), signal.SIGINT)

            salebra.set_threads(1)
            threading.Thread(target=interrupt, daemon=True).start()
            try:
            """
        )
        + f"    {LONG[name]}\n"
        + "except KeyboardInterrupt:\n    print(time.process_time() - sent[0], fractions[-1])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    seconds, fraction = map(float, done.stdout.split())
    # Processor time is measured, so that a busy machine does not matter. What had ended would have told all of it.
    assert seconds < 1.0
    assert fraction < 0.95


@pytest.mark.parametrize("name", ["filtered_noise", "random_phase", "exact_rms"])
def test_a_progress_function_stops_a_generator(name: str) -> None:
    grid = salebra.Grid2D(64, 64, 1e-3, 1e-3)
    spectrum = salebra.SelfAffineSpectrum(rolloff=2.5e-4, short_cutoff=1.25e-4, rms_height=1e-6)
    stages: list[str] = []

    def stop(report: salebra.ProgressReport) -> bool:
        stages.append(report.stage)
        return False

    with pytest.raises(salebra.Interrupted, match="surface: interrupted"):
        getattr(salebra, name)(grid, spectrum, 1, progress=stop)
    for sums in (lambda: salebra.forecast(grid, spectrum, progress=stop), lambda: spectrum.lattice_moments(grid, progress=stop)):
        with pytest.raises(salebra.Interrupted):
            sums()
    assert stages == ["surface", "moments", "moments"]
    # A Python function as the spectrum is called by the threads of the library, which must not wait for each other.
    density = salebra.FunctionSpectrum(spectrum.radial_density, 2e4, 5e4)
    assert salebra.forecast(grid, density).lattice.rms_height > 0


def test_progress_tells_and_may_stop() -> None:
    surface = generated(512)
    reports: list[salebra.ProgressReport] = []

    def stop(report: salebra.ProgressReport) -> bool:
        reports.append(report)
        return False

    state = salebra.press(surface, 1e9, pressure=1e6, tolerance=1e-13, progress=stop)
    assert reports and reports[0].stage
    assert state.termination == "interrupted" and not state.converged


def test_an_error_in_a_progress_function_is_raised() -> None:
    def fail(report: salebra.ProgressReport) -> None:
        raise LookupError("from the user")

    with pytest.raises(LookupError, match="from the user"):
        salebra.press(generated(512), 1e9, pressure=1e6, progress=fail)


def test_tqdm_shows_the_progress(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    state = salebra.press(generated(512), 1e9, pressure=1e6, progress=True)
    assert state.converged
    assert "%" in capsys.readouterr().err


def test_a_build_without_mpi_says_what_spreads_a_surface(monkeypatch: pytest.MonkeyPatch) -> None:
    comm = types.SimpleNamespace(py2f=int, Is_inter=bool, Get_attr=lambda key: None, allgather=lambda text: [text])
    mpi = types.SimpleNamespace(
        Is_initialized=lambda: True, Is_finalized=lambda: False, COMM_NULL=None, Comm=types.SimpleNamespace(Create_keyval=int)
    )
    monkeypatch.setitem(sys.modules, "mpi4py.MPI", mpi)
    monkeypatch.setitem(sys.modules, "salebra._mpi", None)
    monkeypatch.setattr(_processes, "_key", None)
    grid, spectrum = salebra.Grid2D(64, 64, 1e-3, 1e-3), salebra.SelfAffineSpectrum(rolloff=2e-4, short_cutoff=1e-4, rms_height=1e-6)
    with pytest.raises(salebra.InvalidInput, match="^comm: .* built without MPI; build it with -D SALEBRA_BUILD_MPI=ON") as refusal:
        salebra.filtered_noise(grid, spectrum, 1, comm=comm)  # type: ignore[arg-type, unused-ignore]
    assert refusal.value.field == "comm"
    with pytest.raises(TypeError, match="comm: wanted a communicator of mpi4py, got 4"):
        salebra.filtered_noise(grid, spectrum, 1, comm=4)  # type: ignore[arg-type, unused-ignore]
    whole = salebra.filtered_noise(grid, spectrum, 1, comm=None)
    assert whole.rows == range(64) and whole.gather() is whole
    state = salebra.press(whole, 1e9, pressure=1e6)
    assert state.rows == range(64) and state.gather() is state


def test_citations_name_what_was_used_with_doi() -> None:
    _core._forget_citations()
    assert [citation.key for citation in salebra.citations()] == ["salebra"]
    salebra.persson_area_fraction(1.0, 1e9, 0.1)
    assert "10.1063/1.1388626" in str(salebra.citations()[-1])
    # Every key that the library may cite has an entry.
    sources = [path.read_text() for path in (salebra_sources() or []) if path.suffix == ".cpp"]
    from salebra._citations import _ALL

    import re

    for source in sources:
        for call in re.findall(r"cite\(\{([^}]*)\}\)", source):
            for key in re.findall(r'"(\w+)"', call):
                assert key in _ALL


def salebra_sources() -> list[object]:
    from conftest import ROOT

    return list((ROOT / "python" / "src").glob("*.cpp"))


def test_the_package_has_all_names_of_the_library_with_docstrings() -> None:
    public = {name for name in dir(_core) if not name.startswith("_")}
    names = {name for name in vars(salebra) if not name.startswith("_")}
    assert public | {"Citation", "citations", "closed_form"} <= names
    for name in names:
        assert inspect.getdoc(getattr(salebra, name)), name
    for name in salebra.closed_form.__all__:
        assert inspect.getdoc(getattr(salebra.closed_form, name)), name


def test_the_version_is_that_of_the_library() -> None:
    assert salebra.__version__ == salebra.version()


def test_results_become_datasets_with_units(surface: salebra.Surface, material: salebra.Material) -> None:
    pytest.importorskip("xarray")
    curve = salebra.sweep_pressures(surface, material, np.geomspace(1e5, 1e6, 4))
    data = curve.to_xarray()
    assert data.mean_gap.attrs["units"] == "m"
    assert data.pressure.attrs["units"] == "Pa"
    assert np.array_equal(data.mean_gap, curve.mean_gap)
    state = salebra.press(surface, 1e9, pressure=1e5)
    fields = state.to_xarray()
    assert fields.contact_pressure.dims == ("x", "y")
    assert float(fields.x[1]) == surface.grid.dx
    results = [
        surface, salebra.power_spectrum(surface), salebra.radial_spectrum(salebra.power_spectrum(surface)),
        salebra.profile_psd(surface), salebra.radial_correlation(salebra.correlation_map(surface)),
        salebra.scale_dependence(surface), salebra.height_histogram(salebra.BearingCurve(surface)),
        salebra.local_decay_length(curve),
    ]  # fmt: skip
    for result in results:
        for variable in result.to_xarray().variables.values():
            assert variable.attrs["units"] and variable.attrs["long_name"]


def test_pictures_have_labels_with_units(surface: salebra.Surface, material: salebra.Material) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    curve = salebra.sweep_pressures(surface, material, np.geomspace(1e5, 1e6, 4))
    axes = curve.plot()
    axes.figure.canvas.draw()
    assert axes.get_xlabel() == "mean gap ū (µm)"
    # The data are in metres; the ticks are in the unit of the label.
    assert axes.get_xlim()[1] < 1e-3
    assert all(abs(float(text.get_text().replace("−", "-"))) < 1000 for text in axes.get_xticklabels() if text.get_text())
    assert axes.get_yscale() == "log"
    law = salebra.IndenterLaw(salebra.paraboloid_profile(1e-2), material)
    motion = salebra.EqualFrequency(normal_amplitude=1e-7, tangential_amplitude=1e-7, phase=1.5)
    stresses = salebra.stress_map(law, 1e-6, motion, phases=16, radii=32)
    drawn = [surface, salebra.press(surface, 1e9, pressure=1e5), stresses, salebra.profile_psd(surface)]
    for result in drawn:
        assert result.plot().get_xlabel()


def test_curves_on_one_pair_of_axes_have_one_scale() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    # A thousand times apart: each would get a prefix of its own.
    small, large = (salebra.Surface(generated().heights * factor, 1e-3, 1e-3) for factor in (1e-3, 1.0))
    axes = salebra.height_histogram(salebra.BearingCurve(small)).plot()
    assert salebra.height_histogram(salebra.BearingCurve(large)).plot(ax=axes) is axes
    for surface, line in zip((small, large), axes.get_lines()):
        heights = np.asarray(line.get_xdata())
        # The classes cover the heights.
        assert np.ptp(heights) == pytest.approx(np.ptp(surface.heights), rel=0.1)
    curve = salebra.ForceCurve(pressure=[1e5, 2e5, 4e5], mean_gap=[3e-6, 2e-6, 1e-6], nominal_area=1e-6)
    drawn = curve.plot(fit=False).get_lines()[0]
    assert np.array_equal(drawn.get_xdata(), curve.mean_gap) and np.array_equal(drawn.get_ydata(), curve.pressure)


def test_tension_is_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    curve = salebra.ForceCurve(pressure=[-2e5, -1e5, 1e5], mean_gap=[3e-6, 2e-6, 1e-6], nominal_area=1e-6)
    axes = curve.plot()
    assert axes.get_yscale() == "linear"
    assert axes.get_ylim()[0] < -2e5


def test_the_array_of_a_dataset_remembers_that_the_surface_repeats_itself() -> None:
    pytest.importorskip("xarray")
    surface = generated()
    heights = surface.to_xarray().heights
    assert salebra.Surface(heights).periodic and not salebra.Surface(heights, periodic=False).periodic
    assert not salebra.Surface(heights.isel(x=slice(0, 20))).periodic
    assert not salebra.Surface(salebra.Surface(surface.heights, 1e-3, 1e-3).to_xarray().heights).periodic


def test_help_shows_no_annotation_where_there_is_none() -> None:
    assert "inspect" not in str(inspect.signature(salebra.ContactLaw.force))


def test_equal_objects_have_equal_hashes() -> None:
    def laws() -> list[object]:
        curve = salebra.ForceCurve(pressure=[1e5, 2e5, 4e5, 8e5], mean_gap=[4e-6, 3e-6, 2e-6, 1e-6], nominal_area=1e-6)
        return [
            salebra.ExponentialLaw(1.0, 1e-7, 0.8), salebra.TabulatedLaw(curve, 0.8), salebra.paraboloid_profile(1e-2),
            salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2e-5, short_cutoff=3e-6, rms_height=2e-7),
            salebra.TabulatedProfile(np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 2), salebra.Material(1e9, poisson=0.3),
        ]  # fmt: skip

    for one, other in zip(laws(), laws()):
        assert one == other and hash(one) == hash(other), one
    assert len({salebra.ExponentialLaw(1.0, length, 0.8) for length in (1e-7, 2e-7)}) == 2


def test_a_signal_handler_of_the_user_runs_during_a_solve() -> None:
    surface = generated(2048)  # a solve of several of the tenths of a second after which it looks for signals
    called: list[float] = []
    before = signal.signal(signal.SIGALRM, lambda number, frame: called.append(time.perf_counter()))
    start = time.perf_counter()
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        salebra.press(surface, 1e9, pressure=1e6, tolerance=1e-13)
    finally:
        end = time.perf_counter()
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    # Python runs a handler that had to wait right after the solve, which is its very end.
    assert called and called[0] - start < 0.9 * (end - start)


def test_the_package_runs_the_program_that_lies_in_it() -> None:
    if not (Path(salebra.__file__).parent / "_program" / "salebra").exists():
        pytest.skip("the package was built without the program")
    done = subprocess.run([sys.executable, "-m", "salebra", "--version"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, f"salebra {salebra.version()}\n")
    refused = subprocess.run([sys.executable, "-m", "salebra", "statistics", "absent.h5"], capture_output=True, text=True)
    assert refused.returncode == 2 and refused.stderr.startswith("salebra: error: absent.h5")
