"""Two finished runs compared, part by part."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from nptcs.language import tr, tr_count
from nptcs.runs.all_tables import compare_tables
from nptcs.runs.constants import K, beyond, compare_constants
from nptcs.runs.decisions import compare_decisions
from nptcs.runs.finished import FinishedRun
from nptcs.runs.inputs import compare_inputs
from nptcs.runs.part import RESULT, Found, Part
from nptcs.runs.ranking import compare_ranking
from nptcs.runs.settings import compare_configuration, compare_software
from nptcs.runs.stiffness import SUMMARY, compare_stiffness, stiffness_summary
from nptcs.tables.result_table import Heading

WITHIN = 1e-9
"""Relative difference up to which numbers are the same."""

NAMED = 6
"""Most input files that a sentence names."""


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
    factors : mapping of str to Heading
        Label and unit of each factor of either run; that of B counts.
    """

    a: str
    b: str
    parts: tuple[Part, ...]
    same_identity: bool
    synthetic: bool
    k: float = K
    within: float = WITHIN
    factors: Mapping[str, Heading] = field(default_factory=dict)

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
            return tr("No difference between the two runs.")
        changed = [
            part.title[0].lower() + part.title[1:]
            for part in self.parts
            if part.name != SUMMARY and not part.differences.empty
        ]
        if not changed:
            return tr("No difference was found, but not everything could be compared.")
        return tr("The runs differ in: {parts}.", parts="; ".join(changed))

    def sentences(self) -> tuple[str, ...]:
        """State the most important differences in words."""
        return tuple(filter(None, (self._inputs(), self._constants(), self._stiffness())))

    def _inputs(self) -> str:
        part = self.part("inputs")
        if part.differences.empty:
            return tr("All known input files are the same.")
        both = part.table[RESULT] == Found.DIFFERENT
        changed = part.table.loc[both, "file"].tolist()
        alone = len(part.differences) - len(changed)
        said = []
        if changed:
            shown = ", ".join(changed[:NAMED])
            if more := len(changed) - NAMED if len(changed) > NAMED else 0:
                shown = tr("{names} and {count} more", names=shown, count=more)
            said.append(
                tr_count(
                    "{count} of {total} input files has different content: {names}.",
                    "{count} of {total} input files have different content: {names}.",
                    len(changed),
                    total=len(part.table),
                    names=shown,
                )
            )
        if alone:
            said.append(
                tr_count(
                    "{count} input file is in one run only.",
                    "{count} input files are in one run only.",
                    alone,
                )
            )
        return " ".join(said)

    def _constants(self) -> str:
        part = self.part("constants")
        far = beyond(part)
        changed = len(part.differences)
        if not changed:
            return tr("All {count} material constants are the same.", count=len(part.table))
        named = ", ".join(
            tr(
                "{constant} of {material} by {percent} % ({times} times the combined standard "
                "error)",
                constant=row.constant,
                material=row.material,
                percent=f"{row.difference_percent:+.2f}",
                times=f"{row.difference_over_error:.1f}",
            )
            for row in far.itertuples()
        )
        return tr_count(
            "{count} of {total} material constants differs; beyond {k} times their combined "
            "standard error: {named}.",
            "{count} of {total} material constants differ; beyond {k} times their combined "
            "standard error: {named}.",
            changed,
            total=len(part.table),
            k=f"{self.k:g}",
            named=named or tr("none"),
        )

    def _stiffness(self) -> str:
        summary = self.part(SUMMARY)
        changed = summary.differences.dropna(subset=["largest_percent"])
        if changed.empty:
            return (
                "" if len(summary.differences) else tr("The stiffness of every case is the same.")
            )
        worst = changed.iloc[int(changed["largest_percent"].abs().to_numpy(float).argmax())]
        cases = self.part("stiffness").table
        number = int((cases[RESULT] == Found.DIFFERENT).sum())
        return tr(
            "The stiffness of {count} of {total} cases differs, most in case {case} by solver "
            "{solver}: {percent} %.",
            count=number,
            total=len(cases),
            case=worst["largest_case"],
            solver=worst["solver"],
            percent=f"{worst['largest_percent']:+.2f}",
        )


def compare_runs(
    a: FinishedRun, b: FinishedRun, k: float = K, within: float = WITHIN
) -> ComparedRuns:
    """Compare two finished runs, in words of the current language (`nptcs.language`).

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
        factors={**a.factors, **b.factors},
    )
