"""Reading the load–displacement curve from the .dat file of the Abaqus deck."""

from __future__ import annotations

import re

from nptcs.decks.abaqus.deck import GROUND, RIM

ALL_ZERO = "ALL VALUES IN THIS TABLE ARE ZERO"


def load_curve(dat_text: str) -> tuple[list[float], list[float]]:
    """Read settlement of the rim (mm) and load on the road (N), one point per converged increment.

    The deck prints U2 of the rim and RF2 of the road at each increment; the first point is the
    unloaded tyre.

    Parameters
    ----------
    dat_text : str
        Content of the .dat file.
    """
    displacement, force = [0.0], [0.0]
    # a job that was stopped may have left half a line
    dat_text = dat_text[: dat_text.rfind("\n") + 1]
    for increment in re.split(r"INCREMENT +\d+ +SUMMARY", dat_text)[1:]:
        rim = _table(increment, RIM)
        road = _table(increment, GROUND)
        if rim is None or road is None:
            break
        displacement.append(-rim.get("U2", 0.0))
        force.append(road.get("RF2", 0.0))
    return displacement, force


def _table(text: str, node_set: str) -> dict[str, float] | None:
    """Read the row of a set's only node from a printed table, by column; None if there is none.

    Abaqus does not print rows of zeros: for a table that says so the result is empty.
    """
    start = re.search(
        rf"PRINTED FOR NODES BELONGING TO NODE SET (?:\S*_)?{re.escape(node_set)}\s*$",
        text,
        re.MULTILINE,
    )
    if start is None:
        return None
    lines = text[start.end() :].splitlines()
    following = next((i for i, line in enumerate(lines) if "TABLE IS PRINTED" in line), len(lines))
    table = lines[:following]
    if any(ALL_ZERO in line for line in table):
        return {}
    header = next((line.split() for line in table if line.split()[:1] == ["NODE"]), None)
    if header is None:
        return None
    names = [name for name in header[1:] if not name.startswith("FOOT")]
    for line in table:
        words = line.split()
        if words and words[0].isdigit() and len(words) >= len(names) + 1:
            values = [float(word) for word in words[-len(names) :]]
            return dict(zip(names, values, strict=True))
    return None
