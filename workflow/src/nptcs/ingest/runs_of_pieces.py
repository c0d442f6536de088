"""Files that are runs on one piece: ``S1_run1``, ``S1_run2``, ``S1_modulus``, ``S1_rupture``."""

from __future__ import annotations

import re
from collections.abc import Sequence

_RUN = re.compile(
    r"(?i)(?<=[A-Za-z0-9])(?:[ _.-]+(?:(?:run|lauf|durchlauf|pass|passage|repeat|rerun|loading)"
    r"[ _.-]*(?P<number>\d+)|(?P<elastic>modulus|e[ -_]?mod(?:ul)?|elastic|stiffness|steifigkeit|"
    r"elastique|modulo|young)|(?P<final>rupture|failure|break|bruch|fracture|rotura|rottura|"
    r"ultimate|strength|final)))$"
)
_PROPERTIES = {"elastic": "modulus;poisson_ratio", "final": "strength;ultimate_strain"}
"""What counts from a run with such a name, in the tests that have these properties."""
_WITH_BOTH = ("tension", "compression")


def piece_of(name: str) -> str:
    """Return the piece that a run's name begins with; empty if the name is not that of a run."""
    return _RUN.sub("", name) if _RUN.search(name) else ""


def mark_runs(rows: Sequence[dict[str, str]]) -> None:
    """Give rows that are runs on one piece its name, and say what is left to state.

    Names that differ in the run only are runs on one piece if the piece has a number
    (``S1_run1``): ``tension_run1`` and ``tension_run2`` may as well be two specimens.

    Parameters
    ----------
    rows : sequence of dict
        Rows of the sheet; get ``piece``, ``properties`` where the names tell, and a remark.
    """
    pieces: dict[str, list[dict[str, str]]] = {}
    for row in rows:
        piece = piece_of(row["specimen"])
        if any(mark.isdigit() for mark in piece):
            pieces.setdefault(piece, []).append(row)
    known = {row["specimen"]: row for row in rows}
    for piece, runs in pieces.items():
        runs = [*runs, *([known[piece]] if piece in known else [])]
        if len(runs) < 2:
            continue
        for row in runs:
            row["piece"] = piece
            named = _RUN.search(row["specimen"])
            kind = "" if named is None else next((k for k in _PROPERTIES if named[k]), "")
            if kind and row.get("test") in _WITH_BOTH:
                row["properties"] = _PROPERTIES[kind]
            note = (
                f"properties by the word in its name ({piece}), to be checked"
                if row.get("properties")
                else f"a run of piece {piece}: state in properties what counts from it; "
                "what several runs give counts with their mean"
            )
            row["remarks"] = "; ".join(text for text in (row.get("remarks", ""), note) if text)
