"""Workbooks (XLSX by openpyxl, XLS by xlrd) as sheets of native cells."""

from __future__ import annotations

import io
import warnings
import zipfile
import zlib
from pathlib import Path
from xml.etree.ElementTree import ParseError

from nptcs.errors import InputError
from nptcs.ingest.reading.cells import SheetSource

ZIP = b"PK\x03\x04"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"

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
    RuntimeError,  # zipfile: encrypted, or (its subclass NotImplementedError) packed unknown ways
)
"""What openpyxl and xlrd raise for a damaged or encrypted file."""


def is_workbook(raw: bytes) -> bool:
    """Tell whether this is XLSX and XLS content, whatever the suffix says."""
    return raw.startswith((ZIP, OLE))


def read_workbook(
    path: Path, raw: bytes, missing: frozenset[str]
) -> tuple[list[SheetSource], tuple[str, ...]]:
    """Read all sheets that hold anything, and the reader's warnings as notes."""
    with warnings.catch_warnings(record=True) as caught:
        # recorded, none hidden: each of openpyxl's becomes a note, also of the second such file
        warnings.simplefilter("always", UserWarning)
        try:
            sheets = _xlsx(raw) if raw.startswith(ZIP) else _xls(raw)
        except _DAMAGE as error:
            raise InputError(
                f"workbook cannot be read: {type(error).__name__}: {error}",
                "open and save it again, without a password",
                path,
            ) from error
    notes = tuple(dict.fromkeys(str(warning.message) for warning in caught))
    sources = [SheetSource(path, name, rows, missing) for name, rows in sheets if rows]
    return sources, notes


def _xlsx(raw: bytes) -> list[tuple[str, list[tuple[object, ...]]]]:
    from openpyxl import load_workbook

    book = load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
    try:
        return [(sheet.title, list(sheet.iter_rows(values_only=True))) for sheet in book.worksheets]
    finally:
        book.close()


def _xls(raw: bytes) -> list[tuple[str, list[tuple[object, ...]]]]:
    import xlrd

    try:
        book = xlrd.open_workbook(file_contents=raw)
    except xlrd.XLRDError as error:
        raise ValueError(str(error)) from error
    blank = (xlrd.XL_CELL_EMPTY, xlrd.XL_CELL_BLANK)
    text = (xlrd.XL_CELL_BOOLEAN, xlrd.XL_CELL_DATE, xlrd.XL_CELL_ERROR)

    def value(cell: xlrd.sheet.Cell) -> object:
        if cell.ctype in blank:
            return None
        return f"<{cell.value}>" if cell.ctype in text else cell.value

    return [
        (sheet.name, [tuple(value(cell) for cell in row) for row in sheet.get_rows()])
        for sheet in book.sheets()
    ]
