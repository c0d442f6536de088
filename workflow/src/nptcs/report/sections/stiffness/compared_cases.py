"""The cases of one study with its solvers next to each other, and the order of the solvers."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.tables.headings import Heading
from nptcs.tables.published.stiffness import (
    COMPUTED_STIFFNESS,
    DIFFERENCE,
    PUBLISHED,
    PUBLISHED_STIFFNESS,
)
from nptcs.tables.status import has_result


def rests_on_synthetic(results: Results, study: Study, table: pd.DataFrame) -> bool:
    """Tell whether any solver of a study's table rests on synthetic specimens."""
    return any(results.study_is_synthetic(study, str(name)) for name in table["solver"].unique())


def solver_order(results: Results) -> list[str]:
    """List the solvers in an order that does not change from figure to figure."""
    return sorted(name for name in results.solvers if name != PUBLISHED)


def case_comparison(
    rows: pd.DataFrame, factors: list[str]
) -> tuple[pd.DataFrame, Mapping[str, Heading]]:
    """Write one study of ``stiffness_against_published.csv`` with one row per case.

    Returns
    -------
    table : DataFrame
        The case, its factors and published stiffness; stiffness and difference of each solver;
        ``failed`` and ``calibrated_on`` name solvers.
    headings : mapping of str to Heading
    """
    table = rows.drop_duplicates("case_id").set_index("case_id")[[*factors, PUBLISHED_STIFFNESS]]
    headings = {PUBLISHED_STIFFNESS: Heading(tr("published"), "N/mm")}
    failed, calibrated = (pd.Series("", index=table.index) for _ in range(2))
    for solver, of_solver in rows.groupby("solver", sort=False):
        case = of_solver.set_index("case_id")
        table[f"{solver}_computed"] = case[COMPUTED_STIFFNESS]
        table[f"{solver}_{DIFFERENCE}"] = case[DIFFERENCE]
        headings[f"{solver}_computed"] = Heading(str(solver), "N/mm")
        headings[f"{solver}_{DIFFERENCE}"] = Heading(tr("{solver} − published", solver=solver), "%")
        failed += (f"{solver}: " + case["status"] + " ").where(~has_result(case["status"]), "")
        calibrated += pd.Series(f"{solver} ", case.index).where(case["used_for_calibration"], "")
    table["failed"], table["calibrated_on"] = failed.str.strip(), calibrated.str.strip()
    return table.reset_index(), headings
