"""Find the tables of a source: one file may have several, with different columns."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from nptcs.errors import InputError
from nptcs.ingest.reading.native.sheet_cells import SheetSource
from nptcs.ingest.reading.table_columns import SMALLEST_TABLE, FoundTable, describe_columns
from nptcs.ingest.reading.text.cells import CellSource, TextSource
from nptcs.ingest.reading.units import clean_unit

DATA = frozenset(("data", "odd data"))
_ROWS_ABOVE = 4
_NOTES_SHARE = 0.2
"""Share of the rows up to which readings without a name are notes next to the table."""
_OF_A_SUMMARY = re.compile(
    r"(?i)(max|min|mean|average|avg|median|std|stand|s\.?d\.?$|cv|cov|n$|sum|total|mittel|"
    r"standardabw|moyenne|[ée]cart|media|desv|m[áa]x|m[íi]n|сред|макс|мин|平均|最大|最小|標準|标准)"
)


def find_tables(source: CellSource, path: Path, unnamed: str) -> list[FoundTable]:
    """Find every table of at least `SMALLEST_TABLE` rows.

    Blank rows and one-cell remarks inside a table are left out and noted. A row in the middle of
    a table that is neither numbers, a remark nor names is an error.

    Parameters
    ----------
    source : CellSource
        Rows of cells.
    path : Path
        For messages.
    unnamed : str
        Where surplus columns without a name are (`FormatProfile.unnamed_columns`).
    """
    found_tables = [
        found_table
        for found_table in _runs(source)
        if len(found_table.rows_of_data) >= SMALLEST_TABLE
    ]
    for number, found_table in enumerate(found_tables, 1):
        found_table.part = str(number)
        _drop_footer(source, found_table)
        _refuse_broken(source, found_table, path)
        _trim(source, found_table, path)
        above = _rows_above(source, found_table)
        describe_columns(found_table, above, unnamed)
        _settle_unnamed(source, found_table, unnamed, path)
        _settle_clocks(source, found_table, path)
        _settle_units(source, found_table, path)
    return found_tables


def _drop_footer(source: CellSource, found_table: FoundTable) -> None:
    """Leave out rows of a summary below the readings: ``Maximum``, ``Mean`` and the like."""
    while len(found_table.rows_of_data) > SMALLEST_TABLE:
        row = found_table.rows_of_data[-1]
        if source.kinds[row] != "odd data":
            return
        first = next((cell for cell in source.cells(row) if cell), "")
        if not _OF_A_SUMMARY.match(first):
            return
        found_table.rows_of_data.pop()
        found_table.last = found_table.rows_of_data[-1] + 1
        found_table.notes.append(f"line {row + 1}, '{first[:30]}', is a summary and was left out")


def _refuse_broken(source: CellSource, found_table: FoundTable, path: Path) -> None:
    for row in found_table.broken:
        raise InputError(
            "row inside a table does not consist of numbers",
            "correct or delete the row",
            path,
            row + 1,
            value=" | ".join(source.cells(row))[:80],
        )


def _settle_unnamed(source: CellSource, found_table: FoundTable, unnamed: str, path: Path) -> None:
    """Drop phantom columns at the end; a column of numbers without a name is an error."""
    surplus = found_table.unnamed_at_end
    if not surplus or unnamed == "last":
        return
    first = found_table.width - surplus
    filled = [row for row in found_table.rows_of_data if any(source.cells(row)[first:])]
    for row in filled:
        if not _names_are_in_place(source, found_table, len(filled)):
            raise InputError(
                f"{found_table.width} columns, but {first} names: it is not clear which column "
                "has no name",
                "state unnamed_columns (first or last) in a profile",
                path,
                row + 1,
            )
    found_table.columns = found_table.columns[:first]
    what = "with notes but no name" if filled else "without name or values"
    found_table.notes.append(f"{surplus} phantom column(s) {what} left out")


def _names_are_in_place(source: CellSource, found_table: FoundTable, filled: int) -> bool:
    """Tell whether the names are surely those of the columns below them.

    In a workbook each is in its cell. In a text they are if the row of names is as wide as the
    table, and what has no name is a note next to a few of the rows.
    """
    if isinstance(source, SheetSource):
        return True
    row = found_table.names_row
    wide = row is not None and source.widths[row] >= found_table.width
    return wide and filled <= _NOTES_SHARE * len(found_table.rows_of_data)


def _settle_clocks(source: CellSource, found_table: FoundTable, path: Path) -> None:
    """Mark columns of times of day; a time of day in some rows only is an error."""
    positions = source.clock_columns(found_table.first)
    odd = source.odd_clock_row(found_table)
    if odd is not None:
        raise InputError(
            "only some rows of the table have a time of day",
            "correct the row",
            path,
            odd + 1,
            value=" | ".join(source.cells(odd))[:80],
        )
    for column in found_table.columns:
        if column.position in positions:
            column.unit, column.clock = "s", True
            found_table.notes.append(f"column {column.position + 1} is a time of day, read in s")


def _settle_units(source: CellSource, found_table: FoundTable, path: Path) -> None:
    """Take the units after the numbers; units that change within a column are an error."""
    if not source.units_in(found_table.first):
        return
    rows = {row: source.units_in(row) for row in found_table.rows_of_data}
    for column in found_table.columns:
        place = column.position
        stated = column.unit
        for row, units in rows.items():
            unit = units[place] if place < len(units) else ""
            if unit and stated and clean_unit(unit) != clean_unit(stated):
                raise InputError(
                    f"a number in {unit}, where the column's unit is {stated}",
                    "export the column in one unit",
                    path,
                    row + 1,
                    column.name or f"number {place + 1}",
                )
            stated = stated or unit or None
        column.unit = stated


def _runs(source: CellSource) -> list[FoundTable]:
    """Consecutive rows of data; what may interrupt a table is decided here."""
    runs: list[FoundTable] = []
    gap: list[int] = []
    widths = source.widths
    is_data = np.frombuffer(bytearray(map(DATA.__contains__, source.kinds)), dtype=bool)
    edges = [0, *(np.flatnonzero(np.diff(is_data)) + 1).tolist(), len(is_data)]
    for start, stop in pairwise(edges):
        rows = list(range(start, stop))
        if start == stop or not is_data[start]:
            gap = rows
            continue
        width = max(widths[start:stop])
        last = runs[-1] if runs else None
        if last is not None and _continues(source, last, gap, widths[rows[0]]):
            _note_gap(source, last, gap)
            last.rows_of_data += rows
            last.last = rows[-1] + 1
            last.width = max(last.width, width)
        else:
            _note_end(source, runs, gap)
            runs.append(FoundTable(rows[0], rows[-1] + 1, width, rows_of_data=rows))
        gap = []
    _note_end(source, runs, gap)
    return runs


def _note_end(source: CellSource, runs: list[FoundTable], gap: list[int]) -> None:
    """Say where a table ends if something that is not blank follows."""
    row = next((row for row in gap if source.kinds[row] != "empty"), None)
    if runs and row is not None:
        text = " ".join(cell for cell in source.cells(row) if cell)
        runs[-1].notes.append(f"the table ends above line {row + 1}: {text[:60]!r}")


def _continues(source: CellSource, found_table: FoundTable, gap: list[int], width: int) -> bool:
    """Tell whether the table goes on after the rows of `gap`."""
    kinds = [source.kinds[row] for row in gap]
    if "names" in kinds:
        return False
    return "other" not in kinds or abs(width - found_table.width) <= 1


def _note_gap(source: CellSource, found_table: FoundTable, gap: list[int]) -> None:
    for row in gap:
        kind = source.kinds[row]
        if kind == "other":
            found_table.broken.append(row)
        if kind == "remark":
            text = " ".join(cell for cell in source.cells(row) if cell)
            found_table.notes.append(f"line {row + 1} is a remark: {text[:60]!r}")


def _trim(source: CellSource, found_table: FoundTable, path: Path) -> None:
    """Refuse rows that lack cells in the middle; drop a last line that was cut off."""
    widths = source.widths
    rows = found_table.rows_of_data
    whole = rows[-1] - rows[0] == len(rows) - 1
    lengths = widths[rows[0] : rows[-1] + 1] if whole else [widths[row] for row in rows]
    if len(lengths) > 1 and lengths[-1] < lengths[-2]:
        row = found_table.rows_of_data.pop()
        lengths.pop()
        found_table.notes.append(f"line {row + 1}, the last, is cut off and was dropped")
    if len(set(lengths)) <= 1:
        return
    for index in range(1, len(lengths)):
        if lengths[index] > lengths[index - 1]:
            raise InputError(
                f"row has {lengths[index - 1]} cells, the next one {lengths[index]}",
                "complete or delete the row",
                path,
                found_table.rows_of_data[index - 1] + 1,
            )


def _rows_above(source: CellSource, found_table: FoundTable) -> list[tuple[int, list[str]]]:
    """Collect the filled rows above a table, nearest first; in a text a blank row ends it."""
    found: list[tuple[int, list[str]]] = []
    for row in range(found_table.first - 1, max(found_table.first - 8, -1), -1):
        kind = source.kinds[row]
        if kind in DATA or len(found) == _ROWS_ABOVE:
            break
        if kind == "empty":
            if len(found) >= 1 and not isinstance(source, SheetSource):
                break
            continue
        cells = (
            source.header_cells(row, found_table.width)
            if isinstance(source, TextSource)
            else source.cells(row)
        )
        found.append((row, cells))
    return found
