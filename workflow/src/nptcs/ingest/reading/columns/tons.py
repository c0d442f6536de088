"""Which ton a file means: metric, of the US or of the UK."""

from __future__ import annotations

import re

from nptcs.ingest.reading.table_columns import FoundTable
from nptcs.ingest.reading.units import TONS, clean_unit

_METRIC = re.compile(
    r"mm|cm|[µμu]m|^m$|pa$|^k?n$|n/mm|kgf|мм|мкм|па$|^к?н$|毫米|兆帕|千牛|°c$", re.I
)
_IMPERIAL = re.compile(r"^in\b|inch|^mils?$|thou|lb|psi|ksi|kip|°f$", re.I)


def settle_tons(found_table: FoundTable) -> None:
    """Read a column in tons as metric tons where the other columns are metric, and note a doubt.

    Where none of them is, or one is in inches, pounds or the like, the unit stays and is refused
    later.
    """
    others = [clean_unit(c.unit) for c in found_table.columns if c.unit and not is_ton(c.unit)]
    metric = any(_METRIC.search(unit) for unit in others)
    if not metric or any(_IMPERIAL.search(unit) for unit in others):
        return
    for column in found_table.columns:
        if column.unit and is_ton(column.unit):
            found_table.doubts.append(
                f"column '{column.name}' in {column.unit}: read in metric tons (9806.65 N), since "
                "the other columns are metric"
            )
            column.unit = "tf"


def is_ton(unit: str) -> bool:
    """Tell whether a unit is a ton that may be one of several."""
    return clean_unit(unit).casefold() in TONS
