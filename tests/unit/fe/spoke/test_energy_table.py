from itertools import product

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from small_tyres import COARSE_SPOKE, spoke_design

from nptcs.config.solvers.fe import EnergyTableOptions, FeModel, SpokeGeometry, SpokeMesh
from nptcs.fe.energy_cache import read_energy_table, shared_table, table_key, write_energy_table
from nptcs.fe.spoke.coordinates import (
    carried,
    coordinates_of,
    elongations_at,
    motion_of,
    straight_elongation_mm,
    unit_elongation,
)
from nptcs.fe.spoke.energy_table import SpokeSamples, TableRangeError, chebyshev_nodes, fit_energy
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.sampling import sample_spoke
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

OPTIONS = EnergyTableOptions(
    elongation_mm=(-6.0, 3.0), inclination_rad=0.045, phi_rad=(-0.04, 0.04), samples=(4, 3, 3),
    degrees=(6, 4), narrowing=1.0,
)  # fmt: skip
SAMPLE_FIELDS = ("coordinates", "energy", "force", "tangent")
GEOMETRY = SpokeGeometry()
HEIGHT = GEOMETRY.height_mm


def manufactured(coordinates):
    """E = s² (1 + 40 β²) + 300 φ² + 2 s φ + 5000 β², with its derivatives."""
    s, beta, phi = coordinates.T
    energy = s**2 * (1 + 40 * beta**2) + 300 * phi**2 + 2 * s * phi + 5000 * beta**2
    force = np.stack(
        [
            2 * s * (1 + 40 * beta**2) + 2 * phi,
            80 * s**2 * beta + 10000 * beta,
            600 * phi + 2 * s,
        ],
        axis=1,
    )
    tangent = np.zeros((len(coordinates), 3, 3))
    tangent[:, 0, 0] = 2 * (1 + 40 * beta**2)
    tangent[:, 0, 1] = tangent[:, 1, 0] = 160 * s * beta
    tangent[:, 1, 1] = 80 * s**2 + 10000
    tangent[:, 2, 2] = 600
    tangent[:, 0, 2] = tangent[:, 2, 0] = 2
    return SpokeSamples(coordinates, energy, force, tangent)


def grid_samples():
    """States with β ≥ 0, as `sample_spoke` computes them."""
    sides = chebyshev_nodes(-OPTIONS.inclination_rad, OPTIONS.inclination_rad, OPTIONS.samples[1])
    lines = [
        chebyshev_nodes(*OPTIONS.elongation_mm, OPTIONS.samples[0]),
        sides[sides > -1e-12],
        chebyshev_nodes(*OPTIONS.phi_rad, OPTIONS.samples[2]),
    ]
    return manufactured(np.stack(np.meshgrid(*lines), axis=-1).reshape(-1, 3))


TABLE = fit_energy(grid_samples(), OPTIONS, GEOMETRY)
CHORDS = st.tuples(st.floats(-6.0, 3.0), st.floats(-0.045, 0.045), st.floats(-0.04, 0.04))


@given(CHORDS)
@example((0.0, 0.045, 0.004))  # s comes back as -1.4e-14, where β's range is already narrower
@settings(max_examples=40, deadline=None)
def test_a_polynomial_energy_is_recovered_everywhere(coordinates):
    coordinates = np.array([coordinates])
    motion, first, second = motion_of(coordinates, HEIGHT)
    energy, force, tangent = TABLE.evaluate(motion)
    wanted = manufactured(coordinates)
    assert energy == pytest.approx(wanted.energy, abs=1e-8)
    assert carried(force, tangent, first, second)[0] == pytest.approx(wanted.force, abs=1e-6)
    assert carried(force, tangent, first, second)[1] == pytest.approx(wanted.tangent, abs=1e-4)


@given(CHORDS)
@settings(max_examples=20, deadline=None)
def test_forces_and_tangents_are_derivatives_by_the_motion(coordinates):
    motion = motion_of(0.9 * np.array([coordinates]), HEIGHT)[0]
    _, force, tangent = TABLE.evaluate(motion)
    for axis, step in enumerate((1e-4, 1e-4, 1e-6)):
        shift = step * np.eye(3)[axis]
        ahead, behind = TABLE.evaluate(motion + shift), TABLE.evaluate(motion - shift)
        slope = (ahead[0] - behind[0]) / (2 * step)
        assert slope == pytest.approx(force[:, axis], rel=1e-6, abs=1e-4)
        curve = (ahead[1] - behind[1]) / (2 * step)
        assert curve == pytest.approx(tangent[:, axis], rel=1e-6, abs=1e-3)


def test_leaving_the_table_is_an_error_that_names_the_spoke():
    motion = np.array([[0.0, 0.0, 0.0], [-7.0, 0.0, 0.0]])
    with pytest.raises(TableRangeError, match=r"spoke 1: elongation \(mm\) = -7"):
        TABLE.evaluate(motion)
    with pytest.raises(TableRangeError):
        TABLE.evaluate(np.array([[np.nan, 0.0, 0.0]]))


@pytest.mark.parametrize("corner", list(product((-6.0, 3.0), (-0.045, 0.045), (-0.04, 0.04))))
def test_the_table_ends_at_its_corners(corner):
    inside = np.array([corner])
    TABLE.evaluate(motion_of(inside, HEIGHT)[0])
    for axis in range(3):
        beyond = inside.copy()
        beyond[0, axis] *= 1.0 + 1e-9
        with pytest.raises(TableRangeError):
            TABLE.evaluate(motion_of(beyond, HEIGHT)[0])


LIMITS = (-40.0, 8.0)
STRAIGHT = straight_elongation_mm(HEIGHT, GEOMETRY.leg_angle_deg, LIMITS[1])


@given(st.floats(-40.0, 10.0))
@settings(max_examples=40, deadline=None)
def test_the_variable_of_the_elongation_has_these_derivatives(elongation):
    s, step = np.array([elongation]), 1e-4
    ahead, behind = (unit_elongation(s + d, LIMITS, STRAIGHT) for d in (step, -step))
    _, slope, curve = unit_elongation(s, LIMITS, STRAIGHT)
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope, rel=1e-6)
    if abs(elongation - LIMITS[1]) > step:
        assert (ahead[1] - behind[1]) / (2 * step) == pytest.approx(curve, rel=1e-5)


@pytest.mark.parametrize("straight", [STRAIGHT, 1e12])
def test_elongations_and_their_variable_belong_together(straight):
    x = np.linspace(-1.0, 1.0, 9)
    s = elongations_at(x, LIMITS, straight)
    assert s[[0, -1]] == pytest.approx(LIMITS)
    assert unit_elongation(s, LIMITS, straight)[0] == pytest.approx(x, abs=1e-9)


def test_the_legs_are_in_one_line_beyond_the_table():
    assert pytest.approx(HEIGHT / np.cos(np.radians(29.5)) - HEIGHT) == STRAIGHT
    # steep legs would be straight within the range: they stretch there
    assert straight_elongation_mm(HEIGHT, 10.0, 8.0) == 12.0


def hinged_legs(s):
    """Force and stiffness along the line of two rigid legs with a spring in the hinge, E = θ²/2."""
    leg = HEIGHT / 2.0 / np.cos(np.radians(GEOMETRY.leg_angle_deg))
    inclination = np.arccos((HEIGHT + s) / (2.0 * leg))
    turn = 2.0 * (np.radians(GEOMETRY.leg_angle_deg) - inclination)
    by_s = 1.0 / (leg * np.sin(inclination))
    bend = np.cos(inclination) / (2.0 * leg**2 * np.sin(inclination) ** 3)
    return 0.5 * turn**2, turn * by_s, by_s**2 + turn * bend


def misfit(straight):
    """Largest relative error of the stiffness of hinged legs, by a polynomial of degree 11."""
    s = elongations_at(-np.cos(np.pi * np.arange(7) / 6), LIMITS, straight)
    energy, force, stiffness = hinged_legs(s)
    x, slope, curve = unit_elongation(s, LIMITS, straight)
    along = force / slope
    rows = [
        np.array([np.polynomial.Chebyshev.basis(i).deriv(order)(x) for i in range(12)]).T
        for order in range(3)
    ]
    data = np.concatenate([energy, along, (stiffness - along * curve) / slope**2])
    terms = np.linalg.lstsq(np.concatenate(rows), data, rcond=None)[0]
    fitted = np.polynomial.Chebyshev(terms)
    s = np.linspace(*LIMITS, 200)
    x, slope, curve = unit_elongation(s, LIMITS, straight)
    found = fitted.deriv(2)(x) * slope**2 + fitted.deriv()(x) * curve
    return float(np.abs(found / hinged_legs(s)[2] - 1.0).max())


def test_legs_that_straighten_need_the_root():
    assert misfit(STRAIGHT) < 1e-3
    assert misfit(1e12) > 0.02


def test_more_terms_than_data_are_refused():
    few = OPTIONS.model_copy(update={"degrees": (6, 12)})
    with pytest.raises(ValueError, match="lower the degrees"):
        fit_energy(grid_samples(), few, GEOMETRY)


def test_a_table_that_ends_early_has_a_lower_degree():
    samples = grid_samples()
    kept = samples.coordinates[:, 0] > -4.0
    short = SpokeSamples(*(getattr(samples, name)[kept] for name in SAMPLE_FIELDS))
    table = fit_energy(short, OPTIONS, GEOMETRY)
    assert table.exponents[:, 0].max() == 4
    assert table.low[0] > -4.0


def test_the_table_of_a_spoke_predicts_states_between_its_samples():
    model = SpokeModel(spoke_design())
    table = fit_energy(sample_spoke(model, OPTIONS), OPTIONS, GEOMETRY)
    for motion in ([-4.1, 1.3, 0.02], [1.9, -0.7, -0.03]):
        state = model.move(model.rest(), np.array(motion))
        energy, force, _ = table.evaluate(np.array([motion]))
        assert energy[0] == pytest.approx(state.energy, rel=2e-3)
        assert force[0, 0] == pytest.approx(state.force[0], rel=5e-3)


def test_a_level_of_the_unloaded_spoke_is_one_state():
    options = EnergyTableOptions(
        elongation_mm=(-1.5, 1.5), inclination_rad=0.02, phi_rad=(-0.02, 0.02), samples=(3, 3, 3),
        degrees=(4, 4),
    )  # fmt: skip
    every = options.model_copy(update={"side_states": "every"})
    coordinates = sample_spoke(SpokeModel(spoke_design()), every).coordinates
    assert len(coordinates) == 3 * 2 * 3
    assert np.unique(coordinates[:, 0].round(9)) == pytest.approx([-1.5, 0.0, 1.5])


def test_a_half_turn_leaves_the_spoke_as_it_is():
    """States at β and -β: rim and band change places, with coupled plies too."""
    model = SpokeModel(spoke_design(angle_deg=30.0))
    coordinates = np.array([[-4.0, 0.05, -0.03], [-4.0, -0.05, -0.03]])
    motions = motion_of(coordinates, HEIGHT)[0]
    assert coordinates_of(motions, HEIGHT)[0] == pytest.approx(coordinates, abs=1e-12)
    assert abs(motions[0, 1] + motions[1, 1]) > 1.0
    states = [model.move(model.rest(), motion) for motion in motions]
    assert states[0].energy == pytest.approx(states[1].energy, rel=1e-9)
    force = np.array([state.force for state in states])
    tangent = np.array([state.tangent for state in states])
    force, tangent = carried(force, tangent, *motion_of(coordinates, HEIGHT)[1:])
    mirror = np.array([1.0, -1.0, 1.0])
    assert force[1] == pytest.approx(mirror * force[0], rel=1e-6)
    # tangents are those of the last iterate, where the work left is 1e-9 of the energy
    size = np.sqrt(np.diag(tangent[0]))
    mirrored = np.outer(mirror, mirror) * tangent[0]
    assert np.abs((tangent[1] - mirrored) / np.outer(size, size)).max() < 2e-4


def test_equal_spokes_share_one_file(tmp_path, monkeypatch):
    calls = []

    def computed(design, options):
        calls.append(design)
        return TABLE

    monkeypatch.setattr("nptcs.fe.energy_cache.computed_table", computed)
    model = FeModel(spoke_mesh=COARSE_SPOKE, table=OPTIONS)
    first = shared_table(model, spoke_design(), tmp_path)
    again = shared_table(model, spoke_design(), tmp_path)
    assert len(calls) == 1
    assert again.coefficients == pytest.approx(first.coefficients, rel=0, abs=0)
    shared_table(model, spoke_design(c10_mpa=2.0), tmp_path)
    assert len(calls) == 2
    assert len(list(tmp_path.glob("*.npz"))) == 2
    key = table_key(spoke_design(), OPTIONS)
    path = tmp_path / f"{key}.npz"
    assert read_energy_table(path, key).force_residual_n == TABLE.force_residual_n


@pytest.mark.parametrize("harm", ["emptied", "cut", "renamed", "doubled", "not a number"])
def test_a_table_that_is_not_sound_is_computed_again(tmp_path, harm):
    key = "a" * 64
    path = tmp_path / f"{key}.npz"
    bad = {"doubled": 2.0 * TABLE.coefficients, "not a number": np.nan * TABLE.coefficients}
    write_energy_table(path, key, TABLE)
    assert read_energy_table(path, key) is not None
    whole = path.read_bytes()
    if harm == "emptied":
        path.write_bytes(b"")
    elif harm == "cut":
        path.write_bytes(whole[: len(whole) // 2])
    elif harm == "renamed":
        key = "b" * 64
        path = path.rename(tmp_path / f"{key}.npz")
    else:
        with np.load(path) as data:
            content = {**data, "coefficients": bad[harm]}
        np.savez(path, **content)
    assert read_energy_table(path, key) is None


def test_every_part_of_the_design_is_in_the_key():
    base = table_key(spoke_design(), OPTIONS)
    other_ply = {**PUBLISHED_PLY, "g23_mpa": 2301.0}
    changes = [
        {"angle_deg": 46.0},
        {"ply": other_ply},
        {"geometry": SpokeGeometry(block_thickness_mm=12.5)},
        {"mesh": SpokeMesh()},
        {"plates": 13},
        {"plate_coupling": "conforming"},
    ]
    keys = {table_key(spoke_design(**change), OPTIONS) for change in changes}
    keys.add(table_key(spoke_design(), EnergyTableOptions()))
    assert len(keys) == 7
    assert base not in keys
