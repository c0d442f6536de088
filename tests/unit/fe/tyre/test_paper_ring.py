"""The ring with the elements of table 4 of the paper."""

import numpy as np
import pytest
from pydantic import ValidationError

from nptcs.config.solvers.fe import (
    SECTIONS,
    FeModel,
    GroundContact,
    PaperMesh,
    SpokeGeometry,
    TyreMesh,
)
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.tyre.equilibrium import TyreModel
from nptcs.fe.tyre.mesh import build_ring
from nptcs.fe.tyre.responses import wire_wrinkle_mm

TYRE = TyreGeometry()
FOOT_MM = 15.0
# of table 4: bricks of band and tread, and how many of them are side by side across the width
TABLE_4_BRICKS, ACROSS = 33480, 31


@pytest.fixture(scope="module")
def tyre(springs):
    return TyreModel(TYRE, springs(), FOOT_MM, 5.0, 2000.0, PaperMesh(), GroundContact())


def test_elements_are_those_of_table_4(tyre):
    ((orders, elements),) = tyre.mesh.rubber
    assert orders == (1, 1)
    assert ACROSS * len(elements) == TABLE_4_BRICKS
    assert tyre.mesh.radii == pytest.approx([300.0, 307.0, 314.0, 318.7, 323.4])
    # one pressure each
    assert [group.pressure.shape for group in tyre.rubbers] == [(1080, 1)]


def test_wires_are_membranes_at_their_diameters(tyre):
    """A uniform growth strains each layer as a ring of its own radius."""
    section = np.pi / 4 / 2.0 * TYRE.tread_width_mm * 2
    growth = 1e-3
    moved = growth * tyre.mesh.positions
    strain = growth + growth**2 / 2
    for group, radius in zip(tyre.wires, (300.75, 313.25), strict=True):
        energy = 0.5 * TYRE.wire_modulus_mpa * section * 2 * np.pi * radius * strain**2
        # polygons of 270 sides
        assert group.respond(moved).energy == pytest.approx(energy, rel=1e-4)


def test_membranes_bend_almost_freely(tyre):
    """Inextensional mode w = a cos 2θ of the outer layer: a beam would take π/2 E I (3a)²/R³."""
    amplitude, middle = 1e-2, 313.25
    x, y = tyre.mesh.positions.T
    theta, radius = np.arctan2(x, -y), np.hypot(x, y)
    w, slope = amplitude * np.cos(2 * theta), -2.0 * amplitude * np.sin(2 * theta)
    v = -0.5 * amplitude * np.sin(2 * theta)
    along = v + (radius - middle) / middle * (v - slope)
    outward = np.stack([np.sin(theta), -np.cos(theta)], axis=1)
    tangent = np.stack([np.cos(theta), np.sin(theta)], axis=1)
    moved = w[:, None] * outward + along[:, None] * tangent
    inertia = TYRE.tread_width_mm * np.pi * TYRE.wire_diameter_mm**4 / 64
    beam = np.pi / 2 * TYRE.wire_modulus_mpa * inertia * (3 * amplitude) ** 2 / middle**3
    assert tyre.wires[1].respond(moved).energy < 0.05 * beam


def test_a_wrinkle_is_a_wave_from_node_to_node(tyre):
    """A smooth motion has none; every other column moved by 0.2 mm has its amplitude, 0.1 mm."""
    mesh = tyre.mesh
    outward = mesh.positions / np.linalg.norm(mesh.positions, axis=1)[:, None]
    column = np.arange(len(mesh.positions)) // len(mesh.radii)
    angle = mesh.theta[column]
    smooth = (5.0 * np.exp(-((angle - np.pi) ** 2) / 0.05))[:, None] * outward
    assert wire_wrinkle_mm(mesh, smooth) < 0.01
    near = np.abs(angle - np.pi) < 0.2
    wave = np.where(near & (column % 2 == 0), 0.2, 0.0)[:, None] * outward
    assert wire_wrinkle_mm(mesh, smooth + wave) == pytest.approx(0.1, abs=0.01)
    bending = build_ring(TYRE, TyreMesh(), FOOT_MM)
    assert wire_wrinkle_mm(bending, np.zeros_like(bending.positions)) is None


def test_feet_are_averaged_over_their_true_width(springs):
    """Feet begin and end inside elements: a foot's mean of θ² shows its width."""
    turned = PaperMesh(first_spoke_deg=1.7)
    model = TyreModel(TYRE, springs(), FOOT_MM, 5.0, 10.0, turned, GroundContact())
    mesh = model.mesh
    spoke, half = 7, FOOT_MM / 600.0
    angle = mesh.spoke_angle[spoke]
    radial = np.array([np.sin(angle), -np.cos(angle)])
    along = np.array([np.cos(angle), np.sin(angle)])
    arm = (mesh.positions @ along) / 300.0
    turn = 1e-4
    rigid = (0.3 + 300.0 * arm[:, None] * turn) * radial - 0.2 * along
    assert model.spoke_motion(rigid)[spoke] == pytest.approx([0.3, -0.2, turn], rel=1e-6)
    bowl = arm[:, None] ** 2 * radial
    # chords of 1.33° lie above the parabola by a sixth of the square of an element's angle
    sag = (2 * np.pi / 270) ** 2 / 6.0
    assert model.spoke_motion(bowl)[spoke, 0] == pytest.approx(half**2 / 3.0 + sag, rel=0.05)
    assert half**2 / 3.0 > 2.0 * sag


def test_the_ground_acts_at_nodes(tyre):
    state = tyre.load([1000.0])
    ground = tyre.ground.respond(state.displacement, state.rise_mm)
    lowest = (tyre.mesh.positions + state.displacement)[4::5, 1]
    inside = state.rise_mm - 323.4 - lowest
    lengths = 2.0 * 323.4 * np.sin(np.pi / 270)
    held = inside > 0.0
    soft, smooth = 500.0, 0.002
    pressure = np.where(
        inside < smooth, soft * inside**2 / 2 / smooth, soft * (inside - smooth / 2)
    )
    assert np.sum(pressure[held]) * lengths * 215.0 == pytest.approx(1000.0, rel=1e-6)
    assert ground.reaction_n == pytest.approx(1000.0, rel=1e-6)
    assert 2 < np.count_nonzero(held) < 12


def test_a_finer_paper_mesh_is_refused_with_the_reason():
    with pytest.raises(ValidationError, match=r"wrinkle.*refine the ring `converged`"):
        PaperMesh(around=271)


def test_each_ring_has_the_section_that_was_calibrated_with_it():
    for ring, section in SECTIONS.items():
        assert FeModel(ring=ring).geometry == section
        assert section.calibrated_with == ring
        assert section.calibrated_axial == "free_edges"


@pytest.mark.parametrize("change", [{}, {"calibrated_with": None}], ids=["named", "by its values"])
def test_a_section_of_the_other_ring_is_refused(change):
    other = SECTIONS["converged"].model_dump() | change
    with pytest.raises(ValidationError, match="calibrated with the ring 'converged'"):
        FeModel(ring="paper_mesh", geometry=other)


def test_a_changed_section_is_not_calibrated_and_keeps_the_rest():
    found = FeModel(ring="paper_mesh", geometry={"leg_thickness_mm": 3.0}).geometry
    assert found.calibrated_with is None
    known = SECTIONS["paper_mesh"].model_copy(
        update={"leg_thickness_mm": 3.0, "calibrated_with": None, "calibrated_axial": None}
    )
    assert found == known
    drawn = SpokeGeometry(leg_thickness_mm=4.0)
    assert FeModel(geometry=drawn).geometry == drawn


def test_a_section_calibrated_with_another_axial_freedom_says_so():
    held = FeModel(axial="plane_strain")
    (note,) = held.geometry.axial_notes(held.axial)
    assert "`axial: free_edges`" in note
    assert "`axial: plane_strain`" in note
    free = FeModel()
    assert free.geometry.axial_notes(free.axial) == []
    changed = FeModel(axial="plane_strain", geometry={"leg_thickness_mm": 3.0})
    assert changed.geometry.axial_notes(changed.axial) == []


def test_the_mesh_of_the_other_ring_is_refused():
    with pytest.raises(ValidationError, match="tyre_mesh has no effect"):
        FeModel(ring="paper_mesh", tyre_mesh={"band_rows": 2})
    with pytest.raises(ValidationError, match="paper_mesh has no effect"):
        FeModel(paper_mesh={"around": 200})


def test_free_edges_soften_the_band_and_plane_strain_holds_it():
    assert FeModel().band_bulk_to_shear() == 10.0
    assert FeModel(ring="paper_mesh").band_bulk_to_shear() == 10.0
    held = FeModel(axial="plane_strain")
    assert held.band_bulk_to_shear() == held.spoke_mesh.bulk_to_shear_ratio
