import numpy as np
import pytest
from small_tyres import COARSE_SPOKE, COARSE_TABLE, VALUES

from nptcs.config.solvers.fe import SECTIONS
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.solvers import fe_tyre, fe_tyre_paper
from nptcs.solvers.contract import CaseInputs, Status
from nptcs.solvers.registry import model_choices, read_options
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

SMALL = {"spoke_mesh": COARSE_SPOKE, "table": COARSE_TABLE, "load_steps": 2}


def test_the_papers_ring_comes_with_its_section_and_says_so():
    options = read_options(fe_tyre_paper.SOLVER, {})
    assert options.geometry == SECTIONS["paper_mesh"]
    assert model_choices(options)["ring"] == "paper_mesh"
    assert model_choices(read_options(fe_tyre.SOLVER, {}))["ring"] == "converged"
    with pytest.raises(InputError, match="ring"):
        read_options(fe_tyre_paper.SOLVER, {"ring": "converged"})


def test_both_rings_share_spokes_and_solve_a_tyre(tmp_path):
    found = []
    for solver in (fe_tyre.SOLVER, fe_tyre_paper.SOLVER):
        options = read_options(solver, {**SMALL, "spoke_cache": tmp_path})
        # one section for both
        options = options.model_copy(update={"geometry": SECTIONS["paper_mesh"]})
        inputs = CaseInputs("c", VALUES, 800.0, TyreGeometry(), options, ply=PUBLISHED_PLY)
        found.append(solver.solve(inputs))
    assert [result.status for result in found] == [Status.OK] * 2
    assert len(list(tmp_path.glob("*.npz"))) == 1
    converged, paper = (result.vertical_stiffness_n_per_mm for result in found)
    # coarse and fine, bending wires and membranes: near each other and not the same
    assert 0.0 < abs(paper / converged - 1.0) < 0.06
    assert len(found[1].neutral_line["theta_deg"]) == 270
    assert (np.diff(found[1].neutral_line["theta_deg"]) > 0).all()
