# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies, their files and pages: what Python and the program make of the same configuration is the same."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import salebra
from conftest import STUDY


@pytest.fixture(scope="module")
def result() -> salebra.StudyResult:
    return salebra.run_study(salebra.parse_study_configuration(STUDY))


def test_a_study_from_text_writes_what_it_computed(result: salebra.StudyResult, tmp_path: Path) -> None:
    assert len(result.realisations) == 2
    assert result.models == ["bem", "gw_moments", "gw_deterministic"]
    decay_length = result.decay_length()
    fitted = [realisation.bem.fit.decay_length for realisation in result.realisations]
    assert decay_length.mean == pytest.approx(np.mean(fitted), rel=1e-12)
    assert len(result.damping("damping_constant_closed_form")) == 10
    with pytest.raises(salebra.InvalidInput, match=r"did you mean small_amplitude_work\?"):
        result.damping("small_work_per_cycle")
    result.write(tmp_path / "study.h5")
    assert (tmp_path / "study.h5").exists()


def test_results_over_the_pressure_are_curves(result: salebra.StudyResult) -> None:
    gap = result.curve("mean_gap")
    assert len(gap) == 10 and np.array_equal(gap.pressure, result.pressures)
    assert [one.mean for one in gap] == list(gap.mean) and gap[-1].low == gap.low[9]
    with pytest.raises(AttributeError, match="'MeanCurve' has no attribute 'force'"):
        gap.force
    bem = result.realisations[0]
    for curve in (gap, result.damping(), result.solution().damping_constant, bem.bem.damping, bem.spots):
        data = curve.to_xarray()
        assert data.pressure.values == pytest.approx(result.pressures, rel=1e-12) and data.pressure.attrs["units"] == "Pa"
        assert set(data.data_vars) <= set(curve.to_dataframe().columns)
        curve.plot()
    assert gap.to_xarray()["mean"].attrs["units"] == gap.to_dataframe().attrs["units"]["low"] == "m"
    assert result.convergence().coordinate == "surfaces" and result.convergence().to_xarray()["mean"].attrs["units"] == "1"
    assert list(bem.bem.damping.damping_constant) == pytest.approx([one.damping_constant for one in bem.bem.damping], nan_ok=True)
    assert list(bem.spots.spot_count) == [one.spot_count for one in bem.spots]
    assert len(bem.flow) == 0 and not bem.flow


def test_the_answer_of_a_study_is_that_of_the_program(program: Callable[..., Any], tmp_path: Path) -> None:
    text = STUDY.replace("[contact]", "friction_coefficient = 0.3\n[contact]", 1) + 'excursion = "1mm"\n'
    (tmp_path / "slips.toml").write_text(text)
    said = program("study", tmp_path / "slips.toml")
    result = salebra.run_study(salebra.parse_study_configuration(text))
    answer = result.solution()
    data = answer.to_xarray()
    assert np.array_equal(data.pressure, answer.pressures) and data.attrs["validity"] == answer.validity
    assert np.array_equal(data.damping_constant_mean, [one.mean for one in answer.damping_constant])
    assert data.damping_constant_low.attrs["units"] == "N s/m" and data.relaxation_share.dims == ("pressure",)
    assert answer.slip_followed and answer.validity == said["validity"] and said["validity"] in repr(answer)
    assert [one.mean for one in answer.damping_constant] == pytest.approx(said["damping"]["damping_constant"]["mean"], rel=1e-9, nan_ok=True)
    assert list(answer.slip_share) == pytest.approx(said["damping"]["slip_share"], rel=1e-9, nan_ok=True)
    # Of two surfaces for what two surfaces reach.
    width = result.damping()[5].relative_precision
    assert result.surfaces_for(width)[5] == 2 and result.surfaces_for(width / 3)[5] == 18


def test_weights_of_the_fit_are_those_of_the_program(
    result: salebra.StudyResult, program: Callable[..., Any], tmp_path: Path
) -> None:
    curve = result.realisations[0].bem.curve
    salebra.write_force_curve(tmp_path / "curve.h5", curve)
    window = (float(curve.pressure[1]), float(curve.pressure[8]))
    lengths = []
    for weights in ("spacing", "equal", "force"):
        answer = program("fit", tmp_path / "curve.h5", "--weights", weights, "--pressure-window", f"{window[0]},{window[1]}")
        fit = salebra.fit_exponential(curve, window, weights)
        assert fit.decay_length == pytest.approx(answer["decay_length"], rel=1e-12)
        lengths.append(fit.decay_length)
        test = salebra.test_exponential(curve, window, weights=weights)
        assert test.decay_length_at_max_gap == pytest.approx(answer["test"]["decay_length_at_max_gap"], rel=1e-12)
        # A computed curve has misfit in place of scatter: no probability belongs to it.
        if weights == "spacing":
            assert "significance" not in answer["test"]
        else:
            assert test.significance == pytest.approx(answer["test"]["significance"], rel=1e-9)
        sensitivity = salebra.window_sensitivity(curve, window, weights=weights)
        assert sensitivity.decay_length_min <= fit.decay_length <= sensitivity.decay_length_max
    # The law does not hold exactly, so that what counts for how much matters.
    assert len(set(lengths)) == 3
    assert salebra.fit_exponential(curve, window).decay_length == lengths[0]
    with pytest.raises(salebra.InvalidInput, match="weights: 'best' is none of spacing, equal, force"):
        salebra.fit_exponential(curve, window, "best")  # type: ignore[arg-type]


def test_models_are_chosen_as_by_compare(program: Callable[..., Any], tmp_path: Path) -> None:
    configuration = salebra.parse_study_configuration(STUDY)
    assert configuration.models == ["bem", "gw_moments", "gw_deterministic"]
    assert set(configuration.models) < set(configuration.compared_models)
    # The boundary elements, which the others are measured by, are among them in any case.
    chosen = configuration.with_models(["gw_interacting", "persson"])
    assert set(chosen.models) == {"bem", "gw_interacting", "persson"}
    assert configuration.models == ["bem", "gw_moments", "gw_deterministic"]
    with pytest.raises(salebra.InvalidInput, match="models: 'gw'"):
        configuration.with_models(["gw"])

    result = salebra.run_study(chosen)
    assert set(result.models) == {"bem", "gw_interacting", "persson"}
    (tmp_path / "study.toml").write_text(STUDY)
    answer = program("compare", tmp_path / "study.toml", "--models", "gw_interacting,persson")["models"]
    assert set(answer) == set(result.models)
    for model in result.models:
        ours = result.fitted("area_slope", model).mean
        assert ours == pytest.approx(answer[model]["area_slope"]["mean"], rel=1e-12)
    assert len(result.realisations[0].model("gw_interacting").curve) == 10
    with pytest.raises(salebra.InvalidInput, match="model: 'gw_monte_carlo' was not computed"):
        result.realisations[0].model("gw_monte_carlo")


def test_a_file_of_results_gives_arrays_with_units_and_attributes(result: salebra.StudyResult, tmp_path: Path) -> None:
    result.write(tmp_path / "study.h5")
    reader = salebra.ResultReader(tmp_path / "study.h5")
    assert reader.file == str(tmp_path / "study.h5")
    assert {"surface", "curve", "fit", "damping"} <= set(reader.groups())
    assert "damping/pressure" in reader and "damping/absent" not in reader
    assert "damping_constant" in reader.datasets("damping")
    assert reader.coordinates("damping/damping_constant") == ["model", "realisation", "pressure"]
    values = reader["damping/damping_constant"]
    assert values.shape == (3, 2, 10) and values.dtype == np.float64
    assert values[0, 1, 4] == result.realisations[1].bem.damping[4].damping_constant
    assert reader.units("damping/damping_constant") == "N s/m"
    assert list(reader["damping/model"]) == result.models
    assert np.array_equal(reader["damping/pressure"], result.pressures)
    flags = reader["curve/converged"]
    assert flags.dtype == np.bool_ and flags.all()
    provenance = reader.attributes()
    assert provenance["version"] == salebra.version() and "Eigen" in str(provenance["libraries"])
    assert reader.attributes("damping/pressure")["units"] == "Pa"
    # An array is the reader's no longer.
    values[:] = 0.0
    assert reader["damping/damping_constant"][0, 1, 4] != 0.0
    with pytest.raises(salebra.InvalidInput, match="study.h5: has no dataset damping/absent"):
        reader["damping/absent"]
    with pytest.raises(salebra.InvalidInput, match="absent.h5"):
        salebra.ResultReader(tmp_path / "absent.h5")


def test_columns_have_one_name_and_unit_in_python_and_in_files(result: salebra.StudyResult, tmp_path: Path) -> None:
    result.write(tmp_path / "study.h5")
    reader = salebra.ResultReader(tmp_path / "study.h5")
    bem = result.realisations[0].bem
    for group, owner, columns in (
        ("curve", bem.curve, salebra._core._curve_columns()),
        ("damping", bem.damping[0], salebra._core._damping_columns()),
    ):
        assert len(columns) > 5
        for name, units, long_name in columns:
            assert reader.units(f"{group}/{name}") == units
            kind = type(owner) if hasattr(owner, name) else salebra.ErrorBudget  # the causes of an error
            documentation = getattr(kind, name).__doc__
            assert documentation.startswith(long_name) and (units == "1" or f", {units}." in documentation)


def test_a_group_of_a_file_becomes_a_dataset(result: salebra.StudyResult, tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    result.write(tmp_path / "study.h5")
    reader = salebra.ResultReader(tmp_path / "study.h5")
    for group in ("damping", "/damping"):
        data = reader.to_xarray(group)
        # Fully selected by names, as xarray.open_dataset of the same group would have it.
        chosen = data.damping_constant.sel(model="bem").isel(realisation=1, pressure=4)
        assert float(chosen) == result.realisations[1].bem.damping[4].damping_constant
        assert data.damping_constant.attrs["units"] == "N s/m"
        assert data.pressure.attrs["long_name"]
    assert reader.to_xarray().attrs["version"] == salebra.version()


def test_a_table_of_the_program_is_read(program: Callable[..., Any], tmp_path: Path) -> None:
    surface, curve = tmp_path / "rough.h5", tmp_path / "curve.h5"
    program("generate", "--points", "32", "--size-x", "1mm", "--hurst", "0.8", "--rolloff", "0.5mm", "--short-cutoff",
            "125um", "--rms-height", "1um", "-o", surface)  # fmt: skip
    answer = program("contact", surface, "--contact-modulus", "1GPa", "--poisson", "0.3", "--pressure", "10kPa:1MPa:4", "-o", curve)
    reader = salebra.ResultReader(curve)
    assert reader["curve/mean_gap"].tolist() == answer["curve"]["mean_gap"]
    assert "salebra contact" in str(reader.attributes()["command_line"])
    heights = salebra.ResultReader(surface)
    field = next(name for name in heights.datasets() if heights[name].ndim == 2)
    assert np.array_equal(heights[field], salebra.read_surface(surface).heights)


def test_a_report_is_the_page_of_the_program(result: salebra.StudyResult, program: Callable[..., Any], tmp_path: Path) -> None:
    results = tmp_path / "study.h5"
    result.write(results)
    if not salebra.can_report():
        with pytest.raises(salebra.IoError, match="plotly"):
            salebra.write_report(results, tmp_path / "page.html")
        return
    salebra.write_report(results, tmp_path / "page.html", title="A title of ours")
    page = (tmp_path / "page.html").read_text()
    assert "A title of ours" in page
    program("report", results, "--title", "A title of ours", "-o", tmp_path / "again.html")
    assert (tmp_path / "again.html").read_text() == page
    with pytest.raises(salebra.InvalidInput, match="page.html: exists"):
        salebra.write_report(results, tmp_path / "page.html")
    salebra.write_report(results, tmp_path / "page.html", overwrite=True)
    with pytest.raises(salebra.InvalidInput, match="page.html: exists|chromium"):
        salebra.write_report_pdf(results, tmp_path / "page.html")
    assert "A title of ours" not in (tmp_path / "page.html").read_text()
    (tmp_path / "text.h5").write_text("no results")
    with pytest.raises(salebra.InvalidInput, match="text.h5"):
        salebra.write_report(tmp_path / "text.h5", tmp_path / "other.html")
    assert not (tmp_path / "other.html").exists()


def test_a_study_goes_on_from_its_parts(result: salebra.StudyResult, tmp_path: Path) -> None:
    configuration = salebra.parse_study_configuration(STUDY)
    parts = tmp_path / "parts"
    finished: list[float] = []

    def stop(report: salebra.ProgressReport) -> bool:
        finished.append(report.fraction)
        return False

    # Stopped at its first word: nothing, or what was finished by then.
    first = salebra.run_ensembles(configuration, parts=parts, progress=stop)
    assert finished and (not first or first[0].interrupted)
    whole = salebra.run_ensembles(configuration, parts=parts, resume=True)[0]
    kept = sorted(path.name for path in parts.glob("*.realisation"))
    assert len(kept) == 2
    with pytest.raises(salebra.InvalidInput, match="2 finished surfaces"):
        salebra.run_ensembles(configuration, parts=parts)
    # Nothing is computed anew: the files stay as they are, and the numbers are those of an undisturbed run.
    times = [path.stat().st_mtime_ns for path in sorted(parts.glob("*.realisation"))]
    again = salebra.run_ensembles(configuration, parts=parts, resume=True)[0]
    assert [path.stat().st_mtime_ns for path in sorted(parts.glob("*.realisation"))] == times
    for other in (whole, again):
        assert [one.bem.fit.decay_length for one in other.realisations] == [one.bem.fit.decay_length for one in result.realisations]
    file = tmp_path / "study.h5"
    assert not salebra.is_result_of(file, configuration)
    salebra.write_ensembles(file, [again])
    assert salebra.is_result_of(file, configuration)
    assert not salebra.is_result_of(file, configuration.with_models(["persson"]))
    assert not re.search(r"lock", " ".join(path.name for path in parts.iterdir()))


def test_pictures_of_a_study_name_its_models_and_draw_its_answer() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    configuration = salebra.parse_study_configuration(STUDY)
    result = salebra.run_study(configuration.with_models(configuration.compared_models))
    realisation = result.realisations[0]
    lines = realisation.plot().get_lines()
    titles = [line.get_label() for line in lines]
    assert len(set(titles)) == len(result.models) and titles[0] == "boundary elements"
    for model, line, title in zip(result.models, lines, titles):
        assert np.array_equal(line.get_ydata(), realisation.model(model).curve.pressure)
        assert realisation.model(model).plot().get_lines()[0].get_label() == title
    # Each curve has a name of its own as well.
    assert len({realisation.model(model).curve.model for model in result.models}) == len(result.models)

    text = STUDY.replace("[contact]", "friction_coefficient = 0.3\n[contact]").replace("[damping]", '[damping]\nexcursion = "1mm"')
    one = re.sub(r"seeds = \[.*\]", "seeds = [3]", text)
    for study, several in ((text, True), (one, False)):
        answer = salebra.run_study(salebra.parse_study_configuration(study)).solution()
        axes = answer.plot()
        points, _, (bars,) = axes.containers[0]
        assert np.array_equal(np.asarray(points.get_ydata(), float), [mean.mean for mean in answer.damping_constant], equal_nan=True)
        for mean, bar in zip(answer.damping_constant, bars.get_segments()):
            ends = (mean.low, mean.high) if several else (mean.mean - mean.error, mean.mean + mean.error)
            if not np.isnan(ends).any():
                assert bar[:, 1] == pytest.approx(ends, rel=1e-12)
        assert len(bars.get_segments()) > 3
        assert [text.get_text() for text in axes.get_legend().get_texts()] == ["with slip", "without slip"]
        assert list(axes.get_lines()[-1].get_ydata()) == pytest.approx(
            [mean.mean for mean in answer.damping_constant_without_slip], nan_ok=True
        )


def test_sensitivities_and_designs(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(
        """
[surface]
points = 32
size_x = "64um"
hurst = 0.7
rolloff = "10um"
short_cutoff = "8um"
rms_height = "100nm"
seeds = [1, 2, 3]
[material]
contact_modulus = "3GPa"
poisson = 0.3
[contact]
pressures = "8MPa:32MPa:4"
[damping]
normal_amplitude = "2nm"
drag_velocity = "1um/s"
frequency = "1kHz"
"""
    )
    found = salebra.study_sensitivity(salebra.read_study_configuration(study), waves=False)
    outputs = found.outputs()
    assert outputs[0] == "mean_gap" and "damping_constant" in outputs
    slope = found.find("rms_height", "normal_stiffness")
    assert np.all(slope.low <= slope.mean) and np.all(slope.mean < 0)
    # Twice the moduli and twice the pressures give twice the stiffness.
    both = slope.mean * 0 + found.find("contact_modulus", "normal_stiffness").mean
    assert both + found.find("pressure", "normal_stiffness").mean == pytest.approx(1, abs=0.2)
    with pytest.raises(salebra.InvalidInput, match="colour"):
        found.find("colour", "mean_gap")

    def design(value: str) -> salebra.Design:
        problem = tmp_path / "problem.toml"
        problem.write_text(
            f"""
study = "study.toml"
[target]
output = "normal_stiffness"
value = "{value}"
tolerance = "50%"
force = ["60mN", "80mN"]
[free]
rms_height = ["50nm", "400nm"]
"""
        )
        return salebra.design(problem)

    far = design("1TN/m")
    assert not far.met and far.parameters[0].at_limit
    nearest = far.points[1].output.mean
    near = design(f"{nearest / 2:.3g}N/m")
    assert near.met and 50e-9 < near.parameters[0].value < 400e-9
    again = salebra.run_study(near.study)
    assert again.pressures[0] == pytest.approx(60e-3 / 64e-6**2)
    assert again.curve("normal_stiffness")[0].mean == pytest.approx(near.points[0].output.mean, rel=0.5)
