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
    """Fill the empty cells of the rows of each series; what is written already stays.

    Raises
    ------
    InputError
        If no row belongs to a series; with the series that there are.
    """
    names = series_names(row["force_file"] for row in rows)
    known = list(dict.fromkeys(names.values()))
    filled = [dict(row) for row in rows]
    for series, cells in fills:
        if series not in known:
            raise InputError("no series of that name", f"series: {', '.join(known)}", value=series)
        for row in filled:
            if names[row["force_file"]] == series:
                row |= {column: value for column, value in cells.items() if not row.get(column)}
                row["remarks"] = _OPEN.sub("", row.get("remarks", "")).removeprefix("; ")
    return filled


def fill_text(text: str, fills: Sequence[tuple[str, Mapping[str, str]]]) -> str:
    """Return a sheet, as text, with the cells of some series filled in.

    Raises
    ------
    InputError
        As `fill_rows`.
    """
    first = text.lstrip("\ufeff").splitlines()[0]
    delimiter = max(",;\t", key=first.count)
    reader = csv.DictReader(io.StringIO(text.lstrip("\ufeff"), newline=""), delimiter=delimiter)
    rows = fill_rows([{k: v or "" for k, v in row.items() if k} for row in reader], fills)
    columns = [*(reader.fieldnames or ()), *dict.fromkeys(c for _, f in fills for c in f)]
    out = io.StringIO(newline="")
    writer = csv.DictWriter(
        out, list(dict.fromkeys(columns)), restval="", delimiter=delimiter, lineterminator="\n"
    )
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()
