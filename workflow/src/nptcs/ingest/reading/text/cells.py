"""What every source of cells offers, and text files as rows of cells and columns of numbers."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Literal, Protocol

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.ingest.reading.table_columns import FoundTable
from nptcs.ingest.reading.text.clock import holds_clock
from nptcs.ingest.reading.text.dialect import MISSING, Dialect, number_pattern
from nptcs.ingest.reading.text.dressed_rows import units_of_cells
from nptcs.ingest.reading.text.regular_rows import chunk_edges, regular_width

NOTHING = "nan"
_COMMENT = re.compile(
    r"^\s*(?:#+|//+|!+|>+|%+(?=\s+(?!\S*(?:strain|dehnung|elongation))[^\W\d_]))\s*"
    r"(?:(?i:columns?|fields?|channels?|header)\s*:\s*)?"
)
Kind = Literal["data", "odd data", "empty", "remark", "names", "other"]
"""``odd data``: a row of numbers that contains something else too."""


class CellSource(Protocol):
    """Rows of cells, whatever the file is."""

    part: str

    @property
    def kinds(self) -> list[Kind]:
        """Kind of each row."""
        ...

    def cells(self, row: int) -> list[str]:
        """Cells of a row (from 0) as text."""
        ...

    @property
    def widths(self) -> list[int]:
        """Number of cells of each row."""
        ...

    def clock_columns(self, row: int) -> list[int]:
        """Positions of the cells of a row that were a time of day."""
        ...

    def odd_clock_row(self, found_table: FoundTable) -> int | None:
        """First row of a table with another number of times of day than its first row."""
        ...

    def units_in(self, row: int) -> list[str]:
        """Units after the numbers of a row's cells; empty if its numbers stand alone."""
        ...

    def numbers(self, found_table: FoundTable, positions: Sequence[int]) -> Array:
        """Columns of a table as numbers, shape (rows, positions)."""
        ...


def kind_of(cells: Sequence[str], numbers: int) -> Kind:
    """Kind of a row that is not all numbers, by its cells and how many of them are numbers."""
    filled = [cell for cell in cells if cell]
    if not filled:
        return "empty"
    if numbers >= 2 and 2 * numbers >= len([c for c in filled if c.casefold() not in MISSING]):
        return "odd data"
    if numbers == 0:
        return "remark" if len(filled) == 1 else "names"
    return "other"


def split_lines(text: str) -> list[str]:
    """Lines of a text, ended by LF, CRLF or a bare CR."""
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")


@dataclass
class TextSource:
    """A text file whose dialect is known."""

    path: Path
    lines: list[str]
    dialect: Dialect
    missing: frozenset[str]
    clock_lines: Mapping[int, str] = field(default_factory=dict)
    clock_counts: Mapping[int, int] = field(default_factory=dict)
    unit_lines: Mapping[int, str] = field(default_factory=dict)
    part: str = ""

    @cached_property
    def _row(self) -> re.Pattern[str]:
        """Match a row whose cells are all numbers or empty, in this dialect."""
        number = number_pattern(self.dialect.decimal, self.dialect.thousands).pattern
        if self.dialect.delimiter == "spaces":
            return re.compile(rf"\s*{number}(?:\s+{number})+\s*", re.ASCII)
        blank = "[ ]*" if self.dialect.delimiter == "\t" else r"[ \t]*"
        bare = rf"(?:{number})?" if self._marks_apart else ""
        cell = rf'{blank}(?:"{number}"|{bare}){blank}'
        mark = re.escape(self.dialect.delimiter)
        return re.compile(rf"{cell}(?:{mark}{cell})+", re.ASCII)

    @cached_property
    def _full_row(self) -> re.Pattern[str]:
        """Match a row of bare numbers, in this dialect: the usual row, found fast."""
        number = number_pattern(self.dialect.decimal, "").pattern
        spaces = self.dialect.delimiter == "spaces"
        mark = r"[ \t]+" if spaces else re.escape(self.dialect.delimiter)
        return re.compile(rf"{number}(?:{mark}{number})+", re.ASCII)

    @property
    def _marks_apart(self) -> bool:
        """Whether the delimiter is neither decimal nor thousands mark: numbers need no quotes."""
        return self.dialect.delimiter not in (self.dialect.decimal, self.dialect.thousands)

    @cached_property
    def kinds(self) -> list[Kind]:
        """Kind of each row."""
        usual = self._full_row.fullmatch if self._marks_apart else re.compile("(?!)").fullmatch
        kinds: list[Kind] = []
        for start, stop, width in self._regular_chunks:
            lines = self.lines[start:stop]
            if width >= 2:
                kinds += ["data"] * len(lines)
            else:
                kinds += ["data" if usual(line) else self._kind(line) for line in lines]
        return kinds

    @cached_property
    def _regular_chunks(self) -> list[tuple[int, int, int]]:
        """Lines [first, last) of each chunk, and its number of cells if all are numbers, else 0."""
        return [
            (start, stop, regular_width(self.lines[start:stop], self.dialect))
            for start, stop in pairwise(chunk_edges(len(self.lines)))
        ]

    def _kind(self, line: str) -> Kind:
        if not line.strip():
            return "empty"
        if self._row.fullmatch(line):
            cells = self.dialect.split(line)
            filled = sum(bool(cell) for cell in cells)
            return "data" if filled >= 2 else "other" if filled else "empty"
        cells = self.dialect.split(line)
        return kind_of(cells, sum(self.dialect.is_number(cell) for cell in cells))

    def cells(self, row: int) -> list[str]:
        """Cells of a row as text."""
        return self.dialect.split(self.lines[row])

    @cached_property
    def widths(self) -> list[int]:
        """Number of cells of each row."""
        delimiter = self.dialect.delimiter
        if delimiter == "spaces":
            return [len(line.split()) for line in self.lines]
        widths: list[int] = []
        for start, stop, width in self._regular_chunks:
            lines = self.lines[start:stop]
            widths += (
                [width] * len(lines)
                if width
                else [
                    len(self.dialect.split(line)) if '"' in line else line.count(delimiter) + 1
                    for line in lines
                ]
            )
        return widths

    def clock_columns(self, row: int) -> list[int]:
        """Positions of the cells of a row that were a time of day."""
        cells = self.dialect.split(self.clock_lines.get(row, ""))
        return [position for position, cell in enumerate(cells) if holds_clock(cell)]

    def odd_clock_row(self, found_table: FoundTable) -> int | None:
        """First row of a table with another number of times of day than its first row."""
        if not self.clock_counts:
            return None
        counts = [self.clock_counts.get(row, 0) for row in found_table.rows_of_data]
        odd = (
            row for row, n in zip(found_table.rows_of_data, counts, strict=True) if n != counts[0]
        )
        return next(odd, None)

    def units_in(self, row: int) -> list[str]:
        """Units after the numbers of a row's cells; empty if its numbers stand alone."""
        line = self.unit_lines.get(row)
        return [] if line is None else units_of_cells(self.dialect.split(line))

    def header_cells(self, row: int, width: int) -> list[str]:
        """Cells of a row of names, which may contain blanks even where blanks also separate.

        A comment mark before the first name (``# time force``) is not part of it.
        """
        line = self.lines[row]
        if self.dialect.delimiter != "spaces":
            return self.dialect.split(_COMMENT.sub("", line))
        line = _COMMENT.sub("", line.strip()).strip()
        wide = re.split(r"\s{2,}|\t", line)
        return wide if len(wide) == width else line.split()

    def is_missing(self, cell: str) -> bool:
        """Tell whether the cell says that there is no value."""
        return cell.casefold() in MISSING or cell in self.missing

    def numbers(self, found_table: FoundTable, positions: Sequence[int]) -> Array:
        """Columns of a table as numbers; a cell that is not a number is refused with its place."""
        rows, kinds = found_table.rows_of_data, self.kinds
        if rows[-1] - rows[0] == len(rows) - 1 and "odd data" not in kinds[rows[0] : rows[-1] + 1]:
            lines = self.lines[rows[0] : rows[-1] + 1]
        else:
            lines = [
                self.lines[row]
                if kinds[row] == "data"
                else self._checked_line(found_table, row, positions)
                for row in rows
            ]
        text = "\n".join(lines)
        if self._uses_thousands(text):
            return self._numbers_with_thousands(found_table, positions)
        filled = self._all_filled(rows)
        frame = pd.read_csv(
            io.BytesIO(text.encode()),
            sep=r"\s+" if self.dialect.delimiter == "spaces" else self.dialect.delimiter,
            decimal=self.dialect.decimal,
            header=None,
            names=list(range(found_table.width)),
            usecols=list(dict.fromkeys(positions)),
            index_col=False,
            dtype=np.float64,
            na_values=["", NOTHING],
            keep_default_na=False,
            skipinitialspace=not filled,
            na_filter=not filled,
            low_memory=False,
        )
        values = frame[list(positions)].to_numpy()
        self._refuse_infinite(found_table, values, positions)
        return values

    def _all_filled(self, rows: Sequence[int]) -> bool:
        """Tell whether all lines of a table are in chunks in which every cell is a number."""
        chunks = [chunk for chunk in self._regular_chunks if chunk[1] > rows[0]]
        return all(width for start, _, width in chunks if start <= rows[-1])

    def _checked_line(self, found_table: FoundTable, row: int, positions: Sequence[int]) -> str:
        """Return a line that is not all numbers, with only the checked cells."""
        self._check_cells(found_table, row, positions)
        cells = [
            cell if position in positions and not self.is_missing(cell) else NOTHING
            for position, cell in enumerate(self.cells(row))
        ]
        if self.dialect.delimiter == "spaces":
            return " ".join(cells)
        return self.dialect.delimiter.join(f'"{cell}"' for cell in cells)

    def _check_cells(self, found_table: FoundTable, row: int, positions: Sequence[int]) -> None:
        cells = self.cells(row)
        for position in positions:
            cell = cells[position] if position < len(cells) else ""
            if not self.dialect.is_number(cell) and not self.is_missing(cell):
                raise InputError(
                    "not a number",
                    "correct the file, or name the word in the profile's 'missing'",
                    self.path,
                    row + 1,
                    found_table.columns[position].name or f"number {position + 1}",
                    value=cell,
                )

    def _uses_thousands(self, text: str) -> bool:
        mark = self.dialect.thousands
        if not mark:
            return False
        before = r"\d" if self._marks_apart else r'"[+-]?\d{1,3}'
        return re.search(rf"{before}{re.escape(mark)}\d{{3}}", text, re.ASCII) is not None

    def _numbers_with_thousands(self, found_table: FoundTable, positions: Sequence[int]) -> Array:
        def plain(cell: str) -> str:
            if self.is_missing(cell):
                return "nan"
            return cell.replace(self.dialect.thousands, "").replace(self.dialect.decimal, ".")

        rows = [self.cells(row) for row in found_table.rows_of_data]
        text = [[plain(c[p]) if p < len(c) else "nan" for p in positions] for c in rows]
        values = np.array(text, dtype=np.float64)
        self._refuse_infinite(found_table, values, positions)
        return values

    def _refuse_infinite(
        self, found_table: FoundTable, values: Array, positions: Sequence[int]
    ) -> None:
        for index, column in np.argwhere(np.isinf(values))[:1]:
            raise InputError(
                "number is too large",
                "correct the file",
                self.path,
                found_table.rows_of_data[index] + 1,
                found_table.columns[positions[column]].name,
            )
