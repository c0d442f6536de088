"""The solver `ring` on a coarse finite element spoke, next to `fe_tyre` on the same."""

import pytest
from small_tyres import COARSE_SPOKE, COARSE_TABLE, VALUES

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.solvers import fe_tyre, ring
from nptcs.solvers.contract import CaseInputs, Status
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

OPTIONS = {"spoke_mesh": COARSE_SPOKE, "table": COARSE_TABLE, "load_steps": 3}


def solved(solver, options, load_n=900.0, tyre=None):
    return solver.solve(
        CaseInputs("case_1", VALUES, load_n, tyre or TyreGeometry(), options, ply=PUBLISHED_PLY)
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("spokes")


@pytest.fixture(scope="module")
def result(folder):
    return solved(ring, ring.RingSolverOptions(spoke_cache=folder, **OPTIONS))


def test_it_shares_the_spokes_of_fe_tyre_and_agrees_with_it(folder, result):
    assert result.status is Status.OK
    files = sorted(folder.iterdir())
    finite = solved(fe_tyre, fe_tyre.FeTyreOptions(spoke_cache=folder, **OPTIONS))
    assert sorted(folder.iterdir()) == files
    assert result.displacement_mm == pytest.approx(finite.displacement_mm, rel=0.01)
    assert result.vertical_stiffness_n_per_mm == pytest.approx(900.0 / result.displacement_mm)
    assert result.curve["force_n"][-1] == 900.0
    assert result.curve["displacement_mm"][-1] == result.displacement_mm
    assert min(result.neutral_line["radial_mm"]) == pytest.approx(
        min(finite.neutral_line["radial_mm"]), rel=0.02
    )
    assert result.extra["contact_cells"] > 1.0


def test_a_load_beyond_the_table_is_diverged_with_its_last_point(folder, result):
    beyond = solved(ring, ring.RingSolverOptions(spoke_cache=folder, **OPTIONS), load_n=2e4)
    assert beyond.status is Status.DIVERGED
    assert "outside the table's range" in beyond.message
    assert beyond.curve["force_n"][-1] > 900.0


def test_a_tyre_that_contradicts_its_spokes_is_bad_input(folder):
    options = ring.RingSolverOptions(spoke_cache=folder, **OPTIONS)
    with pytest.raises(InputError, match="distance between rim and band"):
        solved(ring, options, tyre=TyreGeometry(rim_diameter_mm=420.0))


def test_it_reports_what_fe_tyre_reports(folder, result):
    with_stress = solved(
        ring, ring.RingSolverOptions(spoke_cache=folder, plate_stress="all", **OPTIONS)
    )
    finite = solved(fe_tyre, fe_tyre.FeTyreOptions(spoke_cache=folder, **OPTIONS))
    assert result.plate_stress is None
    # the ring has no wires that are membranes; where a contact is too short depends on the mesh
    own = {"wire_wrinkle_mm", "contact_length_mm", "largest_pressure_mpa", "mean_pressure_mpa"}
    assert set(finite.extra) - own <= set(with_stress.extra)
    for name in ("plate_volume_mm3", "smallest_spoke_force_n", "plate_largest_mises_mpa"):
        assert with_stress.extra[name] == pytest.approx(finite.extra[name], rel=0.03)
