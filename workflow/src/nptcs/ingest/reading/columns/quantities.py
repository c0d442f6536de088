"""Which column is which quantity, in which unit, and which table of a file is the test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from nptcs.errors import InputError
from nptcs.ingest.reading.columns.names import LOADS, STRAINS, by_unit, map_columns
from nptcs.ingest.reading.columns.tons import is_ton, settle_tons
from nptcs.ingest.reading.columns.words import may_be
from nptcs.ingest.reading.profiles import (
    UNITLESS,
    FormatProfile,
    name_matches,
    normalise,
)
from nptcs.ingest.reading.table_columns import Column, FoundTable, repeated_columns
from nptcs.ingest.reading.text.cells import CellSource
from nptcs.ingest.reading.units import (
    DIMENSION,
    FACTORS,
    VOLTS,
    factor,
    find_unit,
    usual_units,
)
from nptcs.tables.laboratory.curves import Role

NEEDS: dict[Role, tuple[tuple[str, ...], ...]] = {
    "force": (LOADS,),
    "strain": (STRAINS,),
    "force and strain": (LOADS, (*STRAINS, "displacement")),
}
"""Role → sets of quantities; a table needs one of each set."""
_PROBE = 5
"""Rows in the middle and at the end; a channel has a reading in some of them."""


@dataclass
class Test:
    """One test in a file: a table, or some columns of one."""

    __test__ = False

    label: str
    source: CellSource
    found_table: FoundTable
    quantities: dict[str, Column]
    strain_source: str = ""
    """``crosshead`` where the strain is a travel in a unit of strain."""

    def serves(self, role: Role) -> bool:
        """Tell whether the table contains what the role needs."""
        return all(any(name in self.quantities for name in needed) for needed in NEEDS[role])


def tests_in(
    source: CellSource,
    found_tables: Sequence[FoundTable],
    profile: FormatProfile,
    path: Path,
    plain: FormatProfile | None,
) -> list[Test]:
    """Every test in the tables of one source, with tests side by side separated.

    Where the profile's own names leave load or strain open, those of `plain` are tried.
    """
    found: list[Test] = []
    for found_table in found_tables:
        settle_tons(found_table)
        label = found_table.part if not source.part else source.part
        if source.part and len(found_tables) > 1:
            label = f"{source.part}/{found_table.part}"
        groups = _groups(source, found_table, profile)
        for group in groups or [""]:
            every = _without_raw_signals(_channels(source, found_table))
            columns = [
                column
                for column, part in zip(every, repeated_columns(every), strict=True)
                if not groups or part in ("", group)
            ]
            name = label if not group else group if len(found_tables) == 1 else f"{label}/{group}"
            quantities = map_columns(columns, profile, path, found_table, plain)
            strain_source = by_unit(quantities, profile, found_table)
            found.append(Test(name, source, found_table, quantities, strain_source))
    return found


def _channels(source: CellSource, found_table: FoundTable) -> list[Column]:
    """Leave out columns that are empty in the middle and at the end: notes next to readings."""
    rows = found_table.rows_of_data
    half = len(rows) // 2
    probe = [source.cells(row) for row in (*rows[half : half + _PROBE], *rows[-_PROBE:])]
    return [
        column
        for column in found_table.columns
        if any(column.position < len(cells) and cells[column.position] for cells in probe)
    ] or list(found_table.columns)


def _without_raw_signals(columns: Sequence[Column]) -> list[Column]:
    """Leave out the raw signal in volts of a channel that is also recorded in its own unit."""
    measured = {normalise(column.name) for column in columns if column.unit not in VOLTS}
    return [c for c in columns if c.unit not in VOLTS or normalise(c.name) not in measured]


def _groups(source: CellSource, found_table: FoundTable, profile: FormatProfile) -> list[str]:
    """Parts of columns that repeat a name the profile knows; empty if there is one test."""
    known = [name for names in profile.columns.values() for name in names]
    columns = _without_raw_signals(_channels(source, found_table))
    parts = [
        part
        for column, part in zip(columns, repeated_columns(columns), strict=True)
        if part and any(name_matches(column.name, name) for name in known)
    ]
    return list(dict.fromkeys(parts))


def choose_test(
    tests: Sequence[Test], part: str, specimen: str, role: Role, path: Path, profile: FormatProfile
) -> Test:
    """Choose the table: the part named, the only one that serves, or the specimen's own.

    Raises
    ------
    InputError
        With the choices, if none or several fit.
    """
    labels = ", ".join(f"'{test.label}'" for test in tests)
    if part:
        named = [test for test in tests if _is_part(test.label, part)]
        if len(named) != 1:
            what = "no table" if not named else "several tables"
            raise InputError(f"{what} of that name", f"parts: {labels}", path, value=part)
        if not named[0].serves(role):
            raise _nothing(named, role, path, profile)
        return named[0]
    serving = [test for test in tests if test.serves(role)]
    own = [test for test in serving if specimen and _is_part(test.label, specimen)]
    if len(serving) > 1 and len(own) == 1:
        return own[0]
    if len(serving) > 1:
        labels = ", ".join(f"'{test.label}'" for test in serving)
        raise InputError(
            f"the file holds {len(serving)} tests",
            f"name one of {labels} as force_part or strain_part in the sheet",
            path,
        )
    if not serving:
        raise _nothing(tests, role, path, profile)
    _refuse_continuation(serving[0], tests, path)
    return serving[0]


def _refuse_continuation(chosen: Test, tests: Sequence[Test], path: Path) -> None:
    """Stop if a table like the chosen one follows under something that is not a header."""
    found_table = chosen.found_table
    for test in tests:
        other = test.found_table
        same = test.source is chosen.source and other.width == found_table.width
        if same and other.first >= found_table.last:
            raise InputError(
                f"the table seems to go on in line {other.first + 1}, under other names",
                f"correct the file, or name '{chosen.label}' as force_part or strain_part",
                path,
                found_table.last + 1,
            )


def _is_part(label: str, part: str) -> bool:
    return normalise(part) in (normalise(label), normalise(label.rsplit("/", 1)[-1]))


def _nothing(tests: Sequence[Test], role: Role, path: Path, profile: FormatProfile) -> InputError:
    largest = max(tests, key=lambda test: len(test.found_table.rows_of_data), default=None)
    if largest is None:
        return InputError("no table of five rows or more", "export the raw data", path)
    names = [column.name for column in largest.found_table.columns if column.name]
    if not names:
        return InputError(
            f"the table of {largest.found_table.width} columns has no names",
            "write a profile with columns_in_order and units, and name it in the sheet",
            path,
            largest.found_table.first + 1,
        )
    missing = [needed for needed in NEEDS[role] if not set(needed) & set(largest.quantities)]
    wanted = " and ".join("one of " + ", ".join(needed) for needed in missing)
    found = ", ".join(_with_unit(column) for column in largest.found_table.columns if column.name)
    row = largest.found_table.names_row
    message = f"no column for {wanted} by profile '{profile.name}'; columns: {found}"
    if may := _candidates(largest, missing):
        likely = ", ".join(map(_with_unit, may))
        message = (
            f"no column for {wanted} by profile '{profile.name}'; columns: {found}; several may be "
            f"it: {likely}"
            if len(may) > 1 and all(column.unit for column in may)
            else f"no column for {wanted} by profile '{profile.name}'; columns: {found}; {likely} "
            "may be it, but its unit is not known"
        )
    return InputError(
        message,
        "name another profile in the sheet, or write one: nptcs inspect FILE --write-profile",
        path,
        None if row is None else row + 1,
    )


def _with_unit(column: Column) -> str:
    return f"'{column.name}' in {column.unit}" if column.unit else f"'{column.name}'"


def _candidates(test: Test, missing: Sequence[tuple[str, ...]]) -> list[Column]:
    """Columns that may be the first missing quantity, by their names."""
    read = list(test.quantities.values())
    free = [column for column in test.found_table.columns if column not in read and column.name]
    kinds: list[Literal["load", "strain"]] = [
        "load" if needed == LOADS else "strain" for needed in missing
    ]
    found = [[column for column in free if may_be(kind, column)] for kind in kinds]
    return next((columns for columns in found if columns), [])


def unit_of(
    quantity: str, column: Column, profile: FormatProfile, may_assume: bool, path: Path, line: int
) -> tuple[str, float, str]:
    """Return the unit of a column, the factor to the base unit, and a note if it was not stated.

    A strain without a unit is taken as dimensionless if `may_assume` is set; whether that is
    plausible is checked later.

    Raises
    ------
    InputError
        If no unit is stated or declared, or it is not one of the quantity.
    """
    if quantity in UNITLESS:
        return column.unit or "", 1.0, ""
    choices = usual_units(DIMENSION[quantity])
    note = ""
    wrong = profile.wrong_units.get(quantity)  # type: ignore[call-overload]
    unit = wrong or column.unit or profile.units.get(quantity, "")  # type: ignore[call-overload]
    if wrong:
        note = f"{quantity}: unit '{wrong}' by profile instead of '{column.unit or ''}'"
    elif not column.unit and unit:
        note = f"{quantity}: no unit in the file, '{unit}' by profile '{profile.name}'"
    elif not unit and may_assume and DIMENSION[quantity] in ("strain", "stretch"):
        unit, note = "1", f"{quantity}: no unit, taken as dimensionless"
    if not unit:
        raise InputError(
            f"no unit for {quantity}",
            f"state it in a profile under 'units' ({choices}) and name the profile in the sheet",
            path,
            line,
            column.name,
        )
    known = find_unit(DIMENSION[quantity], unit)
    if not wrong:
        _require_one_unit(quantity, column, unit, path, line)
    if known is None and quantity == "displacement" and unit in VOLTS:
        note = f"column '{column.name}' in {unit} is not a travel without its calibration: left out"
        return unit, float("nan"), note
    if known is None:
        raise InputError(
            f"not a unit of {quantity}",
            f"state the right one in a profile under 'wrong_units': {choices}",
            path,
            line,
            column.name,
            value=unit,
        )
    return known, FACTORS[DIMENSION[quantity]][known], note


def _require_one_unit(quantity: str, column: Column, unit: str, path: Path, line: int) -> None:
    """Refuse a ton that may be one of several, and two units in name and row of units."""
    if DIMENSION[quantity] == "force" and is_ton(unit):
        raise InputError(
            "which ton is meant is not known: metric 9806.65 N, US 8896.44 N or UK 9964.02 N",
            "state 'tf', 'US ton' or 'UK ton' in a profile under 'wrong_units', and name the "
            "profile in the sheet",
            path,
            line,
            column.name,
            value=unit,
        )
    stated, named = factor(quantity, unit), factor(quantity, column.unit_of_name or unit)
    if None not in (stated, named) and stated != named:
        raise InputError(
            f"two units for {quantity}: {column.unit_of_name} in its name, {unit} in the row of "
            "units",
            "state the right one in a profile under 'wrong_units', and name the profile in the "
            "sheet",
            path,
            line,
            column.name,
        )
