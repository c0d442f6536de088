"""The vertical stiffness of each case in two runs.

Cases are matched by their id if both runs define the cases of the study in the same way (a tested
rubber may still have another C10), and otherwise by the values of their factors.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, as_number, compared, part_table, percent, presence
from nptcs.tables.result_table import Heading

CASES = "cases.csv"
SUMMARY = "stiffness_summary"
STIFFNESS = "vertical_stiffness_n_per_mm"
DEFINED_BY = ("factors", "design", "further_cases", "fixed")
"""Keys of a study that decide which case has which id."""

COLUMNS = (
    "study",
    "solver",
    "case_a",
    "case_b",
    "stiffness_a_n_per_mm",
    "stiffness_b_n_per_mm",
    "difference_n_per_mm",
    "difference_percent",
    "status_a",
    "status_b",
    "load_n",
    "design_a",
    "design_b",
    "note",
)
SUMMARY_COLUMNS = (
    "study",
    "solver",
    "cases",
    "compared",
    "mean_percent",
    "mean_absolute_percent",
    "largest_percent",
    "largest_case",
    "without_result_a",
    "without_result_b",
    "only_a",
    "only_b",
)
HEADINGS = {
    "difference_n_per_mm": Heading("B − A", "N/mm"),
    "difference_percent": Heading("B − A", "%"),
}

Row = dict[str, Any]


def compare_stiffness(a: FinishedRun, b: FinishedRun, within: float) -> Part:
    """Compare the stiffness of the cases of two runs, one row per case and solver."""
    rows: list[Row] = []
    remarks = []
    for study in dict.fromkeys([*a.studies, *b.studies]):
        one, two = a.studies.get(study), b.studies.get(study)
        factors = _factors(one, two)
        by_id = _same_definition(one, two)
        if one and two and not by_id:
            remarks.append(
                tr(
                    "study {study} defines its cases differently in B: they are matched by the "
                    "values of {factors}",
                    study=study,
                    factors=", ".join(factors),
                )
            )
        matched = _matched(_cases(a, study), _cases(b, study), factors, by_id)
        rows += [_row(study, *pair, factors, within) for pair in matched]
    return Part(
        "stiffness",
        tr("Vertical stiffness, case by case"),
        tr(
            "Secant stiffness at the load of the study; a case without a result in only one of "
            "the runs is different."
        ),
        part_table(rows, COLUMNS),
        tuple(remarks),
        dict(HEADINGS),
    )


def stiffness_summary(part: Part) -> Part:
    """Summarise the cases by study and solver.

    Parameters
    ----------
    part : Part
        `compare_stiffness`.
    """
    rows: list[dict[str, object]] = []
    for (study, solver), cases in part.table.groupby(["study", "solver"], sort=False):
        found = cases[RESULT].value_counts()
        change = cases.dropna(subset=["difference_percent"])
        sizes = change["difference_percent"].abs()
        largest = change.iloc[int(sizes.to_numpy().argmax())] if len(change) else None
        same = found.get(Found.SAME, 0) == len(cases)
        rows.append(
            {
                "study": study,
                "solver": solver,
                "cases": len(cases),
                "compared": len(change),
                "mean_percent": change["difference_percent"].mean(),
                "mean_absolute_percent": sizes.mean(),
                "largest_percent": None if largest is None else largest["difference_percent"],
                "largest_case": "" if largest is None else largest["case_a"],
                "without_result_a": _without(cases, "a"),
                "without_result_b": _without(cases, "b"),
                "only_a": int(found.get(Found.ONLY_A, 0)),
                "only_b": int(found.get(Found.ONLY_B, 0)),
                RESULT: Found.SAME if same else Found.DIFFERENT,
            }
        )
    return Part(
        SUMMARY,
        tr("Vertical stiffness by study and solver"),
        tr("Means over the cases that have a stiffness in both runs, B − A in percent of A."),
        part_table(rows, SUMMARY_COLUMNS),
    )


def _without(cases: pd.DataFrame, letter: str) -> int:
    there = cases[f"case_{letter}"] != ""
    return int((there & cases[f"stiffness_{letter}_n_per_mm"].isna()).sum())


def _factors(one: Mapping[str, Any] | None, two: Mapping[str, Any] | None) -> list[str]:
    """Return the factors and fixed values of a study in either run."""
    names: list[str] = []
    for study in (one, two):
        if study:
            names += [str(factor["name"]) for factor in study.get("factors", [])]
            names += map(str, study.get("fixed", {}))
    return list(dict.fromkeys(names))


def _same_definition(one: Mapping[str, Any] | None, two: Mapping[str, Any] | None) -> bool:
    if one is None or two is None:
        return False
    return all(_levels(one, key) == _levels(two, key) for key in DEFINED_BY)


def _levels(study: Mapping[str, Any], key: str) -> object:
    """Return what defines cases under a key, without labels."""
    value = study.get(key)
    if key == "factors" and isinstance(value, list):
        return [(factor.get("name"), factor.get("levels")) for factor in value]
    return value or None


def _cases(run: FinishedRun, study: str) -> pd.DataFrame:
    cases = run.tables[CASES]
    return cases[cases["study"] == study]


def _matched(
    one: pd.DataFrame, two: pd.DataFrame, factors: list[str], by_id: bool
) -> list[tuple[Row | None, Row | None]]:
    """Pair the cases of a study; a case without a partner is paired with none."""
    first, second = (_keyed(table, factors, by_id) for table in (one, two))
    keys = list(dict.fromkeys([*first, *second]))
    return [(first.get(key), second.get(key)) for key in keys]


def _keyed(table: pd.DataFrame, factors: list[str], by_id: bool) -> dict[tuple[Any, ...], Row]:
    """Return cases by solver and id, or by solver and values; equal ones are numbered."""
    found: dict[tuple[Any, ...], Row] = {}
    for record in table.to_dict("records"):
        row = {str(key): value for key, value in record.items()}
        values = [row["case_id"]] if by_id else [_value(row.get(name)) for name in factors]
        key = (row["solver"], *values, 0)
        while key in found:
            key = (*key[:-1], key[-1] + 1)
        found[key] = row
    return found


def _value(value: Any) -> float | None:
    """Return a factor's value such that equal ones compare as equal."""
    return None if value is None or pd.isna(value) else float(f"{as_number(value):.12g}")


def _row(
    study: str, one: Row | None, two: Row | None, factors: list[str], within: float
) -> dict[str, object]:
    known = one or two or {}
    k_a, k_b = (as_number(case.get(STIFFNESS)) if case else np.nan for case in (one, two))
    row: dict[str, object] = {
        "study": study,
        "solver": known["solver"],
        "load_n": as_number(known.get("load_n")),
        "stiffness_a_n_per_mm": k_a,
        "stiffness_b_n_per_mm": k_b,
        "note": "",
    }
    for letter, case in (("a", one), ("b", two)):
        row[f"case_{letter}"] = case["case_id"] if case else ""
        row[f"status_{letter}"] = case["status"] if case else ""
        row[f"design_{letter}"] = _design(case, factors) if case else ""
    found = presence(one is not None, two is not None)
    if one and two:
        loads = as_number(one.get("load_n")), as_number(two.get("load_n"))
        if loads[0] != loads[1] and not np.isnan(loads).all():
            row["note"] = tr(
                "solved at {a} N in A and {b} N in B", a=f"{loads[0]:g}", b=f"{loads[1]:g}"
            )
            return {**row, RESULT: Found.NOT_COMPARED}
        row["difference_n_per_mm"] = k_b - k_a
        row["difference_percent"] = percent(k_a, k_b)
        found = compared(k_a, k_b, within)
        if one["status"] != two["status"]:
            found = Found.DIFFERENT
    return {**row, RESULT: found}


def _design(case: Row, factors: list[str]) -> str:
    return ", ".join(
        f"{name} {as_number(case[name]):.6g}"
        for name in factors
        if name in case and not pd.isna(case[name])
    )
