"""Numbers and tables as the page writes them."""

import math
import re

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.report.kept_together import kept
from nptcs.report.table_view import WHOLE_ROWS, table_view
from nptcs.report.tables.entries import result_entry
from nptcs.report.tables.names import in_symbols
from nptcs.report.tables.row_classes import row_class
from nptcs.report.text import number_text, with_error
from nptcs.tables.catalogue import TABLES
from nptcs.tables.result_table import Heading, RowMark

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


def test_full_numbers_are_stored_with_the_cells():
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


def test_a_long_text_that_all_rows_have_is_said_once():
    text = "not a probability where the results come from a solver, which has no noise"
    other = [text, text.replace("no noise", "noise")]
    table = pd.DataFrame({"a": [1.0, 2.0], "p_meaning": text, "form": other, "short": "same"})
    view = table_view(table, FILES)
    assert [heading.name for heading in view.headings] == ["a", "form", "short"]
    assert view.notes == (f"p meaning: {text}",)
    one_row = table_view(table.iloc[:1], FILES)
    assert one_row.notes == ()
    assert len(one_row.headings) == 4


@pytest.mark.parametrize(
    ("rows", "shown"), [(WHOLE_ROWS, WHOLE_ROWS), (WHOLE_ROWS + 1, 12), (500, 12)]
)
def test_a_table_is_cut_only_where_that_saves_much(rows, shown):
    view = table_view(pd.DataFrame({"a": range(rows)}), FILES)
    assert (len(view.rows), view.all_rows) == (shown, rows)


FACTORS = {
    "spacing_mm": Heading("plate spacing S", "mm"),
    "thickness_mm": Heading("plate thickness T", "mm"),
    "shear_band_c10_mpa": Heading("shear band C10 (T-C)", "MPa"),
    "width_mm": Heading("rim width", "mm"),
    "second_mm": Heading("second", "mm"),
    "other_mm": Heading("another second S", "mm"),
}


@pytest.mark.parametrize(
    ("term", "written"),
    [
        ("1", "1"),
        ("thickness_mm*shear_band_c10_mpa^2", "T × T-C²"),
        ("width_mm^3", "rim width³"),
        ("linear", "linear"),
        # two factors with the same symbol keep their labels
        ("spacing_mm*other_mm", "plate spacing S × another second S"),
    ],
)
def test_terms_have_the_symbols_of_their_factors(term, written):
    assert in_symbols(term, FACTORS) == written


def test_terms_keep_their_names_where_no_factor_is_known():
    assert in_symbols("a_mm^2", {}) == "a_mm²"


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("R88-2, S45-4", '<span class="nb">R88-2</span>, <span class="nb">S45-4</span>'),
        ("C10 (T-C) < 5 MPa", 'C10 (<span class="nb">T-C</span>) &lt; 5\u00a0MPa'),
        ("Box-Behnken, leave-one-out, 2026-11-26", "Box-Behnken, leave-one-out, 2026-11-26"),
        ("5 minutes, 3 %", "5 minutes, 3\u00a0%"),
        ("<b>", "&lt;b&gt;"),
    ],
)
def test_no_line_breaks_in_a_short_name_or_before_a_unit(text, html):
    assert str(kept(text)) == html


@pytest.mark.parametrize(
    ("status", "marked"),
    [("ok", ""), ("not assessed", "out"), ("not reached", "warn"), ("diverged", "bad")],
)
def test_only_a_failure_is_marked_as_one(status, marked):
    assert row_class(RowMark.STATUS)({"status": status}) == marked
