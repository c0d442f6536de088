"""The specimen sheet: what a laboratory states about each specimen, one row each.

``specimens.csv`` is the only place where dimensions, file names and the decision to leave a
specimen out are kept; nothing of it is ever taken from the order of the files.
"""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path, PurePosixPath
from typing import Any, Literal, Self

from pydantic import Field, ValidationError, ValidationInfo, field_validator, model_validator

from nptcs.config.base import Strict
from nptcs.errors import InputError
from nptcs.mechanical_tests import TestType

NAME = r"^[A-Za-z0-9._-]+$"
STATION_SEPARATORS = re.compile(r"[;|/\s]+")


class Specimen(Strict):
    """One row of the specimen sheet.

    Lengths in mm. `width_mm` and `thickness_mm` hold the stations measured; their means enter
    the area (ASTM D3039 §11.2.3). A section that is not a rectangle (round bar, or a published
    curve of stress alone: 1 mm²) states `section_area_mm2` instead.
    """

    specimen: str = Field(pattern=NAME, description="Id, unique in the sheet")
    test: TestType = Field(description="Test type: " + ", ".join(TestType))
    material: str = Field(pattern=NAME, description="E.g. cfrp, rubber_75A")
    orientation_deg: float | None = Field(
        None, ge=-90, le=90, description="Fibre angle to the load: 0, 90, 45; empty for rubber"
    )
    width_mm: tuple[float, ...] = Field((), description="Stations, separated by ';'")
    thickness_mm: tuple[float, ...] = Field((), description="Stations, separated by ';'")
    section_area_mm2: float | None = Field(
        None, gt=0, description="Area of a section that is not width × thickness; usually empty"
    )
    gauge_length_mm: float | None = Field(
        None, gt=0, description="Gauge length (grip distance for crosshead strain)"
    )
    force_file: str = Field(min_length=1, description="Path relative to the sheet's folder")
    force_part: str = Field(
        "", description="Workbook sheet, table number or test name, if the file holds several"
    )
    force_format: str = Field("", description="Profile name; empty: detect")
    strain_file: str = Field("", description="Empty: the strain is in the force file")
    strain_part: str = Field("", description="As force_part")
    strain_format: str = Field("", description="Profile name; empty: detect")
    strain_axis: str = Field(
        "", description="Channel that is axial (e.g. exx); empty: found from the data"
    )
    time_offset_s: float | None = Field(
        None,
        description="Added to the strain file's time; empty: from the force that both files "
        "hold, else 0 and checked",
    )
    include: bool = Field(True, description="yes or no: enters statistics and material card")
    reason: str = Field("", description="Why the specimen is left out; required with no")
    origin: Literal["measured", "synthetic"] = Field("measured", description="measured, synthetic")
    remarks: str = Field("", description="Anything else")

    @field_validator("width_mm", "thickness_mm")
    @classmethod
    def _stations_positive(
        cls, stations: tuple[float, ...], info: ValidationInfo
    ) -> tuple[float, ...]:
        if any(station <= 0 for station in stations):
            raise ValueError(f"{info.field_name} must be greater than 0")
        return stations

    @field_validator("force_file", "strain_file")
    @classmethod
    def _inside_the_folder(cls, path: str) -> str:
        parts = PurePosixPath(path.replace("\\", "/"))
        if parts.is_absolute() or ".." in parts.parts or re.match(r"^[A-Za-z]:", path):
            raise ValueError("must lie in the sheet's folder (a relative path without '..')")
        return str(parts) if path else ""

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if self.section_area_mm2 is None:
            for name in ("width_mm", "thickness_mm"):
                if not getattr(self, name):
                    raise ValueError(f"{name} is empty: the stress cannot be computed")
        if self.test.is_rubber and self.orientation_deg is not None:
            raise ValueError("orientation_deg must be empty for a rubber")
        if not self.test.is_rubber and self.orientation_deg is None:
            raise ValueError("orientation_deg is empty: give the fibre angle (0, 90, 45)")
        if not self.include and not self.reason.strip():
            raise ValueError("reason is empty: a specimen that is left out needs one")
        return self

    @property
    def mean_width_mm(self) -> float | None:
        """Mean of the width stations, None if none was measured."""
        return _mean(self.width_mm) if self.width_mm else None

    @property
    def mean_thickness_mm(self) -> float | None:
        """Mean of the thickness stations, None if none was measured."""
        return _mean(self.thickness_mm) if self.thickness_mm else None

    @property
    def area_mm2(self) -> float:
        """Original cross-section: stated, or mean width × mean thickness (ASTM D3039 §11.2.3)."""
        if self.section_area_mm2 is not None:
            return self.section_area_mm2
        return _mean(self.width_mm) * _mean(self.thickness_mm)

    @property
    def series(self) -> str:
        """Group of equal tests, e.g. ``cfrp_tension_0``; safe in file names."""
        parts = [self.material, self.test.value]
        if self.orientation_deg is not None:
            parts.append(f"{self.orientation_deg:g}")
        return "_".join(parts)

    @property
    def files(self) -> tuple[str, ...]:
        """The raw files of this specimen, without repetition."""
        names = [self.force_file, self.strain_file]
        return tuple(dict.fromkeys(name for name in names if name))


def _mean(stations: tuple[float, ...]) -> float:
    return sum(stations) / len(stations)


COLUMNS = tuple(Specimen.model_fields)
REQUIRED_COLUMNS = ("specimen", "test", "material", "force_file")


def read_sheet(path: str | Path) -> tuple[list[Specimen], list[InputError]]:
    """Read a specimen sheet; a bad row is one error and the good rows go on.

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
        except InputError as error:
            errors.append(error)
        else:
            specimens.append(specimen)
    if not specimens and not errors:
        raise InputError("the sheet has no rows", "add one row for each specimen", path)
    return specimens, errors


def files_named(path: str | Path) -> dict[str, list[str]]:
    """Files that the sheet names, also in rows that are not valid: file → specimen ids."""
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
    if column in ("width_mm", "thickness_mm"):
        return tuple(part for part in STATION_SEPARATORS.split(text) if part)
    if column == "include":
        return {"yes": True, "no": False}.get(text.lower(), text)
    return text.lower() if column in ("test", "origin") else text


REMEDIES = {
    "include": "write yes or no",
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
