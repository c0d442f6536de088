"""No length of the ring's mesh, and no softness of its ground, acts as if it were the tyre's."""

import pytest

from nptcs.config.solvers.fe import GroundContact, PaperMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.tyre.equilibrium import TyreModel
from nptcs.fe.tyre.responses import contact_responses

# the published band and tread on a third of the spokes
SMALL = TyreGeometry(
    outer_diameter_mm=246.8,
    rim_diameter_mm=31.8,
    inner_wire_diameter_mm=201.5,
    outer_wire_diameter_mm=226.5,
    band_radius_mm=103.875,
    spoke_count=20,
)
FOOT_MM = 15.0
HALF_ROW_MM = TyreMesh().wire_row_mm / 2.0
THROUGH = {"cover_rows": 2, "band_rows": 2, "tread_rows": 2, "wire_row_mm": HALF_ROW_MM}
ALONG = {"foot_elements": 2, "gap_elements": 2}


@pytest.fixture(scope="module")
def stiffness(springs):
    def make(mesh, dimensions=SMALL, load_n=600.0, k_r=20.0, contact=None):
        contact = contact or GroundContact()
        tyre = TyreModel(dimensions, springs(k_r), FOOT_MM, 5.0, 10.0, mesh, contact)
        return load_n / tyre.load([load_n / 2.0, load_n]).rise_mm

    return make


@pytest.fixture(scope="module")
def coarse(stiffness):
    return stiffness(TyreMesh())


@pytest.mark.parametrize(
    "finer", [THROUGH, ALONG, THROUGH | ALONG], ids=["through", "along", "all"]
)
def test_half_of_every_length_leaves_the_stiffness(stiffness, coarse, finer):
    assert stiffness(TyreMesh(**finer)) == pytest.approx(coarse, rel=0.003)


def test_deep_rows_around_the_wires_would_be_a_length_of_the_tyre(stiffness, coarse):
    """Rows of 1.4 mm take their depth from the rubber between the wires: the test above fails."""
    deep, half = (stiffness(TyreMesh.model_construct(wire_row_mm=row)) for row in (1.4, 0.7))
    assert deep > 1.01 * coarse
    assert half != pytest.approx(deep, rel=0.003)


@pytest.mark.parametrize("mesh", [TyreMesh(), PaperMesh()], ids=["converged", "paper_mesh"])
def test_the_ground_does_not_count_as_displacement(stiffness, mesh):
    """1500 N on the stiffest spokes of table 7, where softness of the ground shows most."""
    given = stiffness(mesh, TyreGeometry(), 1500.0, 100.0)
    hard = GroundContact(penalty_mpa_per_mm=2000.0, smoothing_mm=0.001)
    assert given == pytest.approx(stiffness(mesh, TyreGeometry(), 1500.0, 100.0, hard), rel=1e-3)


@pytest.mark.parametrize("shift_deg", [0.0, 3.0], ids=["on a spoke", "between two spokes"])
def test_the_contact_does_not_jump_with_the_mesh(springs, shift_deg):
    """Length and mean pressure of the contact at 5000 N, where it once jumped by 10 mm."""
    found = []
    for finer in ({}, ALONG):
        mesh = TyreMesh(first_spoke_deg=shift_deg, **finer)
        tyre = TyreModel(TyreGeometry(), springs(), FOOT_MM, 5.0, 10.0, mesh, GroundContact())
        state = tyre.load([2500.0, 5000.0])
        found.append(contact_responses(tyre.ground.cells(state.displacement, state.rise_mm)))
    coarse, fine = found
    assert coarse["contact_length_mm"] == pytest.approx(fine["contact_length_mm"], rel=0.03)
    assert coarse["mean_pressure_mpa"] == pytest.approx(fine["mean_pressure_mpa"], rel=0.03)
    assert coarse["mean_pressure_mpa"] < coarse["largest_pressure_mpa"]
