"""Dimensions and specimen id that a machine writes above its table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from nptcs.ingest.dialect import Dialect
from nptcs.ingest.profiles import FormatProfile, name_matches
from nptcs.ingest.units import factor, is_unit, split_unit


@dataclass(frozen=True)
class LabelValue:
    """A header entry: text as found, and in mm or mm² where it is a dimension."""

    text: str
    value: float | None = None
    unit: str = ""


def read_labels(
    rows: Iterable[Sequence[str]], profile: FormatProfile, dialect: Dialect
) -> dict[str, LabelValue]:
    """Find the labels of a profile in the rows above a table.

    Parameters
    ----------
    rows : iterable of sequence of str
        Cells of each header row: key, value, unit; ``key : value`` in one cell is told apart.
    profile : FormatProfile
        Its ``labels``.
    dialect : Dialect
        How numbers are written.

    Returns
    -------
    dict of str to LabelValue
        Dimensions without a unit that belongs to them have no value.
    """
    found: dict[str, LabelValue] = {}
    for cells in rows:
        filled = [cell.strip() for cell in cells if cell.strip()]
        if len(filled) == 1 and ":" in filled[0]:
            filled = [part.strip() for part in filled[0].split(":", 1)]
        if len(filled) < 2:
            continue
        key, unit = split_unit(filled[0])
        for label, names in profile.labels.items():
            if label not in found and any(name_matches(key, name) for name in names):
                stated = filled[2] if len(filled) > 2 and is_unit(filled[2]) else unit or ""
                found[label] = _label(label, filled[1], stated, dialect)
    return found


def _label(label: str, text: str, unit: str, dialect: Dialect) -> LabelValue:
    if label == "specimen":
        return LabelValue(text)
    head, _, tail = text.partition(" ")
    if tail and is_unit(tail):
        text, unit = head, tail
    scale = factor(label, unit) if unit else None
    if scale is None or not dialect.is_number(text):
        return LabelValue(text, None, unit)
    plain = text.replace(dialect.thousands, "") if dialect.thousands else text
    return LabelValue(text, float(plain.replace(dialect.decimal, ".")) * scale, unit)
