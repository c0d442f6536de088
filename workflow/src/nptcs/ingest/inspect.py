"""What detection makes of one file, in words, and a profile to start from."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.columns.head_units import add_units_of_head
from nptcs.ingest.reading.columns.names import ACROSS, LOADS, STRAINS
from nptcs.ingest.reading.columns.quantities import NEEDS, Test, unit_of
from nptcs.ingest.reading.columns.words import may_be
from nptcs.ingest.reading.continued_tables import tests_of
from nptcs.ingest.reading.opened_file import OpenedFile, open_file
from nptcs.ingest.reading.profiles import PLAIN, FormatProfile
from nptcs.ingest.reading.raw_file import header_labels, matching, sources_of
from nptcs.ingest.reading.text.dialect import Dialect
from nptcs.ingest.reading.unit_in_name import factor_in_name
from nptcs.ingest.reading.units import DIMENSION, FACTORS, factor

ROWS_SHOWN = 3


@dataclass
class Inspection:
    """One file as one profile sees it."""

    opened: OpenedFile
    profile: FormatProfile
    reason: str
    dialect: Dialect | None = None
    tests: list[Test] = field(default_factory=list)
    problem: InputError | None = None

    @property
    def understood(self) -> int:
        """Number of columns that are a quantity, in the fullest table."""
        if self.problem is not None:
            return -1
        return max((len(test.quantities) for test in self.tests), default=0)

    @property
    def has_strain(self) -> bool:
        """Tell whether a table contains a strain, not only the travel of the crosshead."""
        return any(set(STRAINS) & set(test.quantities) for test in self.tests)

    @property
    def usable(self) -> bool:
        """Tell whether a table contains a load, or strains for one, and its units are known."""
        return self.obstacle() == ""

    def obstacle(self) -> str:
        """Return why no table of the file can be used; empty if one can."""
        if self.problem is not None:
            return self.problem.message
        serving = [test for test in self.tests if any(test.serves(role) for role in NEEDS)]
        if not serving:
            seen = [c.name for test in self.tests for c in test.found_table.columns if c.name]
            names = ", ".join(f"'{name}'" for name in dict.fromkeys(seen)) or "none"
            return f"no column is a load or a strain; columns: {names}"
        reasons = [self.no_unit(test) for test in serving]
        return "" if "" in reasons else reasons[0]

    def unread(self) -> str:
        """Return which load or strain of a usable file was not understood; empty if none.

        A file with only the load, or only strains, is complete together with another one, but not
        if it contains a column that is probably the other of the two.
        """
        tests = [test for test in self.tests if any(test.serves(role) for role in NEEDS)]
        if not self.usable or any(test.serves("force and strain") for test in tests):
            return ""
        for test in tests:
            kind: Literal["load", "strain"] = "strain" if test.serves("force") else "load"
            read = [*test.quantities.values()]
            columns = [c for c in test.found_table.columns if c.name and c not in read]
            if found := [c for c in columns if may_be(kind, c)]:
                names = ", ".join(f"'{c.name}' in {c.unit or 'no unit'}" for c in found)
                return f"no column is read as a {kind}; {names} may be one (a profile can name it)"
        return ""

    def no_unit(self, test: Test) -> str:
        """Name the first column of a table whose unit cannot be told."""
        stated = any(column.unit for column in test.found_table.columns)
        for quantity, column in test.quantities.items():
            if quantity == "force" and "strain_xx" in test.quantities and not column.unit:
                continue  # determined from the machine's own file
            if quantity in ACROSS or (quantity == "time" and test.serves("force and strain")):
                continue  # not needed: left out with a note
            try:
                unit_of(quantity, column, self.profile, stated, self.opened.path, 0)
            except InputError as error:
                return f"{error.message} ('{column.name}')"
            if quantity in (*LOADS, *STRAINS) and (found := factor_in_name(column.name)):
                return (
                    f"the name '{column.name}' contains a factor, '{found}': state it in the sheet"
                )
        return ""


def inspect_file(
    path: Path,
    profiles: Mapping[str, FormatProfile],
    declared: FormatProfile | None = None,
    limits: FileLimits = FileLimits(),  # noqa: B008  (immutable)
) -> Inspection:
    """Open a file, detect its format and find its tables; a problem is kept, not raised.

    Raises
    ------
    InputError
        If the file cannot even be opened.
    """
    opened = open_file(path, profiles, declared or profiles[PLAIN], limits)
    if declared is not None:
        return _inspect(opened, declared, "named on the command line", profiles[PLAIN])
    fitting, reason = matching(opened, profiles)
    best = max((_inspect(opened, one, reason, None) for one in fitting), key=_worth)
    if best.usable and best.has_strain:
        return best
    # as in reading: the names of PLAIN may tell a strain next to the travel that the profile knows
    again = (_inspect(opened, one, reason, profiles[PLAIN]) for one in fitting)
    return max([best, *again], key=_worth)


def _worth(inspection: Inspection) -> tuple[bool, bool, int]:
    return inspection.usable, inspection.has_strain, inspection.understood


def _inspect(
    opened: OpenedFile, profile: FormatProfile, reason: str, plain: FormatProfile | None
) -> Inspection:
    result = Inspection(opened, profile.for_head(opened.head), reason)
    try:
        sources, result.dialect = sources_of(opened, result.profile)
        for source in sources:
            result.tests += tests_of(source, profile, opened.path, plain)
        for test in result.tests:
            add_units_of_head(test)
    except InputError as error:
        result.problem = error
    return result


def inspection_text(inspection: Inspection) -> str:
    """Return the inspection as text for a terminal."""
    opened = inspection.opened
    lines = [
        f"file       {opened.path}",
        f"sha256     {opened.sha256}",
        f"content    {opened.kind}",
        *(f"           {note}" for note in opened.notes),
        f"format     {inspection.profile.name}: {inspection.profile.title}",
        f"           {inspection.reason}",
    ]
    if inspection.dialect is not None:
        lines.append(f"numbers    {inspection.dialect.describe()}")
    for test in inspection.tests:
        lines += ["", *_describe_test(test, inspection)]
    if inspection.problem is not None:
        lines += ["", f"problem    {inspection.problem}"]
    elif not inspection.tests:
        lines += ["", "problem    no table of five rows or more"]
    elif not inspection.usable:
        lines += ["", f"problem    {inspection.obstacle()}"]
    elif words := inspection.unread():
        lines += ["", f"problem    {words}"]
    return "\n".join(lines)


def _describe_test(test: Test, inspection: Inspection) -> list[str]:
    found_table = test.found_table
    lines = [
        f"table {test.label}: {len(found_table.rows_of_data)} rows, lines "
        f"{found_table.first + 1} to {found_table.last}, names "
        + (
            f"in line {found_table.names_row + 1}"
            if found_table.names_row is not None
            else "absent"
        )
    ]
    labels = header_labels(test, inspection.profile, inspection.dialect)
    lines += [f"  {name}: {found.text} {found.unit}".rstrip() for name, found in labels.items()]
    quantities = {column.position: name for name, column in test.quantities.items()}
    samples = [test.source.cells(row) for row in found_table.rows_of_data[:ROWS_SHOWN]]
    lines.append(f"  {'column':<28} {'unit':<10} {'read as':<18} first values")
    for column in found_table.columns:
        quantity = quantities.get(column.position, "-")
        unit = column.unit or _declared_unit(quantity, inspection.profile)
        values = "  ".join(
            cells[column.position] if column.position < len(cells) else "" for cells in samples
        )
        name = f"{column.group}: {column.name}" if column.group else column.name or "(no name)"
        lines.append(f"  {name:<28} {unit:<10} {quantity:<18} {values}")
    lines += [f"  note: {note}" for note in found_table.notes]
    return lines


def _declared_unit(quantity: str, profile: FormatProfile) -> str:
    unit = profile.units.get(quantity)  # type: ignore[call-overload]
    return f"{unit} (profile)" if unit else "none"


def draft_profile(inspection: Inspection, name: str) -> str:
    """Write a profile for files like this one, to be completed by hand.

    What was detected is declared; what could not be understood is written as a comment.
    """
    name = re.sub(r"[^a-z0-9]+", "-", name.casefold()).strip("-") or "new-format"
    dialect, opened = inspection.dialect, inspection.opened
    lines = [
        f"# Draft from {opened.path.name}: check every line, then name it in the sheet",
        "# (force_format, strain_format), or give it a signature to have it detected.",
        f"name: {name}",
        f"title: {_quoted(opened.path.name)}",
        f"kind: {opened.kind}",
    ]
    if opened.kind == "text":
        encoding = opened.encoding if "damaged" not in opened.encoding else ""
        lines.append(f"encoding: {encoding}")
    if dialect is not None:
        mark = "tab" if dialect.delimiter == "\t" else dialect.delimiter
        lines += [f"delimiter: {_quoted(mark)}", f"decimal: {_quoted(dialect.decimal)}"]
        if dialect.thousands:
            lines.append(f"thousands: {_quoted(dialect.thousands)}")
    test = max(inspection.tests, key=lambda one: len(one.found_table.rows_of_data), default=None)
    if test is not None:
        lines += _draft_columns(test, inspection.profile)
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _draft_columns(test: Test, profile: FormatProfile) -> list[str]:
    named = any(column.name for column in test.found_table.columns)
    quantities = {column.position: name for name, column in test.quantities.items()}
    lines, unknown, units, comments = [], [], [], []
    for column in test.found_table.columns:
        quantity = quantities.get(column.position)
        if quantity is None:
            unknown.append(f"#   {_quoted(column.name)} in {column.unit or 'no unit'}")
            continue
        lines.append(f"  {quantity}: [{_quoted(column.name)}]")
        unit = column.unit or profile.units.get(quantity)  # type: ignore[call-overload]
        if unit and factor(quantity, unit) is not None:
            units.append(f"  {quantity}: {_quoted(unit)}")
        else:
            choices = ", ".join(FACTORS[DIMENSION[quantity]])
            comments.append(f"#   {quantity}: one of {choices}")
    if not named:
        order = ", ".join("'-'" for _ in test.found_table.columns)
        return [
            "# no names: put a quantity for each column: " + ", ".join(DIMENSION),
            f"columns_in_order: [{order}]",
        ]
    lines = ["columns:", *lines] if lines else ["columns: {}"]
    lines += ["# columns not used:", *unknown] if unknown else []
    lines += ["units:", *units] if units else []
    lines += ["# units that the file does not state:", *comments] if comments else []
    return lines
