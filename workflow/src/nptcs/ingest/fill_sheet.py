"""Fill in what no file can tell: once for each series of a sheet."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence

from nptcs.errors import InputError
from nptcs.ingest.file_names import series_names
from nptcs.tables.laboratory.specimens import COLUMNS

_OPEN = re.compile(r"(?:^|; )fill in [^;]*")
_PROPOSED = re.compile(r"(?:^|; )proposed by words, to be checked: ([^;]*)")


def parse_fill(text: str) -> tuple[str, dict[str, str]]:
    """Split ``UD: test=tension material=cfrp`` into the series and its cells.

    Raises
    ------
    InputError
        If it is written another way or names a column that the sheet does not have.
    """
    series, colon, rest = text.rpartition(":")
    pairs = [part.partition("=") for part in rest.replace(",", " ").split()]
    if not colon or not pairs or not all(equals and value for _, equals, value in pairs):
        raise InputError(
            "is not a series and its cells", "e.g. 'UD: test=tension material=cfrp'", value=text
        )
    cells = {column.strip(): value.strip() for column, _, value in pairs}
    for column in cells:
        if column not in COLUMNS:
            raise InputError("unknown column", f"use one of {', '.join(COLUMNS)}", column=column)
    return series.strip(), cells


def fill_rows(
    rows: Sequence[Mapping[str, str]], fills: Sequence[tuple[str, Mapping[str, str]]]
) -> list[dict[str, str]]:
    """Fill the cells of the rows of each series that are empty or only proposed by words.

    What was measured, read from a head or written by a person stays: `kept_cells` says where.

    Raises
    ------
    InputError
        If no row belongs to a series; with the series that exist.
    """
    names = series_names(row["force_file"] for row in rows)
    known = list(dict.fromkeys(names.values()))
    filled = [dict(row) for row in rows]
    for series, cells in fills:
        if series not in known:
            raise InputError("no series of that name", f"series: {', '.join(known)}", value=series)
        for row in filled:
            if names[row["force_file"]] == series:
                row |= {name: cells[name] for name in cells.keys() - _differing(row, cells)}
                row["remarks"] = _remarks_after(row.get("remarks", ""), cells)
    return filled


def kept_cells(
    rows: Sequence[Mapping[str, str]], fills: Sequence[tuple[str, Mapping[str, str]]]
) -> list[str]:
    """Say which cells `fill_rows` leaves as they are although another value is stated."""
    names = series_names(row["force_file"] for row in rows)
    return [
        f"{row['specimen']}: {column} stays {row[column]}, not {cells[column]}; "
        "change it in the sheet"
        for series, cells in fills
        for row in rows
        if names[row["force_file"]] == series
        for column in sorted(_differing(row, cells))
    ]


def _differing(row: Mapping[str, str], cells: Mapping[str, str]) -> set[str]:
    """Return the columns whose cell has another value that is more than a proposal."""
    written = {name for name, value in cells.items() if row.get(name) not in ("", None, value)}
    return written - set(_proposed(row.get("remarks", "")))


def _proposed(remarks: str) -> list[str]:
    found = _PROPOSED.search(remarks)
    return found[1].split(", ") if found else []


def _remarks_after(remarks: str, cells: Mapping[str, str]) -> str:
    """Return the remarks without what the stated cells have settled."""
    left = [name for name in _proposed(remarks) if name not in cells]
    again = f"proposed by words, to be checked: {', '.join(left)}" if left else ""
    rest = _OPEN.sub("", _PROPOSED.sub("", remarks)).removeprefix("; ")
    return "; ".join(part for part in (again, rest) if part)


def fill_text(text: str, fills: Sequence[tuple[str, Mapping[str, str]]]) -> str:
    """Return a sheet, as text, with the cells of some series filled in.

    Raises
    ------
    InputError
        As `fill_rows`.
    """
    delimiter, header, rows = read_rows(text)
    rows = fill_rows(rows, fills)
    columns = [*header, *dict.fromkeys(c for _, f in fills for c in f)]
    out = io.StringIO(newline="")
    writer = csv.DictWriter(
        out, list(dict.fromkeys(columns)), restval="", delimiter=delimiter, lineterminator="\n"
    )
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def read_rows(text: str) -> tuple[str, list[str], list[dict[str, str]]]:
    """Return delimiter, header and rows of a sheet that is given as text."""
    text = text.lstrip("\ufeff")
    delimiter = max(",;\t", key=text.splitlines()[0].count)
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter)
    rows = [{k: v or "" for k, v in row.items() if k} for row in reader]
    return delimiter, list(reader.fieldnames or ()), rows
