"""The specimen sheet: what a laboratory states about each specimen, one row each.

``specimens.csv`` is the only place where dimensions, file names and the decision to leave a
specimen out are kept; nothing of it is ever taken from the order of the files.
"""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path, PurePosixPath
from typing import Any

from pydantic import ValidationError

from nptcs.errors import InputError
from nptcs.mechanical_tests import TestType
from nptcs.tables.laboratory.specimen import LISTS, Specimen

__all__ = ["COLUMNS", "REQUIRED_COLUMNS", "Specimen", "files_named", "read_sheet"]


SEPARATORS = re.compile(r"[;|/\s]+")
COLUMNS = tuple(Specimen.model_fields)
REQUIRED_COLUMNS = ("specimen", "test", "material", "force_file")


def read_sheet(path: str | Path) -> tuple[list[Specimen], list[InputError]]:
    """Read a specimen sheet; each bad row is one error, and the good rows are kept.

    Parameters
    ----------
    path : str or Path
        ``specimens.csv``, UTF-8, separated by comma, semicolon or tab, decimal points.

    Returns
    -------
    specimens : list of Specimen
        The good rows, in the sheet's order.
    errors : list of InputError
        One for each bad row, with file, line, column, specimen, value and remedy.

    Raises
    ------
    InputError
        If the file as a whole cannot be read: missing, not UTF-8, unknown or missing columns.
    """
    path = Path(path)
    header, rows = _rows(path)
    specimens: list[Specimen] = []
    errors: list[InputError] = []
    first_line: dict[str, int] = {}
    for line, cells in rows:
        try:
            specimen = _specimen(path, line, header, cells)
            _require_unique(path, line, specimen, first_line)
            _require_one_material(path, line, specimen, specimens)
        except InputError as error:
            errors.append(error)
        else:
            specimens.append(specimen)
    if not specimens and not errors:
        raise InputError("the sheet has no rows", "add one row for each specimen", path)
    return specimens, errors


def files_named(path: str | Path) -> dict[str, list[str]]:
    """Files that the sheet names, even in rows that are not valid: file → specimen ids."""
    header, rows = _rows(Path(path))
    named: dict[str, list[str]] = {}
    for _, cells in rows:
        row = dict(zip(header, cells, strict=False))
        for column in ("force_file", "strain_file"):
            if row.get(column):
                name = str(PurePosixPath(row[column].replace("\\", "/")))
                named.setdefault(name, []).append(row.get("specimen", ""))
    return named


def _rows(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Column names and the non-empty rows with their line numbers."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", "check the path", path) from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise InputError("is not UTF-8", "save the sheet as 'CSV UTF-8'", path, line) from error
    first = text.splitlines()[0] if text.strip() else ""
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        header = [name.strip() for name in next(reader, [])]
        rows = [
            (reader.line_num, [cell.strip() for cell in row])
            for row in reader
            if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        raise InputError(f"not a CSV table: {error}", "save it as CSV", path) from error
    _check_header(path, header)
    return header, rows


def _check_header(path: Path, header: list[str]) -> None:
    for name in REQUIRED_COLUMNS:
        if name not in header:
            raise InputError("column is missing", f"add it; columns: {COLUMNS}", path, 1, name)
    for name in header:
        if name not in COLUMNS:
            raise InputError("unknown column", f"rename it to one of {COLUMNS}", path, 1, name)
        if header.count(name) > 1:
            raise InputError("column appears twice", "keep one of them", path, 1, name)


def _specimen(path: Path, line: int, header: list[str], cells: list[str]) -> Specimen:
    if len(cells) > len(header) and any(cells[len(header) :]):
        raise InputError(
            f"row has {len(cells)} cells, the header {len(header)}",
            "quote cells that contain the separator",
            path,
            line,
            specimen=cells[0] or None,
        )
    row = dict(zip(header, cells, strict=False))
    try:
        return Specimen(**{key: _value(key, text) for key, text in row.items() if text})
    except ValidationError as error:
        raise _row_error(path, line, row, error) from error


def _value(column: str, text: str) -> Any:
    """Turn a cell into what the model expects; words and numbers are checked there."""
    if column in LISTS:
        return tuple(part for part in SEPARATORS.split(text) if part)
    if column in ("include", "failed"):
        return {"yes": True, "no": False}.get(text.lower(), text)
    return text.lower() if column in ("test", "origin", "loading", "platens") else text


REMEDIES = {
    "include": "write yes or no",
    "failed": "write yes or no, or leave it empty: the record decides",
    "loading": "write first, last, envelope or the number of the loading",
    "platens": "write lubricated, dry or bonded, or leave it empty",
    "properties": "name properties of this test, separated by ';', or leave it empty for all",
    "date": "write year-month-day, e.g. 2026-03-31",
    "piece": "use letters, digits, '.', '_' and '-' only",
    "force_factor": "write the factor of the readings, or leave it empty for 1",
    "strain_factor": "write the factor of the readings, or leave it empty for 1",
    "test": "use one of " + ", ".join(TestType),
    "specimen": "use letters, digits, '.', '_' and '-' only",
    "material": "use letters, digits, '.', '_' and '-' only",
    "force_file": "name the raw file, relative to the sheet",
    "strain_file": "name the raw file, relative to the sheet, or leave it empty",
    "reason": "say why the specimen is left out, or set include to yes",
    "orientation_deg": "give the fibre angle in degrees, or leave it empty for a rubber",
    "origin": "write measured or synthetic",
}


def _row_error(path: Path, line: int, row: dict[str, str], error: ValidationError) -> InputError:
    problems = error.errors()
    messages = [str(problem["msg"]).removeprefix("Value error, ") for problem in problems]
    column = str(problems[0]["loc"][0]) if problems[0]["loc"] else messages[0].split(" ")[0]
    others = [
        f"{problem['loc'][0] if problem['loc'] else 'row'}: {message}"
        for problem, message in zip(problems[1:], messages[1:], strict=True)
    ]
    return InputError(
        "; ".join([messages[0], *others]),
        REMEDIES.get(column, "write the measured number with a decimal point, in the unit named"),
        path,
        line,
        column,
        row.get("specimen") or None,
        row.get(column) or None,
    )


def _require_unique(path: Path, line: int, specimen: Specimen, seen: dict[str, int]) -> None:
    name = specimen.specimen
    if name.lower() in seen:
        raise InputError(
            f"specimen id is already on line {seen[name.lower()]}",
            "give each specimen its own id (case does not count)",
            path,
            line,
            "specimen",
            name,
        )
    seen[name.lower()] = line


def _require_one_material(path: Path, line: int, row: Specimen, before: list[Specimen]) -> None:
    """Refuse runs of one piece that name different materials or fibre angles."""
    for other in before:
        same = (other.material, other.orientation_deg) == (row.material, row.orientation_deg)
        if row.piece and other.piece == row.piece and not same:
            raise InputError(
                f"piece {row.piece} has another material or fibre angle in {other.specimen}",
                "give the runs of one piece the same material and orientation_deg",
                path,
                line,
                "piece",
                row.specimen,
                row.piece,
            )
