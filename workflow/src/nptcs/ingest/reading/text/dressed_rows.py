"""Rows that are formatted for the eye: borders around the cells, units after the numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from nptcs.ingest.reading.units import FACTORS, OTHER_UNITS

UNIT_FOLLOWS = "\ue000"
"""Put between a number and its unit, where a row keeps both."""
_PROBE = 20
_SHARE = 0.75
_RULE = re.compile(r"[\s|+\-:=─━│┃┼┌┐└┘├┤┬┴]*")
_SIDES = re.compile(r"^\s*[|│┃]|[|│┃]\s*$")
_INNER = re.compile(r"[│┃]")
_NOT_BEHIND_NUMBERS = frozenset(["1", "-", "d", "h", "K", "E-6"])


def _middle(lines: Sequence[str]) -> Sequence[str]:
    """Lines from the middle of a file, where its readings are."""
    start = max(len(lines) // 2 - _PROBE // 2, 0)
    return [line for line in lines[start : start + _PROBE] if line.strip()]


def without_borders(lines: list[str]) -> list[str]:
    """Take the outer bars off rows ``| 0.1 | 12.5 |``, and empty the rules between them.

    The number of lines stays, so that messages name the lines of the file.
    """
    probe = _middle(lines)
    bordered = [line for line in probe if line.strip()[0] in "|│┃" and line.strip()[-1] in "|│┃"]
    if not bordered or len(bordered) < _SHARE * len(probe):
        return lines
    return [
        "" if _RULE.fullmatch(line) else _INNER.sub("|", _SIDES.sub("", line)) for line in lines
    ]


@cache
def _units_behind_numbers() -> re.Pattern[str]:
    known = {unit for units in FACTORS.values() for unit in units} | OTHER_UNITS
    words = sorted(known - _NOT_BEHIND_NUMBERS, key=len, reverse=True)
    choice = "|".join(re.escape(word) for word in words)
    return re.compile(rf"(?<=[\d.,])[ \u00a0]?({choice})(?=\"?(?:\s|[;,|]|$))")


def mark_units(lines: list[str]) -> tuple[list[str], dict[int, str]]:
    """Take units off the cells of rows such as ``12.5 N;0.12 %``.

    Only where three quarters of the rows in the middle of the file have some.

    Returns
    -------
    lines : list of str
        The same lines without these units.
    marked : dict of int to str
        By row, the line with `UNIT_FOLLOWS` before each unit.
    """
    probe = _middle(lines)
    if not probe or sum(any(map(str.isalpha, line)) or "%" in line for line in probe) < (
        _SHARE * len(probe)
    ):
        return lines, {}
    pattern = _units_behind_numbers()
    if sum(pattern.search(line) is not None for line in probe) < _SHARE * len(probe):
        return lines, {}
    marked = {
        row: pattern.sub(rf"{UNIT_FOLLOWS}\1", line)
        for row, line in enumerate(lines)
        if _is_row(line, pattern)
    }
    plain = [pattern.sub("", line) if row in marked else line for row, line in enumerate(lines)]
    return plain, marked


def unit_behind_number(cell: str) -> str:
    """Return the unit at the end of a cell such as ``12.5 N``; empty if a number stands alone."""
    found = _units_behind_numbers().search(cell) if cell and not cell[-1].isdigit() else None
    return found.group(1) if found and found.end() == len(cell) else ""


def _is_row(line: str, pattern: re.Pattern[str]) -> bool:
    """Tell whether a line contains numbers with units, and nothing else."""
    rest, units = pattern.subn("", line)
    letters = [letter for letter in rest.casefold().replace("nan", "") if letter.isalpha()]
    return bool(units) and all(letter == "e" for letter in letters)


def units_of_cells(cells: Sequence[str]) -> list[str]:
    """Units after the numbers of a row's cells; empty where there is none."""
    return [cell.partition(UNIT_FOLLOWS)[2].strip('" ') for cell in cells]
