"""One raw file, read: quantities in s, N, mm, MPa and dimensionless strain."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.columns.head_units import add_units_of_head
from nptcs.ingest.reading.columns.labels import LabelValue, read_labels
from nptcs.ingest.reading.columns.names import ACROSS, STRAINS
from nptcs.ingest.reading.columns.quantities import Test, choose_test, unit_of
from nptcs.ingest.reading.columns.words import may_be_gauge
from nptcs.ingest.reading.continued_tables import tests_of
from nptcs.ingest.reading.opened_file import HEAD_LINES, OpenedFile, open_file, refuse_larger
from nptcs.ingest.reading.profiles import PLAIN, FormatProfile, normalise
from nptcs.ingest.reading.table_columns import Column
from nptcs.ingest.reading.text.cells import CellSource, TextSource
from nptcs.ingest.reading.text.clock import PlainLines
from nptcs.ingest.reading.text.dialect import Dialect, find_dialect
from nptcs.ingest.reading.units import VOLTS
from nptcs.tables.laboratory.curves import Role

TRUE_STRAINS = ("true strain", "logarithmic strain", "hencky strain", "wahre dehnung")


@dataclass
class RawFile:
    """The table of one test as read from a file.

    Parameters
    ----------
    values : dict of str to ndarray
        Quantity → readings, all of one length, in s, N, mm, MPa or dimensionless.
    columns, units : dict of str to str
        Quantity → column name and unit as found.
    head, names : tuple of str
        Lines above the names; all names of the table, including columns that are not used.
    unread : tuple of str
        Columns that were not read and may be a strain or an extension, with their units.
    assumed : tuple of str
        Quantities without a unit that were taken as dimensionless.
    notes, doubts : tuple of str
        How the file was read; what was assumed, which is flagged with every result.
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
    unread: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """Number of readings."""
        return len(next(iter(self.values.values())))


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
    role: Role = "force and strain",
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
        Workbook sheet, table number or test name; needed if the file contains several.
    specimen : str
        Specimen id; chooses the part of that name if no part is given.
    role : Role
        ``force``, ``strain`` or ``force and strain``: what the table must contain.
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
        if any(set(STRAINS) & set(table.values) or role == "force" for table in tables):
            break
        found: list[RawFile] = []
        for profile in fitting:
            again = open_file(path, profiles, profile, limits) if profile.encoding else opened
            try:
                table = _read(again, profile, plain, (reason,), part, specimen, role, detected=True)
                found.append(table)
            except InputError as error:
                errors.append(error)
        tables = found or tables
    if not tables:
        raise errors[len(fitting)]  # with the names of PLAIN, too
    if len({_reading(table) for table in tables}) > 1:
        names = ", ".join(table.profile.name for table in tables)
        raise InputError(
            f"several formats fit and read different values: {names}",
            "name one of them as force_format or strain_format in the sheet",
            path,
        )
    return tables[0]


def _reading(table: RawFile) -> tuple[tuple[str, bytes], ...]:
    """Return the values of a table, to compare two readings of one file."""
    return tuple((name, values.tobytes()) for name, values in sorted(table.values.items()))


def sources_of(
    opened: OpenedFile, profile: FormatProfile
) -> tuple[list[CellSource], Dialect | None]:
    """Rows of cells of a file: one source for a text, one per sheet for a workbook."""
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
        opened.unit_lines,
    )
    return [source], dialect


def _dialect(opened: OpenedFile, profile: FormatProfile) -> Dialect:
    """Find the dialect; a profile's delimiter that does not fit the file is detected instead."""
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
    role: Role,
    detected: bool = False,
) -> RawFile:
    path = opened.path
    profile = profile.for_head(opened.head)
    sources, dialect = sources_of(opened, profile)
    tests = [test for source in sources for test in tests_of(source, profile, path, plain)]
    test = choose_test(tests, part or profile.part, specimen, role, path, profile)
    add_units_of_head(test)
    values, units, notes = _values(test, profile, path, role)
    assumed = tuple(
        q for q, unit in units.items() if unit == "1" and not _has_unit(q, test, profile)
    )
    if "strain" in assumed and _agrees_with_true_strain(test, values["strain"]):
        assumed = ()
    found_table = test.found_table
    refuse_larger(path, "columns", found_table.width, opened.largest_width, "columns")
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
        header_line=None if found_table.names_row is None else found_table.names_row + 1,
        first_line=found_table.first + 1,
        labels=header_labels(test, profile, dialect),
        head=head_lines(test),
        names=tuple(column.name for column in found_table.columns if column.name),
        unread=_unread(test),
        assumed=assumed,
        doubts=tuple(dict.fromkeys(found_table.doubts)),
        notes=(*reasons, *opened.notes, *found_table.notes, *notes),
    )


def _unread(test: Test) -> tuple[str, ...]:
    """Columns that are not read and may be a strain or an extension, with their units."""
    read = list(test.quantities.values())
    free = [column for column in test.found_table.columns if column.name and column not in read]
    return tuple(f"'{column.name}' in {column.unit}" for column in free if may_be_gauge(column))


def _values(
    test: Test, profile: FormatProfile, path: Path, role: Role
) -> tuple[dict[str, Array], dict[str, str], list[str]]:
    """Read the mapped columns and convert them to base units; rows empty in all are left out."""
    quantities, notes = _readable_quantities(test, profile, path, role)
    units, scales = {}, []
    for quantity in quantities:
        units[quantity], scale, note = _unit_and_scale(quantity, test, profile, path, role)
        scales.append(scale)
        notes += [note] if note else []
    positions = [column.position for column in quantities.values()]
    numbers = test.source.numbers(test.found_table, positions) * np.array(scales)
    filled = ~np.isnan(numbers).all(axis=1)
    if not filled.all():
        notes.append(f"{int((~filled).sum())} rows hold no number in these columns")
    values = dict(zip(quantities, numbers[filled].T, strict=True))
    if "time" in values and _runs_back(values["time"]):
        values = {name: readings[::-1] for name, readings in values.items()}
        notes.append("the time runs backwards: the rows were read from the last to the first")
    return values, units, notes


def _readable_quantities(
    test: Test, profile: FormatProfile, path: Path, role: Role
) -> tuple[dict[str, Column], list[str]]:
    """Leave out, with a note, a time and strains across the load whose unit is not known."""
    quantities, notes = dict(test.quantities), []
    if role == "force and strain" and "time" in quantities and not _has_unit("time", test, profile):
        del quantities["time"]
        notes.append("time: no unit, left out; nothing in a single file depends on it")
    for quantity in [name for name in ACROSS if name in quantities]:
        try:
            _unit_and_scale(quantity, test, profile, path, role)
        except InputError as error:
            left = test.quantities[quantity]
            quantities = {name: column for name, column in quantities.items() if column is not left}
            notes.append(f"column '{left.name}' left out: {error.message}")
    return quantities, notes


def _unit_and_scale(
    quantity: str, test: Test, profile: FormatProfile, path: Path, role: Role
) -> tuple[str, float, str]:
    """Return the unit of a quantity, the factor to the base unit, and a note.

    The force of a strain file only pairs it with the force file: it needs no unit of force.
    """
    column = test.quantities[quantity]
    if quantity == "force" and role == "strain":
        if column.unit in VOLTS and "force" not in profile.wrong_units:
            return str(column.unit), 1.0, f"force: in {column.unit}, its shape pairs the files"
        if not _has_unit("force", test, profile):
            return "", 1.0, "force: no unit, to be determined from the peak of the force file"
    found_table = test.found_table
    may_assume = role == "strain" or any(column.unit for column in found_table.columns)
    return unit_of(quantity, column, profile, may_assume, path, found_table.end_of_head + 1)


def _runs_back(time: Array) -> bool:
    """Tell whether each time is before the one above it: the newest reading comes first."""
    return len(time) > 1 and bool((np.diff(time) < 0).all())


def _agrees_with_true_strain(test: Test, strain: Array) -> bool:
    """Tell whether the table contains a true strain that is ln(1 + ε): only a strain ε fits it."""
    columns = [c for c in test.found_table.columns if normalise(c.name) in TRUE_STRAINS]
    if len(columns) != 1:
        return False
    try:
        true = test.source.numbers(test.found_table, [columns[0].position])[:, 0]
    except InputError:
        return False
    largest = int(np.nanargmax(strain))
    ends = len(true) == len(strain) and strain[largest] > -1
    return bool(ends and abs(true[largest] / np.log1p(strain[largest]) - 1) < 0.01)


def _has_unit(quantity: str, test: Test, profile: FormatProfile) -> bool:
    stated = test.quantities[quantity].unit
    return bool(stated or quantity in profile.units or quantity in profile.wrong_units)


def head_lines(test: Test) -> tuple[str, ...]:
    """Return the filled lines above the names, at most `HEAD_LINES`, and the name of the sheet."""
    last = test.found_table.end_of_head
    rows = (test.source.cells(row) for row in range(max(0, last - HEAD_LINES), last))
    lines = (" ".join(cell for cell in cells if cell) for cells in rows)
    return tuple(line for line in (test.source.part, *lines) if line)


def header_labels(
    test: Test, profile: FormatProfile, dialect: Dialect | None
) -> dict[str, LabelValue]:
    """Header entries; in a text the header may use another delimiter than the table."""
    rows = [test.source.cells(row) for row in range(test.found_table.end_of_head)]
    return read_labels(rows, profile, dialect or Dialect("\t", "."))
