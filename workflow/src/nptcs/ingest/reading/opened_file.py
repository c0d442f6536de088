"""A raw file's bytes: decoded to lines, or unpacked to sheets, within the limits."""

from __future__ import annotations

import hashlib
import re
import stat
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, assert_never

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.native.binary import is_binary_table, read_binary_table
from nptcs.ingest.reading.native.sheet_cells import SheetSource
from nptcs.ingest.reading.native.workbooks import is_workbook, read_workbook
from nptcs.ingest.reading.profiles import ContentKind, FormatProfile
from nptcs.ingest.reading.text.cells import CellSource, split_lines
from nptcs.ingest.reading.text.clock import PlainLines, clocks_to_seconds, join_grouped_digits
from nptcs.ingest.reading.text.decimal_marks import one_decimal_mark
from nptcs.ingest.reading.text.decode import decode
from nptcs.ingest.reading.text.dressed_rows import mark_units, without_borders
from nptcs.ingest.reading.text.turned_tables import NOTE, upright_lines
from nptcs.ingest.reading.units import FACTORS

HEAD_LINES = 60
_MARKUP = re.compile(rb"(?i)(?:\xef\xbb\xbf)?\s*<(?:\?xml|!doctype|html|head|table|workbook)\b")
_UNITS = frozenset(unit for units in FACTORS.values() for unit in units)
_WORD = re.compile(r"[^\W\d_]{2}|[|\[(%]")


@dataclass
class OpenedFile:
    """A raw file's content, before a dialect and a table are chosen."""

    path: Path
    head: str
    encoding: str
    sha256: str
    lines: list[str] = field(default_factory=list)
    clocks: PlainLines | None = None
    unit_lines: dict[int, str] = field(default_factory=dict)
    largest_width: int = FileLimits().columns
    sheets: list[CellSource] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    @property
    def kind(self) -> ContentKind:
        """What was opened."""
        return "text" if self.lines else "workbook"


def vocabulary(profiles: Mapping[str, FormatProfile]) -> frozenset[str]:
    """Every column name and label that the profiles know, and the units."""
    return _UNITS.union(*(profile.words for profile in profiles.values()))


def open_file(
    path: Path,
    profiles: Mapping[str, FormatProfile],
    profile: FormatProfile,
    limits: FileLimits = FileLimits(),  # noqa: B008  (immutable)
) -> OpenedFile:
    """Read a file's bytes and decode them, by the profile's encoding if it states one.

    Raises
    ------
    InputError
        If it is missing, empty, binary, or larger than the limits.
    """
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            # reading a pipe or a device might never end
            what = "a folder" if path.is_dir() else "a pipe or a device"
            raise InputError(f"is {what}, not a file", "name a file in the sheet", path)
        refuse_larger(path, "file_mb", status.st_size / 1e6, limits.file_mb, "MB")
        raw = path.read_bytes()
    except OSError as error:
        what = "file is missing" if isinstance(error, FileNotFoundError) else "cannot be read"
        raise InputError(what, "check the name in the sheet", path) from error
    digest = hashlib.sha256(raw).hexdigest()
    missing = frozenset(profile.missing)
    reader = reader_of(raw)
    match reader:
        case "workbook":
            sheets, notes = read_workbook(path, raw, missing, limits)
            return OpenedFile(
                path, _head_of_sheets(sheets), "", digest, sheets=list(sheets), notes=notes
            )
        case "binary table":
            tables = read_binary_table(path, raw, missing, limits)
            head = "\n".join("\t".join(map(_text, row)) for one in tables for row in one.rows[:1])
            return OpenedFile(path, head, "", digest, sheets=list(tables))
        case "text":
            return _open_text(path, raw, digest, profiles, profile, limits)
        case _:
            assert_never(reader)


Reader = Literal["workbook", "binary table", "text"]


def reader_of(raw: bytes) -> Reader:
    """Tell by the first bytes which reader a file needs; anything else is text."""
    if is_workbook(raw):
        return "workbook"
    return "binary table" if is_binary_table(raw) else "text"


def _head_of_sheets(sheets: Sequence[SheetSource]) -> str:
    rows = (
        [sheet.part, *("\t".join(map(_text, row)) for row in sheet.rows[:HEAD_LINES])]
        for sheet in sheets
    )
    return "\n".join("\n".join(lines) for lines in rows)


def _open_text(
    path: Path,
    raw: bytes,
    digest: str,
    profiles: Mapping[str, FormatProfile],
    profile: FormatProfile,
    limits: FileLimits,
) -> OpenedFile:
    if _MARKUP.match(raw):
        raise InputError(
            "is a page of HTML or XML, not a table",
            "open it in a spreadsheet and save it as XLSX or CSV",
            path,
        )
    if raw.endswith(b"\x00\x00\x00\x00"):
        raw = raw.rstrip(b"\x00")  # a file whose space was reserved but not filled
    decoded = decode(raw, path, profile.encoding, vocabulary(profiles))
    written = split_lines(join_grouped_digits(decoded.text))
    upright = upright_lines(written)
    lines, unit_lines = mark_units(without_borders(upright))
    lines, mixed = one_decimal_mark(lines)
    plain = clocks_to_seconds(lines)
    lines = plain.lines
    refuse_larger(path, "rows", len(lines), limits.rows, "lines")
    longest = max(map(len, lines))
    refuse_larger(path, "line_length", longest, limits.line_length, "characters in a line")
    notes = [f"encoding {decoded.encoding}: {decoded.note}", *([mixed] if mixed else [])]
    notes += [NOTE] if upright is not written else []
    head = "\n".join(line for line in lines[:HEAD_LINES] if _WORD.search(line))
    return OpenedFile(
        path,
        head,
        decoded.encoding,
        digest,
        lines=plain.lines,
        clocks=plain,
        unit_lines=unit_lines,
        largest_width=limits.columns,
        notes=tuple(notes),
    )


def refuse_larger(path: Path, limit: str, size: float, allowed: float, what: str) -> None:
    """Raise InputError if a size is beyond its limit, with the key of the configuration."""
    if size > allowed:
        raise InputError(
            f"has {size:.6g} {what}, {allowed:.6g} are allowed",
            f"export one test per file, or raise ingest.limits.{limit}",
            path,
        )


def _text(cell: object) -> str:
    return "" if cell is None else str(cell)
