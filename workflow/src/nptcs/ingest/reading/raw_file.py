"""One raw file, read: quantities in s, N, mm, MPa and dimensionless strain."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.binary_tables import is_binary_table, read_binary_table
from nptcs.ingest.reading.cells import CellSource, TextSource, split_lines
from nptcs.ingest.reading.clock import PlainLines, clocks_to_seconds, join_grouped_digits
from nptcs.ingest.reading.decode import decode
from nptcs.ingest.reading.dialect import Dialect, find_dialect
from nptcs.ingest.reading.find_tables import find_tables
from nptcs.ingest.reading.labels import LabelValue, read_labels
from nptcs.ingest.reading.profiles import PLAIN, FormatProfile, Quantity
from nptcs.ingest.reading.quantities import Test, choose_test, tests_in, unit_of
from nptcs.ingest.reading.units import FACTORS
from nptcs.ingest.reading.workbooks import is_workbook, read_workbook

HEAD_LINES = 60
_WORD = re.compile(r"[^\W\d_]{2}|[|\[(%]")


@dataclass
class RawFile:
    """The table of one test as a file holds it.

    Parameters
    ----------
    values : dict of str to ndarray
        Quantity → readings, all of one length, in s, N, mm, MPa or dimensionless.
    columns, units : dict of str to str
        Quantity → column name and unit as found.
    head, names : tuple of str
        Lines above the names; all names of the table, also of columns that are not used.
    """

    path: Path
    profile: FormatProfile
    detected: bool
    sha256: str
    values: dict[str, Array]
    columns: dict[str, str]
    units: dict[str, str]
    strain_source: str = "unspecified"
    part: str = ""
    encoding: str = ""
    delimiter: str = ""
    decimal: str = ""
    header_line: int | None = None
    first_line: int | None = None
    labels: dict[str, LabelValue] = field(default_factory=dict)
    head: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """Number of readings."""
        return len(next(iter(self.values.values())))


@dataclass
class OpenedFile:
    """A raw file's content, before a dialect and a table are chosen."""

    path: Path
    head: str
    encoding: str
    sha256: str
    lines: list[str] = field(default_factory=list)
    clocks: PlainLines | None = None
    largest_width: int = FileLimits().columns
    sheets: list[CellSource] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    @property
    def kind(self) -> str:
        """``text`` or ``workbook``."""
        return "text" if self.lines else "workbook"


def vocabulary(profiles: Mapping[str, FormatProfile]) -> set[str]:
    """Every column name and label that the profiles know, and the units."""
    words = {unit for units in FACTORS.values() for unit in units}
    for profile in profiles.values():
        for names in (*profile.columns.values(), *profile.labels.values()):
            words.update(name.strip("*") for name in names)
    return words


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
        _refuse_larger(path, "file_mb", path.stat().st_size / 1e6, limits.file_mb, "MB")
        raw = path.read_bytes()
    except OSError as error:
        what = "file is missing" if isinstance(error, FileNotFoundError) else "cannot be read"
        raise InputError(what, "check the name in the sheet", path) from error
    digest = hashlib.sha256(raw).hexdigest()
    if is_workbook(raw):
        sheets, notes = read_workbook(path, raw, frozenset(profile.missing), limits)
        head = "\n".join(
            "\n".join(
                [sheet.part, *("\t".join(map(_text, row)) for row in sheet.rows[:HEAD_LINES])]
            )
            for sheet in sheets
        )
        return OpenedFile(path, head, "", digest, sheets=list(sheets), notes=notes)
    if is_binary_table(raw):
        tables = read_binary_table(path, raw, frozenset(profile.missing), limits)
        head = "\n".join("\t".join(map(_text, row)) for one in tables for row in one.rows[:1])
        return OpenedFile(path, head, "", digest, sheets=list(tables))
    decoded = decode(raw, path, profile.encoding, vocabulary(profiles))
    plain = clocks_to_seconds(split_lines(join_grouped_digits(decoded.text)))
    lines = plain.lines
    _refuse_larger(path, "rows", len(lines), limits.rows, "lines")
    longest = max(map(len, lines))
    _refuse_larger(path, "line_length", longest, limits.line_length, "characters in a line")
    note = f"encoding {decoded.encoding}: {decoded.note}"
    head = "\n".join(line for line in lines[:HEAD_LINES] if _WORD.search(line))
    return OpenedFile(
        path,
        head,
        decoded.encoding,
        digest,
        lines=plain.lines,
        clocks=plain,
        largest_width=limits.columns,
        notes=(note,),
    )


def _refuse_larger(path: Path, limit: str, size: float, allowed: float, what: str) -> None:
    if size > allowed:
        raise InputError(
            f"has {size:.6g} {what}, {allowed:.6g} are allowed",
            f"export one test per file, or raise ingest.limits.{limit}",
            path,
        )


def _text(cell: object) -> str:
    return "" if cell is None else str(cell)


def matching(
    opened: OpenedFile, profiles: Mapping[str, FormatProfile]
) -> tuple[list[FormatProfile], str]:
    """Profiles whose signature fits a file, `PLAIN` if none does, and the reason."""
    found = [
        profile
        for profile in profiles.values()
        if profile.kind == opened.kind and profile.matches(opened.head)
    ]
    if not found:
        return [profiles[PLAIN]], f"no signature of {len(profiles)} profiles fits: '{PLAIN}'"
    names = ", ".join(f"'{profile.name}'" for profile in found)
    return found, f"signature of {names} fits"


def read_raw(
    path: Path,
    profiles: Mapping[str, FormatProfile],
    *,
    declared: FormatProfile | None = None,
    part: str = "",
    specimen: str = "",
    role: str = "force and strain",
    limits: FileLimits = FileLimits(),  # noqa: B008  (immutable)
) -> RawFile:
    """Read the table of one test from a raw file.

    Parameters
    ----------
    path : Path
        The raw file.
    profiles : mapping of str to FormatProfile
        All known formats.
    declared : FormatProfile, optional
        The profile that the sheet names; None: detect.
    part : str
        Workbook sheet, table number or test name; needed if the file holds several.
    specimen : str
        Specimen id; chooses the part of that name if no part is given.
    role : str
        ``force``, ``strain`` or ``force and strain``: what the table must hold.
    limits : FileLimits
        Largest file that is read.

    Raises
    ------
    InputError
        With the line, the column and the choices.
    """
    opened = open_file(path, profiles, declared or profiles[PLAIN], limits)
    if declared is not None:
        reasons = ("profile named by the sheet",)
        return _read(opened, declared, profiles[PLAIN], reasons, part, specimen, role)
    fitting, reason = matching(opened, profiles)
    tables: list[RawFile] = []
    errors: list[InputError] = []
    for plain in (None, profiles[PLAIN]):
        for profile in fitting if not tables else ():
            again = open_file(path, profiles, profile, limits) if profile.encoding else opened
            try:
                table = _read(again, profile, plain, (reason,), part, specimen, role, detected=True)
                tables.append(table)
            except InputError as error:
                errors.append(error)
    if not tables:
        raise errors[0]
    if len({_reading(table) for table in tables}) > 1:
        names = ", ".join(table.profile.name for table in tables)
        raise InputError(
            f"several formats fit and read different values: {names}",
            "name one of them as force_format or strain_format in the sheet",
            path,
        )
    return tables[0]


def _reading(table: RawFile) -> tuple[tuple[str, bytes], ...]:
    """Return what a table says, to compare two readings of one file."""
    return tuple((name, values.tobytes()) for name, values in sorted(table.values.items()))


def sources_of(
    opened: OpenedFile, profile: FormatProfile
) -> tuple[list[CellSource], Dialect | None]:
    """Rows of cells of a file: one source for a text, one a sheet for a workbook."""
    if opened.kind != profile.kind and profile.signature:
        raise InputError(
            f"is a {opened.kind}, profile '{profile.name}' is for a {profile.kind}",
            "name another profile in the sheet",
            opened.path,
        )
    if opened.kind == "workbook":
        return opened.sheets, None
    dialect = _dialect(opened, profile)
    clocks = opened.clocks or PlainLines([])
    source = TextSource(
        opened.path,
        opened.lines,
        dialect,
        frozenset(profile.missing),
        clocks.originals,
        clocks.counts,
    )
    return [source], dialect


def _dialect(opened: OpenedFile, profile: FormatProfile) -> Dialect:
    """Find the dialect; a delimiter of the profile that the file does not keep is looked for."""
    try:
        return find_dialect(opened.lines, profile, opened.path)
    except InputError:
        if not profile.delimiter:
            raise
        free = profile.model_copy(update={"delimiter": "", "thousands": ""})
        return find_dialect(opened.lines, free, opened.path)


def _read(
    opened: OpenedFile,
    profile: FormatProfile,
    plain: FormatProfile | None,
    reasons: tuple[str, ...],
    part: str,
    specimen: str,
    role: str,
    detected: bool = False,
) -> RawFile:
    path = opened.path
    profile = profile.for_head(opened.head)
    sources, dialect = sources_of(opened, profile)
    tests = [
        test
        for source in sources
        for test in tests_in(
            source, find_tables(source, path, profile.unnamed_columns), profile, path, plain
        )
    ]
    test = choose_test(tests, part or profile.part, specimen, role, path, profile)
    values, units, notes = _values(test, profile, path, role)
    block = test.block
    _refuse_larger(path, "columns", block.width, opened.largest_width, "columns")
    return RawFile(
        path,
        profile,
        detected,
        opened.sha256,
        values,
        {quantity: column.name for quantity, column in test.quantities.items()},
        units,
        strain_source=test.strain_source or profile.strain_source,
        part=test.label if len(tests) > 1 else "",
        encoding=opened.encoding,
        delimiter="" if dialect is None else dialect.delimiter,
        decimal="" if dialect is None else dialect.decimal,
        header_line=None if block.names_row is None else block.names_row + 1,
        first_line=block.first + 1,
        labels=header_labels(test, profile, dialect),
        head=head_lines(test),
        names=tuple(column.name for column in block.columns if column.name),
        notes=(*reasons, *opened.notes, *block.notes, *notes),
    )


def _values(
    test: Test, profile: FormatProfile, path: Path, role: str
) -> tuple[dict[str, Array], dict[str, str], list[str]]:
    """Read the mapped columns and bring them to base units; rows without any load are left."""
    quantities = test.quantities
    line = (test.block.names_row if test.block.names_row is not None else test.block.first) + 1
    stated = any(column.unit for column in test.block.columns)
    units, scales, notes = {}, [], []
    if role == "force and strain" and "time" in quantities and not _has_unit("time", test, profile):
        quantities = {name: column for name, column in quantities.items() if name != "time"}
        notes.append("time: no unit, left out; nothing of one file rests on it")
    for quantity, column in quantities.items():
        if quantity == "force" and role == "strain" and not _has_unit("force", test, profile):
            units[quantity] = ""
            scales.append(1.0)
            notes.append("force: no unit, to be told from the force file's peak")
            continue
        unit, scale, note = unit_of(quantity, column, profile, stated, path, line)
        units[quantity] = unit
        scales.append(scale)
        notes += [note] if note else []
    positions = [column.position for column in quantities.values()]
    numbers = test.source.numbers(test.block, positions) * np.array(scales)
    filled = ~np.isnan(numbers).all(axis=1)
    if not filled.all():
        notes.append(f"{int((~filled).sum())} rows hold no number in these columns")
    return dict(zip(quantities, numbers[filled].T, strict=True)), units, notes


def _has_unit(quantity: Quantity, test: Test, profile: FormatProfile) -> bool:
    stated = test.quantities[quantity].unit
    return bool(stated or quantity in profile.units or quantity in profile.wrong_units)


def head_lines(test: Test) -> tuple[str, ...]:
    """Return the filled lines above the names, at most `HEAD_LINES`, and the name of the sheet."""
    last = test.block.names_row if test.block.names_row is not None else test.block.first
    rows = (test.source.cells(row) for row in range(max(0, last - HEAD_LINES), last))
    lines = (" ".join(cell for cell in cells if cell) for cells in rows)
    return tuple(line for line in (test.source.part, *lines) if line)


def header_labels(
    test: Test, profile: FormatProfile, dialect: Dialect | None
) -> dict[str, LabelValue]:
    """Header entries; in a text the header may use another delimiter than the table."""
    last = test.block.names_row if test.block.names_row is not None else test.block.first
    if dialect is None:
        rows = [test.source.cells(row) for row in range(last)]
        return read_labels(rows, profile, Dialect("\t", "."))
    rows = [test.source.cells(row) for row in range(last)]
    return read_labels(rows, profile, dialect)
