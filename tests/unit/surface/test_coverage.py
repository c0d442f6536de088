"""Failed and missing cases: counted by level, and what they do to the terms."""

from itertools import product

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.study import Study
from nptcs.surface.diagnostics.coverage import Planned, coverage_table
from nptcs.surface.study import fit_study
from nptcs.tables.io import check
from nptcs.tables.tyres.coverage import CaseCoverage

TERMS = ("1", "a", "b", "a^2")
POINTS = pd.DataFrame(list(product([1.0, 2.0, 3.0], [10.0, 20.0])), columns=["a", "b"])
DESIGN = POINTS.assign(case_id=[f"s_{n:03d}" for n in range(1, 7)], case=range(1, 7))
STUDY = Study.model_validate(
    {
        "name": "s",
        "title": "t",
        "factors": [
            {"name": "a", "label": "a", "unit": "mm", "levels": [1, 2, 3]},
            {"name": "b", "label": "b", "unit": "mm", "levels": [10, 20]},
        ],
        "solvers": ["lca"],
        "terms": TERMS,
    }
)


def cases(failed=(), missing=()):
    table = DESIGN.assign(study="s", solver="lca", status="ok")
    table.loc[table["case"].isin(failed), "status"] = "diverged"
    table["vertical_stiffness_n_per_mm"] = 5 + table["a"] ** 2 + table["b"]
    table.loc[table["case"].isin(failed), "vertical_stiffness_n_per_mm"] = np.nan
    return table[~table["case"].isin(missing)]


def covered(table, least=5, terms=TERMS):
    planned = Planned(DESIGN, ("a", "b"), ("lca",), terms, least)
    found = check(coverage_table(table, {"s": planned}), CaseCoverage, "coverage")
    return found.set_index(["factor", "level"])


def test_each_level_counts_what_was_solved_failed_and_never_run():
    table = covered(cases(failed=[1], missing=[6]), least=4)
    assert table.loc[("", ""), ["cases", "solved", "failed", "missing"]].tolist() == [6, 4, 1, 1]
    assert table.loc[("a", "1"), ["cases", "solved", "failed", "missing"]].tolist() == [2, 1, 1, 0]
    assert table.loc[("b", "20"), ["solved", "missing"]].tolist() == [2, 1]
    assert table.loc[("a", "1"), "statuses"] == "diverged 1"
    assert table.loc[("", ""), "estimable"] == "all 4 terms"


@pytest.mark.parametrize(
    ("failed", "least", "word"),
    [
        ([], 5, "all 4 terms"),
        ([1, 2], 5, "4 of 6 cases solved, at least 5"),
        ([1, 2], 4, "aliased: a^2 with"),
        ([1, 3, 5], 3, "one level left of b"),
    ],
)
def test_what_failures_do_to_the_terms_is_reported(failed, least, word):
    assert word in covered(cases(failed=failed), least).loc[("", ""), "estimable"]


def test_a_study_without_terms_asks_for_no_surface():
    assert "no surface is requested" in covered(cases(), terms=()).loc[("", ""), "estimable"]


def test_below_the_least_number_no_surface_is_fitted():
    enough = fit_study(cases(), STUDY)
    assert list(enough.polynomials) == ["lca"]
    few = fit_study(cases(failed=[6]), STUDY.model_copy(update={"least_cases": 6}))
    assert few.polynomials == {}
    message = few.problems["message"].iloc[0]
    assert "5 cases solved, 1 failed" in message
    assert "studies.s.least_cases" in message


def test_many_values_are_shown_by_quarters():
    design = pd.DataFrame({"a": np.linspace(0, 8, 21), "case": range(1, 22)})
    design["case_id"] = [f"s_{n:03d}" for n in design["case"]]
    planned = Planned(design, ("a",), ("lca",), (), 2)
    solved = design.assign(study="s", solver="lca", status="ok")
    table = coverage_table(solved, {"s": planned})
    assert table["level"].tolist() == ["", "0 to 2", "2 to 4", "4 to 6", "6 to 8"]
    assert table["cases"].tolist() == [21, 5, 5, 5, 6]
