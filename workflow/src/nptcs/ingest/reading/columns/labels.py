"""Dimensions and specimen id that a machine writes above its table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from nptcs.ingest.reading.profiles import FormatProfile, name_matches
from nptcs.ingest.reading.text.dialect import Dialect
from nptcs.ingest.reading.unit_in_name import split_unit
from nptcs.ingest.reading.units import clean_unit, factor, is_unit


@dataclass(frozen=True)
class LabelValue:
    """A header entry: text as found, and in mm or mm² where it is a dimension."""

    text: str
    value: float | None = None
    unit: str = ""


def read_labels(
    rows: Sequence[Sequence[str]], profile: FormatProfile, dialect: Dialect
) -> dict[str, LabelValue]:
    """Find the labels of a profile in the rows above a table.

    Two layouts are known: key, value, unit in one row (also ``key : value`` in one cell); and
    a small table of results, names over units over one row of values.

    Parameters
    ----------
    rows : sequence of sequence of str
        Cells of each header row.
    profile : FormatProfile
        Its ``labels``.
    dialect : Dialect
        How numbers are written.

    Returns
    -------
    dict of str to LabelValue
        Dimensions without a number or without a unit that belongs to them have no value.
    """
    found: dict[str, LabelValue] = {}
    for index, cells in enumerate(rows):
        for label, value in {
            **_in_row(cells, profile, dialect),
            **_in_columns(rows, index, profile, dialect),
        }.items():
            found.setdefault(label, value)
    return found


def _label_of(name: str, profile: FormatProfile) -> str | None:
    """Find the label that a key means; ``Group : Name`` counts as ``Name``."""
    name = name.rsplit(" : ", 1)[-1]
    for label, names in profile.labels.items():
        if any(name_matches(name, known) for known in names):
            return label
    return None


def _in_row(
    cells: Sequence[str], profile: FormatProfile, dialect: Dialect
) -> dict[str, LabelValue]:
    """Key, value, unit."""
    filled = [cell.strip() for cell in cells if cell.strip()]
    if len(filled) == 1 and ":" in filled[0]:
        filled = [part.strip() for part in filled[0].split(":", 1)]
    if len(filled) < 2:
        return {}
    key, unit = split_unit(filled[0])
    label = _label_of(key, profile)
    if label is None or _label_of(split_unit(filled[1])[0], profile) is not None:
        return {}
    stated = filled[2] if len(filled) > 2 and is_unit(filled[2]) else unit or ""
    return {label: _value(label, filled[1], stated, dialect)}


def _in_columns(
    rows: Sequence[Sequence[str]], index: int, profile: FormatProfile, dialect: Dialect
) -> dict[str, LabelValue]:
    """Names over units over one row of values; several rows of values are several specimens."""
    below = [list(row) for row in rows[index + 1 : index + 4]]
    units = below.pop(0) if below and _holds_units(below[0]) else []
    values, next_values = (*below, [], [])[:2]
    found = {}
    for position, cell in enumerate(rows[index]):
        name, unit = split_unit(cell)
        label = _label_of(name, profile) if name else None
        text = _cell(values, position)
        alone = not _cell(next_values, position)
        if label not in (None, "specimen") and alone and dialect.is_number(text):
            stated = _cell(units, position) or unit or ""
            found[str(label)] = _value(str(label), text, stated, dialect)
    return found


def _holds_units(cells: Sequence[str]) -> bool:
    return any(is_unit(cell) and not cell.isdigit() for cell in cells if cell)


def _cell(cells: Sequence[str], position: int) -> str:
    return cells[position].strip() if position < len(cells) else ""


def _value(label: str, text: str, unit: str, dialect: Dialect) -> LabelValue:
    if label == "specimen":
        return LabelValue(text)
    head, _, tail = text.partition(" ")
    if tail and is_unit(tail):
        text, unit = head, tail
    unit = clean_unit(unit)
    scale = factor(label, unit) if unit else None
    if scale is None or not dialect.is_number(text):
        return LabelValue(text, None, unit)
    plain = text.replace(dialect.thousands, "") if dialect.thousands else text
    return LabelValue(text, float(plain.replace(dialect.decimal, ".")) * scale, unit)
