"""Two runs' material constants, and whether they differ by more than their uncertainty.

The combined uncertainty of the difference of two independent means is √(s_A² + s_B²), with their
standard errors (GUM, JCGM 100:2008, section 5.1.2); a difference of more than k times that is
beyond it. Constants of the same specimens' files are not independent: what differs then comes from
sheet, rule, configuration or code, and no scatter of tests can explain it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import hypot

import pandas as pd

from nptcs.language import tr, translatable
from nptcs.runs.content import FILES
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, compared, part_table, percent, presence
from nptcs.tables.laboratory.material_card import CardConstant, PlyCard, RubberCard
from nptcs.tables.result_table import Heading

NOT_ASSESSED = translatable("not assessed")
K = 2.0
"""Coverage factor: about 95 % for a normal distribution."""

COLUMNS = (
    "material",
    "constant",
    "unit",
    "a",
    "b",
    "difference_percent",
    "difference_over_error",
    "beyond_uncertainty",
    "data",
    "difference",
    "combined_standard_error",
    "standard_error_a",
    "standard_error_b",
    "note",
)
HEADINGS = {
    "difference": Heading("B − A"),
    "difference_percent": Heading("B − A", "%"),
    "difference_over_error": Heading("|B − A| / combined"),
}
Card = PlyCard | RubberCard


def compare_constants(a: FinishedRun, b: FinishedRun, k: float, within: float) -> Part:
    """Compare the constants of the material cards of two runs.

    Parameters
    ----------
    a, b : FinishedRun
    k : float
        Coverage factor of the combined standard error.
    within : float
        Relative difference up to which numbers are the same.
    """
    cards_a, cards_b = _cards(a), _cards(b)
    files = _files_of_specimens(a), _files_of_specimens(b)
    rows: list[dict[str, object]] = []
    for name in dict.fromkeys([*cards_a, *cards_b]):
        one, two = cards_a.get(name), cards_b.get(name)
        constants_a = one.constants if one else {}
        constants_b = two.constants if two else {}
        for constant in dict.fromkeys([*constants_a, *constants_b]):
            pair = constants_a.get(constant), constants_b.get(constant)
            rows.append({"material": name, "constant": constant, **_row(*pair, k, within, files)})
    return Part(
        "constants",
        tr("Material constants"),
        tr(
            "Beyond uncertainty: |B − A| is more than k = {k} times the combined standard error "
            "√(s_A² + s_B²); not assessed without both standard errors, and where both runs rest "
            "on the same files, whose scatter explains no difference.",
            k=f"{k:g}",
        ),
        part_table(rows, COLUMNS),
        headings=dict(HEADINGS),
    )


def _cards(run: FinishedRun) -> dict[str, Card]:
    return {**run.card.plies, **run.card.rubbers}


def _row(
    one: CardConstant | None,
    two: CardConstant | None,
    k: float,
    within: float,
    files: tuple[Mapping[str, frozenset[str]], Mapping[str, frozenset[str]]],
) -> dict[str, object]:
    """Compare one constant."""
    row: dict[str, object] = {"unit": _units(one, two)}
    for letter, quantity in (("a", one), ("b", two)):
        row[letter] = quantity.value if quantity else float("nan")
        row[f"standard_error_{letter}"] = quantity.standard_error if quantity else None
    if one is None or two is None:
        row[RESULT] = presence(one is not None, two is not None)
        return row
    if one.unit != two.unit:
        row["note"] = tr("the unit is {a} in A and {b} in B", a=one.unit, b=two.unit)
        row[RESULT] = Found.NOT_COMPARED
        return row
    data = _data(one, two, files)
    row |= {"data": data, "note": "; ".join(_notes(one, two))}
    row |= _difference(one, two, k, data)
    row[RESULT] = compared(one.value, two.value, within)
    if row[RESULT] is Found.SAME and one.standard_error != two.standard_error:
        row[RESULT] = Found.DIFFERENT
        row["note"] = "; ".join([*_notes(one, two), tr("the standard error differs")])
    return row


def _difference(one: CardConstant, two: CardConstant, k: float, data: str) -> dict[str, object]:
    difference = two.value - one.value
    found: dict[str, object] = {
        "difference": difference,
        "difference_percent": percent(one.value, two.value),
        "beyond_uncertainty": NOT_ASSESSED,
    }
    errors = one.standard_error, two.standard_error
    if errors[0] is None or errors[1] is None:
        return found
    combined = hypot(errors[0], errors[1])
    found["combined_standard_error"] = combined
    if combined > 0:
        found["difference_over_error"] = abs(difference) / combined
    if data != SAME_FILES:
        found["beyond_uncertainty"] = "yes" if abs(difference) > k * combined else "no"
    return found


SAME_FILES = translatable("same files")
SOME_FILES = translatable("some files the same")
OTHER_FILES = translatable("other files")
NO_FILES = translatable("no files")


def _data(
    one: CardConstant,
    two: CardConstant,
    files: tuple[Mapping[str, frozenset[str]], Mapping[str, frozenset[str]]],
) -> str:
    """Say whether two constants are based on the same files, by their checksums."""
    held = [
        {digest for name in quantity.specimens for digest in known.get(name, ())}
        for quantity, known in zip((one, two), files, strict=True)
    ]
    if not held[0] and not held[1]:
        return NO_FILES
    if held[0] == held[1]:
        return SAME_FILES
    return SOME_FILES if held[0] & held[1] else OTHER_FILES


def _files_of_specimens(run: FinishedRun) -> dict[str, frozenset[str]]:
    """Return the checksums of the files of each specimen."""
    table = run.tables[FILES].fillna("")
    if not {"specimens", "sha256"} <= set(table):
        return {}
    found: dict[str, set[str]] = {}
    for names, digest in zip(table["specimens"], table["sha256"], strict=True):
        for name in filter(None, str(names).split()):
            found.setdefault(name, set()).add(str(digest))
    return {name: frozenset(digests) for name, digests in found.items()}


def _notes(one: CardConstant, two: CardConstant) -> Iterator[str]:
    """Say what else differs in a constant."""
    if one.origin != two.origin:
        yield tr("{a} in A, {b} in B", a=tr(one.origin), b=tr(two.origin))
    if one.rule != two.rule:
        yield tr("the rule differs")
    lost, new = set(one.specimens) - set(two.specimens), set(two.specimens) - set(one.specimens)
    if lost:
        yield tr("specimens only in A: {names}", names=", ".join(sorted(lost)))
    if new:
        yield tr("specimens only in B: {names}", names=", ".join(sorted(new)))


def _units(one: CardConstant | None, two: CardConstant | None) -> str:
    return " / ".join(dict.fromkeys(q.unit for q in (one, two) if q is not None))


def beyond(part: Part) -> pd.DataFrame:
    """Return the constants that differ by more than their uncertainty."""
    return part.table[part.table["beyond_uncertainty"] == "yes"]
