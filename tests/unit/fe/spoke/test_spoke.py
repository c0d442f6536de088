import numpy as np
import pytest
from small_tyres import spoke_design

from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel
from nptcs.fe.spoke.mesh import build_period
from nptcs.fe.spoke.pull import pull

COARSE = SpokeMesh(rows=(1, 1, 2, 1, 1, 1))


def spoke(ply, **change):
    return SpokeModel(spoke_design(**{"ply": ply, "mesh": COARSE, **change}))


@pytest.fixture(scope="module")
def model(published_ply):
    return spoke(published_ply)


def test_the_mesh_fills_the_section(ply):
    geometry = SpokeGeometry()
    mesh = build_period(geometry, COARSE, 15.0, 5.0)
    model = spoke(ply)
    volume = sum(block.weight.sum() for block in model.rubbers)
    heights, thickness = geometry.section()
    area = 2.0 * np.trapezoid(thickness, heights) / np.cos(np.radians(geometry.leg_angle_deg))
    plates = heights[5] - heights[1]
    plate = 2.0 * plates * geometry.plate_layer_mm / np.cos(np.radians(geometry.leg_angle_deg))
    assert volume == pytest.approx(15.0 * area - 5.0 * plate)
    assert mesh.positions[mesh.top, 2] == pytest.approx(geometry.height_mm)


def test_plates_that_touch_are_refused():
    with pytest.raises(ValueError, match="leaves no rubber"):
        build_period(SpokeGeometry(), COARSE, 5.0, 5.0)


def test_a_section_out_of_order_is_refused():
    with pytest.raises(ValueError, match="must increase in this order"):
        SpokeGeometry(plate_foot_gap_mm=9.0, foot_taper_mm=7.0)


def test_forces_and_condensed_tangents_are_derivatives_of_the_energy(model):
    state = model.move(model.rest(), np.array([-6.0, 2.0, 0.05]))
    for axis, step in enumerate((2e-3, 2e-3, 2e-5)):
        shift = step * np.eye(3)[axis]
        ahead = model.move(state, state.motion + shift)
        behind = model.move(state, state.motion - shift)
        slope = (ahead.energy - behind.energy) / (2.0 * step)
        assert slope == pytest.approx(state.force[axis], rel=1e-4)
        curve = (ahead.force - behind.force) / (2.0 * step)
        scale = np.sqrt(np.abs(np.diag(state.tangent)) * abs(state.tangent[axis, axis]))
        assert np.abs(curve - state.tangent[axis]).max() < 1e-3 * scale.max()


def test_the_way_to_a_state_does_not_matter(model):
    target = np.array([-5.0, 1.0, -0.03])
    straight = model.move(model.rest(), target)
    around = model.move(model.move(model.rest(), np.array([2.0, -1.0, 0.0])), target)
    assert around.energy == pytest.approx(straight.energy, rel=1e-6)
    assert around.force == pytest.approx(straight.force, rel=1e-4, abs=1e-3)


def test_stiffness_scales_with_all_moduli(ply, model):
    harder = {name: v * (3.0 if name.endswith("mpa") else 1.0) for name, v in ply.items()}
    triple = spoke(harder, c10_mpa=3.0).rest().tangent
    assert triple == pytest.approx(3.0 * model.rest().tangent, rel=1e-6, abs=1e-6)


def test_more_and_thicker_plates_along_the_leg_stiffen(ply, model):
    base = model.rest().tangent[0, 0]
    assert spoke(ply, pitch_mm=10.0, plates=21).rest().tangent[0, 0] > 1.02 * base
    assert spoke(ply, angle_deg=0.0).rest().tangent[0, 0] > 1.01 * base
    assert spoke(ply, thickness_mm=2.4).rest().tangent[0, 0] > 1.005 * base
    assert spoke(ply, angle_deg=90.0).rest().tangent[0, 0] < 0.995 * base


def test_plates_that_may_bow_are_softer_where_the_fibres_are_oblique(ply):
    """For fibres along or across the plate, lamination theory has next to no difference."""
    added = {}
    for angle in (0.0, 45.0, 90.0):
        held, free = (
            spoke(ply, angle_deg=angle, plate_coupling=coupling).rest().tangent[0, 0]
            for coupling in ("embedded", "conforming")
        )
        added[angle] = held / free - 1.0
    assert added[45.0] > 0.01
    assert 0.0 <= added[0.0] < 0.001
    assert 0.0 <= added[90.0] < 0.001


def test_pulling_follows_the_tangent_and_energy_balances(model):
    displacement, force = pull(model, 1.0, 8)
    # a curve through the origin itself: the LCA takes it as a spoke's law
    assert (displacement[0], force[0]) == (0.0, 0.0)
    assert force[1] / displacement[1] == pytest.approx(model.rest().tangent[0, 0], rel=0.02)
    work = float(np.trapezoid(force, displacement))
    assert model.move(model.rest(), np.array([1.0, 0.0, 0.0])).energy == pytest.approx(
        work, rel=5e-3
    )


def test_mesh_converges(ply):
    """Three meshes: the error falls, and the campaign's mesh is within 4 % of the finest."""
    stiffness = []
    for mesh in (
        SpokeMesh(),
        SpokeMesh(rows=(2, 2, 4, 2, 2, 2)),
        SpokeMesh(rows=(3, 3, 6, 3, 3, 3), columns=2),
    ):
        model = spoke(ply, mesh=mesh)
        stiffness.append(model.rest().tangent[0, 0])
    assert abs(stiffness[1] / stiffness[2] - 1.0) < abs(stiffness[0] / stiffness[2] - 1.0)
    assert stiffness[0] == pytest.approx(stiffness[2], rel=0.04)


def test_an_impossible_motion_is_reported_with_the_last_state(model):
    with pytest.raises(SpokeError, match="no equilibrium beyond"):
        model.move(model.rest(), np.array([-120.0, 0.0, 0.0]))
