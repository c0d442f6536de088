"""Results of the paper's ring and of a converged one, and the remaining difference in table 7."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.blocks import Fact, Facts, Listing, PageBlock, Text
from nptcs.report.data import Results
from nptcs.report.tables.names import in_words
from nptcs.report.text import joined
from nptcs.tables.published.stiffness import StiffnessErrors, StiffnessExponents

RINGS: Mapping[str, str] = {
    "fe_tyre_paper": translatable(
        "the ring as meshed in the paper: 270 × 4 elements of four nodes with one pressure each, "
        "wires as membranes, which wrinkle on finer meshes. It predicts the paper's model and is "
        "meant for nothing else"
    ),
    "fe_tyre": translatable(
        "a converged ring: wires that bend; halving every length of its mesh changes the "
        "stiffness by less than 0.3 %. It is the one to use for a tyre that is to be built"
    ),
}
"""Solvers of finite element tyres, and the purpose of their rings."""

BAND, SPOKES = "shear_band_c10_mpa", "spoke_c10_mpa"

EXCLUDED = (
    translatable("stiffness of the contact"),
    translatable("phase of the spokes relative to the contact"),
    translatable("number of elements around the ring"),
    translatable("a rim that moves"),
    translatable(
        "the lateral stiffness of the spokes: nothing supports the factor of 1.5 that would "
        "be needed"
    ),
    translatable("the wires' modulus: with another value tables 5 and 10 no longer agree"),
    translatable("the convention of R²: the uncentred one fits all ten values of table 10"),
    translatable("locking of the paper's host bricks: it would show in table 10"),
)
"""What cannot explain the remaining difference; each was changed in a separate experiment."""

OPEN_CLUE = translatable(
    "The open clue is the shape of the load curve. The errors that the paper "
    "gives for its LCA (16, 11.63, 7.49 and 8.44 % at 3, 4, 5 and 6 kN) "
    "bound the curve of its finite elements: that tyre softens between 3 and "
    "5 kN on stiff spokes, where this one does not."
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
                tr(
                    "Both rings are shown: the paper's mesh and a converged one. Each uses the "
                    "spoke section that was calibrated with it, on table 10 and five cases of "
                    "table 5; no number of table 7 was used."
                )
            )
        )
    facts = [Fact(solver, _ring(errors, solver), "stiffness_errors.csv") for solver in found]
    blocks.append(Facts(tr("The finite element tyre by its ring"), tuple(facts)))
    return [*blocks, *_rest(results.table(StiffnessExponents), found)]


def _ring(errors: pd.DataFrame, solver: str) -> str:
    """Say what a ring is and how far it is from each published study."""
    rows = errors[
        errors["solver"].eq(solver) & errors["group"].eq("blind") & errors["compared"].gt(0)
    ]
    parts = [
        tr(
            "{study}: mean {mean_percent:+.2f} %, mean absolute "
            "{mean_absolute_percent:.2f} %, largest {largest_percent:+.2f} %, over "
            "{compared} of {cases} blind cases",
            study=row.study,
            mean_percent=row.mean_percent,
            mean_absolute_percent=row.mean_absolute_percent,
            largest_percent=row.largest_percent,
            compared=row.compared,
            cases=row.cases,
        )
        for row in rows.itertuples()
    ]
    return ". ".join([tr(RINGS[solver]), *parts])


def _rest(exponents: pd.DataFrame, solvers: list[str]) -> list[PageBlock]:
    """Say what is known about the difference in a study of both rubbers."""
    mine = exponents[exponents["solver"].isin(solvers)]
    both = mine.groupby("study", sort=False)["factor"].agg(set)
    studies = [study for study, factors in both.items() if {BAND, SPOKES} <= factors]
    facts = [fact for study in studies for fact in _study(mine[mine["study"] == study])]
    if not facts:
        return []
    return [
        Facts(
            tr("What is known about the difference from the published table of rubbers"),
            tuple(facts),
        ),
        Listing(
            tr("Excluded, each by an experiment with the model outside this run"),
            tuple(map(tr, EXCLUDED)),
        ),
        Text(tr(OPEN_CLUE)),
    ]


def _study(rows: pd.DataFrame) -> list[Fact]:
    facts = []
    for solver, mine in rows[rows["factor"] == SPOKES].groupby("solver", sort=False):
        whole = mine[mine["levels"] == mine["levels"].max()]
        difference = whole["exponent_difference"]
        facts.append(
            Fact(
                tr("Exponent of the spokes' C10, {solver}", solver=solver),
                tr(
                    "computed {computed}, published {published} ({held}): the computed "
                    "stiffness is the published one times a constant and C10 to the power of "
                    "{lowest:+.3f} to {highest:+.3f}",
                    computed=_numbers(whole["computed_exponent"]),
                    published=_numbers(whole["published_exponent"]),
                    held=_held(whole),
                    lowest=difference.min(),
                    highest=difference.max(),
                ),
                "stiffness_exponents.csv",
            )
        )
    band = rows[(rows["factor"] == BAND) & (rows["solver"] == rows["solver"].iloc[0])]
    steps = band[band["levels"] == 2].groupby(["low_mpa", "high_mpa"], sort=True)
    spans = [
        tr(
            "from {low:g} to {high:g} MPa {numbers}",
            low=low,
            high=high,
            numbers=_numbers(step["published_exponent"]),
        )
        for (low, high), step in steps
    ]
    if len(spans) > 1:
        facts.append(
            Fact(
                tr("Scatter within the published table"),
                tr(
                    "its exponent of the band's C10 is {names}, in order of rising spoke C10; a "
                    "single law would give equal numbers",
                    names=joined(spans),
                ),
                "stiffness_exponents.csv",
            )
        )
    return facts


def _numbers(values: pd.Series) -> str:
    return ", ".join(f"{value:.3f}" for value in values)


def _held(rows: pd.DataFrame) -> str:
    return in_words("; ".join(rows["held"]), {})
