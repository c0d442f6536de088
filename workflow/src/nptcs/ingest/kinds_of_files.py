"""What a file of a folder is, if not one test of a machine: strain field, camera, summary."""

from __future__ import annotations

import re
from collections.abc import Sequence

from nptcs.ingest.inspect import Inspection
from nptcs.ingest.reading.columns.quantities import Test

_SUMMARY = re.compile(
    r"(?i)summar|result|ergebnis|hit.?list|statisti|report|protokoll|r[ée]sum|resultad|risultat|"
    r"overview|übersicht|bericht|evaluat|auswertung|notes?\b|notiz"
)
_ROWS_OF_A_SUMMARY = 40


def is_field(inspection: Inspection) -> bool:
    """Tell whether a file contains the points of one frame: positions, and the strains there."""
    return any(
        {"x", "y"} & set(test.quantities) and {"strain_xx", "strain_yy"} & set(test.quantities)
        for test in inspection.tests
    )


def is_camera(test: Test) -> bool:
    """Tell whether a table is a camera's: in-plane strains, with or without an analog force."""
    return bool({"strain_xx", "strain_yy"} & set(test.quantities)) and "displacement" not in (
        test.quantities
    )


def is_summary(name: str, tests: Sequence[Test]) -> bool:
    """Tell whether a file is a summary of results, by its name and its few rows."""
    longest = max(len(test.found_table.rows_of_data) for test in tests)
    return bool(_SUMMARY.search(name)) and longest < _ROWS_OF_A_SUMMARY
