"""Numbers and tables as the page writes them."""

import math
import re

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.report.table_view import table_view
from nptcs.report.tables.entries import result_entry
from nptcs.report.text import number_text, with_error
from nptcs.tables.catalogue import TABLES

FILES = result_entry("files.csv", TABLES["files.csv"])


@pytest.mark.parametrize(
    ("number", "digits", "text"),
    [
        (263.2645502645, 5, "263.26"),
        (127742.1234, 5, "127742"),
        (4004.59, 3, "4005"),
        (9.522633744e-05, 10, "9.522633744e-05"),
        (63.0, 5, "63"),
        (-0.5, 5, "-0.5"),
        (1.0554e9, 5, "1055400000"),
        (math.nan, 5, "–"),
    ],
)
def test_numbers(number, digits, text):
    assert number_text(number, digits) == text


@given(st.floats(-1e8, 1e8), st.integers(1, 12))
def test_a_number_is_never_off_by_more_than_its_last_digit(number, digits):
    shown = float(number_text(number, digits))
    assert shown == pytest.approx(number, rel=0.5000001 * 10 ** (1 - digits), abs=1e-300)


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (127742.0, 2042.8, "127700 ± 2000 MPa"),
        (8816.17, 76.18, "8816 ± 76 MPa"),
        (1.17112, 0.0073, "1.1711 ± 0.0073 MPa"),
        (2.935, None, "2.935 MPa"),
        (2.935, 0.0, "2.935 MPa"),
    ],
)
def test_a_value_ends_where_its_standard_error_does(value, error, text):
    assert with_error(value, error, "MPa") == text


def test_columns_without_a_value_are_left_out_but_still_mark_rows():
    table = pd.DataFrame({"a": [1.0, 2.0], "flags": ["", ""], "b": [math.nan, math.nan]})
    view = table_view(table, FILES, mark=lambda row: "bad" if row["a"] > 1 else "")
    assert [heading.name for heading in view.headings] == ["a"]
    assert [css for css, _ in view.rows] == ["", "bad"]


def test_full_numbers_stand_behind_the_cells():
    view = table_view(pd.DataFrame({"a": [math.pi]}), FILES)
    cell = view.rows[0][1][0]
    assert cell.text == "3.1416"
    assert float(cell.number) == math.pi


def test_truth_values_are_words():
    view = table_view(pd.DataFrame({"a": [True, False]}), FILES)
    assert [cells[0].text for _, cells in view.rows] == ["yes", "no"]
    assert view.numeric == (False,)


def test_hashes_are_not_wrapped():
    view = table_view(pd.DataFrame({"sha256": ["0f" * 32]}), FILES)
    assert view.rows[0][1][0].css == "hash"
    assert re.fullmatch("[0-9a-f]{64}", view.rows[0][1][0].text)
