"""Surfaces in the values that a solver really used: plates are a whole number."""

import numpy as np
import pandas as pd
import pytest

from nptcs.campaign.cases import cases_table
from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.record import CaseRecord
from nptcs.campaign.worker import solve
from nptcs.compare.impact import with_published
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.solvers import fe_tyre, published
from nptcs.solvers.contract import SolverResult, Status
from nptcs.solvers.registry import MODULES, load_solver
from nptcs.surface.cases import changed_factors, solved_cases
from nptcs.surface.sensitivity.impact_table import impact_table
from nptcs.surface.study import fit_study
from nptcs.surface.tables import quality_table
from nptcs.tables.io import check
from nptcs.tables.tyres.cases import Cases

FACTORS = ["spacing_mm", "thickness_mm"]
STUDY = Study.model_validate(
    {
        "name": "plate",
        "title": "Plates",
        "factors": [
            {"name": "spacing_mm", "label": "S", "unit": "mm", "levels": [10, 14.05, 15, 20]},
            {"name": "thickness_mm", "label": "T", "unit": "mm", "levels": [1.2, 1.8, 2.4]},
        ],
        "solvers": ["published", "fe_tyre"],
        "terms": ["1", "spacing_mm", "spacing_mm^2", "thickness_mm"],
    }
)
SOLVERS = {"published": published.SOLVER, "fe_tyre": fe_tyre.SOLVER}


def record(solver, number, spacing, thickness, status=Status.OK):
    values = {"spacing_mm": spacing, "thickness_mm": thickness}
    realise = SOLVERS[solver].realise
    realised = realise(values, TyreGeometry()) if realise and status == Status.OK else {}
    pitch = realised.get("spacing_mm", spacing)
    stiffness = 400 - 10 * pitch + 0.1 * pitch**2 + 8 * thickness
    result = SolverResult(status=status, realised=realised)
    if status == Status.OK:
        result.vertical_stiffness_n_per_mm = stiffness
        result.displacement_mm = 5000 / stiffness
    return CaseRecord(
        study="plate", case_id=f"plate_{number:03d}", solver=solver, solver_version="1", key="k",
        values=values, load_n=5000.0, wall_time_s=0.1, result=result,
    )  # fmt: skip


def table(failed=()):
    points = [(s, t) for s in (10.0, 14.05, 15.0, 20.0) for t in (1.2, 1.8, 2.4)]
    records = [
        record(solver, number, *point, Status.DIVERGED if number in failed else Status.OK)
        for solver in SOLVERS
        for number, point in enumerate(points, start=1)
    ]
    return check(cases_table(records), Cases, "cases.csv")


def test_two_spacings_are_one_point_for_fe_tyre_and_two_for_published():
    cases = table()
    fe, paper = (solved_cases(cases, solver, FACTORS) for solver in ("fe_tyre", "published"))

    assert sorted(set(paper.table["spacing_mm"])) == [10, 14.05, 15, 20]
    np.testing.assert_allclose(sorted(set(fe.table["spacing_mm"])), [215 / 22, 215 / 15, 215 / 11])
    assert (fe.same, paper.same) == (3, 0)
    assert (fe.changed, paper.changed) == (("spacing_mm",), ())
    assert changed_factors(cases[cases["solver"] == "fe_tyre"], FACTORS) == ["spacing_mm"]


def test_a_surface_in_the_realised_pitch_finds_the_true_coefficients():
    done = fit_study(table(), STUDY)
    quality = quality_table(done).set_index("solver")

    for surface in done.polynomials.values():
        np.testing.assert_allclose(surface.coefficients_natural, [400, -10, 0.1, 8], rtol=1e-8)
    assert quality["points"].to_dict() == {"published": 12, "fe_tyre": 9}
    assert quality["same_cases"].to_dict() == {"published": 0, "fe_tyre": 3}
    assert quality["realised_factors"].to_dict() == {"published": "", "fe_tyre": "spacing_mm"}


def test_impact_states_its_values_and_what_failed():
    cases = table(failed=(2, 12))
    done = fit_study(cases, STUDY)
    design = cases[cases["solver"] == "published"][FACTORS]
    impact = impact_table(
        {"plate": done.polynomials},
        {"plate": design},
        quality_table(done),
        ["domain_mean_signed"],
        0.8,
    )
    rows = impact.set_index(["solver", "factor"])

    assert rows.loc[("fe_tyre", "spacing_mm"), "range"] == pytest.approx(215 / 11 - 215 / 22)
    assert rows.loc[("fe_tyre", "spacing_mm"), "nominal_range"] == 10
    assert rows["values_used"].to_dict() == {
        ("published", "spacing_mm"): "given",
        ("published", "thickness_mm"): "given",
        ("fe_tyre", "spacing_mm"): "realised",
        ("fe_tyre", "thickness_mm"): "given",
    }
    assert set(rows["failed_cases"]) == {2}
    # table 9 still applies to the pitch: its levels are the paper's
    table_9 = pd.DataFrame(
        [("plate", "spacing_mm", 5.49, 10.0, 54.93)],
        columns=["study", "factor", "gradient", "range", "impact"],
    )
    compared = with_published(impact, table_9)
    assert compared.loc[compared["factor"] == "spacing_mm", "published_impact"].notna().all()


OWN_SOLVER = """
from nptcs.solvers.contract import Solver, SolverResult

def solve(inputs):
    if inputs.values["spacing_mm"] > 19:
        return SolverResult(status="diverged", message="too far")
    return SolverResult(status="ok", vertical_stiffness_n_per_mm=250.0, displacement_mm=20.0)

def realise(values, tyre):
    return {"spacing_mm": tyre.tread_width_mm / round(tyre.tread_width_mm / values["spacing_mm"])}

SOLVER = Solver("own", "1", solve, frozenset({"spacing_mm"}), about="own", realise=realise)
"""


def test_the_campaign_records_what_a_solver_realises_for_each_solved_case(tmp_path):
    module = tmp_path / "own.py"
    module.write_text(OWN_SOLVER)
    design = pd.DataFrame({"case_id": ["a", "b"], "case": [1, 2], "spacing_mm": [15.0, 20.0]})
    study = STUDY.model_copy(update={"name": "s"})
    jobs = make_jobs(study, "own", {"module": str(module)}, TyreGeometry(), design, None)

    solved, failed = (solve(job) for job in jobs)

    assert solved.realised == {"spacing_mm": pytest.approx(215 / 14)}
    assert failed.status == Status.DIVERGED
    assert failed.realised == {}


@pytest.mark.parametrize("solver", ["fe_tyre", "fe_tyre_paper", "ring", "fe_spoke", "calculix"])
def test_every_solver_on_our_spokes_says_its_pitch(solver):
    realise = load_solver(MODULES[solver]).realise
    for spacing, plates in ((10.0, 22), (14.05, 15), (15.0, 15), (20.0, 11)):
        realised = realise({"spacing_mm": spacing}, TyreGeometry())
        assert realised == {"spacing_mm": pytest.approx(215 / plates)}
