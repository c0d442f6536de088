"""The workbook, read back cell by cell."""

import io
import math
import zipfile
from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import openpyxl
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.report.tables.dictionary import dictionary_table
from nptcs.report.tables.entries import design_entry, result_entry
from nptcs.report.tables.sheets import Sheet, sheets_of
from nptcs.report.workbook.build import build_workbook
from nptcs.report.workbook.cell_xml import quick_cells
from nptcs.report.workbook.cells import WRAPPED
from nptcs.report.workbook.chart_data import charts_of
from nptcs.report.workbook.layout import LINE_HEIGHT, WIDEST, finish_table, fit_heights
from nptcs.report.workbook.number_formats import format_of_column, format_of_number, shown_number
from nptcs.runs.identity import identify
from nptcs.tables.catalogue import TABLES


@pytest.fixture(scope="module")
def content(results):
    return build_workbook(results)


@pytest.fixture(scope="module")
def workbook(content):
    return openpyxl.load_workbook(io.BytesIO(content))


def test_the_first_sheet_answers_and_says_what_each_sheet_is(workbook):
    summary = workbook.worksheets[0]
    assert summary.title == "Summary"
    links = {row[0].value: row[0].hyperlink for row in summary.iter_rows() if row[0].hyperlink}
    assert set(workbook.sheetnames) - {"Summary"} <= set(links)
    assert links["cases"].location == "'cases'!A1"
    assert "No problems" in summary["A3"].value
    answers = {row[0].value: row[1].value for row in summary.iter_rows()}
    assert answers["Origin of the data"].startswith("3 of 3 specimens are SYNTHETIC")
    assert "How stiff is the tyre?" in answers


def test_raw_points_are_a_file_next_to_the_workbook(workbook):
    assert "lca_neutral_line" not in workbook.sheetnames
    row = next(row for row in workbook["Summary"].iter_rows() if row[0].value == "lca_neutral_line")
    assert row[0].hyperlink.target == "tables/lca_neutral_line.csv"
    assert "the CSV file tables/lca_neutral_line.csv next to this workbook" in row[1].value


def test_every_number_is_native_and_whole(workbook, results):
    for name, sheet in sheets_of(results).items():
        if not sheet.in_workbook:
            continue
        rows = list(workbook[name[:31]].iter_rows(min_row=2, values_only=True))
        assert len(rows) == len(sheet.table)
        for written, record in zip(rows, sheet.table.itertuples(index=False), strict=True):
            for cell, value in zip(written, record, strict=True):
                if value is pd.NA:
                    assert cell is None
                elif isinstance(value, bool):
                    assert cell == ("yes" if value else "no")
                elif isinstance(value, int | float | np.integer):
                    # a workbook keeps 16 significant digits: decimal text, the same on any machine
                    assert cell is None if math.isnan(value) else cell == float(f"{value:.16g}")
                else:
                    assert (cell or "") == (value if isinstance(value, str) else "")


def test_headers_have_units_and_stay_in_sight(workbook):
    sheet = workbook["cases"]
    assert "vertical stiffness [N/mm]" in [cell.value for cell in sheet[1]]
    assert sheet.freeze_panes == "B2"
    assert sheet.auto_filter.ref == sheet.dimensions


def test_text_is_never_a_formula(workbook):
    sheet = workbook["specimens"]
    flags = [cell for row in sheet.iter_rows(min_row=2) for cell in row if cell.value == "=1+1"]
    assert len(flags) == 2
    assert {cell.data_type for cell in flags} == {"s"}


def test_problems_are_coloured(faulty):
    workbook = openpyxl.load_workbook(io.BytesIO(build_workbook(faulty)))
    assert workbook["problems"].max_row == 3
    fills = {row[0].value: row[0].fill.start_color.rgb for row in workbook["cases"].iter_rows()}
    colours = [row[1].fill.start_color.rgb for row in workbook["cases"].iter_rows(min_row=2)]
    assert fills
    assert len(set(colours)) == 2
    assert colours[0] != colours[1] == colours[2]
    assert "2 problems" in workbook["Summary"]["A3"].value


def test_synthetic_sheets_are_marked(workbook):
    about = {row[0].value: row[3].value for row in workbook["Summary"].iter_rows()}
    assert about["ply_constants"] == "yes"
    assert about["surface_plate"] == "no"
    header = {name: workbook[name]["A1"].fill.start_color.rgb for name in about if name in workbook}
    assert header["ply_constants"] != header["surface_plate"]


def test_the_columns_are_explained(workbook):
    rows = {(row[0], row[3]): row for row in workbook["columns"].iter_rows(values_only=True)}
    assert rows["impact", "gradient"][2] == "N/mm per unit of the factor"
    assert rows["impact", "rule"][4] == "How the gradient is averaged"


def test_the_same_results_give_the_same_bytes(content, results):
    assert build_workbook(results) == content


def test_a_study_named_as_a_table_does_not_get_its_meanings():
    table = pd.DataFrame({"rank": [1], "coefficient_natural": [1.0]})
    sheets = [
        Sheet(entry, table)
        for entry in (result_entry("impact.csv", TABLES["impact.csv"]), design_entry("impact"))
    ]
    assert dictionary_table(sheets)["meaning"].astype(bool).tolist() == [True, False, False, False]
    surface = dictionary_table(
        [Sheet(result_entry("impact_surface.csv", TABLES["STUDY_surface.csv"], "impact"), table)]
    )
    assert surface["meaning"].astype(bool).tolist() == [False, True]


def test_a_column_has_the_format_of_its_unit(workbook):
    cases = {cell.value: cell.column for cell in workbook["cases"][1]}

    def shown(name):
        return workbook["cases"].cell(2, cases[name]).number_format

    assert shown("vertical stiffness [N/mm]") == "#,##0.00"
    assert shown("load [N]") == "#,##0"
    assert shown("plate thickness T [mm]") == "#,##0.0"
    surface = workbook["surface_plate"]
    named = {cell.value: cell.column for cell in surface[1]}
    column = named["coefficient, natural [N/mm per unit of the term]"]
    assert surface.cell(2, column).number_format == "0.0000000000E+00"


def test_a_number_whose_unit_is_in_its_row_is_shown_by_its_size(workbook):
    sheet = workbook["ply_constants"]
    names = [cell.value for cell in sheet[1]]
    shown = [row[names.index("value")].number_format for row in sheet.iter_rows(min_row=2)]
    assert shown == ["#,##0", "#,##0"]  # 127742.123 and 2300 MPa
    rubber = workbook["rubber_constants"]
    assert rubber.cell(2, names.index("value") + 2).number_format == "#,##0.00"  # 1.25 MPa


def test_a_heading_says_rule_and_range(workbook):
    cells = {cell.value: cell.comment.text for cell in workbook["cases"][1]}
    text = cells["vertical stiffness [N/mm]"]
    assert "Allowed: > 0, may be empty" in text
    assert "In this run: 216.8 to 591.18" in text  # of tables 5 and 7
    assert "Rule: solve, cases" in text
    assert "vertical_stiffness_n_per_mm of results/tables/cases.csv" in text


def test_every_sheet_is_set_for_print(workbook):
    for sheet in workbook:
        assert sheet.page_setup.orientation == "landscape", sheet.title
        assert sheet.print_area, sheet.title
    assert workbook["cases"].print_title_rows == "$1:$1"


def test_numbers_are_under_their_headers_and_apart_from_text():
    sheet = openpyxl.Workbook().active
    for row in (["name", "value", "unit", "rule"], ["K", 264.2, "N/mm", "ring " * 30]):
        sheet.append(row)
    finish_table(sheet)
    assert sheet["B1"].alignment.horizontal == "right"
    assert [sheet[place].alignment.indent for place in ("A2", "C1", "C2", "D2")] == [0, 1, 1, 0]
    sheet["B2"].value = "none"
    finish_table(sheet)
    assert sheet["B1"].alignment.horizontal is None


def test_a_row_is_as_high_as_the_cells_that_are_merged_need():
    sheet = openpyxl.Workbook().active
    sheet["A1"] = "word " * 20
    sheet["A1"].alignment = WRAPPED
    for column in "ABCD":
        sheet.column_dimensions[column].width = 12
    fit_heights(sheet, 1, 1)
    alone = sheet.row_dimensions[1].height
    sheet.merge_cells("A1:D1")
    fit_heights(sheet, 1, 1)
    assert alone == 10 * LINE_HEIGHT
    assert sheet.row_dimensions[1].height == 3 * LINE_HEIGHT


def test_a_long_text_wraps_in_a_row_that_is_high_enough():
    sheet = openpyxl.Workbook().active
    text = "ASTM D6641, from the curve, least squares up to the peak. " * 5
    for row in (["name", "rule"], ["short", "one line"], ["long", text], ["中文", "弦线" * 80]):
        sheet.append(row)
    finish_table(sheet)
    assert sheet["B2"].alignment.wrap_text is None
    assert sheet["B3"].alignment.wrap_text
    assert sheet["A3"].alignment.vertical == "top"
    assert sheet.column_dimensions["B"].width == WIDEST
    assert sheet.row_dimensions[3].height == 5 * LINE_HEIGHT
    assert sheet.row_dimensions[4].height == 5 * LINE_HEIGHT  # a Chinese character is 1.75 wide


def test_it_names_its_run(results, content):
    made = datetime(2026, 11, 26, 4, 3, tzinfo=UTC)
    identity = identify({"a.csv": "1"}, {}, "c0de", {}, {}, made)
    dated = build_workbook(replace(results, identity=identity))
    workbook = openpyxl.load_workbook(io.BytesIO(dated))
    properties = workbook.properties
    assert properties.title == "A title <b>&"
    assert properties.creator == "Laboratory of tyres"
    assert properties.created == properties.modified == made.replace(tzinfo=None)
    assert identity.identity in properties.keywords
    assert f"Run {identity.short}, tables complete 2026-11-26 04:03 UTC" in [
        row[0].value for row in workbook["Summary"].iter_rows()
    ]
    assert content != dated


def test_charts_draw_cells_of_their_sheet(workbook):
    charts = workbook["charts"]._charts
    assert len(charts) >= 3
    data = workbook["chart_data"]
    for chart in charts:
        for series in chart.series:
            cells = data[series.yVal.numRef.f.split("!")[1].replace("$", "")]
            assert all(isinstance(cell.value, int | float) for (cell,) in cells)
            name = data[series.tx.strRef.f.split("!")[1].replace("$", "")]
            assert isinstance(name.value, str)


def test_a_chart_of_synthetic_specimens_says_so(results):
    charts = {chart.title: chart for chart in charts_of(results)}
    assert charts["Specimens cfrp_tension_0: stress against strain"].synthetic
    lines = charts["Specimens cfrp_tension_0: stress against strain"].lines
    assert [line.name for line in lines] == ["T0-1"]  # T0-2 is left out by the sheet
    assert len(lines[0].x) == 120
    assert lines[0].y[-1] == results.curves["T0-1"]["stress_mpa"].iloc[-1]


@pytest.mark.parametrize(
    ("unit", "values", "shown"),
    [
        ("MPa", [127742.1, 8812.7], "#,##0"),
        ("1", [0.00123456, 0.00234567], "#,##0.0000000"),
        ("%", [0.0, 0.0], "#,##0"),
        ("kg", [0.92708217, 0.91], "#,##0.0000"),
        ("", [1e-9, 1.0], "0.0000E+00"),
        ("N", [float("nan"), 5000.0], "#,##0"),
        ("unit of the row", [1.5], None),
    ],
)
def test_formats_follow_unit_and_size(unit, values, shown):
    assert format_of_column(unit, pd.Series(values)) == shown


@given(st.floats(-1e300, 1e300))
def test_a_number_keeps_two_significant_digits_in_sight(value):
    text = shown_number(value, format_of_number(value)).replace(",", "")
    assert float(text) == pytest.approx(value, rel=0.01)


def saved(workbook):
    """Contents of the sheets of a workbook by the names of their files."""
    stream = io.BytesIO()
    workbook.save(stream)
    with zipfile.ZipFile(stream) as parts:
        return {name: parts.read(name) for name in parts.namelist() if "sheets/" in name}


def test_cells_are_written_as_openpyxl_writes_them():
    workbook = openpyxl.Workbook()
    sheet = workbook.active
    texts = ["a", "<a & b>", " blanks ", "", " ", "two\nlines", '"quoted"', "板厚", "=a formula"]
    numbers = [1, -2.5, 0.1 + 0.2, 1e-300, np.float64(3.25), True, datetime(2026, 1, 2), "=A1&B1"]
    for column, value in enumerate([*texts, *numbers, None], start=1):
        for row in (1, 2):
            sheet.cell(row, column).value = value
        sheet.cell(2, column).fill = openpyxl.styles.PatternFill("solid", start_color="FFF2C4")
    sheet.cell(1, len(texts)).data_type = "s"
    sheet.cell(1, 1).hyperlink = "#A2"
    slow = saved(workbook)
    with quick_cells():
        quick = saved(workbook)
    assert quick == slow
    assert b"&lt;a &amp; b&gt;" in quick["xl/worksheets/sheet1.xml"]
