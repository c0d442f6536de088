from dataclasses import replace

import numpy as np
import pytest

from nptcs.config.solvers.fe import GroundContact, SpokeGeometry, SpokeMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.output.outlines import tyre_outlines
from nptcs.fe.output.spoke_picture import section_stress, spoke_figure
from nptcs.fe.output.tyre_picture import FINE, ring_stress, tyre_figure
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.tyre.equilibrium import LoadPath, TyreModel, TyreState


@pytest.fixture(scope="module")
def spoke(published_ply):
    coarse = SpokeMesh(rows=(1, 1, 1, 1, 1, 1), columns=2)
    return SpokeModel(
        SpokeDesign(
            SpokeGeometry(), coarse, 15.0, 5.0, 1.8, 45.0, 1.0, published_ply, 14, "embedded"
        )
    )


def test_cells_cover_the_section(spoke):
    section = section_stress(spoke, spoke.rest())
    assert section.mises_mpa == pytest.approx(0.0, abs=1e-12)
    assert section.fibre_mpa == pytest.approx(0.0, abs=1e-6)
    cells = np.concatenate([section.rubber, section.plate])
    x, z = cells[..., 0], cells[..., 1]
    area = 0.5 * np.abs(np.sum(x * np.roll(z, -1, axis=1) - z * np.roll(x, -1, axis=1), axis=1))
    geometry = spoke.design.geometry
    heights, thickness = geometry.section()
    slope = np.cos(np.radians(geometry.leg_angle_deg))
    assert area.sum() == pytest.approx(2.0 * np.trapezoid(thickness, heights) / slope)
    # the plates are where the section says, measured from the rim
    assert section.plate[..., 1].min() == pytest.approx(geometry.plate_foot_gap_mm)
    assert np.ptp(section.height_mm) < geometry.height_mm - 2.0 * geometry.plate_foot_gap_mm
    assert np.all(np.diff(section.height_mm) > 0.0)


def test_a_uniform_stretch_is_a_uniform_stress(spoke):
    """Axial stretch 1.1 between rim and band at constant volume: σ = 2 C10 (λ² - 1/λ)."""
    rest = spoke.rest()
    factors = np.array([1.1**-0.5, 1.1**-0.5, 1.1])
    stretched = replace(rest, displacement=spoke.mesh.positions * (factors - 1.0))
    section = section_stress(spoke, stretched)
    # the period's last strip reaches back to its first nodes: that leaves only x and z usable
    assert section.mises_mpa == pytest.approx(2.0 * (1.1**2 - 1.0 / 1.1), rel=1e-6)
    assert section.rubber[..., 1].max() == pytest.approx(1.1 * spoke.design.geometry.height_mm)


def test_plates_bend_when_the_spoke_is_pressed(spoke):
    """The plies' faces are strained with opposite sign in the middle of a leg."""
    section = section_stress(spoke, spoke.move(spoke.rest(), np.array([-2.0, 0.0, 0.0])))
    middle = np.abs(section.fibre_mpa).max(axis=1).argmax()
    plus, minus = section.fibre_mpa[middle]
    assert plus * minus < 0.0


def test_the_spoke_is_drawn_pulled_and_pressed(spoke):
    figure = spoke_figure(spoke)
    pulled, pressed, fibres = figure.axes[:3]
    assert pulled.get_title().startswith("+4 mm, +")
    assert pressed.get_title().startswith("-20 mm, -")
    assert [line.get_label() for line in fibres.lines[:4]] == [
        "+4 mm, ply +45°",
        "+4 mm, ply -45°",
        "-20 mm, ply +45°",
        "-20 mm, ply -45°",
    ]


def tyre_of(dimensions):
    nothing = SpokeEnergyTable(
        84.1,
        1e12,
        np.full(3, -9.0),
        np.full(3, 9.0),
        np.zeros((1, 3), dtype=int),
        np.zeros(1),
        1,
        0,
    )
    return TyreModel(
        dimensions, nothing, 7.0, 5.0, 2000.0, TyreMesh(gap_elements=1), GroundContact()
    )


def test_outlines_of_a_band_that_is_shifted(spoke):
    """The feet of all spokes move with the band, their heads stay at the rim."""
    tyre = tyre_of(TyreGeometry(spoke_count=6))
    shift = np.array([0.2, -0.4])
    moved = np.zeros_like(tyre.mesh.positions) + shift
    rows = tyre_outlines(tyre, TyreState(moved, 0.0, tyre.spoke_motion(moved), LoadPath()), spoke)
    after = rows[["x_mm", "y_mm"]].to_numpy()
    before = rows[["x_undeformed_mm", "y_undeformed_mm"]].to_numpy()
    radius, step = np.hypot(*before.T), after - before
    of_spokes = (rows["part"] == "spoke").to_numpy()
    feet = of_spokes & (radius > radius[of_spokes].max() - 0.2)
    heads = of_spokes & (radius < radius[of_spokes].min() + 0.2)
    assert feet.sum() >= 12
    np.testing.assert_allclose(step[feet], np.tile(shift, (feet.sum(), 1)), atol=0.01)
    np.testing.assert_allclose(step[heads], 0.0, atol=0.002)
    np.testing.assert_allclose(
        step[rows["part"] == "band"], [shift] * (rows["part"] == "band").sum()
    )
    assert rows.groupby("part")["outline"].nunique().to_dict() == {
        "band": 2,
        "plate": 12,
        "rim": 1,
        "spoke": rows.loc[of_spokes, "outline"].nunique(),
    }


def test_the_tyre_is_drawn_with_all_its_spokes(spoke):
    dimensions = TyreGeometry(spoke_count=12)
    tyre = tyre_of(dimensions)
    still = np.zeros_like(tyre.mesh.positions)
    state = TyreState(still, 0.0, tyre.spoke_motion(still), LoadPath())
    figure = tyre_figure(tyre, state, spoke)
    whole = figure.axes[0]
    drawn = whole.collections[0].get_paths()
    section = section_stress(spoke, spoke.rest(), FINE)
    ring, stress = ring_stress(tyre, state)
    assert stress == pytest.approx(0.0, abs=1e-12)
    assert len(drawn) == 12 * len(section.rubber) + len(ring)
    feet = np.concatenate([path.vertices for path in drawn])
    assert np.hypot(*feet.T).min() == pytest.approx(215.9, abs=0.5)
    assert np.hypot(*feet.T).max() == pytest.approx(dimensions.outer_diameter_mm / 2, abs=0.05)
    assert len(whole.collections[1].get_paths()) == 12 * len(section.plate)
