"""Errors in the table of the spokes' stiffness name the line of the file."""

import pytest

from nptcs.errors import InputError
from nptcs.lca.spokes.stiffness_table import COLUMNS, SpokeStiffnessTable


@pytest.mark.parametrize(("value", "what"), [("x", "a number is missing"), (-1.0, "above zero")])
@pytest.mark.parametrize(("row", "line"), [(0, 2), (2, 4)])
def test_a_wrong_number_is_named_with_its_line(row, line, value, what):
    rows = [dict.fromkeys(COLUMNS, float(c10)) for c10 in (1, 2, 3)]
    rows[row][COLUMNS[1]] = value
    with pytest.raises(InputError, match=what) as caught:
        SpokeStiffnessTable.from_rows(rows)
    assert (caught.value.line, caught.value.column) == (line, COLUMNS[1])
