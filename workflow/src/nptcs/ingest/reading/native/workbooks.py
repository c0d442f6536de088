"""Workbooks (XLSX by openpyxl, XLS by xlrd) as sheets of native cells."""

from __future__ import annotations

import datetime
import io
import warnings
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from xml.etree.ElementTree import ParseError

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.native.sheet_cells import FORMULA, Clock, SheetSource
from nptcs.ingest.reading.native.text_numbers import numbers_of_texts
from nptcs.ingest.reading.text.turned_tables import NOTE, upright_rows

ZIP = b"PK\x03\x04"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"

Row = tuple[object, ...]
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    ParseError,
    KeyError,
    ValueError,
    TypeError,
    IndexError,
    AttributeError,
    EOFError,
    OSError,
    RuntimeError,  # zipfile: encrypted; its subclass NotImplementedError: unknown compression
)
"""What openpyxl and xlrd raise for a damaged or encrypted file."""


def is_workbook(raw: bytes) -> bool:
    """Tell whether this is XLSX or XLS content, whatever the suffix says."""
    return raw.startswith((ZIP, OLE))


def read_workbook(
    path: Path, raw: bytes, missing: frozenset[str], limits: FileLimits
) -> tuple[list[SheetSource], tuple[str, ...]]:
    """Read all sheets that contain anything, and the reader's warnings as notes.

    A sheet is as large as its cells say: the ``<dimension>`` tag, which some programs write
    wrongly, is ignored. A formula without a stored value is kept as `FORMULA`.

    Raises
    ------
    InputError
        If it is damaged or encrypted, or larger than the limits.
    """
    with warnings.catch_warnings(record=True) as caught:
        # recorded, not hidden: each of openpyxl's becomes a note, for every such file
        warnings.simplefilter("always", UserWarning)
        _refuse_other_archive(path, raw)
        try:
            sheets = _xlsx(path, raw, limits) if raw.startswith(ZIP) else _xls(path, raw, limits)
        except InputError:
            raise
        except _DAMAGE as error:
            raise InputError(
                f"workbook cannot be read: {type(error).__name__}: {error}",
                "open and save it again, without a password",
                path,
            ) from error
    notes = [str(warning.message) for warning in caught]
    sources = []
    for name, rows in sheets:
        upright = upright_rows(rows, lambda cell: type(cell) in (int, float, Clock))
        numbers, note = numbers_of_texts(rows if upright is rows else list(map(tuple, upright)))
        notes += [f"sheet '{name}': {note}"] if note else []
        notes += [f"sheet '{name}': {NOTE}"] if upright is not rows else []
        sources += [SheetSource(path, name, numbers, missing)] if rows else []
    return sources, tuple(dict.fromkeys(notes))


_OTHER_ARCHIVES = (
    ("mimetype", "is an OpenDocument spreadsheet", "save it as XLSX or CSV"),
    ("xl/workbook.bin", "is a binary workbook (XLSB)", "save it as XLSX or CSV"),
)


def _refuse_other_archive(path: Path, raw: bytes) -> None:
    """Refuse an archive that is not an XLSX workbook and say what it is; not a damaged one."""
    if not raw.startswith(ZIP) or not zipfile.is_zipfile(io.BytesIO(raw)):
        return
    names = set(zipfile.ZipFile(io.BytesIO(raw)).namelist())
    for name, what, remedy in _OTHER_ARCHIVES:
        if name in names:
            raise InputError(what, remedy, path)
    if names and not any(name.startswith(("xl/", "[Content_Types]")) for name in names):
        raise InputError("is a packed archive (ZIP), not a workbook", "unpack it", path)


def _xlsx(path: Path, raw: bytes, limits: FileLimits) -> list[tuple[str, list[Row]]]:
    from openpyxl import load_workbook

    formulas = _holds_formulas(path, raw, limits)
    values = load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
    texts = load_workbook(io.BytesIO(raw), read_only=True) if formulas else None
    try:
        sheets = []
        for sheet in values.worksheets:
            sheet.reset_dimensions()
            rows: Iterable[Row] = sheet.iter_rows(values_only=True)
            if texts is not None:
                twin = texts[sheet.title]
                twin.reset_dimensions()
                rows = map(_mark_formulas, rows, twin.iter_rows(values_only=True))
            sheets.append((sheet.title, _bounded(rows, path, sheet.title, limits)))
        return sheets
    finally:
        values.close()
        if texts is not None:
            texts.close()


def _holds_formulas(path: Path, raw: bytes, limits: FileLimits) -> bool:
    """Tell whether a sheet contains formulas, if all parts together are within the limits."""
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        parts = archive.infolist()
        size = sum(part.file_size for part in parts)
        if size > limits.unpacked_mb * 1e6:
            raise InputError(
                f"workbook of {len(raw) / 1e6:.3g} MB unpacks to {size / 1e6:.4g} MB; "
                f"{limits.unpacked_mb:g} MB are allowed",
                "check the file, or raise ingest.limits.unpacked_mb",
                path,
            )
        sheets = [part for part in parts if part.filename.startswith("xl/worksheets/")]
        return any(_holds_formula(archive, part) for part in sheets)


def _holds_formula(archive: zipfile.ZipFile, part: zipfile.ZipInfo) -> bool:
    """Look for a formula element, some bytes at a time."""
    before = b""
    with archive.open(part) as stream:
        while chunk := stream.read(1 << 20):
            text = before + chunk
            if b"<f>" in text or b"<f " in text:
                return True
            before = chunk[-2:]
    return False


def _mark_formulas(values: Row, texts: Row) -> Row:
    """Put `FORMULA` where a formula has no stored value."""
    if not any(isinstance(text, str) and text.startswith("=") for text in texts):
        return values
    return tuple(
        FORMULA if value is None and isinstance(text, str) and text.startswith("=") else value
        for value, text in zip(values, texts, strict=False)
    )


def _bounded(rows: Iterable[Row], path: Path, sheet: str, limits: FileLimits) -> list[Row]:
    """Take the rows of a sheet up to the last filled one, all of one width, within the limits."""
    found: list[Row] = []
    for row in _within(rows, path, sheet, limits):
        found.append(tuple(_plain(cell) for cell in row))
    while found and all(cell is None for cell in found[-1]):
        found.pop()
    width = max(map(len, found), default=0)
    return [row + (None,) * (width - len(row)) if len(row) < width else row for row in found]


def _within(rows: Iterable[Row], path: Path, sheet: str, limits: FileLimits) -> Iterator[Row]:
    for number, row in enumerate(rows, 1):
        if number > limits.rows or len(row) > limits.columns:
            what = "rows" if number > limits.rows else "columns"
            raise InputError(
                f"sheet '{sheet}' has more than {getattr(limits, what)} {what}",
                f"export one test per file, or raise ingest.limits.{what}",
                path,
                number,
            )
        yield row


def _plain(cell: object) -> object:
    """Return times of day and durations in s, anything else as it is."""
    if isinstance(cell, datetime.datetime):
        return Clock((cell - datetime.datetime(1900, 1, 1)).total_seconds())
    if isinstance(cell, datetime.time):
        seconds = 3600 * cell.hour + 60 * cell.minute + cell.second + 1e-6 * cell.microsecond
        return Clock(seconds)
    if isinstance(cell, datetime.timedelta):
        return Clock(cell.total_seconds())
    return cell


def _xls(path: Path, raw: bytes, limits: FileLimits) -> list[tuple[str, list[Row]]]:
    import xlrd

    try:
        book = xlrd.open_workbook(file_contents=raw)
    except xlrd.XLRDError as error:
        raise ValueError(str(error)) from error
    blank = (xlrd.XL_CELL_EMPTY, xlrd.XL_CELL_BLANK)
    text = (xlrd.XL_CELL_BOOLEAN, xlrd.XL_CELL_ERROR)

    def value(cell: xlrd.sheet.Cell) -> object:
        if cell.ctype in blank:
            return None
        if cell.ctype == xlrd.XL_CELL_DATE:
            return Clock(86_400 * float(cell.value))
        return f"<{cell.value}>" if cell.ctype in text else cell.value

    return [
        (
            sheet.name,
            _bounded(
                (tuple(value(cell) for cell in row) for row in sheet.get_rows()),
                path,
                sheet.name,
                limits,
            ),
        )
        for sheet in book.sheets()
    ]
