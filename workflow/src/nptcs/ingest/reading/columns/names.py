"""Which column is which quantity: by a profile's names, and by the unit where they disagree."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

from nptcs.errors import InputError
from nptcs.ingest.reading.columns.words import is_reading, map_by_words
from nptcs.ingest.reading.profiles import (
    COUNTERS,
    PLAIN,
    UNITLESS,
    FormatProfile,
    core_name,
    name_matches,
    normalise,
    without_channel,
)
from nptcs.ingest.reading.table_columns import Column, FoundTable
from nptcs.ingest.reading.units import DIMENSION, find_unit

STRAINS = ("strain", "strain_xx", "strain_yy", "stretch", "extension")
LOADS = ("force", "stress")
ACROSS = ("strain_transverse", "extension_transverse")


def map_columns(
    columns: Sequence[Column],
    profile: FormatProfile,
    path: Path,
    found_table: FoundTable,
    plain: FormatProfile | None = None,
) -> dict[str, Column]:
    """Quantity → column, by the profile's names or order.

    Names count as they are, then without the prefix and suffix of a channel, then without the
    words that say how it was measured; then, where no load or no strain was found, the names of
    `plain` in the same way.

    Raises
    ------
    InputError
        If a name of the profile fits several columns.
    """
    if profile.columns_in_order:
        if len(profile.columns_in_order) != found_table.width:
            raise InputError(
                f"table has {found_table.width} columns, profile '{profile.name}' names "
                f"{len(profile.columns_in_order)}",
                "correct columns_in_order",
                path,
                found_table.first + 1,
            )
        pairs = zip(profile.columns_in_order, columns, strict=True)
        return {quantity: column for quantity, column in pairs if quantity != "-"}
    mapped: dict[str, Column] = {}
    for known in (profile, plain):
        for part in (_whole, without_channel, core_name):
            if known is None:
                continue
            wanted = {str(name) for name in known.columns} - set(mapped)
            if known is not profile or part is not _whole:
                lacking = _lacking(mapped, columns, own=known is profile)
                # a column called a strain is one, even next to a travel
                lacking |= (
                    {"strain"} if not set(STRAINS) & set(mapped) and part is _whole else set()
                )
                wanted &= lacking
                # without its digits a channel '0x10' would be a coordinate
                wanted -= set() if part is _whole else _NEED_WHOLE_NAMES[part is core_name]
            _map_names(mapped, wanted, columns, known, part, path, found_table)
    _prefer_a_sensor(mapped, columns)
    every = plain is not None or profile.name == PLAIN
    found_table.notes += map_by_words(mapped, _wanted_by_words(mapped, columns, every), columns)
    order = [*profile.columns, *(plain.columns if plain is not None else ()), *DIMENSION]
    return dict(sorted(mapped.items(), key=lambda item: order.index(item[0])))


_NEED_WHOLE_NAMES = {False: set(UNITLESS) - set(COUNTERS), True: set(UNITLESS)}
"""Quantities that a part of a name does not identify: the name without the marks of a channel
(False), or its core (True)."""
_OF_A_SENSOR = re.compile(r"extensom|video|laser|optical|optisch|dic|ga[u]?ge|dms|fein|aufnehm")


def _prefer_a_sensor(mapped: dict[str, Column], columns: Sequence[Column]) -> None:
    """Take a strain whose name says its sensor rather than a nominal one.

    ISO 527 and testXpert call travel over the distance of the grips the nominal strain.
    """
    own = mapped.get("strain")
    if own is None or "nomin" not in normalise(own.name):
        return
    measured = [c for c in columns if c is not own and _OF_A_SENSOR.search(normalise(c.name))]
    better: dict[str, Column] = {}
    map_by_words(better, {"strain"}, measured)
    mapped |= better


def _wanted_by_words(mapped: dict[str, Column], columns: Sequence[Column], every: bool) -> set[str]:
    """Quantities that words in names may identify.

    Only those across the load, unless `every` is set, as it is with the names of `PLAIN`. A travel
    is wanted next to a strain, too: it shows where the strain is nothing but travel.
    """
    across = set() if {*ACROSS, "strain_xx"} & set(mapped) else set(ACROSS)
    if not every:
        return across
    travel = set() if "displacement" in mapped else {"displacement"}
    return across | travel | _lacking(mapped, columns, own=True)


def _whole(name: str) -> str:
    return name


def _lacking(mapped: dict[str, Column], columns: Sequence[Column], own: bool) -> set[str]:
    """Quantities of which none of their kind is mapped yet; a time must state its unit.

    A travel counts as a strain only against the names of a profile other than its `own`.
    """
    kinds: list[tuple[str, ...]] = [LOADS, STRAINS if own else (*STRAINS, "displacement")]
    if "strain_xx" not in mapped:
        kinds.append(ACROSS)
    lacking = {name for kind in kinds if not set(kind) & set(mapped) for name in kind}
    lacking |= set(UNITLESS) - set(mapped)
    return lacking | ({"time"} - set(mapped) if any(c.unit for c in columns) else set())


def _map_names(
    mapped: dict[str, Column],
    wanted: set[str],
    columns: Sequence[Column],
    profile: FormatProfile,
    part: Callable[[str], str],
    path: Path,
    found_table: FoundTable,
) -> None:
    """Add the quantities of `wanted` whose name is that part of a free column's, in order."""
    taken = {column.position for column in mapped.values()}
    for quantity in (name for name in profile.columns if name in wanted):
        for name in profile.columns[quantity]:
            fitting = [
                column
                for column in columns
                if column.position not in taken and name_matches(part(column.name), name)
            ]
            if part is not _whole and quantity not in _NUMBERED:
                fitting = fitting + _siblings(fitting, columns)
            if len(fitting) > 1:
                fitting = [column for column in fitting if is_reading(column)] or fitting
            if len(fitting) > 1:
                raise _several(path, found_table, quantity, name, fitting)
            if fitting:
                mapped[quantity] = fitting[0]
                taken.add(fitting[0].position)
                break


_NUMBERED = ("strain", "strain_transverse")
"""In many programs `1` and `2` of these are the strains along and across."""


def _siblings(fitting: Sequence[Column], columns: Sequence[Column]) -> list[Column]:
    """Columns that differ from one of `fitting` in the number at the end only: ``Load1, Load2``."""

    def stem(column: Column) -> tuple[str, str | None]:
        return re.sub(r"\d+$", "", normalise(column.name)), column.unit

    stems = [stem(column) for column in fitting if column.name[-1:].isdigit()]
    return [column for column in columns if column not in fitting and stem(column) in stems]


_BY_UNIT = {
    "strain": "extension",
    "extension": "strain",
    "strain_transverse": "extension_transverse",
    "extension_transverse": "strain_transverse",
    "displacement": "strain",
    "force": "stress",
    "stress": "force",
}
OVER_LENGTH = re.compile(r"strain.*\((?:extension|displacement|crosshead|stroke|position)\)")
"""Bluehill's ``Tensile strain (Extension)``: travel over the gauge length."""
_TRAVEL = re.compile(
    r"crosshead|travel|travers|position|stroke|course|weg\b|carrera|corsa|ход|行程"
)


def by_unit(mapped: dict[str, Column], profile: FormatProfile, found_table: FoundTable) -> str:
    """Let the unit decide what a column is where its name says another quantity.

    ``Axial Extensometer`` in mm/mm is a strain, ``Strain 1`` in mm an extension. A column whose
    quantity is already there, or whose unit belongs to neither, stays as it is.

    Returns
    -------
    str
        ``crosshead`` if a travel became the strain, else empty.
    """
    source = ""
    if not {*STRAINS, "displacement"} & set(mapped):
        over_length = [c for c in found_table.columns if OVER_LENGTH.search(normalise(c.name))]
        if len(over_length) == 1:
            mapped["strain"], source = over_length[0], "crosshead"
    for quantity, other in _BY_UNIT.items():
        column = mapped.get(quantity)
        unit = profile.wrong_units.get(quantity) or (column and column.unit)  # type: ignore[call-overload]
        if column is None or not unit or find_unit(DIMENSION[quantity], unit):
            continue
        if unit in ("1", "-") or find_unit(DIMENSION[other], unit) is None or other in mapped:
            continue
        mapped[other] = mapped.pop(quantity)
        found_table.notes.append(f"column '{column.name}' in {unit} is read as {other}")
        if quantity == "displacement" and _TRAVEL.search(normalise(column.name)):
            source = "crosshead"
    return source


def _several(
    path: Path, found_table: FoundTable, quantity: str, name: str, fitting: Sequence[Column]
) -> InputError:
    choices = ", ".join(f"'{column.name}' (number {column.position + 1})" for column in fitting)
    remedy = f"name the right one exactly as {quantity} in a profile, and the profile in the sheet"
    if quantity == "strain":
        remedy += "; gauges on both faces: strain and strain_back, across: strain_transverse"
    return InputError(
        f"'{name}' fits several columns for {quantity}: {choices}",
        remedy,
        path,
        None if found_table.names_row is None else found_table.names_row + 1,
    )
