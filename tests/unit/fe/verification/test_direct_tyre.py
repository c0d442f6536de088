import numpy as np
import pytest
from small_tyres import COARSE_SPOKE

from nptcs.config.solvers.fe import EnergyTableOptions, FeModel, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import spoke_design
from nptcs.fe.spoke.energy_table import fit_energy
from nptcs.fe.spoke.sampling import sample_spoke
from nptcs.fe.tyre.equilibrium import TyreError, TyreModel
from nptcs.fe.tyre.mesh import build_ring
from nptcs.fe.verification.direct_tyre import (
    ConformingFoot,
    DirectTyre,
    MeshedSpoke,
    RigidFoot,
    edge_shape,
)

FE = FeModel(
    spoke_mesh=COARSE_SPOKE,
    table=EnergyTableOptions(
        elongation_mm=(-1.5, 1.5),
        inclination_rad=0.022,
        phi_rad=(-0.02, 0.02),
        samples=(5, 3, 3),
        degrees=(6, 4),
    ),
)
# few spokes: the direct model solves each of them
TYRE = TyreGeometry(spoke_count=12)


@pytest.fixture(scope="module")
def design(published_ply):
    values = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0, "spoke_c10_mpa": 1.0}
    return spoke_design(FE, TYRE, published_ply, values)


@pytest.fixture(scope="module")
def table(design):
    return fit_energy(sample_spoke(MeshedSpoke(design), FE.table), FE.table, FE.geometry)


@pytest.fixture(scope="module", params=["conforming", "rigid"])
def foot(request, design):
    ring = build_ring(TYRE, TyreMesh(foot_elements=2), FE.geometry.foot_width_mm())
    kind = ConformingFoot if request.param == "conforming" else RigidFoot
    spoke = MeshedSpoke(design)
    return spoke, kind(spoke, ring)


def settled(spoke, foot, q, start=None):
    """Repeat the inner step at fixed q until it vanishes."""
    state = start or spoke.at_rest(foot)
    for _ in range(12):
        state = spoke.follow_foot(state, q, foot)
        if np.abs(state.step).max() < 1e-10:
            return state
    raise AssertionError("no equilibrium")


def test_condensed_forces_and_tangents_are_derivatives_of_the_energy(foot):
    spoke, feet = foot
    rng = np.random.default_rng(0)
    count = feet.operators.shape[1]
    size = np.array([2.0, 1.0, 0.03]) if count == 3 else np.full(count, 0.3)
    q = -size + 0.3 * size * rng.normal(size=count)
    direction = size * rng.normal(size=count)
    here = settled(spoke, feet, q)
    ahead, behind = (settled(spoke, feet, q + s * direction, here) for s in (1e-3, -1e-3))
    slope = (ahead.energy - behind.energy) / 2e-3
    assert slope == pytest.approx(here.force @ direction, rel=1e-5)
    curve = (ahead.force - behind.force) / 2e-3
    assert curve == pytest.approx(here.tangent @ direction, rel=1e-4, abs=1e-4 * abs(curve).max())


def test_away_from_equilibrium_the_condensed_force_leads_to_it(foot):
    """The linearised force predicts, to second order, the force of the settled inner nodes."""
    spoke, feet = foot
    q = np.full(feet.operators.shape[1], 1e-3)
    away = spoke.follow_foot(spoke.at_rest(feet), q, feet)
    assert np.abs(away.step).max() > 0.0
    assert away.force == pytest.approx(settled(spoke, feet, q).force, rel=1e-3, abs=1e-3)


def test_a_rigid_motion_of_the_conforming_foot_is_the_rigid_foot(design):
    ring = build_ring(TYRE, TyreMesh(foot_elements=2), FE.geometry.foot_width_mm())
    spoke = MeshedSpoke(design)
    conforming, rigid = ConformingFoot(spoke, ring), RigidFoot(spoke, ring)
    place = ring.positions[ring.feet[0]] @ [
        np.cos(ring.spoke_angle[0]),
        np.sin(ring.spoke_angle[0]),
    ]
    motion = np.array([-2.0, 0.5, 0.02])
    nodes = np.stack(
        [
            motion[1] + place * (np.cos(motion[2]) - 1.0),
            motion[0] + place * np.sin(motion[2]),
        ],
        axis=1,
    )
    one = settled(spoke, conforming, nodes.ravel())
    other = settled(spoke, rigid, motion)
    assert one.energy == pytest.approx(other.energy, rel=1e-4)
    assert other.energy == pytest.approx(spoke.move(spoke.rest(), motion).energy, rel=1e-8)


def test_at_a_small_load_direct_and_reduced_tyre_agree(design, table):
    reduced = TyreModel(
        TYRE,
        table,
        FE.geometry.foot_width_mm(),
        5.0,
        FE.band_bulk_to_shear(),
        FE.tyre_mesh,
        FE.contact,
    ).load([80.0])
    direct = DirectTyre(FE, TYRE, design, table, 5.0, rigid_foot=True)
    state = direct.load([80.0])
    assert state.rise_mm == pytest.approx(reduced.rise_mm, rel=1e-5)
    assert max(np.abs(spoke.step).max() for spoke in direct.spokes) < 1e-5
    energy = direct.energy(state)
    assert energy["spokes"] > 0.0
    work = np.trapezoid(state.path.force_n, state.path.rise_mm)
    assert sum(energy.values()) == pytest.approx(work, rel=0.02)
    conforming = DirectTyre(FE, TYRE, design, table, 5.0).load([80.0])
    assert conforming.rise_mm != state.rise_mm
    assert conforming.rise_mm == pytest.approx(state.rise_mm, rel=2e-3)


def test_spokes_return_after_a_failed_step(design, table, monkeypatch):
    direct = DirectTyre(FE, TYRE, design, table, 5.0)
    calls = []

    def fail(self, *rest):
        calls.append(len(self.spokes))
        self.spokes = []
        raise np.linalg.LinAlgError("singular")

    monkeypatch.setattr(TyreModel, "_newton", fail)
    with pytest.raises(TyreError, match="singular"):
        direct.load([80.0])
    assert set(calls) == {12}
    assert len(direct.spokes) == 12


def test_places_beyond_the_rings_foot_are_refused():
    nodes = np.linspace(-2.0, 2.0, 5)
    places = np.array([-2.0, -0.3, 0.0, 1.7])
    shape = edge_shape(nodes, places)
    assert shape @ nodes == pytest.approx(places)
    assert shape @ nodes**2 == pytest.approx(places**2)
    with pytest.raises(ValueError, match="wider than the ring's"):
        edge_shape(nodes, np.array([2.1]))
