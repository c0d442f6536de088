import numpy as np
import pytest

from nptcs.config.fe import GroundContact, SpokeGeometry, SpokeMesh, TyreMesh
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.pictures import section_cells, tyre_figure
from nptcs.fe.spoke import SpokeDesign, SpokeModel
from nptcs.fe.spoke_table import SpokeTable
from nptcs.fe.tyre import LoadPath, TyreModel, TyreState


@pytest.fixture(scope="module")
def spoke(published_ply):
    coarse = SpokeMesh(rows=(1, 1, 1, 1, 1, 1), columns=2)
    return SpokeModel(
        SpokeDesign(SpokeGeometry(), coarse, 15.0, 5.0, 1.8, 45.0, 1.0, published_ply, 215.0)
    )


def test_cells_cover_the_section_and_show_a_uniform_stretch(spoke):
    position = spoke.mesh.positions
    corners, strain = section_cells(spoke, np.zeros_like(position))
    assert strain == pytest.approx(0.0, abs=1e-12)
    x, z = corners[..., 0], corners[..., 1]
    area = 0.5 * np.sum(x * np.roll(z, -1, axis=1) - z * np.roll(x, -1, axis=1))
    heights, thickness = spoke.design.geometry.section()
    slope = np.cos(np.radians(spoke.design.geometry.leg_angle_deg))
    assert area == pytest.approx(2.0 * np.trapezoid(thickness, heights) / slope)
    stretched = np.zeros_like(position)
    stretched[:, 2] = 0.1 * position[:, 2]
    _, strain = section_cells(spoke, stretched)
    assert strain == pytest.approx(0.5 * (1.1**2 - 1.0))


def test_the_tyre_is_drawn_with_all_its_spokes(spoke):
    nothing = SpokeTable(
        np.array([-9.0] * 3), np.array([9.0] * 3), np.zeros((1, 3), dtype=int), np.zeros(1), 1, 0
    )
    tyre = TyreModel(
        TyreGeometry(), nothing, 7.0, 5.0, 2000.0, TyreMesh(gap_elements=1), GroundContact()
    )
    still = np.zeros_like(tyre.mesh.positions)
    state = TyreState(still, 0.0, tyre.spoke_motion(still), LoadPath())
    figure = tyre_figure(tyre, state, spoke)
    whole = figure.axes[0]
    spokes = whole.collections[0].get_paths()
    cells, _ = section_cells(spoke, np.zeros_like(spoke.mesh.positions))
    assert len(spokes) == 60 * len(cells)
    feet = np.concatenate([path.vertices for path in spokes])
    assert np.hypot(*feet.T).min() == pytest.approx(215.9, abs=0.5)
    assert np.hypot(*feet.T).max() == pytest.approx(300.0, abs=0.5)
