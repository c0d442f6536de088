"""Stress at the plates' faces against states whose stress is known."""

import numpy as np
import pytest
from small_tyres import spoke_design

from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh
from nptcs.fe.output.plate_stress import face_stress, fibre_axes, mises_in_plane, rubber_extremes
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.laminate import abd, rotated_stiffness
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY


@pytest.fixture
def make(ply):
    def model(**change):
        return SpokeModel(spoke_design(**{"angle_deg": 30.0, "ply": ply, **change}))

    return model


def moved(model, along, curvature=0.0):
    """Move all nodes so that each plate is stretched and bent along its length.

    The displacement acts along the plate's own length: ε11 = along + curvature × (distance from
    the mid-surface).
    """
    state = model.rest()
    positions, axes = model.mesh.positions, model.mesh.plate_axes
    plate = model.mesh.plate
    displacement = np.zeros_like(positions)
    for leg in (0, 1):
        nodes = np.unique(plate.nodes[plate.leg == leg])
        corners = plate.corners[plate.leg == leg].reshape(-1, 3)
        middle = corners.mean(axis=0)
        local = (positions[nodes] - middle) @ axes[leg]
        shift = np.zeros_like(local)
        shift[:, 0] = along * local[:, 0] + curvature * local[:, 0] * local[:, 2]
        shift[:, 2] = -0.5 * curvature * local[:, 0] ** 2
        displacement[nodes] = shift @ axes[leg].T
    state.displacement = displacement
    return state


def test_a_stretched_plate_has_the_stress_of_its_plies_at_both_faces(make):
    model = make()
    faces = face_stress(model, moved(model, 1e-4))
    for angle in (30.0, -30.0):
        stress = rotated_stiffness(PUBLISHED_PLY, angle) @ [1e-4, 0.0, 0.0]
        wanted = fibre_axes(stress, angle)
        mine = faces.ply_deg == angle
        assert faces.along_mpa[mine] == pytest.approx(wanted[0], rel=2e-3)
        assert faces.across_mpa[mine] == pytest.approx(wanted[1], rel=2e-3)
        assert faces.shear_mpa[mine] == pytest.approx(wanted[2], rel=2e-3)
        assert faces.mises_mpa[mine] == pytest.approx(mises_in_plane(stress), rel=2e-3)
        assert faces.mean_mises_mpa[mine] == pytest.approx(mises_in_plane(stress), rel=2e-3)


def test_a_bent_plate_is_read_at_half_its_thickness(make):
    """Curvature κ gives the faces the strain ±κ T/2, more than any point inside."""
    for thickness in (1.2, 2.4):
        model = make(thickness_mm=thickness, angle_deg=0.0)
        curvature = 1e-5
        faces = face_stress(model, moved(model, 0.0, curvature))
        q11 = rotated_stiffness(PUBLISHED_PLY, 0.0)[0, 0]
        wanted = q11 * curvature * thickness / 2.0
        assert np.abs(faces.along_mpa) == pytest.approx(wanted, rel=0.01)
        # the ply +A is on the side of smaller x, where the local normal points
        assert faces.along_mpa[faces.face == 0] == pytest.approx(wanted, rel=0.01)


def test_the_moment_of_a_laminate_gives_the_same_stress(ply):
    """Classical lamination theory: strains at the faces from the inverse of [A B; B D]."""
    strain = np.linalg.solve(abd(ply, 30.0, 1.8), [0.0, 0.0, 0.0, 5.0, 0.0, 0.0])
    at_face = strain[:3] - 0.9 * strain[3:]
    stress = rotated_stiffness(ply, 30.0) @ at_face
    turned = fibre_axes(stress, 30.0)
    invariant = stress[0] + stress[1]
    assert turned[0] + turned[1] == pytest.approx(invariant)
    assert turned[0] * turned[1] - turned[2] ** 2 == pytest.approx(
        stress[0] * stress[1] - stress[2] ** 2
    )


def test_known_von_mises_stresses():
    assert mises_in_plane(np.array([100.0, 0.0, 0.0])) == pytest.approx(100.0)
    assert mises_in_plane(np.array([100.0, 100.0, 0.0])) == pytest.approx(100.0)
    assert mises_in_plane(np.array([0.0, 0.0, 10.0])) == pytest.approx(10.0 * np.sqrt(3.0))


def test_rubber_extremes_of_a_spoke_stretched_evenly(make):
    model = make()
    rest = model.rest()
    assert rubber_extremes(model, rest) == pytest.approx((0.0, 0.0), abs=1e-9)
    rest.displacement = model.mesh.positions * [0.0, 0.0, 0.1]
    strain, _ = rubber_extremes(model, rest)
    assert strain == pytest.approx(0.1, rel=1e-6)


def test_the_stress_of_a_separate_program_is_reproduced(ply):
    """A separate study of this section gave 89 MPa at the motion of the spoke over the contact."""
    section = SpokeGeometry(
        leg_angle_deg=29.55,
        leg_thickness_mm=2.5,
        block_thickness_mm=12.526,
        block_half_length_mm=6.001,
        block_ramp_mm=4.654,
        foot_thickness_mm=12.031,
        foot_taper_mm=10.346,
        plate_foot_gap_mm=5.0,
        plate_mid_gap_mm=5.5,
    )
    model = SpokeModel(
        SpokeDesign(section, SpokeMesh(), 215.0 / 15, 5.0, 1.8, 45.0, 1.04, ply, 15, "embedded")
    )
    *_, state = model.walk(model.rest(), np.array([[-9.4, 0.0, 0.0], [-18.85, 0.0, 0.0]]))
    faces = face_stress(model, state)
    assert faces.mises_mpa.max() == pytest.approx(89.0, rel=0.02)
    assert faces.mean_mises_mpa.max() == pytest.approx(89.0, rel=0.02)
