"""States guessed with the help of other spokes: fewer iterations, the same table."""

import numpy as np
import pytest

from nptcs.config.fe import EnergyTableOptions, FeModel, SpokeGeometry, SpokeMesh
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.coordinates import motion_of
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeFields, SpokeModel
from nptcs.fe.spoke.neighbours import CorrectionsFolder, kriging_weights
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.sampling import START, Grid, sampled_states
from nptcs.tables.material_card import PUBLISHED_PLY

OPTIONS = EnergyTableOptions(
    elongation_mm=(-14.0, 4.0), inclination_rad=0.09, phi_rad=(-0.08, 0.08), samples=(6, 3, 3),
    degrees=(8, 4),
)  # fmt: skip
COARSE = SpokeMesh(rows=(1, 1, 1, 1, 1, 1))
HEIGHT = SpokeGeometry().height_mm
MODEL = FeModel(spoke_mesh=COARSE, table=OPTIONS)
ANGLES = (20.0, 30.0, 45.0)


def design(angle_deg, **change):
    values = {
        "geometry": SpokeGeometry(),
        "mesh": COARSE,
        "pitch_mm": 15.0,
        "plate_width_mm": 5.0,
        "thickness_mm": 1.8,
        "angle_deg": angle_deg,
        "c10_mpa": 1.0,
        "ply": PUBLISHED_PLY,
        "plates": 14,
        "plate_coupling": "embedded",
    }
    return SpokeDesign(**{**values, **change})


@pytest.fixture
def counted(monkeypatch):
    """Count the factorisations."""
    calls = []
    respond = SpokeModel._respond
    monkeypatch.setattr(SpokeModel, "_respond", lambda self, u: calls.append(1) or respond(self, u))
    return calls


def probes():
    """Motions all over the table, its corners with them."""
    s = np.repeat(np.linspace(-14.0, 4.0, 10), 9)
    part = np.where(s < 0, 1.0 - 0.4 * s / -14.0, 1.0)
    beta, phi = np.meshgrid([-0.09, 0.0, 0.09], [-0.08, 0.0, 0.08])
    beta, phi = (np.tile(side.ravel(), 10) * part for side in (beta, phi))
    return motion_of(np.stack([s, beta, phi], axis=1), HEIGHT)[0]


def force_of(table):
    return table.evaluate(probes())[1][:, 0]


def secant(table, load_n=1000.0):
    """Stiffness of the tyre on spokes with this table, N/mm."""
    tyre = tyre_model(MODEL, TyreGeometry(), table, 5.0)
    return load_n / tyre.load([500.0, load_n]).rise_mm


def test_the_order_of_the_spokes_does_not_change_their_results(tmp_path, counted):
    orders = {"up": ANGLES, "down": ANGLES[::-1]}
    tables, spent = {}, {}
    for name, angles in orders.items():
        for angle in angles:
            before = len(counted)
            tables[name, angle] = shared_table(MODEL, design(angle), tmp_path / name)
            spent[name, angle] = len(counted) - before
    # the last of each order has two spokes to learn from, the first none
    assert spent["up", 45.0] < 0.85 * spent["down", 45.0]
    assert spent["down", 20.0] < 0.85 * spent["up", 20.0]
    for angle in ANGLES:
        up, down = (force_of(tables[name, angle]) for name in orders)
        assert np.abs(up - down).max() < 3e-4 * np.abs(up).max()
    for angle in (ANGLES[0], ANGLES[-1]):
        up, down = (secant(tables[name, angle]) for name in orders)
        assert up == pytest.approx(down, rel=1e-4)


def test_a_guess_that_misleads_does_not_change_the_states():
    model = SpokeModel(design(30.0), OPTIONS.accepted_work)
    alone = sampled_states(model, OPTIONS)

    def misleading(place):
        own = alone.corrections[place]
        wrong = np.random.default_rng(abs(hash(place)) % 2**32).normal(
            0.0, 0.05, own.displacement.shape
        )
        return SpokeFields(own.displacement + wrong, [30.0 + p for p in own.pressures])

    misled = sampled_states(model, OPTIONS, misleading)
    for place, state in alone.states.items():
        size = max(abs(state.energy), 1e-3)
        assert misled.states[place].energy == pytest.approx(state.energy, abs=1e-5 * size)


def test_rows_take_turns_and_the_middle_one_has_every_level():
    grid = Grid(OPTIONS, HEIGHT)
    rows = grid.rows()
    middle = next(
        row for row in rows if row.beta == pytest.approx(0) and row.phi == pytest.approx(0)
    )
    assert middle.levels == tuple(range(6))
    for row in rows:
        if row is not middle:
            assert len(row.levels) == 3
    by_place = {(round(row.beta, 3), round(row.phi, 3)): row for row in rows}
    assert by_place[0.09, 0.0].levels != by_place[0.09, 0.08].levels


def test_a_row_that_loses_its_stability_ends_the_table_at_its_last_level(monkeypatch):
    model = SpokeModel(design(30.0), OPTIONS.accepted_work)
    grid = Grid(OPTIONS, HEIGHT)
    side = next(row for row in grid.rows() if row.beta > 0 and row.levels == (0, 2, 4))
    limit = grid.motions(side, [1])[0]
    found = SpokeModel.next_state

    def unstable(motion):
        same_turn = abs(motion[2]) > 1e-6 and np.sign(motion[2]) == np.sign(limit[2])
        return same_turn and motion[1] > 1e-6 and motion[0] < limit[0] - 1e-6

    def next_state(self, before, last, motion, correction=None):
        if unstable(motion):
            raise SpokeError("unstable")
        return found(self, before, last, motion, correction)

    monkeypatch.setattr(SpokeModel, "next_state", next_state)
    states = sampled_states(model, OPTIONS).states
    levels = {level for _, level in states}
    # level 0 fails in that row; level 1, which it leaves out, is found and kept
    assert levels == {START, 1, 2, 3, 4, 5}
    assert (side.number, 1) in states


def test_weights_of_neighbours_add_up_to_one_and_hit_the_known():
    sites = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 2.0], [0.5, 0.5]])
    weights = kriging_weights(sites, np.array([0.4, 0.6]))
    assert weights.sum() == pytest.approx(1.0, abs=1e-9)
    assert kriging_weights(sites, sites[2]) == pytest.approx([0, 0, 1, 0], abs=1e-4)
    assert kriging_weights(np.vstack([sites, sites[:1]]), sites[0]).sum() == pytest.approx(1.0)


def test_neighbours_are_spokes_of_the_same_kind_and_sound_files(tmp_path):
    def keep(angle, **change):
        own = design(angle, **change)
        mesh = SpokeModel(own).mesh
        fields = SpokeFields(np.full((len(mesh.positions), 3), angle), [np.zeros((2, 1))])
        CorrectionsFolder(tmp_path, own, OPTIONS).keep({(0, 1): fields})

    keep(30.0)
    keep(45.0, plate_coupling="conforming")
    own = CorrectionsFolder(tmp_path, design(40.0), OPTIONS)
    assert own.neighbours().correction((0, 1)) is None  # one alone extrapolates nothing
    keep(50.0)
    correction = own.neighbours().correction((0, 1))
    assert 30.0 < correction.displacement[0, 0] < 50.0
    assert own.neighbours().correction((0, 2)) is None
    next(tmp_path.glob("guesses/*/*_1.11*.npz")).write_bytes(b"")
    assert own.neighbours().correction((0, 1)) is None
