"""States of a spoke on the grid of its table."""

import numpy as np
import pytest
from small_tyres import COARSE_SPOKE, spoke_design

from nptcs.config.solvers.fe import EnergyTableOptions, FeModel, SpokeGeometry
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.coordinates import coordinates_of
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeFields, SpokeModel
from nptcs.fe.spoke.sampling import START, Grid, sampled_states

OPTIONS = EnergyTableOptions(
    elongation_mm=(-14.0, 4.0), inclination_rad=0.09, phi_rad=(-0.08, 0.08), samples=(6, 3, 3),
    degrees=(8, 4),
)  # fmt: skip
FEW = OPTIONS.model_copy(update={"samples": (4, 3, 3), "degrees": (5, 4)})
MODEL = FeModel(spoke_mesh=COARSE_SPOKE, table=FEW)
ANGLES = (20.0, 45.0)


@pytest.fixture
def counted(monkeypatch):
    """Count the matrices that are made."""
    calls = []
    respond = SpokeModel._respond
    monkeypatch.setattr(SpokeModel, "_respond", lambda self, u: calls.append(1) or respond(self, u))
    return calls


def differences(states, others):
    """Largest differences of energies, forces and tangents, in parts of the largest of each."""
    assert list(states) == list(others)
    parts = []
    for name in ("energy", "force", "tangent"):
        here, there = (
            np.array([getattr(state, name) for state in found.values()])
            for found in (states, others)
        )
        parts.append(np.abs(here - there).max() / np.abs(there).max())
    return parts


def test_the_order_of_the_spokes_does_not_change_a_bit(tmp_path):
    """A table depends on no other spoke: neither those of this process nor those of the folder."""
    tables = {}
    for name, angles in {"up": ANGLES, "down": ANGLES[::-1]}.items():
        for angle in angles:
            tables[name, angle] = shared_table(
                MODEL, spoke_design(angle_deg=angle), tmp_path / name
            )
    for angle in ANGLES:
        up, down = (tables[name, angle].coefficients for name in ("up", "down"))
        assert np.array_equal(up, down)


def test_a_matrix_is_used_for_several_steps(counted):
    """Without this each state takes four to six matrices."""
    states = sampled_states(SpokeModel(spoke_design(angle_deg=30.0), FEW.accepted_work), FEW)
    assert len(counted) < 2.7 * len(states)


def test_states_are_those_of_newtons_method_with_a_new_matrix_for_each_step(monkeypatch):
    few = sampled_states(SpokeModel(spoke_design(angle_deg=30.0), FEW.accepted_work), FEW)

    def one_step(self, displacement, factor, step, work):
        for group in self.mixed:
            group.follow(step)
        return displacement + step

    monkeypatch.setattr(SpokeModel, "_followed", one_step)
    many = sampled_states(SpokeModel(spoke_design(angle_deg=30.0), 1e-12), FEW)
    energy, force, tangent = differences(few, many)
    assert energy < 1e-8
    assert force < 1e-7
    assert tangent < 1e-3


def test_a_guess_that_misleads_does_not_change_a_state():
    model = SpokeModel(spoke_design(angle_deg=30.0), OPTIONS.accepted_work)
    state = model.move(model.rest(), np.array([-5.0, 1.0, 0.03]))
    noise = np.random.default_rng(1).normal(0.0, 0.002, state.displacement.shape)
    noise[model.mesh.top] = noise[model.mesh.bottom] = 0.0
    misled = SpokeFields(
        state.displacement + noise,
        [0.3 + pressure for pressure in state.pressures],
        [20.0 + stress for stress in state.stresses],
    )
    again = model.settle(state.motion, misled)
    assert again.energy == pytest.approx(state.energy, rel=1e-8)
    assert again.force == pytest.approx(state.force, rel=1e-5, abs=1e-4)


def test_stresses_of_another_state_do_not_reach_the_tangent():
    model = SpokeModel(spoke_design(angle_deg=30.0), FEW.accepted_work)
    state = model.move(model.rest(), np.array([-5.0, 1.0, 0.03]))
    other = SpokeFields(state.displacement, state.pressures, [50.0 + s for s in state.stresses])
    tangent = model.settle(state.motion, other).tangent
    assert tangent == pytest.approx(state.tangent, rel=1e-4, abs=1e-4 * np.abs(tangent).max())


def test_rows_take_turns_and_the_middle_one_has_every_level():
    grid = Grid(OPTIONS, SpokeGeometry())
    rows = grid.rows()
    middle = next(
        row for row in rows if row.beta == pytest.approx(0) and row.phi == pytest.approx(0)
    )
    assert middle.levels == tuple(range(6))
    for row in rows:
        if row is not middle:
            assert len(row.levels) == 4
            assert {0, 5} < set(row.levels)
    by_place = {(round(row.beta, 3), round(row.phi, 3)): row for row in rows}
    assert by_place[0.09, 0.0].levels != by_place[0.09, 0.08].levels


def test_a_row_that_loses_its_stability_ends_the_table_at_its_last_level(monkeypatch):
    model = SpokeModel(spoke_design(angle_deg=30.0), OPTIONS.accepted_work)
    grid = Grid(OPTIONS, SpokeGeometry())
    side = next(row for row in grid.rows() if row.beta > 0 and row.levels == (0, 2, 4, 5))
    limit = grid.motions(side, [1])[0]
    found = SpokeModel.next_state

    def unstable(motion):
        in_this_row = abs(motion[2]) < 1e-9 and motion[1] > 1e-6
        return in_this_row and motion[0] < limit[0] - 1e-6

    def next_state(self, before, last, motion):
        if unstable(motion):
            raise SpokeError("unstable")
        return found(self, before, last, motion)

    monkeypatch.setattr(SpokeModel, "next_state", next_state)
    states = sampled_states(model, OPTIONS)
    levels = {level for _, level in states}
    # level 0 fails in that row; level 1, which it leaves out, is found and kept
    assert levels == {START, 1, 2, 3, 4, 5}
    assert (side.number, 1) in states


def test_a_foot_that_would_turn_by_itself_ends_the_table(monkeypatch):
    model, geometry = (
        SpokeModel(spoke_design(angle_deg=30.0), OPTIONS.accepted_work),
        SpokeGeometry(),
    )
    limit = Grid(OPTIONS, geometry).lengths[:2].mean()
    found = SpokeModel.next_state

    def about_to_snap(self, before, last, motion):
        state = found(self, before, last, motion)
        if coordinates_of(motion[None], geometry.height_mm)[0][0, 0] < limit:
            state.tangent[2, 2] = -1.0
        return state

    monkeypatch.setattr(SpokeModel, "next_state", about_to_snap)
    assert min(level for _, level in sampled_states(model, OPTIONS) if level != START) == 1
