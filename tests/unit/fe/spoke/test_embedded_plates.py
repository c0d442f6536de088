"""What keeps the mid-surface of embedded plates straight."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh
from nptcs.fe.spoke import embedded_plates as embedded
from nptcs.fe.spoke.embedded_plates import HELD, straight_group
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.mesh import build_period
from nptcs.fe.spoke.period import SpokeDesign


@pytest.fixture(scope="module", params=[1, 2])
def mesh(request):
    coarse = SpokeMesh(rows=(1, 1, 2, 1, 1, 1), plate_columns=request.param)
    return build_period(SpokeGeometry(), coarse, 15.0, 5.0), request.param


def test_rigid_motions_linear_stretch_and_twist_cost_nothing(mesh):
    period, columns = mesh
    block = straight_group(period.plate, columns, 8800.0)
    x = period.positions
    turned = x @ Rotation.from_rotvec([0.3, 1.2, -0.7]).as_matrix().T + [5.0, -3.0, 2.0] - x
    twisted = np.stack([0.01 * x[:, 1] * x[:, 2], 0.1 * x[:, 1], 0.2 * x[:, 2] ** 2], axis=1)
    for displacement in (turned, twisted):
        assert block.respond(displacement).energy == pytest.approx(0.0, abs=1e-12)


def test_a_bow_costs_its_height_squared_times_the_length(mesh):
    """u_x = h (1 - (2 y / width)²): on each line of nodes ½ k h_j², k the modulus times HELD."""
    period, columns = mesh
    block = straight_group(period.plate, columns, 8800.0)
    height = 0.01
    bow = np.zeros_like(period.positions)
    bow[:, 0] = height * (1.0 - (period.positions[:, 1] / 2.5) ** 2)
    lines = np.linspace(-1.0, 1.0, 2 * columns + 1)[1:-1]
    geometry = SpokeGeometry()
    radial = geometry.height_mm - 2.0 * (geometry.plate_foot_gap_mm + geometry.plate_mid_gap_mm)
    length = radial / np.cos(np.radians(geometry.leg_angle_deg))
    wanted = 0.5 * HELD * 8800.0 * length * np.sum((height * (1.0 - lines**2)) ** 2)
    response = block.respond(bow)
    assert response.energy == pytest.approx(wanted, rel=1e-3)
    local = bow[block.nodes].reshape(len(block.nodes), -1)
    assert np.sum(local * response.force) == pytest.approx(2.0 * response.energy)
    assert np.matmul(response.tangent, local[..., None])[..., 0] == pytest.approx(response.force)


def test_stiffer_springs_change_next_to_nothing(published_ply, monkeypatch):
    """A spoke of thin plates with oblique fibres, where the springs have most to hold."""
    coarse = SpokeMesh(rows=(1, 1, 2, 1, 1, 1))
    values = (SpokeGeometry(), coarse, 215.0 / 15, 5.0, 1.2, 45.0, 1.04, published_ply, 15)
    stiffness = []
    for factor in (1.0, 100.0):
        monkeypatch.setattr(embedded, "HELD", factor * HELD)
        stiffness.append(SpokeModel(SpokeDesign(*values, "embedded")).rest().tangent[0, 0])
    assert stiffness[0] < stiffness[1]
    assert stiffness[0] == pytest.approx(stiffness[1], rel=1e-4)
