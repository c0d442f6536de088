"""Which column is which quantity, in which unit, and which table of a file is the test."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from nptcs.errors import InputError
from nptcs.ingest.reading.cells import CellSource
from nptcs.ingest.reading.profiles import (
    UNITLESS,
    FormatProfile,
    name_matches,
    normalise,
    without_channel,
)
from nptcs.ingest.reading.table_columns import Column, FoundTable, repeated_columns
from nptcs.ingest.reading.units import DIMENSION, FACTORS, find_unit

STRAINS = ("strain", "strain_xx", "strain_yy", "stretch", "extension")
LOADS = ("force", "stress")
NEEDS = {
    "force": (LOADS,),
    "strain": (STRAINS,),
    "force and strain": (LOADS, (*STRAINS, "displacement")),
}
"""Role → sets of quantities of which one each must be there."""


@dataclass
class Test:
    """One test in a file: a table, or some columns of one."""

    __test__ = False

    label: str
    source: CellSource
    block: FoundTable
    quantities: dict[str, Column]
    strain_source: str = ""
    """``crosshead`` where the strain is a travel in a unit of strain."""

    def serves(self, role: str) -> bool:
        """Tell whether the table holds what the role needs."""
        return all(any(name in self.quantities for name in needed) for needed in NEEDS[role])


def tests_in(
    source: CellSource,
    blocks: Sequence[FoundTable],
    profile: FormatProfile,
    path: Path,
    plain: FormatProfile | None,
) -> list[Test]:
    """Every test in the tables of one source, tests side by side told apart.

    Where the profile's own names leave load or strain open, those of `plain` are tried.
    """
    found: list[Test] = []
    for block in blocks:
        label = block.part if not source.part else source.part
        if source.part and len(blocks) > 1:
            label = f"{source.part}/{block.part}"
        groups = _groups(block, profile)
        for group in groups or [""]:
            columns = [
                column
                for column, part in zip(block.columns, repeated_columns(block.columns), strict=True)
                if not groups or part in ("", group)
            ]
            name = label if not group else group if len(blocks) == 1 else f"{label}/{group}"
            quantities = map_columns(columns, profile, path, block, plain)
            strain_source = by_unit(quantities, profile, block)
            found.append(Test(name, source, block, quantities, strain_source))
    return found


def _groups(block: FoundTable, profile: FormatProfile) -> list[str]:
    """Parts of columns that repeat a name the profile knows; empty if there is one test."""
    known = [name for names in profile.columns.values() for name in names]
    parts = [
        part
        for column, part in zip(block.columns, repeated_columns(block.columns), strict=True)
        if part and any(name_matches(column.name, name) for name in known)
    ]
    return list(dict.fromkeys(parts))


def map_columns(
    columns: Sequence[Column],
    profile: FormatProfile,
    path: Path,
    block: FoundTable,
    plain: FormatProfile | None = None,
) -> dict[str, Column]:
    """Quantity → column, by the profile's names or order.

    Names count as they are, then without the prefix and suffix of a channel; then, where no load
    or no strain was found, the names of `plain` in the same way.

    Raises
    ------
    InputError
        If a name of the profile fits several columns.
    """
    if profile.columns_in_order:
        if len(profile.columns_in_order) != block.width:
            raise InputError(
                f"table has {block.width} columns, profile '{profile.name}' names "
                f"{len(profile.columns_in_order)}",
                "correct columns_in_order",
                path,
                block.first + 1,
            )
        pairs = zip(profile.columns_in_order, columns, strict=True)
        return {quantity: column for quantity, column in pairs if quantity != "-"}
    mapped: dict[str, Column] = {}
    for known in (profile, plain):
        for bare in (False, True):
            if known is None:
                continue
            wanted = {str(name) for name in known.columns} - set(mapped)
            if known is not profile or bare:
                wanted &= _lacking(mapped, columns)
            _map_names(mapped, wanted, columns, known, bare, path, block)
    order = [*profile.columns, *(plain.columns if plain is not None else ())]
    return dict(sorted(mapped.items(), key=lambda item: order.index(item[0])))


def _lacking(mapped: dict[str, Column], columns: Sequence[Column]) -> set[str]:
    """Quantities of which none of their kind is mapped yet; a time must state its unit."""
    kinds = (LOADS, (*STRAINS, "displacement"))
    lacking = {name for kind in kinds if not set(kind) & set(mapped) for name in kind}
    lacking |= set(UNITLESS) - set(mapped)
    return lacking | ({"time"} - set(mapped) if any(c.unit for c in columns) else set())


def _map_names(
    mapped: dict[str, Column],
    wanted: set[str],
    columns: Sequence[Column],
    profile: FormatProfile,
    bare: bool,
    path: Path,
    block: FoundTable,
) -> None:
    """Add the quantities of `wanted` whose name a free column has, first name first."""
    taken = {column.position for column in mapped.values()}
    for quantity in (name for name in profile.columns if name in wanted):
        for name in profile.columns[quantity]:
            fitting = [
                column
                for column in columns
                if column.position not in taken
                and name_matches(without_channel(column.name) if bare else column.name, name)
            ]
            if len(fitting) > 1:
                raise _several(path, block, quantity, name, fitting)
            if fitting:
                mapped[quantity] = fitting[0]
                taken.add(fitting[0].position)
                break


_BY_UNIT = {
    "strain": "extension",
    "extension": "strain",
    "displacement": "strain",
    "force": "stress",
    "stress": "force",
}
_TRAVEL = re.compile(
    r"crosshead|travel|travers|position|stroke|course|weg\b|carrera|corsa|ход|行程"
)


def by_unit(mapped: dict[str, Column], profile: FormatProfile, block: FoundTable) -> str:
    """Let the unit decide what a column is where its name says another quantity.

    ``Axial Extensometer`` in mm/mm is a strain, ``Strain 1`` in mm an extension. A column whose
    quantity is already there, or whose unit belongs to neither, stays as it is.

    Returns
    -------
    str
        ``crosshead`` if a travel became the strain, else empty.
    """
    source = ""
    for quantity, other in _BY_UNIT.items():
        column = mapped.get(quantity)
        unit = profile.wrong_units.get(quantity) or (column and column.unit)  # type: ignore[call-overload]
        if column is None or not unit or find_unit(DIMENSION[quantity], unit):
            continue
        if unit in ("1", "-") or find_unit(DIMENSION[other], unit) is None or other in mapped:
            continue
        mapped[other] = mapped.pop(quantity)
        block.notes.append(f"column '{column.name}' in {unit} is read as {other}")
        if quantity == "displacement" and _TRAVEL.search(normalise(column.name)):
            source = "crosshead"
    return source


def _several(
    path: Path, block: FoundTable, quantity: str, name: str, fitting: Sequence[Column]
) -> InputError:
    choices = ", ".join(f"'{column.name}' (number {column.position + 1})" for column in fitting)
    return InputError(
        f"'{name}' fits several columns for {quantity}: {choices}",
        "name the right one exactly in a profile",
        path,
        None if block.names_row is None else block.names_row + 1,
    )


def choose_test(
    tests: Sequence[Test], part: str, specimen: str, role: str, path: Path, profile: FormatProfile
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
    """Stop if a table like the chosen one follows under something that is no header."""
    block = chosen.block
    for test in tests:
        other = test.block
        same = test.source is chosen.source and other.width == block.width
        if same and other.first >= block.last:
            raise InputError(
                f"the table seems to go on in line {other.first + 1}, under other names",
                f"correct the file, or name '{chosen.label}' as force_part or strain_part",
                path,
                block.last + 1,
            )


def _is_part(label: str, part: str) -> bool:
    return normalise(part) in (normalise(label), normalise(label.rsplit("/", 1)[-1]))


def _nothing(tests: Sequence[Test], role: str, path: Path, profile: FormatProfile) -> InputError:
    largest = max(tests, key=lambda test: len(test.block.rows_of_data), default=None)
    if largest is None:
        return InputError("no table of five rows or more", "export the raw data", path)
    names = [column.name for column in largest.block.columns if column.name]
    if not names:
        return InputError(
            f"the table of {largest.block.width} columns has no names",
            "write a profile with columns_in_order and units, name it in the sheet",
            path,
            largest.block.first + 1,
        )
    missing = [needed for needed in NEEDS[role] if not set(needed) & set(largest.quantities)]
    wanted = " and ".join("one of " + ", ".join(needed) for needed in missing)
    found = ", ".join(f"'{name}'" for name in names)
    row = largest.block.names_row
    return InputError(
        f"no column for {wanted} by profile '{profile.name}'; columns: {found}",
        "name another profile in the sheet, or write one: nptcs inspect FILE --write-profile",
        path,
        None if row is None else row + 1,
    )


def unit_of(
    quantity: str, column: Column, profile: FormatProfile, units_stated: bool, path: Path, line: int
) -> tuple[str, float, str]:
    """Give the unit of a column, the factor to the base unit, and a note where it was not stated.

    Raises
    ------
    InputError
        If no unit is stated nor declared, or it is not one of the quantity.
    """
    if quantity in UNITLESS:
        return column.unit or "", 1.0, ""
    choices = ", ".join(FACTORS[DIMENSION[quantity]])
    note = ""
    wrong = profile.wrong_units.get(quantity)  # type: ignore[call-overload]
    unit = wrong or column.unit or profile.units.get(quantity, "")  # type: ignore[call-overload]
    if wrong:
        note = f"{quantity}: unit '{wrong}' by profile instead of '{column.unit or ''}'"
    elif not column.unit and unit:
        note = f"{quantity}: no unit in the file, '{unit}' by profile '{profile.name}'"
    elif not unit and units_stated and DIMENSION[quantity] in ("strain", "stretch"):
        unit, note = "1", f"{quantity}: no unit beside stated ones, taken as dimensionless"
    if not unit:
        raise InputError(
            f"no unit for {quantity}",
            f"state it in a profile under 'units' ({choices}) and name the profile in the sheet",
            path,
            line,
            column.name,
        )
    known = find_unit(DIMENSION[quantity], unit)
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
