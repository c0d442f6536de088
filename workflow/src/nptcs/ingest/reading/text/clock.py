"""Time of day in a table, and blanks inside numbers, written as plain numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

_DATE = r"(?:\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[./-]\d{1,2}[./-](?:\d{4}|\d{2}))"
_STAMP = re.compile(
    rf"(?<![\d:.-])(?P<date>{_DATE}(?P<gap>T|[ ]+))?"
    r"(?P<hours>\d{1,3}):(?P<minutes>[0-5]\d)"
    r"(?::(?P<seconds>[0-5]\d)(?:(?P<mark>[.,:])(?P<fraction>\d+))?|(?P<short>[.,]\d+))"
    r"(?:\s*(?P<half>[AaPp])[Mm])?(?(date)(?:Z|[+-]\d\d:?\d\d)?|Z?)(?![\d:])"
)
_BARE_DATE = re.compile(rf"(?<![\d.:/-]){_DATE}(?![\d.:/-])")
_HALF_A_DAY_S = 43_200
_DAY_S = 86_400
_SAMPLE = 60
_HEAD = 20_000
"""Characters within which a table's first numbers are."""

BLANKS = "\u00a0\u202f\u2007\u2009'\u2019"
"""No-break, narrow, figure and thin space, apostrophes: thousands marks of many locales."""
_MINUS = re.compile(r"\u2212(?=[\d.,])")
_FORTRAN = re.compile(r"(?<![\w.])([+-]?\d+[.,]\d*)[dD]([+-]\d{2,3})(?!\w)")
_GROUPED = re.compile(
    rf"(?<![\d.,{BLANKS}])(\d{{1,3}}(?:[{BLANKS}]\d{{3}})+)(?![\d{BLANKS}])"
    rf"|(?<=,)(\d{{1,3}}(?:[{BLANKS}]\d{{3}})+)(?=\.\d)"
)


@dataclass
class PlainLines:
    """Lines with clocks as seconds; by row, the original line and the number of its clocks."""

    lines: list[str]
    originals: dict[int, str] = field(default_factory=dict)
    counts: dict[int, int] = field(default_factory=dict)


def join_grouped_digits(text: str) -> str:
    """Take no-break spaces and apostrophes out of numbers: ``1 098,31`` becomes ``1098,31``.

    Only three digits after each mark make it a thousands mark; others stay. A minus sign that is
    not the hyphen of the keyboard becomes one, and the ``D`` of Fortran's ``1.5D+02`` an ``E``.
    """
    text = _MINUS.sub("-", text) if "\u2212" in text else text
    if any(mark in text[:_HEAD] for mark in ("D+", "D-", "d+", "d-")):
        text = _FORTRAN.sub(r"\1E\2", text)
    if not any(blank in text for blank in BLANKS):
        return text

    def joined(found: re.Match[str]) -> str:
        return re.sub(f"[{BLANKS}]", "", found.group())

    return _GROUPED.sub(joined, text)


def clocks_to_seconds(lines: Sequence[str]) -> PlainLines:
    """Write each time of day in a row of numbers as seconds since midnight.

    ``10:30:00.5``, ``0:30.5`` (minutes), ``10:30:00 PM`` and a date in front of it are
    understood; the seconds go on past midnight. A date on its own becomes ``nan``. Rows with
    letters are a header and stay.
    """
    middle = len(lines) // 2
    sample = [*lines[:_SAMPLE], *lines[middle : middle + _SAMPLE], *lines[-_SAMPLE:]]
    if not any(":" in line and _is_row(line) for line in sample):
        return PlainLines(list(lines))
    plain = PlainLines([])
    before = 0.0
    for row, line in enumerate(lines):
        if ":" not in line or not _is_row(line):
            plain.lines.append(line)
            continue
        text, before = _convert(line, before)
        plain.originals[row] = line
        plain.counts[row] = len(_STAMP.findall(line))
        plain.lines.append(text)
    return plain


def _is_row(line: str) -> bool:
    """Tell whether a line contains a clock and otherwise nothing but numbers."""
    rest, clocks = _STAMP.subn("", line)
    letters = [letter for letter in rest.casefold().replace("nan", "") if letter.isalpha()]
    return bool(clocks) and all(letter == "e" for letter in letters)


def _convert(line: str, before: float) -> tuple[str, float]:
    """One line with its clocks as seconds, not before the seconds of the line above."""
    latest = before

    def seconds(found: re.Match[str]) -> str:
        nonlocal latest
        whole, fraction = _seconds(found)
        while whole < before - _HALF_A_DAY_S:
            whole += _DAY_S
        latest = max(latest, float(whole))
        mark = found["mark"] or (found["short"] or "")[:1]
        if fraction and mark == ":":
            mark = "," if re.search(r"\d,\d", line) and "." not in line else "."
        apart = found["date"] and found["gap"].isspace() and not re.search(r"[;,\t|]", line)
        return ("nan " if apart else "") + str(whole) + (f"{mark}{fraction}" if fraction else "")

    text = _STAMP.sub(seconds, line)
    return _BARE_DATE.sub("nan", text), latest


def _seconds(found: re.Match[str]) -> tuple[int, str]:
    """Whole seconds, and the digits after the decimal mark."""
    hours, minutes = int(found["hours"]), int(found["minutes"])
    if found["short"]:
        return 60 * hours + minutes, found["short"][1:]
    if found["half"]:
        hours = hours % 12 + (12 if found["half"].casefold() == "p" else 0)
    return 3600 * hours + 60 * minutes + int(found["seconds"]), found["fraction"] or ""


def holds_clock(cell: str) -> bool:
    """Tell whether a cell is a time of day."""
    return _STAMP.search(cell) is not None
