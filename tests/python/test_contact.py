# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact: against analytic results, and against itself from Python's side."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import salebra
from conftest import generated


def test_hertz_pressure_and_force_of_a_paraboloid() -> None:
    grid = salebra.Grid2D(128, 128, 2e-3, 2e-3)
    radius, modulus, indentation = 10e-3, 1e9, 20e-6
    surface = salebra.paraboloid_surface(grid, radius, salebra.off_grid_center(grid))
    state = salebra.press(surface, modulus, indentation=indentation, boundary="free")
    assert state.converged
    # Hertz: F = 4/3 E* sqrt(R) d^(3/2), p0 = 2/pi E* sqrt(d/R). 28 cells in the radius: below 1 %.
    assert state.force == pytest.approx(4 / 3 * modulus * math.sqrt(radius * indentation**3), rel=5e-3)
    assert state.contact_pressure.max() == pytest.approx(2 / math.pi * modulus * math.sqrt(indentation / radius), rel=1e-2)


def test_westergaards_full_contact_closes_the_gap() -> None:
    grid = salebra.Grid2D(64, 64, 1e-3, 1e-3)
    amplitude, modulus = 1e-6, 1e9
    surface = salebra.sinusoid_surface(grid, amplitude, 1, 0)
    full = math.pi * modulus * amplitude / grid.lx
    state = salebra.press(surface, modulus, pressure=1.01 * full)
    # One Fourier mode: no discretisation error.
    assert state.contact_area_fraction == 1.0
    assert state.contact_pressure.max() == pytest.approx(2.01 * full, rel=1e-9)


def test_fields_of_a_state_are_views_that_keep_it(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=1e5)
    pressure = state.contact_pressure
    assert np.shares_memory(pressure, state.contact_pressure)
    assert pressure.mean() == pytest.approx(1e5, rel=1e-9)
    del state
    assert pressure.mean() == pytest.approx(1e5, rel=1e-9)


def test_a_mean_gap_gives_back_its_pressure(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=2e5)
    back = salebra.press(surface, 1e9, mean_gap=state.mean_gap)
    assert back.mean_pressure == pytest.approx(2e5, rel=1e-6)


def test_a_start_from_the_answer_takes_few_iterations(surface: salebra.Surface) -> None:
    cold = salebra.press(surface, 1e9, pressure=2e5)
    warm = salebra.press(surface, 1e9, pressure=2e5, initial_pressure=cold.contact_pressure)
    assert warm.converged
    assert warm.iterations < cold.iterations
    # The array that was lent is as it was.
    assert cold.contact_pressure.mean() == pytest.approx(2e5, rel=1e-9)


def test_stiffness_is_the_derivative_of_the_force(surface: salebra.Surface) -> None:
    low, middle, high = (salebra.press(surface, 1e9, pressure=2e5 * factor) for factor in (0.98, 1.0, 1.02))
    difference = (high.force - low.force) / (high.indentation - low.indentation)
    # The contact grows between: second order in 2 %, and cells that enter at once.
    assert salebra.normal_stiffness(middle) == pytest.approx(difference, rel=0.02)


def test_non_convergence_is_returned_not_raised(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=2e5, max_iterations=1, tolerance=1e-13)
    assert not state.converged and state.termination == "iteration_limit"
    assert state.residual > 1e-13


def test_a_sweep_has_the_samples_of_single_solves(surface: salebra.Surface, material: salebra.Material) -> None:
    pressures = np.geomspace(2e4, 2e6, 6)
    curve = salebra.sweep_pressures(surface, material, pressures)
    assert curve.converged.all()
    assert np.allclose(curve.pressure, pressures, rtol=1e-12)
    single = salebra.press(surface, 1e9, pressure=pressures[3])
    assert curve.mean_gap[3] == pytest.approx(single.mean_gap, rel=1e-9)
    assert np.allclose(curve.tangential_stiffness, material.modulus_ratio * curve.normal_stiffness, rtol=1e-14)
    assert not curve.mean_gap.flags.owndata


def test_stick_stiffness_of_a_round_contact_is_the_ratio_of_moduli(material: salebra.Material) -> None:
    grid = salebra.Grid2D(96, 96, 1e-3, 1e-3)
    x, y = np.meshgrid(np.arange(96) - 47.6, np.arange(96) - 47.8, indexing="ij")
    contact = np.hypot(x, y) < 20
    punch = salebra.punch_stiffness(contact, grid, material.contact_modulus, boundary="free")
    stick = salebra.stick_stiffness(contact, grid, material, boundary="free")
    assert punch.converged and stick.converged
    # Mindlin: exactly G*/E* for a circle; the jagged edge of 20 cells is good for a few per mille.
    assert stick.xx / punch.normal_stiffness == pytest.approx(material.modulus_ratio, rel=5e-3)


def test_contact_spots_add_up_to_the_contact(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=5e5)
    spots = salebra.contact_spots(state)
    assert spots.force.sum() == pytest.approx(state.force, rel=1e-12)
    assert spots.area.sum() == pytest.approx(state.contact_area_fraction * surface.area, rel=1e-12)


def test_greenwood_williamson_with_exponential_heights_is_the_exponential_law(material: salebra.Material) -> None:
    ensemble = salebra.SummitEnsemble(summit_density=1e9, radius=1e-5, summit_rms=1e-7, distribution="exponential")
    model = salebra.StatisticalSummits(ensemble, material, 1e-6)
    law = salebra.GreenwoodWilliamsonLaw(model)
    exponential = salebra.ExponentialLaw(law.force(-3e-7), 1e-7, material.modulus_ratio)
    steps = np.linspace(-2e-7, 1e-7, 7)
    # F = F0 exp(-s/sigma) exactly, and delta = -s.
    assert np.allclose(law.force(steps - 3e-7), exponential.force(steps), rtol=1e-12)
    assert np.allclose(law.force_curvature(steps - 3e-7), exponential.force_curvature(steps), rtol=1e-12)


def test_perssons_area_has_its_slope() -> None:
    pressure = np.array([1e-4, 1e-3]) * 1e8
    area = salebra.persson_area_fraction(pressure, 1e9, 0.1)
    # erf(x) = 2x/sqrt(pi) (1 - x^2/3): 3e-7 off at p = 1e-3 E*h'.
    assert np.allclose(area, math.sqrt(8 / math.pi) * pressure / 1e8, rtol=1e-6)
    assert isinstance(salebra.bgt_area_fraction(1e4, 1e9, 0.1), float)


def test_mdr_of_a_cone_is_the_power_law(material: salebra.Material) -> None:
    angle = 0.1
    law = salebra.IndenterLaw(salebra.cone_profile(angle), material)
    power = salebra.PowerLaw(2 * material.contact_modulus / (math.pi * math.tan(angle)), 2, material.modulus_ratio)
    indentation = np.array([[1e-6, 2e-6], [3e-6, 4e-6]])
    assert law.force(indentation).shape == (2, 2)
    assert np.allclose(law.force(indentation), power.force(indentation), rtol=1e-12)


def test_the_curve_of_the_user_becomes_a_law() -> None:
    indentation = np.linspace(0, 1e-7, 40)
    force = 2.0 * np.exp(indentation / 3e-8)
    curve = salebra.ForceCurve(1e-6, indentation=indentation, force=force)
    assert np.allclose(curve.pressure, force * 1e6, rtol=1e-14)
    law = salebra.TabulatedLaw(curve, 0.8)
    # ln F is straight: the interpolation is exact.
    assert law.force(5.05e-8) == pytest.approx(2.0 * math.exp(5.05e-8 / 3e-8), rel=1e-12)
    with pytest.raises(salebra.InvalidInput, match="force: 40 values, unlike"):
        salebra.ForceCurve(1e-6, force=force, mean_gap=[1.0, 2.0, 3.0])


def test_the_fit_finds_the_decay_length_of_an_exponential() -> None:
    gap = np.linspace(1e-6, 2.5e-6, 12)
    curve = salebra.ForceCurve(1e-6, mean_gap=gap, pressure=1e9 * np.exp(-gap / 4e-7), rms_height=1e-6)
    fit = salebra.fit_exponential(curve)
    assert fit.decay_length == pytest.approx(4e-7, rel=1e-10)
    part = salebra.fit_exponential(curve, (float(curve.pressure[2]), float(curve.pressure[8])))
    assert part.window.points == 7


def test_a_plastic_limit_caps_the_pressure() -> None:
    state = salebra.press(generated(), 1e9, pressure=2e5, hardness=1e7)
    assert state.converged
    assert state.contact_pressure.max() <= 1e7


def test_what_flowed_carries_the_first_load_by_elasticity_alone() -> None:
    surface = generated()
    plastic = salebra.press(surface, 1e9, pressure=2e5, hardness=1e7)
    residual, loading = salebra.after_first_loading(surface, 1e9, 2e5, hardness=1e7)
    assert loading.yielded
    assert loading.first_loading_pressure == pytest.approx(2e5)
    assert loading.max_plastic_depth == pytest.approx((surface.heights - residual.heights).max())
    elastic = salebra.press(residual, 1e9, pressure=2e5)
    # The tolerance of 1e-10 holds for gaps, its root for pressures.
    assert elastic.mean_gap == pytest.approx(plastic.mean_gap, rel=1e-6)
    assert elastic.contact_pressure.max() == pytest.approx(1e7, rel=1e-3)
    same, nothing = salebra.after_first_loading(surface, 1e9, 2e5, hardness=1e12)
    assert np.array_equal(same.heights, surface.heights)
    assert not nothing.yielded
    with pytest.raises(salebra.InvalidInput, match="hardness"):
        salebra.after_first_loading(surface, 1e9, 2e5, hardness=1e5)


def test_a_modulus_without_its_unit_is_doubted(surface: salebra.Surface) -> None:
    for call in (lambda: salebra.press(surface, 115, pressure=1e6), lambda: salebra.sweep_pressures(surface, salebra.Material(115), [1e6])):
        with pytest.warns(UserWarning, match=r"a nominal pressure of 1 MPa is 8696 times E\* = 115 Pa, .*; check the units"):
            call()


def test_conductance_is_the_stiffness_times_a_constant(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=2e5)
    stiffness = salebra.normal_stiffness(state)
    assert salebra.contact.electrical_conductance(stiffness, 1e9, 1e-8, 3e-8) == pytest.approx(2 * stiffness / (1e9 * 4e-8))
    both = salebra.contact.thermal_conductance(np.array([stiffness, 2 * stiffness]), 1e9, 50.0)
    assert np.allclose(both, np.array([1, 2]) * stiffness * 50.0 / 1e9)
    with pytest.raises(salebra.InvalidInput, match="resistivity"):
        salebra.contact.electrical_conductance(stiffness, 1e9, 0.0)


def test_flow_and_densities_of_a_gap(surface: salebra.Surface) -> None:
    state = salebra.press(surface, 1e9, pressure=2e5)
    flow = salebra.contact.flow_factors(state)
    assert flow.converged and flow.percolates_x and flow.percolates_y
    # Where something touches, the flow is less than between smooth walls.
    assert 0 < flow.pressure_flow_factor_x < 1
    assert flow.mean_gap == pytest.approx(state.mean_gap, rel=1e-9)
    densities = salebra.contact.contact_distributions(state, bins=50)
    whole = densities.pressure_density.sum() * densities.pressure_width + densities.gap_density.sum() * densities.gap_width
    assert whole == pytest.approx(1, rel=1e-12)
    with pytest.raises(salebra.InvalidInput, match="free boundary"):
        salebra.contact.flow_factors(salebra.press(surface, 1e9, indentation=1e-9, boundary="free"))


def test_adhesion_pulls_comes_off_and_loses_work(surface: salebra.Surface) -> None:
    grid = salebra.Grid2D(48, 48, 48e-6, 48e-6)
    spectrum = salebra.SelfAffineSpectrum(hurst=0.8, rolloff=48e-6, short_cutoff=24e-6, rms_slope=0.2)
    rough = salebra.filtered_noise(grid, spectrum, seed=3)
    adhesion = salebra.contact.Adhesion(work=0.3, range=2e-6)
    state = salebra.contact.press_adhesive(rough, 1e6, adhesion, pressure=5e4)
    assert state.converged and not state.detached
    assert state.mean_pressure == pytest.approx(state.contact_pressure.mean() - state.tension.mean(), rel=1e-9)
    assert salebra.normal_stiffness(state) > 0  # it is a NormalContactState to everything that takes one
    assert salebra.contact.press_adhesive(rough, 1e6, adhesion, pressure=-2e5, start=state).detached
    yielded = salebra.contact.press_adhesive(rough, 1e6, adhesion, pressure=5e4, hardness=1e5)
    assert (yielded.contact_pressure - yielded.tension).max() == pytest.approx(1e5, rel=1e-3)
    assert yielded.contact_area_fraction > state.contact_area_fraction
    touch = rough.heights.max() - rough.heights.mean()
    cycle = salebra.contact.adhesive_cycle(rough, 1e6, adhesion, mean_gaps=np.linspace(touch + 30e-6, 0.05 * touch, 20))
    assert cycle.converged and cycle.pull_off_pressure > 0
    assert abs(cycle.adhesion_work_per_cycle) <= cycle.adhesion_work_error  # held by its gap, it snaps nowhere
    assert cycle.unloading.mean_gap[-1] == pytest.approx(cycle.loading.mean_gap[0], rel=1e-9)


def test_an_adhesive_ball_is_between_jkr_and_dmt() -> None:
    radius, modulus, work = 10e-6, 1e6, 0.05
    jkr = salebra.contact.jkr_pull_off(salebra.paraboloid_profile(radius), modulus, work).force
    assert jkr == pytest.approx(-1.5 * math.pi * work * radius, rel=1e-9)
    dmt = salebra.contact.dmt_contact(radius, modulus, work, 0.0 + 1e-12).force
    between = salebra.contact.MaugisDugdale(radius, modulus, work, 1e-6).pull_off().force
    assert dmt < between < jkr
    ball = salebra.contact.MaugisDugdale(radius, modulus, work, 1e-6)
    pulled = salebra.contact.adhesive_equilibrium(ball.contact, ball.pull_off(), force=0.9 * between)
    assert pulled.force == pytest.approx(0.9 * between, rel=1e-9)
    assert pulled.contact_radius > ball.pull_off().contact_radius
    assert salebra.contact.suggested_adhesion_model(salebra.contact.tabor_parameter(radius, modulus, work, 1e-9)) == "jkr"


def test_a_law_is_exported_as_a_deck() -> None:
    law = salebra.ExponentialLaw(10, 100e-9, 0.8)
    deck = law.export("calculix", nominal_area=1e-6, friction_coefficient=0.3, units="mm,t,s")
    lines = [line for line in deck.splitlines() if not line.startswith("*")]
    c0, p0, friction, slope = (float(word) for line in lines for word in line.split(","))
    assert np.isclose(c0, 100e-6 * np.log(100)) and np.isclose(p0, 10)
    assert friction == 0.3 and np.isclose(slope, 0.8 * 10 / 100e-6)
    sliders = law.export("jenkins", friction_coefficient=0.3, sliders=50)
    rows = [line.split(",") for line in sliders.splitlines() if not line.startswith("#")][1:]
    assert len(rows) == 50
    assert np.isclose(sum(float(force) for _, force in rows), 3, rtol=1e-13)
    with pytest.raises(salebra.InvalidInput, match="nominal_area: not given"):
        law.export("abaqus")
    with pytest.raises(salebra.InvalidInput, match="format"):
        law.export("nastran")  # type: ignore[arg-type]


def test_a_body_takes_the_place_of_a_material() -> None:
    surface = generated()
    steel = salebra.contact.ElasticBody(210e9, 0.3)
    material = salebra.Material.of_bodies(steel)
    half_space = salebra.contact.Body.half_space(steel)
    expected = salebra.press(surface, material, pressure=2e8)
    state = salebra.press(surface, half_space, pressure=2e8)
    assert np.array_equal(state.contact_pressure, expected.contact_pressure)
    assert salebra.contact.normal_stiffness(state) == salebra.contact.normal_stiffness(expected)
    with pytest.raises(salebra.InvalidInput, match="contact_modulus"):
        salebra.contact.normal_stiffness(pickle.loads(pickle.dumps(state)))  # a pickle does not keep the body


def test_layers_graded_and_anisotropic_bodies_press_and_stick() -> None:
    surface = generated()
    thickness, young, poisson = 50e-6, 3e9, 0.4
    layer = salebra.contact.Body.layered([(thickness, young, poisson)])
    base = layer.measured_from("base")
    assert (layer.datum, base.datum) == ("mean_plane", "base")
    shear = young / (2 * (1 + poisson))
    assert base.compliance(0)["in_plane"] == pytest.approx(thickness / shear)
    assert layer.compliance(1e9)["across"] == pytest.approx(1 / (shear * 1e9))  # short waves: the layer alone
    curve = salebra.sweep_pressures(surface, base, [1e6, 3e6], stick=True)
    assert curve.converged.all()
    state = salebra.press(surface, base, pressure=3e6)
    assert curve.normal_stiffness[1] == pytest.approx(salebra.contact.normal_stiffness(state), rel=1e-8)
    stick = salebra.contact.stick_stiffness(state.contact_pressure > 0, surface.grid, base)
    assert curve.tangential_stiffness[1] == pytest.approx(stick.xx, rel=1e-5)
    # Springs in series: the compression of the layer adds to the motion of its mean plane.
    on_plane = salebra.contact.normal_stiffness(salebra.press(surface, layer, pressure=3e6))
    added = 1 / salebra.contact.normal_stiffness(state) - 1 / on_plane
    assert added * surface.grid.area == pytest.approx(base.compliance(0)["normal"], rel=1e-6)
    pair = salebra.contact.Body.pair(layer, salebra.contact.Body.graded(3e9, 1e-6, 0.5, 0.3))
    zinc = salebra.contact.Body.transversely_isotropic(161e9, 61e9, 50e9, 38.3e9, 63.4e9)
    for body in (pair, zinc):
        assert salebra.press(surface, body, pressure=1e6).converged
    wavenumber = np.geomspace(1e3, 1e9, 200)
    table = salebra.contact.Body.tabulated(wavenumber, [layer.compliance(q)["normal"] for q in wavenumber])
    assert salebra.press(surface, table, pressure=3e6).mean_gap == pytest.approx(state.mean_gap, rel=1e-4)
    with pytest.raises(salebra.InvalidInput, match="boundary"):
        salebra.press(surface, layer, pressure=1e6, boundary="free")
    with pytest.raises(salebra.InvalidInput, match="tangential response"):
        salebra.contact.stick_stiffness(state.contact_pressure > 0, surface.grid, table)


def test_crystals_respond_by_their_direction() -> None:
    surface = generated()
    steel = salebra.ElasticBody(210e9, 0.3)
    lame, shear = 210e9 * 0.3 / (1.3 * 0.4), 210e9 / 2.6
    isotropic = salebra.Body.cubic(lame + 2 * shear, lame, shear)
    half_space = salebra.Body.half_space(steel)
    of_crystal, expected = isotropic.compliance(1e6, 0.7), half_space.compliance(1e6)
    assert np.isnan(of_crystal["coupling"])
    for name in ("normal", "in_plane", "across", "mixed"):
        assert of_crystal[name] == pytest.approx(expected[name], rel=1e-10, abs=1e-26)
    # Silicon: a plane (001) is alike every quarter turn; (110) is not.
    c11, c12, c44 = 165.7e9, 63.9e9, 79.6e9
    silicon = salebra.Body.cubic(c11, c12, c44)
    cut = salebra.Body.cubic(c11, c12, c44, normal=(1, 1, 0), x=(0, 0, 1))
    normal = [[body.compliance(1e6, angle)["normal"] for angle in (0.3, 0.3 + np.pi / 2)] for body in (silicon, cut)]
    assert normal[0][0] == pytest.approx(normal[0][1], rel=1e-10)
    assert abs(normal[1][0] / normal[1][1] - 1) > 1e-3
    stiffness = np.zeros((6, 6))
    stiffness[:3, :3] = c12 + (c11 - c12) * np.eye(3)
    stiffness[3:, 3:] = c44 * np.eye(3)
    same = salebra.Body.anisotropic(stiffness, normal=(1, 1, 0), x=(0, 0, 1))
    gaps = [salebra.press(surface, body, pressure=1e8).mean_gap for body in (silicon, cut, same)]
    assert gaps[1] == gaps[2] != gaps[0]
    stiffness[0, 1] *= 2
    with pytest.raises(salebra.InvalidInput, match="stiffness"):
        salebra.Body.anisotropic(stiffness)
