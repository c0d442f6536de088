"""Impact and rank of each factor for each response, in two runs."""

from __future__ import annotations

from typing import Any

from nptcs.language import tr
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, as_number, compared, part_table, percent, presence
from nptcs.tables.result_table import Heading

FILE = "response_impact.csv"
KEY = ("study", "solver", "response", "at", "factor")
COLUMNS = (
    *KEY,
    "unit",
    "impact_a",
    "impact_b",
    "difference_percent",
    "rank_a",
    "rank_b",
    "note",
)
HEADINGS = {"difference_percent": Heading("B − A", "%")}


def compare_ranking(a: FinishedRun, b: FinishedRun, within: float) -> Part:
    """Compare impact and rank of each factor, one row per response and factor."""
    found, remarks = {}, []
    for letter, run in (("A", a), ("B", b)):
        table = run.table(FILE)
        if table is None:
            remarks.append(tr("run {run} has no {file}", run=letter, file=FILE))
        else:
            missing = [name for name in (*KEY, "impact", "rank", "unit") if name not in table]
            if missing:
                remarks.append(
                    tr(
                        "{file} of run {run} has no column {columns}",
                        file=FILE,
                        run=letter,
                        columns=", ".join(missing),
                    )
                )
                table = None
        records = [] if table is None else table.to_dict("records")
        found[letter] = {
            tuple("" if row[key] != row[key] else str(row[key]) for key in KEY): row
            for row in records
        }
    keys = list(dict.fromkeys([*found["A"], *found["B"]]))
    rows = [
        {
            **dict(zip(KEY, key, strict=True)),
            **_row(found["A"].get(key), found["B"].get(key), within),
        }
        for key in keys
    ]
    return Part(
        "ranking",
        tr("Ranking of the factors by impact"),
        tr(
            "Impact: mean |slope| × range of the surface that predicts left-out cases best; 1 is "
            "the first rank. Factors in a near tie have no settled order."
        ),
        part_table(rows, COLUMNS),
        tuple(remarks),
        dict(HEADINGS),
    )


def _row(one: Any, two: Any, within: float) -> dict[str, object]:
    row: dict[str, object] = {"unit": (one or two)["unit"]}
    for letter, side in (("a", one), ("b", two)):
        row[f"impact_{letter}"] = as_number(side["impact"]) if side else float("nan")
        row[f"rank_{letter}"] = as_number(side["rank"]) if side else float("nan")
    if one is None or two is None:
        return {**row, RESULT: presence(one is not None, two is not None)}
    if one["unit"] != two["unit"]:
        row["note"] = tr("the unit is {a} in A and {b} in B", a=one["unit"], b=two["unit"])
        return {**row, RESULT: Found.NOT_COMPARED}
    notes = []
    if one["rank"] != two["rank"]:
        notes.append(tr("the rank changed"))
    if one.get("surface") != two.get("surface"):
        surfaces = {"a": one.get("surface"), "b": two.get("surface")}
        notes.append(tr("surface in A: {a}, in B: {b}", **surfaces))
    ties = {side.get("near_tie_with") for side in (one, two)}
    named = sorted(str(tie) for tie in ties if isinstance(tie, str) and tie)
    if named:
        notes.append(tr("near tie with {factors}", factors="; ".join(named)))
    impact = as_number(one["impact"]), as_number(two["impact"])
    result = compared(*impact, within)
    if one["rank"] != two["rank"]:
        result = Found.DIFFERENT
    difference = percent(*impact)
    return {**row, "difference_percent": difference, "note": "; ".join(notes), RESULT: result}
