# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by matplotlib have what the figure has as data, with every text in its place, at the widths of a journal's columns."""

from __future__ import annotations

import json
import pickle
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np
import pytest

import salebra
from conftest import generated
from salebra import _plots
from test_notebook import makers

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.text import Text  # noqa: E402

COLUMN, PAGE = 0.085, 0.17
CONE = "damping --law cone --angle 10deg --indentation 1um --contact-modulus 1GPa --poisson 0.3"
BALL = "damping --law paraboloid --radius 10mm --contact-modulus 1GPa --poisson 0.3"
EQUAL = "--mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm --phase 60deg"
ROUGH = "--law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 --normal-amplitude 10nm --frequency 20kHz"
# Figures of commands, of which the package has no result.
COMMANDS = (
    f"{CONE}", f"{CONE} {EQUAL}",
    "oscillate --shape cylinder,paraboloid --contact-modulus 1GPa --poisson 0.3 --points 32 --steps 16",
    f"{BALL} --indentation 1um {EQUAL} --map-phases 32 --map-radii 40 --stress-map map.h5",
    f"{BALL} --indentation 1um --normal-amplitude 31.25nm:2um:9 --drag-velocity 1um/s --frequency 20kHz",
    f"{BALL} --normal-force 0.1 --hold force --normal-amplitude 10nm:1um:8 --frequency 1:100kHz:8 --falling-slope 0.5",
    f"sliding {ROUGH} --friction-coefficient 0.3 --velocities 1nm/s:10mm/s:8 --excursions 1pm:1um:8",
    f"damping {ROUGH} --mass 10g --spring-stiffness 1kN/m",
)  # fmt: skip


class Loaded(SimpleNamespace):
    """An object of the JSON of a figure, which leaves out what is absent."""

    def __getattr__(self, name: str) -> None:
        if name not in ("low", "high", "second_x", "second_y", "image"):
            raise AttributeError(name)


def figure_of(file: Path) -> Any:
    def loaded(members: dict[str, Any]) -> Loaded:
        """null is NaN among numbers."""
        arrays = {name: np.array(value, float) for name, value in members.items() if name in ("x", "y", "low", "high", "values") and isinstance(value, list)}
        return Loaded(**members | arrays)

    return json.loads(file.read_text(), object_hook=loaded)


def check(name: str, figure: Any, width: float | None) -> None:
    """The picture has the numbers of the figure, no text over another or beyond the paper, and no legend over data."""
    drawn = _plots.plot_figure(figure, width, False)
    panels = [panel for panel in figure.panels if width is None or width > 0.12 or not panel.detail]
    texts: list[Text] = []
    draw = Text.draw
    with mock.patch.object(Text, "draw", lambda self, renderer: (texts.append(self), draw(self, renderer))[1]):
        FigureCanvasAgg(drawn).draw()
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts if text.get_text().strip() and text.get_visible()]
    assert len(boxes) > 4 * len(panels), name  # labels and numbers of two axes each
    paper = drawn.bbox.padded(1)
    for k, (text, box) in enumerate(boxes):
        assert paper.containsx(box.x0) and paper.containsx(box.x1) and paper.containsy(box.y0) and paper.containsy(box.y1), (name, width, text)
        for other, place in boxes[:k]:
            assert text == other and abs(box.x0 - place.x0) < 1 or not box.padded(-0.5).overlaps(place), (name, width, text, other)
    axes = [ax for ax in drawn.axes if ax.get_subplotspec()]
    for ax in axes:
        legend = ax.get_legend()
        if legend:
            assert not any(legend.get_window_extent().overlaps(frame.bbox) for frame in axes), (name, width)
    assert len(axes) == len(panels)
    # Letters, which the caption refers to.
    caption = " ".join(text.get_text() for text in drawn.texts).replace("\n", " ").replace("\u00a0", " ")
    for letter, ax, panel in zip("abcdefghijklmnopqrstuvwxyz", axes, panels):
        assert ax.get_title().startswith(f"({letter})") == (len(figure.panels) > 1), name
    assert figure.caption[:12].split("_")[0] in caption, name
    for ax, panel in zip(axes, panels):
        on_data = [line.get_transform().contains_branch(ax.transData) for line in ax.lines]
        curves = [line for line, data in zip(ax.lines, on_data) if data]
        assert len(curves) == len(panel.curves) and len(ax.lines) - len(curves) == len(panel.lines), name
        for line, curve in zip(curves, panel.curves):
            for values, data in ((line.get_xdata(), curve.x), (line.get_ydata(), curve.y)):
                assert np.array_equal(np.asarray(values, float), np.asarray(data, float), equal_nan=True), name
        assert len(ax.patches) == len(panel.ranges), name
        mesh = [one for one in ax.collections if type(one).__name__ == "QuadMesh"]
        assert len(mesh) == (panel.image is not None), name
        if mesh:
            shown, values = mesh[0].get_array().filled(np.nan), np.asarray(panel.image.values, float).T
            assert np.array_equal(shown, np.where(values > 0, values, np.nan) if panel.image.scale.logarithmic else values, equal_nan=True), name


@pytest.fixture(scope="module")
def figures() -> dict[str, Any]:
    objects = {name: make() for name, make in makers().items()}
    found = {name: value.figure() for name, value in objects.items() if hasattr(value, "figure") and not isinstance(value, salebra.ContactLaw)}
    law = objects["IndenterLaw"]
    return found | {"law": law.figure(np.linspace(1e-7, 1e-6, 5)), "indenter": law.figure(1e-6)}


@pytest.mark.parametrize("width", [COLUMN, PAGE])
def test_the_figure_of_every_result_is_drawn_as_it_is(figures: dict[str, Any], width: float) -> None:
    assert len(figures) > 40
    for name, figure in figures.items():
        if width == COLUMN or len(figure.panels) > 1:  # a single panel only gets more room
            check(name, figure, width)


@pytest.mark.parametrize("command", COMMANDS)
def test_the_figure_of_a_command_is_drawn_as_it_is(program: Callable[..., Any], tmp_path: Path, command: str) -> None:
    words = [word if word != "map.h5" else str(tmp_path / word) for word in command.split()]
    program(*words, "--quiet", "--plot", tmp_path / "figure.json")
    for width in (COLUMN, PAGE):
        check(command, figure_of(tmp_path / "figure.json"), width)


def test_figures_say_what_their_result_was_computed_from() -> None:
    law = salebra.IndenterLaw(salebra.paraboloid_profile(10e-3), salebra.Material(115e9, poisson=0.3))
    joint = salebra.joint_loss(law, friction_coefficient=0.3, tangential_amplitude=219.16662e-9, force=10.0)
    loop, backbone = joint.figure().panels[0].curves
    # The area of the loop is the loss of Mindlin and Deresiewicz.
    assert abs(np.trapezoid(loop.y, loop.x)) == pytest.approx(joint.work_per_cycle, rel=1e-4)
    drag = salebra.Drag(normal_amplitude=3e-7, drag_velocity=2e-3, angular_frequency=1e5)
    sliding = salebra.steady_sliding(law, drag, friction_coefficient=0.4, indentation=1e-6)
    computed, limit, mark = sliding.figure().panels[0].curves
    # The curve passes through the result: it is not interpolated far.
    assert np.interp(mark.x[0], computed.x, computed.y) == pytest.approx(sliding.friction_coefficient, rel=1e-3)
    for one in (joint, sliding):
        with pytest.raises(salebra.InvalidInput, match="does not know the contact law"):
            pickle.loads(pickle.dumps(one)).figure()
    equal = salebra.EqualFrequency(normal_amplitude=1e-7, tangential_amplitude=5e-8, phase=1.5, angular_frequency=6.28e3)
    slips = salebra.ContactParameters(friction_coefficient=0.3)
    for result in (
        salebra.trajectory_damping(law, salebra.sample(equal, 1e-6, 64), friction_coefficient=0.3),
        salebra.damping_curve(law, [equal], force=10.0, parameters=slips),
    ):
        caption = result.figure().caption
        assert "nm tangential and 100 nm normal" in caption and "µ = 0.3" in caption and "F = 1" in caption
    rubber = salebra.Material(4e6, poisson=0.5)
    cone, prony = salebra.IndenterLaw(salebra.cone_profile(0.2), rubber), salebra.PronySeries.of_body(rubber, [(3e6, 0.02)])
    loss = salebra.viscoelastic_damping(cone, prony, salebra.sample(equal, 2e-5, 64))
    over_frequency = loss.figure().panels[0].curves[-1]
    at = over_frequency.x.tolist().index(pytest.approx(6.28e3))
    assert over_frequency.y[at] == loss.work_per_cycle


def test_the_figure_of_a_fit_is_that_of_the_program(program: Callable[..., Any], surface: salebra.Surface, tmp_path: Path) -> None:
    curve = salebra.sweep_pressures(surface, salebra.Material(1e9, poisson=0.3), np.geomspace(1e5, 1e7, 16))
    table = tmp_path / "curve.csv"
    np.savetxt(table, np.column_stack([curve.mean_gap, curve.pressure]), delimiter=",", header="mean_gap (m),pressure (Pa)", comments="")
    picture = tmp_path / "fit.json"
    program("fit", str(table), "--pressure-window", "0.3MPa,5MPa", "--plot", str(picture))
    title = json.loads(picture.read_text())["panels"][0]["title"]
    assert title and salebra.fit_exponential(curve, (3e5, 5e6)).figure().panels[0].title == title


def test_results_share_axes_in_si_units_and_only_with_their_like(surface: salebra.Surface) -> None:
    thin, thick = (salebra.height_histogram(salebra.BearingCurve(salebra.Surface(surface.heights * factor, 1e-3, 1e-3))) for factor in (1e-3, 1.0))
    axes = thin.plot(label="thin")
    assert thick.plot(ax=axes, label="thick", color="red") is axes
    first, second = axes.get_lines()
    assert np.ptp(second.get_xdata()) == pytest.approx(1000 * np.ptp(first.get_xdata()), rel=1e-9)
    assert (first.get_color(), second.get_color()) == ("#0072B2", "red")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["thin", "thick"]
    low, high = axes.get_xlim()
    assert low < np.min(second.get_xdata()) and high > np.max(second.get_xdata())
    assert axes.xaxis.get_major_formatter().unit == "m"
    with pytest.raises(salebra.InvalidInput, match="ax: has 1/m along y, and this panel has Pa"):
        salebra.ForceCurve(1e-6, pressure=[1e5, 2e5, 4e5], mean_gap=[3e-6, 2e-6, 1e-6], rms_height=1e-6).plot(ax=axes)
    pyplot.close("all")


def test_a_second_scale_goes_if_it_is_not_that_of_both_results() -> None:
    def panel(factor: float) -> Loaded:
        axis = {"quantity": "", "label": "", "unit": "Pa", "logarithmic": True}
        curve = Loaded(name="a", x=[1.0, 10.0], y=[1.0, 2.0], low=[], high=[], style="line", color=-1)
        second = Loaded(label="p/E", unit="", factor=factor)
        return Loaded(title="", x=Loaded(**axis), y=Loaded(**axis), second_x=second, curves=[curve], lines=[], ranges=[], equal_scales=False)

    for again, scales in ((1e-9, 1), (2e-9, 0)):
        axes = pyplot.figure().add_subplot()
        for factor in (1e-9, again, 1e-9):
            _plots._panel(axes, panel(factor), {})
        axes.figure.canvas.draw()
        assert [child.get_xlim() for child in axes.child_axes] == [pytest.approx(1e-9 * np.array(axes.get_xlim()))] * scales
    pyplot.close("all")


def test_axes_of_the_user_make_room_for_the_legend_and_the_cycle_of_the_user_is_used() -> None:
    curve = salebra.ForceCurve(1e-6, pressure=[1e5, 2e5, 4e5], mean_gap=[3e-6, 2e-6, 1e-6], rms_height=1e-6)
    with matplotlib.rc_context({"axes.prop_cycle": matplotlib.cycler(color=["#123456", "#654321"])}):
        figure, (left, right) = pyplot.subplots(1, 2)
        before = right.get_position()
        curve.plot(ax=right)
    assert right.get_lines()[0].get_color() == "#123456"
    figure.canvas.draw()
    legend = right.get_legend().get_window_extent()
    assert not any(legend.overlaps(ax.bbox) for ax in (left, right)) and legend.y0 >= 0
    assert right.get_position().y0 > before.y0 and right.get_position().y1 == pytest.approx(before.y1)
    with pytest.raises(salebra.InvalidInput, match="panel: 9 is none of the panels of this figure: 0 pressure$"):
        curve.plot(panel=9)
    pyplot.close("all")


def test_pictures_for_a_journal_have_its_width_and_text_as_text(tmp_path: Path, figures: dict[str, Any]) -> None:
    figure = figures["ForceCurve"]
    figure.save(tmp_path / "a.svg", "85mm")
    figure.save(tmp_path / "a.pdf", width=0.085)
    figure.save(tmp_path / "a.json")
    drawn = (tmp_path / "a.svg").read_text()
    assert float(re.search(r'width="([\d.]+)pt"', drawn)[1]) == pytest.approx(85 / 25.4 * 72, rel=1e-4)
    assert ">mean gap ū (µm)</text>" in drawn and "<script" not in drawn
    assert b"/FontFile2" in (tmp_path / "a.pdf").read_bytes()
    assert (tmp_path / "a.json").read_text() == figure.json()
    check("loaded", figure_of(tmp_path / "a.json"), COLUMN)
    with pytest.raises(salebra.InvalidInput, match="exists; overwrite it with overwrite=True"):
        figure.save(tmp_path / "a.svg")
    with pytest.raises(salebra.InvalidInput, match="must end in .png, .svg, .pdf or .json"):
        figure.save(tmp_path / "a.gif")
    with pytest.raises(salebra.InvalidInput, match="width: 5e-05 must be >= 0.06 and <= 1 m"):
        figure.plot("50um")


def test_notebooks_show_a_picture_above_the_table(monkeypatch: pytest.MonkeyPatch, figures: dict[str, Any]) -> None:
    pyplot.close("all")
    large = generated(256)
    for result in (large, salebra.fit_exponential(salebra.sweep_pressures(generated(), 1e9, np.geomspace(1e5, 5e6, 8))), figures["FrictionMap"]):
        shown = result._repr_html_()
        assert shown.startswith("<svg") and shown.index("</svg>") < shown.index("<table>")
        assert "<script" not in shown and len(shown.encode()) < 200_000
    assert not pyplot.get_fignums()
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    assert large._repr_html_().startswith("<table>")
    with pytest.raises(ImportError, match="plot needs matplotlib; install it"):
        large.plot()


def test_the_caption_of_a_cycle_has_its_mean_force() -> None:
    grid = salebra.Grid2D(32, 32, 1e-3, 1e-3)
    surface = salebra.paraboloid_surface(grid, 4e-3, salebra.off_grid_center(grid))
    material = salebra.Material(1e9, poisson=0.3)
    contacts = salebra.boundary_element_contact_sets(surface, material, tolerance=1e-6, boundary="free")
    motion = salebra.EqualFrequency(normal_amplitude=6e-6, tangential_amplitude=1e-6, phase=0.8)
    cycle = salebra.simulate_cycle(contacts, material, motion, 2e-5, steps=8, boundary="free")
    # Both ends of the period are samples: a mean over all of them would count the end twice.
    mean = float(np.mean(cycle.normal_force[1:]))
    found = re.search(r"F = ([\d.]+) N", cycle.figure().caption)
    assert found and float(found[1]) == pytest.approx(mean, rel=1e-3)
