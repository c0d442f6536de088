"""Confirmation: a case outside the prediction is added, and the choice is made again."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.campaign.record import CaseRecord
from nptcs.config.studies.decisions import Decision
from nptcs.decisions.confirm import Compared, confirmed
from nptcs.decisions.decide import decide
from nptcs.decisions.tables import DecisionAnswer, decision_tables
from nptcs.solvers.contract import SolverResult
from nptcs.tables.analysis import decisions as contracts
from nptcs.tables.analysis.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.tables.io import check, empty_table
from nptcs.tables.published.stiffness import StiffnessErrors
from nptcs.uncertainty.tables import NamedDesign, uncertainty_tables

DECISION = Decision(
    name="d",
    study="plate",
    solver="fe_tyre_paper",
    surface="gaussian process on the mean",
    targets=("K=300±5",),
    minimise=("plate_mass",),
    confirm=True,
)


class Run:
    """A solver whose tyres are stiffer than the cases by a stated amount."""

    def __init__(self, values, error_n_per_mm, status="ok"):
        self.values, self.error, self.status, self.solved = values, error_n_per_mm, status, []

    def solve(self, source, designs):
        (row,) = designs.to_dict("records")
        self.solved.append(row)
        case, responses, curve = self.values(*row.values())
        case["vertical_stiffness_n_per_mm"] += self.error
        ok = self.status == "ok"
        if not ok:
            case |= {"status": self.status, "vertical_stiffness_n_per_mm": np.nan}
            responses, curve = responses[:0], curve[:0]
        result = SolverResult(
            status=self.status,
            message="" if ok else "step 3",
            vertical_stiffness_n_per_mm=case["vertical_stiffness_n_per_mm"] if ok else None,
            displacement_mm=16.0 if ok else None,
        )
        record = CaseRecord(
            study="plate",
            case_id=case["case_id"],
            solver="fe_tyre_paper",
            solver_version="1",
            key="k",
            values={},
            load_n=5000.0,
            wall_time_s=2.0,
            result=result,
        )
        cases = pd.DataFrame([case])
        return [record], replace(source.results, cases=cases, responses=responses, curves=curve)


def test_a_solved_case_inside_the_interval_ends_it(source, solved_design):
    run = Run(solved_design, 0.0)
    outcome, rounds, after = confirmed(DECISION, source, run)
    assert [one.result for one in rounds] == ["inside"]
    assert not rounds[0].added
    assert after is source
    assert outcome.found.feasible
    assert len(run.solved) == 1


def test_an_outside_case_is_added_and_the_surface_fitted_again(source, solved_design):
    run = Run(solved_design, 8.0)
    outcome, rounds, after = confirmed(DECISION, source, run)
    assert rounds[0].result == "outside"
    assert rounds[0].added
    assert len(after.results.solved) > len(source.results.solved)
    first = rounds[0].outcome.found.designs.x[[rounds[0].outcome.choice]]
    (k,) = [name for name in outcome.problem.fitted if name.name == "secant_stiffness"]
    value = outcome.problem.fitted[k].model.value(first, {})[0]
    assert value == pytest.approx(rounds[0].compared[k].solved, abs=1.0)
    assert len(rounds) <= DECISION.rounds
    tables = decision_tables([DecisionAnswer(DECISION, outcome, tuple(rounds), 1.0)])
    confirmation = check(tables.confirmation, contracts.DecisionConfirmation, "confirmation")
    assert confirmation["added"].iloc[0]
    assert confirmation["difference"].iloc[0] == pytest.approx(-8.0, abs=1.0)


def test_a_design_that_cannot_be_solved_is_reported(source, solved_design):
    outcome, rounds, _ = confirmed(DECISION, source, Run(solved_design, 0.0, "diverged"))
    assert [one.result for one in rounds] == ["not solved"]
    tables = decision_tables([DecisionAnswer(DECISION, outcome, tuple(rounds), 1.0)])
    assert tables.decisions["confirmation"].tolist() == ["not solved"]
    assert "step 3" in tables.confirmation["message"].iloc[0]
    assert tables.confirmation["goal_met"].iloc[0] == ""


def test_every_table_keeps_its_contract(source):
    outcome = decide(DECISION, source)
    refused = DecisionAnswer(DECISION.model_copy(update={"name": "e"}), None, refusal="no case")
    tables = decision_tables([DecisionAnswer(DECISION, outcome, cpu_s=1.0), refused])
    found = check(tables.decisions, contracts.Decisions, "decisions")
    assert found["status"].tolist() == ["feasible", "refused"]
    assert found["confirmation"].tolist() == ["not asked", ""]
    designs = check(tables.designs, contracts.DecisionDesigns, "designs")
    assert designs.groupby("rank").size().eq(2).all()
    assert len(set(designs[designs["chosen"]]["rank"])) == 1
    check(tables.front, contracts.DecisionFront, "front")
    empty = decision_tables([])
    for table, contract in (
        (empty.decisions, contracts.Decisions),
        (empty.designs, contracts.DecisionDesigns),
        (empty.confirmation, contracts.DecisionConfirmation),
    ):
        check(table, contract, "empty")


def test_uncertainty_tables_keep_bias_next_to_the_interval(source):
    outcome = decide(DECISION, source)
    design = NamedDesign(
        "d", source, outcome.found.designs.x[0], tuple(outcome.problem.fitted.values())
    )
    errors = pd.DataFrame(
        [["plate", "fe_tyre_paper", "blind", 58, 58, 0.24, 0.59, -1.72, "plate_003"]],
        columns=list(StiffnessErrors.to_schema().columns),
    )
    tables = uncertainty_tables([design], errors)
    responses = check(tables.responses, ResponseUncertainty, "uncertainty").set_index("response")
    assert responses.loc["secant_stiffness", "bias_mean_percent"] == 0.24
    assert np.isnan(responses.loc["plate_mass", "bias_mean_percent"])
    # the published stiffness is that at the study's load: no bias next to a stiffness at another
    study = source.results.study.model_copy(update={"load_n": 3000.0})
    elsewhere = replace(source, results=replace(source.results, study=study))
    other = uncertainty_tables([replace(design, source=elsewhere)], errors).responses
    assert other["bias_mean_percent"].isna().all()
    without = uncertainty_tables([design], empty_table(StiffnessErrors))
    same = ["mean", "sd", "low", "high"]
    pd.testing.assert_frame_equal(tables.responses[same], without.responses[same])
    shares = check(tables.shares, UncertaintyShares, "shares")
    for _, rows in shares.groupby("response"):
        assert rows["share_percent"].sum() == pytest.approx(100)
    lacking = shares[shares["kind"] == "not assessed"]
    assert set(lacking["quantities"]) == {"shear_band_c10_mpa", "angle_deg"}


def test_rounding_does_not_count_as_a_difference():
    assert Compared(0.9270821731437466, 0.927, 0.928, 0.9270821731437464).difference == 0.0
    assert Compared(300.0, 299.0, 301.0, 300.001).difference == pytest.approx(-0.001)
    assert np.isnan(Compared(300.0, 299.0, 301.0, np.nan).difference)
