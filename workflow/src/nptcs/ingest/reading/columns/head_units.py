"""Units that a file states in its head only: ``Force unit: kN``, ``Load, kN``, ``Units: s, kN``."""

from __future__ import annotations

import re

from nptcs.ingest.reading.columns.quantities import Test
from nptcs.ingest.reading.columns.tons import settle_tons
from nptcs.ingest.reading.profiles import normalise
from nptcs.ingest.reading.units import clean_unit, is_unit

_UNIT = "units?|einheit|unité|unidad|unità|unidade|jednostka"
_KEY = re.compile(
    rf"^(?:(?P<before>.+?)[ _-]*(?:{_UNIT}|单位|單位)"
    rf"|(?:{_UNIT})(?: of| der| de| di)?[ _]+(?P<after>.+))$"
)
_SPLIT = re.compile(r"\s*[:=;\t,]\s*")
_ROWS = 60
_ROW_OF_UNITS = ("y unit label", "units", "unit", "einheiten", "einheit", "unités", "unites")


def add_units_of_head(test: Test) -> None:
    """Give columns without a unit the one that an entry above the names states for them.

    Parameters
    ----------
    test : Test
        The chosen table; the units of its columns are changed.
    """
    found_table = test.found_table
    last = found_table.first if found_table.names_row is None else found_table.names_row
    lacking = [column for column in found_table.columns if column.name and not column.unit]
    if not lacking or not last:
        return
    stated: dict[str, str] = {}
    for row in range(max(0, last - _ROWS), last):
        _take_row(test, row)
        text = ";".join(cell for cell in test.source.cells(row) if cell)
        parts = [part for part in _SPLIT.split(text) if part]
        if len(parts) != 2 or not is_unit(parts[1]):
            continue
        key = _KEY.match(normalise(parts[0]))
        name = (key["before"] or key["after"]) if key else normalise(parts[0])
        stated[name] = clean_unit(parts[1])
    for column in (one for one in lacking if not one.unit):
        if unit := stated.get(normalise(column.name)):
            column.unit = unit
            found_table.notes.append(f"column '{column.name}': unit {unit} from the head")
    settle_tons(found_table)


def _take_row(test: Test, row: int) -> None:
    """Take the units of a row ``Y_Unit_Label, N, %``.

    Each is at the place of its column, or after the word if there are as many as columns; all of
    them may be in one cell (``Units: s, N, %``).
    """
    key, *cells = [cell.strip() for cell in test.source.cells(row)] or [""]
    if not any(cells) and ":" in key:
        key, *cells = [part for part in _SPLIT.split(key) if part]
        cells = cells if len(cells) == test.found_table.width else []
    if normalise(key) not in _ROW_OF_UNITS:
        return
    while cells and not cells[-1]:
        cells.pop()
    first = 0 if len(cells) == test.found_table.width else 1
    for column in test.found_table.columns:
        place = column.position - first
        unit = cells[place] if 0 <= place < len(cells) else ""
        if unit and not column.unit and is_unit(unit):
            column.unit = clean_unit(unit)
