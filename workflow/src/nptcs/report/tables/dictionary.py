"""The meaning of each column, taken from the contracts of the tables."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from nptcs.language import tr
from nptcs.report.tables.entries import Entry
from nptcs.report.tables.headings import heading
from nptcs.report.tables.sheets import Sheet


def dictionary_table(sheets: Sequence[Sheet]) -> pd.DataFrame:
    """List the columns of all sheets: heading, unit, name in the file, meaning."""
    rows = []
    for sheet in sheets:
        meanings = _meanings(sheet.entry)
        for column in map(str, sheet.table.columns):
            written = heading(column, sheet.entry.headings)
            rows.append(
                (
                    sheet.entry.sheet,
                    written.name,
                    written.unit,
                    column,
                    tr(meanings.get(column, "")),
                )
            )
    return pd.DataFrame(rows, columns=["sheet", "column", "unit", "name_in_file", "meaning"])


def _meanings(entry: Entry) -> dict[str, str]:
    """Return the descriptions of the columns, where the table has a contract."""
    if entry.contract is None:
        return {}
    return {
        str(column): field.description or ""
        for column, field in entry.contract.to_schema().columns.items()
    }
