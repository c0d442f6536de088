"""The sheets of a workbook, or of any file of native numbers, as rows of cells."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.ingest.reading.table_columns import FoundTable
from nptcs.ingest.reading.text.cells import Kind, kind_of
from nptcs.ingest.reading.text.dialect import MISSING

FORMULA = "<formula without value>"
"""Content of a sheet's cell whose formula was never computed."""


class Clock(float):
    """A time of day or a date of a workbook, in s."""


class WithUnit(float):
    """A number of a text cell such as ``12.5 N``, and its unit."""

    unit: str = ""


@dataclass
class SheetSource:
    """One sheet of a workbook: native numbers and texts."""

    path: Path
    part: str
    rows: list[tuple[object, ...]]
    missing: frozenset[str]

    @cached_property
    def kinds(self) -> list[Kind]:
        """Kind of each row."""
        return [self._kind(row) for row in self.rows]

    def _kind(self, row: tuple[object, ...]) -> Kind:
        numbers = sum(_is_native_number(cell) or cell == FORMULA for cell in row)
        filled = sum(cell is not None and str(cell).strip() != "" for cell in row)
        if numbers >= 2 and numbers == filled:
            return "data"
        return kind_of([_text(cell) for cell in row], numbers)

    def cells(self, row: int) -> list[str]:
        """Cells of a row as text."""
        return [_text(cell) for cell in self.rows[row]]

    @cached_property
    def widths(self) -> list[int]:
        """Number of cells of each row."""
        return [len(row) for row in self.rows]

    def clock_columns(self, row: int) -> list[int]:
        """Positions of the cells of a row that were a time of day."""
        return [place for place, cell in enumerate(self.rows[row]) if isinstance(cell, Clock)]

    def odd_clock_row(self, found_table: FoundTable) -> int | None:
        """Return None: each cell knows its own type and is checked where it is needed."""
        return None

    def units_in(self, row: int) -> list[str]:
        """Units after the numbers of a row's cells, which only texts have; else empty."""
        units = [cell.unit if isinstance(cell, WithUnit) else "" for cell in self.rows[row]]
        return units if any(units) else []

    def numbers(self, found_table: FoundTable, positions: Sequence[int]) -> Array:
        """Columns of a table as numbers; a cell that is not a number is refused with its place."""
        values = [
            [self._number(found_table, row, position) for position in positions]
            for row in found_table.rows_of_data
        ]
        return np.array(values, dtype=np.float64)

    def _number(self, found_table: FoundTable, row: int, position: int) -> float:
        cell = self.rows[row][position] if position < len(self.rows[row]) else None
        if (
            _is_native_number(cell)
            and isinstance(cell, Clock) == found_table.columns[position].clock
        ):
            return float(cell)  # type: ignore[arg-type]
        text = _text(cell)
        if cell == FORMULA:
            name = found_table.columns[position].name or position + 1
            raise InputError(
                f"sheet '{self.part}': column {name} holds formulas without stored values",
                "open and save it in a spreadsheet",
                self.path,
                row + 1,
            )
        if text.casefold() in MISSING or text in self.missing:
            return float("nan")
        raise InputError(
            f"sheet '{self.part}': cell is not a number",
            "store numbers as numbers, not as text or dates",
            self.path,
            row + 1,
            found_table.columns[position].name or f"number {position + 1}",
            value=text,
        )


def _is_native_number(cell: object) -> bool:
    return isinstance(cell, int | float) and not isinstance(cell, bool) and np.isfinite(cell)


def _text(cell: object) -> str:
    return "" if cell is None else str(cell).strip()
