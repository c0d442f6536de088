"""The workbook, read back cell by cell."""

import io
import math

import numpy as np
import openpyxl
import pandas as pd
import pytest

from nptcs.report.tables.dictionary import dictionary_table
from nptcs.report.tables.entries import design_entry, result_entry
from nptcs.report.tables.sheets import Sheet, sheets_of
from nptcs.report.workbook.build import build_workbook
from nptcs.tables.catalogue import TABLES


@pytest.fixture(scope="module")
def content(results):
    return build_workbook(results)


@pytest.fixture(scope="module")
def workbook(content):
    return openpyxl.load_workbook(io.BytesIO(content))


def test_the_first_sheet_says_what_each_sheet_is(workbook):
    about = workbook.worksheets[0]
    assert about.title == "About"
    listed = {row[0].value for row in about.iter_rows() if row[5].value}
    assert set(workbook.sheetnames) - {"About", "columns"} <= listed
    assert "No problems" in about["A3"].value


def test_every_number_is_native_and_whole(workbook, results):
    for name, sheet in sheets_of(results).items():
        rows = list(workbook[name[:31]].iter_rows(min_row=2, values_only=True))
        assert len(rows) == len(sheet.table)
        for written, record in zip(rows, sheet.table.itertuples(index=False), strict=True):
            for cell, value in zip(written, record, strict=True):
                if value is pd.NA:
                    assert cell is None
                elif isinstance(value, bool):
                    assert cell == ("yes" if value else "no")
                elif isinstance(value, int | float | np.integer):
                    # a workbook keeps 16 significant digits: up to 5e-16 of the value is lost
                    assert (
                        cell is None
                        if math.isnan(value)
                        else cell == pytest.approx(value, rel=1e-15)
                    )
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
    assert "2 problems" in workbook["About"]["A3"].value


def test_synthetic_sheets_are_marked(workbook):
    about = {row[0].value: row[3].value for row in workbook["About"].iter_rows()}
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
