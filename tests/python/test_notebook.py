# SPDX-License-Identifier: GPL-3.0-or-later
"""What a notebook asks of objects and calls: pickle, copy, ==, repr, signatures, texts with units, errors that help."""

from __future__ import annotations

import copy
import errno
import inspect
import math
import pickle
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import salebra
from conftest import STUDY, generated
from salebra import _core, _show

GRID = salebra.Grid2D(32, 32, 1e-3, 1e-3)
MATERIAL = salebra.Material(1e9, poisson=0.3)
DRAG = salebra.Drag(normal_amplitude=1e-9, drag_velocity=1e-3, angular_frequency=1e5)
EQUAL = salebra.EqualFrequency(normal_amplitude=1e-7, tangential_amplitude=1e-7, phase=1.5)


def makers() -> dict[str, Callable[[], Any]]:
    """A maker of an object of every class that a session can hold."""
    surface = generated(32)
    pressures = np.geomspace(1e5, 5e6, 8)
    curve = salebra.sweep_pressures(surface, MATERIAL, pressures)
    state = salebra.press(surface, MATERIAL, pressure=1e6)
    spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=2.5e-4, short_cutoff=1.25e-4, rms_height=1e-6)
    summits = salebra.find_summits(surface)
    ensemble = salebra.SummitEnsemble(summit_density=1e9, radius=1e-5, summit_rms=1e-7)
    model = salebra.StatisticalSummits(ensemble, MATERIAL, 1e-6)
    law = salebra.IndenterLaw(salebra.paraboloid_profile(1e-2), MATERIAL)
    contact = state.contact_pressure > 0
    free = salebra.paraboloid_surface(GRID, 10e-3, salebra.off_grid_center(GRID))
    prony = salebra.PronySeries.of_body(MATERIAL, [(1e9, 1e-4)])
    slider = salebra.Slider(mass=1.0, spring_stiffness=1e7, velocity=1e-3, support_damping=9.0, falling_slope=10.0)
    levels = salebra.boundary_element_contact_sets(free, MATERIAL, boundary="free", tolerance=1e-8)
    study = salebra.run_study(salebra.parse_study_configuration(STUDY))
    psd = salebra.power_spectrum(surface)
    shells = salebra.roughness_shells(spectrum, 1e4, 1e5, 20)
    law_of_curve = salebra.TabulatedLaw(curve, MATERIAL.modulus_ratio)
    return {
        "AnisotropicSpectrum": lambda: salebra.AnisotropicSpectrum(spectrum, salebra.Anisotropy(along=2.0, angle=0.3)),
        "Anisotropy": lambda: salebra.Anisotropy(along=2.0, angle=0.3),
        "ArealParameters": lambda: salebra.areal_parameters(surface),
        "AsperityContact": lambda: model.at(1e-7),
        "AsperityDamping": lambda: salebra.asperity_damping(summits, MATERIAL, 0.0, DRAG),
        "BearingCurve": lambda: salebra.BearingCurve(surface),
        "Check": lambda: salebra.verify_installation()[0],
        "ContactSetAt": lambda: levels(2e-5),
        "ContactSets": lambda: levels,
        "ContactParameters": lambda: salebra.ContactParameters(friction_coefficient=0.3, hardness=7e9),
        "ContactSpots": lambda: salebra.contact_spots(state),
        "ConvertedPsd": lambda: salebra.converted(salebra.radial_spectrum(psd), surface.grid, "tamaas"),
        "CoreParameters": lambda: salebra.core_parameters(salebra.BearingCurve(surface)),
        "Correlation": lambda: salebra.radial_correlation(salebra.correlation_map(surface)),
        "CorrelationMap": lambda: salebra.correlation_map(surface),
        "CycleResult": lambda: salebra.simulate_cycle(
            levels, MATERIAL, salebra.EqualFrequency(normal_amplitude=4e-6, tangential_amplitude=1e-6, phase=1.5), 2e-5, steps=8, boundary="free", tolerance=1e-4),
        "DamperMap": lambda: salebra.damper_map(law, [1e-9, 2e-9], [1e4, 1e5], force=1.0),
        "DampingCurve": lambda: salebra.damping_curve(law, [DRAG], indentation=[1e-6, 2e-6]),
        "DampingPoint": lambda: study.realisations[0].bem.damping[0],
        "DampingPointCurve": lambda: study.realisations[0].bem.damping,
        "DampingResult": lambda: salebra.relaxation_damping(law, DRAG, indentation=1e-6),
        "DeterministicSummits": lambda: salebra.DeterministicSummits(summits, MATERIAL, 1e-6),
        "Drag": lambda: DRAG,
        "ElasticBody": lambda: salebra.ElasticBody(210e9, 0.3),
        "EnsembleMean": lambda: study.decay_length(),
        "EqualFrequency": lambda: EQUAL,
        "ErrorBudget": lambda: salebra.surface_damping(surface, MATERIAL, DRAG, curve)[-1].error,
        "ExponentialFit": lambda: salebra.fit_exponential(curve, (1e5, 5e6)),
        "ExponentialLaw": lambda: salebra.ExponentialLaw(0.1, 3e-7, 0.8),
        "ExponentialTest": lambda: salebra.test_exponential(curve, (1e5, 5e6)),
        "ForceCurve": lambda: curve,
        "FirstLoading": lambda: salebra.after_first_loading(surface, MATERIAL, 1e6, hardness=2e7)[1],
        "Forecast": lambda: salebra.forecast(GRID, spectrum),
        "FrictionMap": lambda: salebra.friction_map(law, 1e-6, 1e-7, 1e-7, [0.5, 1.0], [0.5, 1.0], steps=64),
        "GreenwoodWilliamsonLaw": lambda: salebra.GreenwoodWilliamsonLaw(model),
        "Grid2D": lambda: GRID,
        "HeightDistribution": lambda: salebra.weibull_heights(2.0),
        "HeightHistogram": lambda: salebra.height_histogram(salebra.BearingCurve(surface)),
        "HeightStatistics": lambda: surface.height_statistics,
        "HurstEstimate": lambda: salebra.estimate_hurst(psd),
        "IndenterLaw": lambda: law,
        "IndenterProfile": lambda: salebra.cone_profile(0.1),
        "JointLoss": lambda: salebra.joint_loss(law, friction_coefficient=0.3, tangential_force=0.1, force=1.0),
        "MaxMotion": lambda: salebra.assumptions_of(law, DRAG, indentation=1e-6).largest[0],
        "LocalDecayLength": lambda: salebra.local_decay_length(curve),
        "Loss": lambda: salebra.loss_with_slip(law, EQUAL, 1e-6, friction_coefficient=0.3),
        "Material": lambda: MATERIAL,
        "MeanCurve": lambda: study.curve("mean_gap"),
        "ModelResult": lambda: study.realisations[0].bem,
        "MonteCarloCurve": lambda: salebra.monte_carlo_curve(ensemble, MATERIAL, 1e-8, [0.0, 1e-7], realisations=3),
        "NonGaussianSurface": lambda: salebra.non_gaussian(GRID, spectrum, salebra.weibull_heights(2.0), 1),
        "NormalContactState": lambda: state,
        "OscillatorDecay": lambda: salebra.oscillator_decay(law, normal_amplitude=1e-9, angular_frequency=1e5, mass=1e-2, force=1.0),
        "PerssonTheory": lambda: salebra.PerssonTheory(shells, MATERIAL),
        "Profile": lambda: salebra.random_phase_profile(32, 1e-3, salebra.SelfAffineProfileSpectrum(
            hurst=0.8, rolloff=2.5e-4, short_cutoff=1.25e-4, rms_height=1e-6), 1),
        "PowerLaw": lambda: salebra.PowerLaw(1e9, 1.5, 0.8),
        "PowerSpectrum": lambda: psd,
        "Assumption": lambda: salebra.assumptions_of(law, DRAG, indentation=1e-6).amplitude,
        "Assumptions": lambda: salebra.assumptions_of(law, DRAG, indentation=1e-6),
        "PressureWindow": lambda: salebra.fit_exponential(curve, (1e5, 5e6)).window,
        "ProfilePsd": lambda: salebra.profile_psd(surface),
        "ProfileParameters": lambda: salebra.profile_parameters(surface),
        "PronySeries": lambda: prony,
        "PunchStiffness": lambda: salebra.punch_stiffness(contact, surface.grid, MATERIAL),
        "RadialSpectrum": lambda: salebra.radial_spectrum(psd),
        "RegimeMap": lambda: salebra.regime_map(law, 1e-6, 1e-7, 1e5, [1e-4, 1e-3], [1e-8, 1e-7], friction_coefficient=0.3),
        "Realisation": lambda: study.realisations[0],
        "RoughnessShell": lambda: shells[0],
        "SampledMotion": lambda: salebra.sample(EQUAL, 1e-6, 8),
        "ScaleDependence": lambda: salebra.scale_dependence(surface),
        "SelfAffineSpectrum": lambda: spectrum,
        "SpectralMoments": lambda: surface.moments,
        "SpotCurve": lambda: study.realisations[0].spots,
        "SpotStatistics": lambda: study.realisations[0].spots[0],
        "StatisticalSummits": lambda: model,
        "Slider": lambda: slider,
        "SliderMotion": lambda: salebra.slider_motion(law, slider, friction_coefficient=0.3, indentation=1e-6),
        "SliderStability": lambda: salebra.slider_stability(
            law, slider, friction_coefficient=0.3, normal_amplitude=1e-7, angular_frequency=1e5, indentation=1e-6),
        "SliderThreshold": lambda: salebra.threshold_amplitude(
            law, slider, friction_coefficient=0.3, angular_frequency=1e5, max_amplitude=1e-6, indentation=1e-6),
        "SteadySliding": lambda: salebra.steady_sliding(law, DRAG, friction_coefficient=0.3, indentation=1e-6),
        "StickStiffness": lambda: salebra.stick_stiffness(contact, surface.grid, MATERIAL),
        "StressMap": lambda: salebra.stress_map(law, 1e-6, EQUAL, phases=16, radii=16),
        "StudyConfiguration": lambda: study.configuration,
        "StatedMean": lambda: study.solution().damping_constant[0],
        "StatedMeanCurve": lambda: study.solution().damping_constant,
        "StudySolution": study.solution,
        "StudyResult": lambda: study,
        "Summit": lambda: summits[0],
        "SummitEnsemble": lambda: ensemble,
        "SummitList": lambda: summits,
        "SummitStatistics": lambda: salebra.summit_statistics(summits),
        "Surface": lambda: surface,
        "SurfacePicture": lambda: study.realisations[0].picture,
        "TabulatedLaw": lambda: law_of_curve,
        "TrajectoryDamping": lambda: salebra.trajectory_damping(law, salebra.sample(EQUAL, 1e-6, 32)),
        "TwoFrequencies": lambda: salebra.TwoFrequencies(
            normal_amplitude=1e-9, tangential_amplitude=1e-9, phase=0.0, normal_angular_frequency=1e5,
            tangential_angular_frequency=1e4),
        "ViscoelasticCurve": lambda: salebra.viscoelastic_sweep(surface, MATERIAL, prony, EQUAL, [10.0, 100.0], pressure=1e5, steps=16, tolerance=0.01),
        "ViscoelasticDamping": lambda: salebra.viscoelastic_damping(law, prony, salebra.sample(EQUAL, 1e-6, 32), springs=8),
        "ViscoelasticIndentation": lambda: salebra.viscoelastic_indentation(law, prony, [0.0, 1e-3], [0.0, 1e-6], springs=8),
        "ViscoelasticPath": lambda: salebra.viscoelastic_path(surface, MATERIAL, prony, [0.0, 1e-3, 1e-2], pressure=1e5, steps=2),
        "WindowSensitivity": lambda: salebra.window_sensitivity(curve, (1e5, 5e6)),
    }


@pytest.fixture(scope="module")
def objects() -> dict[str, Any]:
    return {name: make() for name, make in makers().items()}


def test_every_object_survives_pickle_and_copy_and_equals_itself(objects: dict[str, Any]) -> None:
    for name, value in objects.items():
        for again in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
            assert type(again) is type(value), name
            assert again == value and not again != value, name
        assert value != 1.0 and value != "x", name


def test_no_name_or_text_shows_the_module_of_the_extension() -> None:
    for holder in (salebra, *(kind for kind in vars(salebra).values() if isinstance(kind, type))):
        for name, thing in vars(holder).items():
            if name.startswith("_"):
                continue
            assert "_core" not in (thing.__doc__ or ""), name
            if isinstance(thing, type):
                assert "_core" not in thing.__module__, name
    assert pickle.loads(pickle.dumps(salebra.closed_form.power)) is salebra.closed_form.power
    error = pickle.loads(pickle.dumps(salebra.InvalidInput("radius: -1 must be > 0")))
    assert type(error) is salebra.InvalidInput and error.args == ("radius: -1 must be > 0",)
    with pytest.raises(salebra.InvalidInput) as raised:
        salebra.power_profile(-1.0, 2.0)
    assert traceback.format_exception_only(raised.value)[0].startswith("salebra.InvalidInput: ")


def test_a_pickled_result_is_the_result(objects: dict[str, Any]) -> None:
    curve = pickle.loads(pickle.dumps(objects["ForceCurve"]))
    assert np.array_equal(curve.mean_gap, objects["ForceCurve"].mean_gap)
    assert salebra.fit_exponential(curve, (1e5, 5e6)) == objects["ExponentialFit"]
    law = pickle.loads(pickle.dumps(objects["TabulatedLaw"]))
    assert law.force(1e-6) == objects["TabulatedLaw"].force(1e-6)
    study = pickle.loads(pickle.dumps(objects["StudyResult"]))
    assert study.decay_length() == objects["StudyResult"].decay_length()
    assert study.models == objects["StudyResult"].models
    surface = pickle.loads(pickle.dumps(objects["Surface"]))
    assert surface.periodic and np.array_equal(surface.heights, objects["Surface"].heights)
    # Other numbers, other objects.
    assert generated(32, seed=8) != objects["Surface"]
    assert salebra.ExponentialLaw(0.2, 3e-7, 0.8) != objects["ExponentialLaw"]
    assert salebra.Material(2e9, poisson=0.3) != MATERIAL
    with pytest.raises(salebra.InvalidInput, match="pickle: "):
        salebra.ForceCurve.__new__(salebra.ForceCurve).__setstate__((salebra.version(), b"short"))
    with pytest.raises(salebra.InvalidInput, match="another version"):
        salebra.ForceCurve.__new__(salebra.ForceCurve).__setstate__(("0.0.1", b""))


def test_every_object_shows_itself(objects: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_show, "_picture", lambda _: "")  # test_plots.py has the pictures
    for name, value in objects.items():
        assert repr(value).startswith(type(value).__name__) or "(" in repr(value), name
        assert " object at 0x" not in repr(value), (name, repr(value))
        assert "<table>" in value._repr_html_() and "</table>" in value._repr_html_(), name
    assert "decay_length" in objects["ExponentialFit"]._repr_html_()
    assert repr(objects["ExponentialLaw"]) == "ExponentialLaw(0.1, 3e-07, 0.8)"


def test_every_function_has_a_signature_with_its_keywords() -> None:
    counted = 0
    for name in dir(_core):
        thing = getattr(_core, name)
        if name.startswith("_") or (isinstance(thing, type) and not hasattr(thing, "__signature__")):
            continue
        signature = inspect.signature(thing)
        assert all(not parameter.kind.name.startswith("VAR") for parameter in signature.parameters.values()), name
        counted += 1
    assert counted > 120
    signature = inspect.signature(salebra.press)
    assert list(signature.parameters)[:3] == ["surface", "material", "pressure"]
    assert signature.parameters["boundary"].default == "periodic"
    assert list(inspect.signature(salebra.Surface.detrended).parameters) == ["self", "method"]
    assert "size_x" in inspect.signature(salebra.Surface).parameters


@pytest.mark.parametrize(("call", "said"), [
    (lambda s: salebra.press(s.heights, 1e9, pressure=1e5),
     "press: surface: wanted a Surface, got an array of shape (64, 64) and type float64; make one with salebra.Surface("),
    (lambda s: salebra.press(s, 1e9, presure=1e5), "no argument presure; did you mean pressure?"),
    (lambda s: salebra.press(s, pressure=1e5), "material is missing; give a Material or a Body or a number"),
    (lambda s: salebra.press(s, 1e9, 1e5), "at most 2 go by place (surface, material); give what follows by name: pressure"),
    (lambda s: salebra.press(s, 1e9, pressure=[1e5]), "pressure: wanted a number, got a list"),
    (lambda s: salebra.press(s, 1e9, pressure=1e5, surface=s), "surface was given twice"),
    (lambda s: salebra.press(s, None, pressure=1e5), "material: wanted a Material or a Body or a number, got None"),
    (lambda s: salebra.press(s, 1e9, pressure=1e5, max_iterations=1.5), "max_iterations: wanted a whole number, got 1.5"),
    (lambda s: salebra.press(s, 1e9, pressure=1e5, initial_pressure=np.zeros(4)), "initial_pressure: wanted two dimensions (nx, ny), got shape (4,)"),
    (lambda s: salebra.Surface(np.zeros(8), 1.0, 1.0), "Surface: heights: wanted two dimensions (nx, ny), got shape (8,)"),
    (lambda s: salebra.Surface(np.zeros((8, 8)), 1.0), "Surface: size_y is missing; give a number"),
    (lambda s: salebra.Surface([["a"]], 1.0, 1.0), "Surface: heights: wanted an array of numbers"),
    (lambda s: salebra.sweep_pressures(s, 1e9, np.ones((2, 2))), "sweep_pressures: pressures: wanted one dimension, got shape (2, 2)"),
    (lambda s: s.detrended(3), "Surface.detrended: method: wanted one of 'none', 'mean', 'plane', 'quadratic', 'lines', 'median_differences', got 3"),
])  # fmt: skip
def test_a_wrong_argument_is_named_with_what_came_and_what_was_wanted(
    call: Callable[[salebra.Surface], Any], said: str, surface: salebra.Surface
) -> None:
    with pytest.raises(TypeError) as raised:
        call(surface)
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_an_error_in_a_function_of_the_user_stays_what_it_is() -> None:
    def broken(q: float) -> float:
        raise TypeError("mine")

    with pytest.raises(TypeError, match="^mine$"):
        salebra.forecast(GRID, salebra.FunctionSpectrum(broken, 2e4, 5e4))


def test_texts_with_units_are_numbers(surface: salebra.Surface) -> None:
    state = salebra.press(surface, "1GPa", pressure="0.1 MPa")  # type: ignore[arg-type]
    assert state == salebra.press(surface, 1e9, pressure=1e5)
    assert salebra.Material("115GPa", poisson=0.3).contact_modulus == 115e9  # type: ignore[arg-type]
    assert salebra.Grid2D(8, 8, "1mm", "2 mm").ly == 2e-3  # type: ignore[arg-type]
    curve = salebra.sweep_pressures(surface, 1e9, ["100kPa", "1MPa"])
    assert np.allclose(curve.pressure, [1e5, 1e6], rtol=1e-12)
    assert salebra.Drag(normal_amplitude="1nm", drag_velocity="1mm/s", angular_frequency=1e5).normal_amplitude == 1e-9  # type: ignore[arg-type]
    with pytest.raises(salebra.InvalidInput, match="pressure: '5mm'") as raised:
        salebra.press(surface, 1e9, pressure="5mm")  # type: ignore[arg-type]
    assert (raised.value.field, raised.value.value) == ("pressure", "'5mm'")


def test_a_refusal_has_its_parts(surface: salebra.Surface, tmp_path: Path) -> None:
    with pytest.raises(salebra.InvalidInput) as raised:
        salebra.Surface(np.zeros((4, 4)), -1.5, 1.0)
    refused = raised.value
    assert (refused.field, refused.value) == ("size_x", "-1.5")
    assert str(refused) == f"size_x: -1.5 {refused.constraint}"
    with pytest.raises(FileNotFoundError) as gone:
        salebra.read_surface(tmp_path / "nowhere.h5")
    assert isinstance(gone.value, salebra.InvalidInput)
    assert gone.value.field == str(tmp_path / "nowhere.h5")
    assert gone.value.constraint and gone.value.value == ""


def test_one_name_for_the_material_and_the_old_one_answered(surface: salebra.Surface) -> None:
    state = salebra.press(surface, salebra.Material(1e9), pressure=1e5)
    assert state == salebra.press(surface, 1e9, pressure=1e5)
    for function in (salebra.press, salebra.sweep_pressures, salebra.boundary_element_contact_sets):
        assert list(inspect.signature(function).parameters)[:2] == ["surface", "material"]
    with pytest.raises(salebra.InvalidInput, match="contact_modulus: -1"):
        salebra.press(surface, -1.0, pressure=1e5)


def test_masked_points_are_undefined_points() -> None:
    heights = np.ma.masked_greater(np.arange(64.0).reshape(8, 8), 60.0)
    surface = salebra.Surface(heights, 1.0, 1.0)
    assert surface.undefined_points == 3
    assert np.isnan(surface.heights[7, 7]) and surface.heights[0, 1] == 1.0
    whole = salebra.Surface(np.ma.masked_array(np.arange(4).reshape(2, 2), mask=[[True, False], [False, False]]), 1.0, 1.0)
    assert whole.undefined_points == 1


def test_a_file_that_is_not_there_is_a_filenotfounderror(tmp_path: Path) -> None:
    for read in (salebra.read_surface, salebra.read_force_curve, salebra.ResultReader, salebra.read_study_configuration):
        with pytest.raises(FileNotFoundError, match="nowhere.h5") as raised:
            read(tmp_path / "nowhere.h5")
        assert isinstance(raised.value, salebra.InvalidInput)
        assert raised.value.errno == errno.ENOENT and "Errno" not in str(raised.value)
    with pytest.raises(FileNotFoundError):
        salebra.write_surface(tmp_path / "no folder" / "s.h5", generated(32))
    # A file that is there and unusable is none.
    (tmp_path / "empty.h5").write_text("")
    with pytest.raises(salebra.InvalidInput) as other:
        salebra.read_surface(tmp_path / "empty.h5")
    assert not isinstance(other.value, FileNotFoundError)


def test_what_did_not_converge_warns(surface: salebra.Surface) -> None:
    with pytest.warns(salebra.ConvergenceWarning, match="press: did not converge, residual") as told:
        salebra.press(surface, 1e9, pressure=2e5, max_iterations=1, tolerance=1e-13)
    assert told[0].filename == __file__
    with pytest.warns(salebra.ConvergenceWarning, match="sweep_pressures: 2 of 2 samples did not converge"):
        salebra.sweep_pressures(surface, 1e9, [1e5, 2e5], max_iterations=1, tolerance=1e-13)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        salebra.press(surface, 1e9, pressure=2e5)
        salebra.press(generated(256), 1e9, pressure=1e6, tolerance=1e-13, progress=lambda report: False)  # stopped on request


def test_asarray_of_a_surface_is_its_heights(surface: salebra.Surface) -> None:
    assert np.shares_memory(np.asarray(surface), surface.heights)
    assert np.asarray(surface, dtype=np.float32).dtype == np.float32
    assert not np.shares_memory(np.array(surface), surface.heights)
    assert np.ptp(surface) == np.ptp(surface.heights)


def test_curves_are_rows_and_tables(surface: salebra.Surface) -> None:
    pandas = pytest.importorskip("pandas")
    curve = salebra.sweep_pressures(surface, 1e9, [1e5, 1e6])
    rows = list(curve)
    assert len(rows) == len(curve) == 2
    assert rows[1].pressure == pytest.approx(1e6) and rows[0].mean_gap == curve.mean_gap[0]
    frame = curve.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert np.array_equal(frame["mean_gap"], curve.mean_gap)
    assert frame.attrs["units"]["mean_gap"] == "m" and frame.attrs["units"]["contact_area_fraction"] == "1"
    # A column without a single number is left out.
    assert "separation" not in frame
    spots = salebra.contact_spots(salebra.press(surface, 1e9, pressure=1e6))
    assert list(spots.to_dataframe().columns) == ["area", "force"] and len(list(spots)) == len(spots)


def test_every_result_with_more_than_numbers_has_a_picture(objects: dict[str, Any]) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    drawn = 0
    for name, value in objects.items():
        if isinstance(value, salebra.ContactLaw):  # drawn over the indentations that it is given, below
            continue
        if hasattr(value, "plot"):
            axes = value.plot()
            assert axes.get_xlabel() and axes.get_ylabel(), name
            plt.close("all")
            drawn += 1
        elif any(isinstance(getattr(value, key, None), np.ndarray) for key in dir(value) if not key.startswith("_")):
            raise AssertionError(f"{name} has arrays and no plot()")
    assert drawn > 20
    assert objects["IndenterLaw"].plot(np.linspace(1e-7, 1e-6, 5)).get_yscale() == "log"


def test_a_curve_is_drawn_with_its_fit(objects: dict[str, Any]) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    gap = np.linspace(1e-6, 2.5e-6, 12)
    curve = salebra.ForceCurve(1e-6, mean_gap=gap, pressure=1e9 * np.exp(-gap / 4e-7), rms_height=1e-6)
    axes = curve.plot()
    points, law = axes.get_lines()
    assert points.get_label() == "measured" and axes.get_title().replace("\u00a0", " ").startswith("decay length l = 400 nm")
    assert np.array_equal(points.get_xdata(), gap[::-1]) and len(law.get_xdata()) == 2
    assert np.allclose(law.get_ydata(), 1e9 * np.exp(-np.asarray(law.get_xdata()) / 4e-7), rtol=1e-9)
    assert len(curve.plot(fit=False).get_lines()) == 1


def test_bars_end_at_a_hundred_per_cent(capsys: pytest.CaptureFixture[str], surface: salebra.Surface) -> None:
    pytest.importorskip("tqdm")
    salebra.press(surface, 1e9, pressure=1e6, progress=True)
    assert capsys.readouterr().err.rstrip().split("\r")[-1].strip().startswith(("contact 100%", "100%"))
    with pytest.raises(salebra.InvalidInput):
        salebra.press(surface, 1e9, pressure=-1.0, progress=True)
    assert "100%" not in capsys.readouterr().err


def test_names_are_sorted_into_submodules() -> None:
    public = {name for name in dir(_core) if not name.startswith("_")}
    modules = [salebra.surfaces, salebra.generators, salebra.contact, salebra.models, salebra.damping, salebra.studies,
               salebra.files, salebra.session]  # fmt: skip
    found: dict[str, str] = {}
    for module in modules:
        for name in public & set(vars(module)):
            assert name not in found, f"{name} is in {found[name]} and {module.__name__}"
            assert getattr(module, name) is getattr(salebra, name)
            found[name] = module.__name__
    assert found.keys() == public
    shown = dir(salebra)
    assert len(shown) < 80 and {"surfaces", "contact", "Surface", "run_study"} <= set(shown)
    for name in shown:
        assert getattr(salebra, name) is not None


def test_a_study_that_was_stopped_goes_on(tmp_path: Path) -> None:
    study = salebra.parse_study_configuration(STUDY)
    whole = salebra.run_study(study)
    seen: list[float] = []

    def stop(report: salebra.ProgressReport) -> bool:
        seen.append(report.fraction)
        return report.fraction < 0.4

    salebra.set_threads(1)
    try:
        stopped = salebra.run_study(study, parts=tmp_path / "parts", progress=stop)
    finally:
        salebra.set_threads(0)
    resumed = salebra.run_study(study, parts=tmp_path / "parts")
    assert resumed == whole
    assert len(stopped.realisations) <= len(whole.realisations)
    assert len([path for path in (tmp_path / "parts").iterdir() if "lock" not in path.name]) == 2
    with pytest.raises(salebra.InvalidInput):
        salebra.run_study(study, parts=tmp_path / "parts", resume=False)
    assert math.isfinite(resumed.decay_length().mean)
