"""Tables of native numbers as rows: what all readers of binary files share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from nptcs.arrays import Array
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError

NativeTable = tuple[str, list[tuple[object, ...]]]
"""Name of a table, and its rows: the names of the columns, if it has any, then the numbers."""
Columns = Mapping[str, Sequence[float] | Array]


def as_table(name: str, columns: Columns) -> NativeTable:
    """Return columns of one length as rows under their names."""
    rows: list[tuple[object, ...]] = [tuple(columns)] if any(columns) else []
    return name, rows + list(zip(*(map(float, column) for column in columns.values()), strict=True))


def refuse_larger_table(path: Path, rows: int, columns: int, limits: FileLimits) -> None:
    """Raise InputError if a table has more rows or columns than allowed."""
    for what, size, allowed in (
        ("rows", rows, limits.rows),
        ("columns", columns, limits.columns),
    ):
        if size > allowed:
            raise InputError(
                f"has {size} {what}, {allowed} are allowed",
                f"export one test per file, or raise ingest.limits.{what}",
                path,
            )
