"""Tables of dimensions in a laboratory's folder: one row per specimen, widths and thicknesses."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.file_names import tokens
from nptcs.ingest.reading.opened_file import OpenedFile, open_file
from nptcs.ingest.reading.profiles import PLAIN, FormatProfile, normalise
from nptcs.ingest.reading.unit_in_name import split_unit
from nptcs.ingest.reading.units import factor

_SPECIMEN = re.compile(
    r"^(sample|specimen|probe|proben|prob|id|no|nr|n°|name|éprouvette|eprouvette|muestra|probeta|"
    r"amostra|provino|campione|vzorek|образец|試験片|试样|coupon|test)\b"
)
_WIDTH = re.compile(
    r"^(w\d*|b\d*|width|breite|probenbreite|ancho|largeur|larghezza|largura|sirka|ширина|幅|宽度)\b"
)
_THICKNESS = re.compile(
    r"^(t\d*|h\d*|a\d*|d\d*|thickness|thick|dicke|probendicke|espesor|epaisseur|spessore|espessura|"
    r"tloustka|толщина|厚さ|厚度)\b"
)
_LENGTH = re.compile(r"^(l\d*|gauge length|gage length|length|lange|messlange|longueur|longitud)\b")
_KINDS = {"width_mm": _WIDTH, "thickness_mm": _THICKNESS, "gauge_length_mm": _LENGTH}
_OWN_WORDS = frozenset(
    [
        "dimension",
        "dimensions",
        "dims",
        "dim",
        "size",
        "sizes",
        "abmessungen",
        "masse",
        "geometry",
        "geometrie",
        "specimen",
        "specimens",
        "sample",
        "samples",
        "proben",
        "coupon",
        "coupons",
        "thickness",
        "width",
        "table",
        "medidas",
    ]
)
_LARGEST_MM = 500.0
_LARGEST_HEAD = 30
"""Rows searched for the names, and rows of a table whose columns are the specimens."""


@dataclass(frozen=True)
class Dimensions:
    """Dimensions of one specimen, as cells of the sheet, and what identifies it."""

    file: str
    words: Counter[str]
    cells: dict[str, str]
    note: str = ""


def read_dimensions(
    name: str,
    path: Path,
    profiles: Mapping[str, FormatProfile],
    limits: FileLimits = FileLimits(),  # noqa: B008  (immutable)
) -> list[Dimensions]:
    """Read a table of dimensions; empty if the file is not one.

    The first row of names that contains a specimen, and a width or a thickness, counts; every row
    below with a specimen and numbers is one specimen. A table whose columns are the specimens is
    transposed. A unit may be in the names; otherwise mm is assumed.
    """
    try:
        rows = _rows(open_file(path, profiles, profiles[PLAIN], limits))
    except InputError:
        return []
    upright = [list(column) for column in zip_longest(*rows[:_LARGEST_HEAD], fillvalue="")]
    for table in (rows, upright):
        for index, cells in enumerate(table[:_LARGEST_HEAD]):
            columns = _columns(cells)
            if columns is not None:
                found = [_dimensions(name, columns, cells, row) for row in table[index + 1 :]]
                return [one for one in found if one is not None]
    return []


def _rows(opened: OpenedFile) -> list[list[str]]:
    if opened.kind == "workbook":
        sheets = opened.sheets
        return [source.cells(row) for source in sheets for row in range(len(source.kinds))]
    lines = [line for line in opened.lines if line.strip()][:2000]
    marks = max(";\t,", key=lambda mark: sum(mark in line for line in lines[:5]))
    return [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=marks)]


def _columns(cells: Sequence[str]) -> tuple[int, dict[str, list[int]]] | None:
    """Position of the specimen and of each dimension, if this is the row of names."""
    names = [normalise(split_unit(cell)[0]) for cell in cells]
    specimen = next((place for place, one in enumerate(names) if _SPECIMEN.match(one)), None)
    kinds = {
        kind: [place for place, one in enumerate(names) if pattern.match(one) and place != specimen]
        for kind, pattern in _KINDS.items()
    }
    if specimen is None or not (kinds["width_mm"] or kinds["thickness_mm"]):
        return None
    return specimen, {kind: places for kind, places in kinds.items() if places}


def _dimensions(
    name: str,
    columns: tuple[int, dict[str, list[int]]],
    names: Sequence[str],
    row: Sequence[str],
) -> Dimensions | None:
    specimen, kinds = columns
    if specimen >= len(row) or not row[specimen].strip():
        return None
    cells = {}
    for kind, places in kinds.items():
        read = [_millimetres(names[place], row[place]) for place in places if place < len(row)]
        stations = [value for value in read if value is not None]
        if stations:
            cells[kind] = ";".join(f"{value:g}" for value in stations)
    if "gauge_length_mm" in cells:
        cells["gauge_length_mm"] = cells["gauge_length_mm"].split(";")[0]
    if not cells:
        return None
    own = Counter({word: n for word, n in tokens(_spaced(name)).items() if word not in _OWN_WORDS})
    words = own | Counter(tokens(_number_of(row[specimen]) + ".x"))
    stated = any(split_unit(names[place])[1] for places in kinds.values() for place in places)
    return Dimensions(name, words, cells, "" if stated else "no unit stated, mm assumed")


def _number_of(cell: str) -> str:
    """Write the specimen of a row as in a file name: ``1.0`` of a spreadsheet is ``1``."""
    return re.sub(r"^(\d+)\.0$", r"\1", cell.strip()).replace("/", "_")


def _spaced(name: str) -> str:
    """Separate words that are written together: ``DimensionsUD`` is two."""
    return re.sub(r"(?<=[a-zà-ÿ])(?=[A-Z])", "_", name)


def _millimetres(name: str, text: str) -> float | None:
    unit = split_unit(name)[1] or "mm"
    scale = factor("width", unit)
    try:
        value = float(text.replace(",", ".")) * (scale or 0.0)
    except ValueError:
        return None
    return value if 0 < value < _LARGEST_MM else None
