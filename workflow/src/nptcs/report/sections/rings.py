"""What the paper's ring and a converged one say, and what is known of the rest of table 7."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from nptcs.report.blocks import Fact, Facts, Listing, PageBlock, Text
from nptcs.report.data import Results
from nptcs.report.text import joined
from nptcs.tables.published_stiffness import StiffnessErrors, StiffnessExponents

RINGS: Mapping[str, str] = {
    "fe_tyre_paper": "the ring as the paper meshed it: 270 × 4 elements of four nodes with one "
    "pressure each, wires as membranes, which wrinkle on finer meshes. It predicts the paper's "
    "model and is for nothing else",
    "fe_tyre": "a converged ring: wires that bend, half of every length of its mesh changes the "
    "stiffness by less than 0.3 %. It is the one for a tyre that is to be built",
}
"""Solvers of finite element tyres and what their rings are for."""

BAND, SPOKES = "shear_band_c10_mpa", "spoke_c10_mpa"

EXCLUDED = (
    "stiffness of the contact",
    "phase of the spokes to the contact",
    "number of elements around the ring",
    "a rim that moves",
    "the spokes' stiffness to the side: nothing supports the 1.5 times that it would take",
    "the wires' modulus: another one breaks tables 5 and 10",
    "the convention of R²: the uncentred one fits all ten values of table 10",
    "locking of the paper's host bricks: it would show in table 10",
)
"""What cannot explain the rest, each changed in an experiment of its own."""

OPEN_CLUE = (
    "The open clue is the shape of the load curve. The errors that the paper gives for its LCA "
    "(16, 11.63, 7.49 and 8.44 % at 3, 4, 5 and 6 kN) bound the curve of its finite elements: that "
    "tyre softens between 3 and 5 kN on stiff spokes, where this one does not."
)


def ring_blocks(results: Results) -> list[PageBlock]:
    """Build the blocks on the rings; none without a finite element tyre in a compared study."""
    errors = results.table(StiffnessErrors)
    found = [solver for solver in RINGS if errors["solver"].eq(solver).any()]
    if not found:
        return []
    blocks: list[PageBlock] = []
    if len(found) == len(RINGS):
        blocks.append(
            Text(
                "Both rings are shown: what the paper's mesh does, and what a converged one says. "
                "Each has the section of the spoke that was calibrated with it, on table 10 and "
                "five cases of table 5; no number of table 7 entered."
            )
        )
    facts = [Fact(solver, _ring(errors, solver), "stiffness_errors.csv") for solver in found]
    blocks.append(Facts("The finite element tyre by its ring", tuple(facts)))
    return [*blocks, *_rest(results.table(StiffnessExponents), found)]


def _ring(errors: pd.DataFrame, solver: str) -> str:
    """Say what a ring is and how far it is from each published study."""
    rows = errors[
        errors["solver"].eq(solver) & errors["group"].eq("blind") & errors["compared"].gt(0)
    ]
    parts = [
        f"{row.study}: mean {row.mean_percent:+.2f} %, mean absolute "
        f"{row.mean_absolute_percent:.2f} %, largest {row.largest_percent:+.2f} %, over "
        f"{row.compared} of {row.cases} blind cases"
        for row in rows.itertuples()
    ]
    return ". ".join([RINGS[solver], *parts])


def _rest(exponents: pd.DataFrame, solvers: list[str]) -> list[PageBlock]:
    """Say what is known of the difference in a study of both rubbers."""
    mine = exponents[exponents["solver"].isin(solvers)]
    both = mine.groupby("study", sort=False)["factor"].agg(set)
    studies = [study for study, factors in both.items() if {BAND, SPOKES} <= factors]
    facts = [fact for study in studies for fact in _study(mine[mine["study"] == study])]
    if not facts:
        return []
    return [
        Facts("What is known of the difference from the published rubbers' table", tuple(facts)),
        Listing("Excluded, each by an experiment with the model outside this run", EXCLUDED),
        Text(OPEN_CLUE),
    ]


def _study(rows: pd.DataFrame) -> list[Fact]:
    facts = []
    for solver, mine in rows[rows["factor"] == SPOKES].groupby("solver", sort=False):
        whole = mine[mine["levels"] == mine["levels"].max()]
        difference = whole["exponent_difference"]
        facts.append(
            Fact(
                f"Exponent of the spokes' C10, {solver}",
                f"computed {_numbers(whole['computed_exponent'])}, published "
                f"{_numbers(whole['published_exponent'])} ({_held(whole)}): the computed stiffness "
                f"is the published one times a constant and C10 to the power of "
                f"{difference.min():+.3f} to {difference.max():+.3f}",
                "stiffness_exponents.csv",
            )
        )
    band = rows[(rows["factor"] == BAND) & (rows["solver"] == rows["solver"].iloc[0])]
    steps = band[band["levels"] == 2].groupby(["low_mpa", "high_mpa"], sort=True)
    spans = [
        f"from {low:g} to {high:g} MPa {_numbers(step['published_exponent'])}"
        for (low, high), step in steps
    ]
    if len(spans) > 1:
        facts.append(
            Fact(
                "The published table's own scatter",
                f"its exponent of the band's C10 is {joined(spans)}, by the spokes' C10 in rising "
                "order; one law would give the same numbers",
                "stiffness_exponents.csv",
            )
        )
    return facts


def _numbers(values: pd.Series) -> str:
    return ", ".join(f"{value:.3f}" for value in values)


def _held(rows: pd.DataFrame) -> str:
    return "; ".join(rows["held"])
