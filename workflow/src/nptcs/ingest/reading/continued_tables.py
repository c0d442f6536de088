"""One test that its file writes in pages or blocks: tables of equal columns whose time goes on."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.ingest.reading.columns.quantities import Test, tests_in
from nptcs.ingest.reading.find_tables import find_tables
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.text.cells import CellSource

LONGEST_GAP = 20.0
"""Steps of time that may pass between two blocks: a new test begins much later, or at 0 again."""


def tests_of(
    source: CellSource, profile: FormatProfile, path: Path, plain: FormatProfile | None
) -> list[Test]:
    """Every test of one source: its tables found, told apart, and joined where they go on."""
    found_tables = find_tables(source, path, profile.unnamed_columns)
    return join_continued(tests_in(source, found_tables, profile, path, plain))


def join_continued(tests: Sequence[Test]) -> list[Test]:
    """Join each table with those that continue where it ends.

    Parameters
    ----------
    tests : sequence of Test
        Of one source, in the order of its rows.

    Returns
    -------
    list of Test
        The same, or fewer; a joined table says how many blocks it was.
    """
    joined: list[Test] = []
    blocks: dict[int, int] = {}
    for test in tests:
        if joined and _goes_on(joined[-1], test):
            last = joined[-1].found_table
            last.rows_of_data += test.found_table.rows_of_data
            last.last = test.found_table.last
            blocks[id(joined[-1])] = blocks.get(id(joined[-1]), 1) + 1
        else:
            joined.append(test)
    for test in joined:
        if number := blocks.get(id(test)):
            test.found_table.notes.append(f"{number} blocks whose time goes on are one test")
    return joined


def _goes_on(test: Test, following: Test) -> bool:
    names, others = (
        [(column.name, column.unit) for column in one.found_table.columns]
        for one in (test, following)
    )
    alike = names == others and list(test.quantities) == list(following.quantities)
    if test.found_table is following.found_table or not alike or "time" not in test.quantities:
        return False
    try:
        before, after = _times(test), _times(following)
    except InputError:
        return False
    step = float(np.median(np.diff(before)))
    return bool(step > 0 and 0 < after[0] - before[-1] <= LONGEST_GAP * step)


def _times(test: Test) -> Array:
    position = test.quantities["time"].position
    return test.source.numbers(test.found_table, [position])[:, 0]
