"""Two runs' decisions: what was asked, which design was chosen, and whether it was confirmed."""

from __future__ import annotations

from typing import Any

import pandas as pd

from nptcs.language import tr
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, compared, part_table, presence

FILE = "decisions.csv"
ASKED = ("study", "solver", "goals", "with_probability")
ANSWERED = ("status", "design", "probability", "confirmation")
COLUMNS = ("decision", "what", "a", "b")


def compare_decisions(a: FinishedRun, b: FinishedRun, within: float) -> Part:
    """Compare decisions by name, one row per fact that was asked or answered."""
    sides: list[dict[str, dict[str, Any]]] = []
    remarks = []
    for letter, run in (("A", a), ("B", b)):
        table = run.table(FILE)
        if table is None:
            remarks.append(tr("run {run} has no {file}", run=letter, file=FILE))
        records = [] if table is None else table.to_dict("records")
        sides.append(
            {str(r["decision"]): {str(key): value for key, value in r.items()} for r in records}
        )
    rows: list[dict[str, object]] = []
    for name in dict.fromkeys([*sides[0], *sides[1]]):
        one, two = sides[0].get(name, {}), sides[1].get(name, {})
        for what in (*ASKED, *ANSWERED):
            row = {"decision": name, "what": what, "a": _text(one, what), "b": _text(two, what)}
            found = presence(bool(one), bool(two))
            rows.append({**row, RESULT: found or _found(one.get(what), two.get(what), within)})
    return Part(
        "decisions",
        tr("Decisions"),
        tr("What was asked and what came out."),
        part_table(rows, COLUMNS),
        tuple(remarks),
    )


def _found(one: object, two: object, within: float) -> Found:
    if isinstance(one, float) and isinstance(two, float):
        return compared(one, two, within)
    return Found.SAME if str(one) == str(two) else Found.DIFFERENT


def _text(row: dict[str, Any], what: str) -> str:
    value = row.get(what)
    if value is None or pd.isna(value):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
