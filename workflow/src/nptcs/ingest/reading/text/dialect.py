"""How a text file writes its numbers: delimiter, decimal mark, thousands mark.

Nothing is guessed in silence: a dialect is taken if it alone makes the rows readable. A table
that two dialects read as different numbers (``1,234``) is refused with the choices.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from nptcs.errors import InputError
from nptcs.ingest.reading.profiles import DELIMITERS, FormatProfile

MISSING = frozenset(
    [
        *("", "nan", "-nan", "nan(ind)", "-nan(ind)", "1.#qnan", "-1.#ind", "1.#inf", "-1.#inf"),
        *("inf", "-inf", "+inf", "null", "none", "n/a", "na", "n.a.", "k.a.", "n. def.", "n.def."),
        *("#n/a", "#nv", "#div/0!", "#value!", "#wert!", "#ref!", "#bezug!", "#name?", "#num!"),
        *("-", "--", "---", "–", "—", "*", "****", "/"),
    ]
)
"""Cells that say that there is no value, in lower case."""
SMALLEST_TABLE = 3
"""Rows of numbers that a dialect must read before it is believed."""
_SPACED_DIGITS = re.compile(r" (?<=\d )\d{3}(?!\d)")
_HEAD = 120
_PROBE = 20
SEPARATOR_NAMES = {"\t": "tab", "spaces": "spaces"}


@dataclass(frozen=True)
class Dialect:
    """Delimiter (a character or ``spaces``), decimal mark, thousands mark (or empty)."""

    delimiter: str
    decimal: str
    thousands: str = ""

    def describe(self) -> str:
        """Describe the dialect in words."""
        text = f"delimiter {SEPARATOR_NAMES.get(self.delimiter, repr(self.delimiter))}"
        text += f", decimal mark {self.decimal!r}"
        return text + (f", thousands mark {self.thousands!r}" if self.thousands else "")

    def split(self, line: str) -> list[str]:
        """Cells of one line, stripped, without quotes."""
        if self.delimiter == "spaces":
            return line.split()
        if '"' in line:
            try:
                cells = next(csv.reader([line], delimiter=self.delimiter, skipinitialspace=True))
            except (csv.Error, StopIteration):
                cells = line.split(self.delimiter)
        else:
            cells = line.split(self.delimiter)
        return [cell.strip() for cell in cells]

    def is_number(self, cell: str) -> bool:
        """Tell whether `cell` is a number in this dialect."""
        return number_pattern(self.decimal, self.thousands).fullmatch(cell) is not None

    def is_data(self, cells: Sequence[str]) -> bool:
        """Tell whether this is a row of a table: two or more numbers, and mostly numbers."""
        is_number = number_pattern(self.decimal, self.thousands).fullmatch
        others = [cell for cell in cells if not is_number(cell)]
        numbers = len(cells) - len(others)
        if numbers < 2:
            return False
        return numbers >= sum(cell.casefold() not in MISSING for cell in others)


@lru_cache
def number_pattern(decimal: str, thousands: str) -> re.Pattern[str]:
    """Return the pattern of a whole cell with a number, with these marks."""
    mark = re.escape(decimal)
    exponent = r"(?:[eE][+-]?\d+)?"
    plain = rf"(?:\d+(?:{mark}\d*)?|{mark}\d+){exponent}"
    if not thousands:
        return re.compile(rf"[+-]?{plain}", re.ASCII)
    grouped = rf"[1-9]\d{{0,2}}(?:{re.escape(thousands)}\d{{3}})+(?:{mark}\d*)?"
    return re.compile(rf"[+-]?(?:{plain}|{grouped})", re.ASCII)


def candidates(profile: FormatProfile, lines: Sequence[str]) -> list[Dialect]:
    """Dialects to try: those that the profile allows and whose marks occur in the lines."""
    delimiters = (
        [DELIMITERS[profile.delimiter]] if profile.delimiter else _delimiters_in(_sample(lines))
    )
    if profile.decimal:
        return [Dialect(delimiter, profile.decimal, profile.thousands) for delimiter in delimiters]
    text = "\n".join(lines)
    point, comma = "." in text, "," in text
    found = [Dialect(delimiter, ".") for delimiter in delimiters]
    if comma:
        found += [Dialect(delimiter, ",") for delimiter in delimiters]
        found += [Dialect(delimiter, ".", ",") for delimiter in delimiters]
    if point:
        found += [Dialect(delimiter, ",", ".") for delimiter in delimiters]
    if _SPACED_DIGITS.search(text):
        apart = [delimiter for delimiter in delimiters if delimiter != "spaces"]
        found += [Dialect(delimiter, mark, " ") for delimiter in apart for mark in ".,"]
    return found


def _delimiters_in(lines: Sequence[str]) -> list[str]:
    """Delimiters that occur in as many lines as make a table."""
    stripped = [line.strip() for line in lines]

    def occurs(delimiter: str) -> bool:
        mark = " " if delimiter == "spaces" else delimiter
        return sum(mark in line for line in stripped) >= SMALLEST_TABLE

    return [delimiter for delimiter in DELIMITERS.values() if occurs(delimiter)]


def find_dialect(lines: Sequence[str], profile: FormatProfile, path: Path) -> Dialect:
    """Find the one dialect that reads the table.

    Parameters
    ----------
    lines : sequence of str
        All lines of the file.
    profile : FormatProfile
        For what it declares, nothing else is tried.
    path : Path
        For messages.

    Raises
    ------
    InputError
        If no dialect reads a table, or several read different numbers.
    """
    sample = _sample(lines)
    tied = _tied(candidates(profile, lines), sample)
    if not tied:
        raise InputError(
            "no table of numbers found",
            "check that the raw data were exported, not only the results; numbers need one "
            "decimal mark and one delimiter",
            path,
        )
    best = _different(tied)
    unseen = lines[_HEAD:] if len(sample) < len(lines) else []
    others = [dialect for dialect in tied if _may_differ(dialect, best[0], unseen)]
    if len(best) > 1 or others:
        best = _different(_tied([best[0], *best[1:], *others], lines))
    if len(best) > 1:
        raise _ambiguous(best, lines, path)
    return best[0]


Reading = tuple[tuple[str, ...], ...]


def _tied(dialects: Sequence[Dialect], lines: Sequence[str]) -> dict[Dialect, Reading]:
    """Dialects that read the most rows and leave the fewest cells, and the numbers they read.

    A thousands mark is believed if a number proves it (``1.234,5`` or ``1,234,567``). Without
    such a number it cannot win, but a draw still makes the table ambiguous.
    """
    readings = {dialect: _rows(dialect, lines) for dialect in _promising(dialects, lines)}
    declared = len({(dialect.decimal, dialect.thousands) for dialect in dialects}) == 1
    proven = [dialect for dialect, read in readings.items() if declared or _proven(dialect, read)]
    most = max((len(readings[dialect].rows) for dialect in proven), default=0)
    if most < SMALLEST_TABLE:
        return {}
    full = {dialect: read for dialect, read in readings.items() if len(read.rows) == most}
    least = min(full[dialect].unread for dialect in proven if dialect in full)
    best = {dialect: read.rows for dialect, read in full.items() if read.unread == least}
    if len(best) == 1:
        return dict.fromkeys(best, ())
    return {dialect: _numbers(dialect, rows) for dialect, rows in best.items()}


def _promising(dialects: Sequence[Dialect], lines: Sequence[str]) -> list[Dialect]:
    """Leave out dialects that read no row in the middle, where another one reads most."""
    middle = len(lines) // 2
    probe = lines[max(middle - _PROBE // 2, 0) :][:_PROBE]
    read = {dialect: len(_rows(dialect, probe).rows) for dialect in dialects}
    if max(read.values(), default=0) < 0.75 * _PROBE:
        return list(dialects)
    return [dialect for dialect in dialects if read[dialect]]


def _proven(dialect: Dialect, read: _Rows) -> bool:
    if not dialect.thousands:
        return True
    mark, decimal = re.escape(dialect.thousands), re.escape(dialect.decimal)
    proof = re.compile(rf"[+-]?[1-9]\d{{0,2}}{mark}\d{{3}}(?:{mark}\d{{3}}|{decimal}\d)")
    return any(
        proof.match(cell) and dialect.is_number(cell) for cells in read.rows for cell in cells
    )


def _different(tied: dict[Dialect, Reading]) -> list[Dialect]:
    """One dialect, the first, for each different reading."""
    first: dict[Reading, Dialect] = {}
    for dialect, reading in tied.items():
        first.setdefault(reading, dialect)
    return list(first.values())


def _may_differ(dialect: Dialect, chosen: Dialect, lines: Sequence[str]) -> bool:
    """Tell whether a file has marks that dialects equal in the sample may read differently."""
    if (dialect.decimal, dialect.thousands) == (chosen.decimal, chosen.thousands):
        return False
    marks = {dialect.decimal, dialect.thousands} ^ {chosen.decimal, chosen.thousands}
    if dialect.delimiter in marks:
        return any('"' in line for line in lines)
    return any(mark in line for mark in marks if mark for line in lines)


def _sample(lines: Sequence[str]) -> Sequence[str]:
    """Head, middle and end of a long file."""
    if len(lines) <= 2 * _HEAD:
        return lines
    middle = len(lines) // 2
    return [*lines[:_HEAD], *lines[middle : middle + 60], *lines[-60:]]


@dataclass(frozen=True)
class _Rows:
    """Rows of numbers that a dialect reads, and their cells that are neither number nor empty."""

    rows: list[list[str]]
    unread: int


def _rows(dialect: Dialect, lines: Sequence[str]) -> _Rows:
    rows, unread = [], 0
    apart = dialect.delimiter not in (dialect.decimal, dialect.thousands)
    all_numbers = _full_row(dialect.delimiter, dialect.decimal).fullmatch
    is_number = number_pattern(dialect.decimal, dialect.thousands).fullmatch
    for line in lines:
        if apart and all_numbers(line):
            rows.append(line.split(None if dialect.delimiter == "spaces" else dialect.delimiter))
            continue
        if dialect.delimiter != "spaces" and dialect.delimiter not in line:
            continue  # a row of data has two cells or more
        cells = dialect.split(line)
        if dialect.is_data(cells):
            rows.append(cells)
            unread += sum(not is_number(cell) and cell.casefold() not in MISSING for cell in cells)
    return _Rows(rows, unread)


@lru_cache
def _full_row(delimiter: str, decimal: str) -> re.Pattern[str]:
    """Match a line of bare numbers: the usual row, found fast."""
    number = number_pattern(decimal, "").pattern
    between = r"[ \t]+" if delimiter == "spaces" else re.escape(delimiter)
    return re.compile(rf"{number}(?:{between}{number})+", re.ASCII)


def _numbers(dialect: Dialect, rows: list[list[str]]) -> Reading:
    """Return the numbers as text in one notation, so that equal readings compare equal."""

    def plain(cell: str) -> str:
        text = cell.replace(dialect.thousands, "") if dialect.thousands else cell
        return text.replace(dialect.decimal, ".")

    return tuple(tuple(plain(cell) for cell in cells if dialect.is_number(cell)) for cells in rows)


def _ambiguous(best: Sequence[Dialect], lines: Sequence[str], path: Path) -> InputError:
    """Name the first line that the dialects read differently."""

    def readings(line: str) -> set[Reading]:
        cells = [(dialect, dialect.split(line)) for dialect in best]
        return {_numbers(dialect, [row] if dialect.is_data(row) else []) for dialect, row in cells}

    number = next(number for number, line in enumerate(lines) if len(readings(line)) > 1)
    return InputError(
        f"the numbers can be read in {len(best)} ways: "
        + "; or ".join(dialect.describe() for dialect in best),
        "name a profile that states 'decimal' (and 'thousands') in the sheet's "
        "force_format or strain_format",
        path,
        number + 1,
        value=lines[number].strip()[:80],
    )
