"""Two finished runs compared, part by part."""

from __future__ import annotations

from dataclasses import dataclass

from nptcs.runs.all_tables import compare_tables
from nptcs.runs.constants import K, beyond, compare_constants
from nptcs.runs.decisions import compare_decisions
from nptcs.runs.finished import FinishedRun
from nptcs.runs.inputs import compare_inputs
from nptcs.runs.part import RESULT, Found, Part
from nptcs.runs.ranking import compare_ranking
from nptcs.runs.settings import compare_configuration, compare_software
from nptcs.runs.stiffness import SUMMARY, compare_stiffness, stiffness_summary

WITHIN = 1e-9
"""Relative difference up to which numbers are the same."""


@dataclass(frozen=True)
class ComparedRuns:
    """The comparison of two runs.

    Parameters
    ----------
    a, b : str
        What the runs are, in words.
    parts : tuple of Part
        In the order in which they are read.
    same_identity : bool
        Whether inputs, configuration, code and tables have the same hash.
    synthetic : bool
        Whether any material of either run rests on synthetic specimens.
    k, within : float
        Coverage factor, and relative difference up to which numbers are the same.
    """

    a: str
    b: str
    parts: tuple[Part, ...]
    same_identity: bool
    synthetic: bool
    k: float = K
    within: float = WITHIN

    @property
    def same(self) -> bool:
        """True if everything could be compared and nothing differs."""
        return all(part.same for part in self.parts)

    def part(self, name: str) -> Part:
        """Return a part by its name."""
        return next(part for part in self.parts if part.name == name)

    def verdict(self) -> str:
        """Say in one sentence whether the runs differ, and in what."""
        if self.same:
            return "No difference between the two runs."
        changed = [
            part.title[0].lower() + part.title[1:]
            for part in self.parts
            if part.name != SUMMARY and not part.differences.empty
        ]
        if not changed:
            return "No difference was found, but not everything could be compared."
        return f"The runs differ in: {'; '.join(changed)}."

    def sentences(self) -> tuple[str, ...]:
        """Say the most important differences in words."""
        return tuple(filter(None, (self._inputs(), self._constants(), self._stiffness())))

    def _inputs(self) -> str:
        part = self.part("inputs")
        if part.differences.empty:
            return "All known input files are the same."
        both = part.table[RESULT] == Found.DIFFERENT
        changed = part.table.loc[both, "file"].tolist()
        alone = len(part.differences) - len(changed)
        shown = ", ".join(changed[:6]) + (f" and {len(changed) - 6} more" * (len(changed) > 6))
        words = [f"{len(changed)} of {len(part.table)} input files have other content: {shown}"]
        words = words if changed else []
        return "; ".join([*words, *([f"{alone} files are in one run only"] if alone else [])]) + "."

    def _constants(self) -> str:
        part = self.part("constants")
        far = beyond(part)
        changed = len(part.differences)
        if not changed:
            return f"All {len(part.table)} material constants are the same."
        named = ", ".join(
            f"{row.constant} of {row.material} by {row.difference_percent:+.2f} % "
            f"({row.difference_over_error:.1f} times the combined standard error)"
            for row in far.itertuples()
        )
        return (
            f"{changed} of {len(part.table)} material constants differ; beyond {self.k:g} times "
            f"their combined standard error: {named or 'none'}."
        )

    def _stiffness(self) -> str:
        summary = self.part(SUMMARY)
        changed = summary.differences.dropna(subset=["largest_percent"])
        if changed.empty:
            return "" if len(summary.differences) else "The stiffness of every case is the same."
        worst = changed.iloc[int(changed["largest_percent"].abs().to_numpy(float).argmax())]
        cases = self.part("stiffness").table
        number = int((cases[RESULT] == Found.DIFFERENT).sum())
        return (
            f"The stiffness of {number} of {len(cases)} cases differs, most in case "
            f"{worst['largest_case']} by solver {worst['solver']}: {worst['largest_percent']:+.2f} "
            "%."
        )


def compare_runs(
    a: FinishedRun, b: FinishedRun, k: float = K, within: float = WITHIN
) -> ComparedRuns:
    """Compare two finished runs.

    Parameters
    ----------
    a, b : FinishedRun
    k : float
        Coverage factor for the uncertainty of constants.
    within : float
        Relative difference up to which numbers are the same.
    """
    stiffness = compare_stiffness(a, b, within)
    parts = (
        compare_inputs(a, b),
        compare_constants(a, b, k, within),
        stiffness_summary(stiffness),
        stiffness,
        compare_ranking(a, b, within),
        compare_decisions(a, b, within),
        compare_configuration(a, b),
        compare_software(a, b),
        compare_tables(a, b, within),
    )
    cards = [card for run in (a, b) for card in (run.card.plies, run.card.rubbers)]
    identities = a.identity, b.identity
    return ComparedRuns(
        a=a.what(),
        b=b.what(),
        parts=parts,
        same_identity=None not in identities
        and len({one.identity for one in identities if one}) == 1,
        synthetic=any(one.synthetic for card in cards for one in card.values()),
        k=k,
        within=within,
    )
