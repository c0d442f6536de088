"""Workbooks: native numbers, several sheets, texts for numbers, damage."""

from __future__ import annotations

import io
import re
import warnings
import zipfile
from datetime import datetime
from pathlib import Path

import openpyxl
import pytest

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.native.workbooks import read_workbook

HERE = Path(__file__).parent
ROWS = [(0.1 * n, 1.5 * n, 0.0125 * n) for n in range(1, 9)]
NAMES = ["Time", "Standard force", "Strain"]
UNITS = ["s", "kN", "%"]


def workbook(tmp_path, sheets):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    path = tmp_path / "made.xlsx"
    book.save(path)
    return path.read_bytes()


def test_sheet_of_values_is_found_among_parameters_and_results(read, tmp_path):
    content = workbook(
        tmp_path,
        {
            "Paramètres": [["Épaisseur", 1.5, "mm"]],
            "Résultats": [[None, "Fmax"], [None, "N"], ["A-1", 9645.8]],
            "Valeurs A-1": [["A-1"] * 3, NAMES, UNITS, *ROWS],
        },
    )
    table = read(content, name="test.xlsx")
    assert table.profile.name == "testxpert-workbook"
    assert table.values["force"] == pytest.approx([1000 * row[1] for row in ROWS])
    assert table.values["strain"] == pytest.approx([row[2] / 100 for row in ROWS])


def test_two_sheets_of_values_need_a_part_or_the_specimens_name(read, tmp_path):
    double = [(row[0], 2 * row[1], row[2]) for row in ROWS]
    content = workbook(tmp_path, {"A-1": [NAMES, UNITS, *ROWS], "A-2": [NAMES, UNITS, *double]})
    with pytest.raises(InputError, match="'A-1', 'A-2'"):
        read(content, name="test.xlsx")
    for options in ({"part": "A-2"}, {"specimen": "A-2"}):
        assert read(content, name="test.xlsx", **options).values["force"][0] == pytest.approx(3000)


@pytest.mark.parametrize("cell", ["1,5", "n. b.", datetime(2024, 5, 29)])  # noqa: DTZ001
def test_a_cell_that_is_not_a_number_is_named(read, tmp_path, cell):
    rows = [list(row) for row in ROWS]
    rows[4][1] = cell
    with pytest.raises(InputError, match="not a number") as caught:
        read(workbook(tmp_path, {"A": [NAMES, UNITS, *rows]}), name="test.xlsx")
    assert (caught.value.line, caught.value.column) == (7, "Standard force")


def test_the_content_counts_not_the_suffix(read, tmp_path):
    content = workbook(tmp_path, {"A": [NAMES, UNITS, *ROWS]})
    assert read(content, name="test.csv").values["force"][0] == pytest.approx(1500)
    text = "\n".join(["time_s\tforce_kN\tstrain_%", *("\t".join(map(str, row)) for row in ROWS)])
    assert read(text, name="test.xls").values["force"][0] == pytest.approx(1500)


def test_old_workbook(read):
    table = read((HERE / "data" / "zwick.xls").read_bytes(), name="test.xls")
    assert table.profile.name == "testxpert-workbook"
    assert table.values["force"] == pytest.approx([1000 * row[1] for row in ROWS])


@pytest.mark.parametrize("keep", [60, 0.5, 0.9])
def test_damaged_workbook_is_refused(read, tmp_path, keep):
    content = workbook(tmp_path, {"A": [NAMES, UNITS, *ROWS]})
    cut = content[: keep if isinstance(keep, int) else int(keep * len(content))]
    with pytest.raises(InputError, match="workbook cannot be read"):
        read(cut, name="test.xlsx")


def test_damaged_old_workbook_is_refused(read):
    content = (HERE / "data" / "zwick.xls").read_bytes()
    with pytest.raises(InputError, match="workbook cannot be read"):
        read(content[:1500], name="test.xls")


@pytest.mark.parametrize(
    ("offset", "value", "message"),
    [(8, 1, "RuntimeError: .*encrypted"), (10, 99, "NotImplementedError: .*compression")],
    ids=["encrypted", "packed in an unknown way"],
)
def test_a_workbook_that_cannot_be_unpacked_is_refused(read, tmp_path, offset, value, message):
    content = bytearray(workbook(tmp_path, {"A": [NAMES, UNITS, *ROWS]}))
    entry = content.find(b"PK\x01\x02")  # of the zip's directory
    while entry >= 0:
        content[entry + offset] = value
        entry = content.find(b"PK\x01\x02", entry + 1)
    with pytest.raises(InputError, match=f"workbook cannot be read: {message}"):
        read(bytes(content), name="test.xlsx")


def without_default_style(content):
    """Leave the named styles out, as some programs do; openpyxl warns about it."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(out, "w") as new:
        for name in old.namelist():
            part = old.read(name)
            new.writestr(name, re.sub(rb"<cellStyles.*</cellStyles>", b"", part, flags=re.S))
    return out.getvalue()


def test_warnings_of_the_library_are_notes_of_each_file(tmp_path):
    content = without_default_style(workbook(tmp_path, {"A": [NAMES, UNITS, *ROWS]}))
    for _ in range(2):
        _, notes = read_workbook(tmp_path / "made.xlsx", content, frozenset(), FileLimits())
        assert notes == ("Workbook contains no default style, apply openpyxl's default",)


def test_other_warnings_are_left_to_the_caller(tmp_path, monkeypatch):
    def deprecated(path, raw, limits):
        warnings.warn("old call", DeprecationWarning, stacklevel=1)

    monkeypatch.setattr("nptcs.ingest.reading.native.workbooks._xlsx", deprecated)
    with pytest.raises(DeprecationWarning, match="old call"):
        read_workbook(tmp_path / "made.xlsx", b"PK\x03\x04", frozenset(), FileLimits())


def as_text(value, mark):
    return f"{value:.4f}".replace(".", mark)


@pytest.mark.parametrize("mark", [".", ","])
def test_columns_of_numbers_stored_as_text_are_read(read, tmp_path, mark):
    rows = [[as_text(value, mark) for value in row] for row in ROWS]
    table = read(workbook(tmp_path, {"A": [NAMES, UNITS, *rows]}), name="test.xlsx")
    assert table.values["force"] == pytest.approx([1000 * row[1] for row in ROWS], rel=1e-3)
    assert any("stored as text" in note for note in table.notes)


@pytest.mark.parametrize("texts", [["1,234", "2,345", "3,456"], ["1,5", "2.5", "3,5"]])
def test_texts_with_two_readings_are_not_numbers(read, tmp_path, texts):
    rows = [[row[0], texts[i % 3], row[2]] for i, row in enumerate(ROWS)]
    with pytest.raises(InputError, match="not a number|no column for one of force"):
        read(workbook(tmp_path, {"A": [NAMES, UNITS, *rows]}), name="test.xlsx")


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (["mimetype", "content.xml"], "OpenDocument"),
        (["[Content_Types].xml", "xl/workbook.bin"], "XLSB"),
        (["a.csv"], "packed archive"),
    ],
)
def test_other_archives_are_called_what_they_are(read, names, message):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name in names:
            archive.writestr(name, "x")
    with pytest.raises(InputError, match=message):
        read(out.getvalue(), name="test.xlsx")


@pytest.mark.parametrize("text", ["<html><table>", '<?xml version="1.0"?><Workbook>', " <TABLE>"])
def test_a_page_of_markup_is_called_what_it_is(read, text):
    with pytest.raises(InputError, match="HTML or XML"):
        read(text + "\n1,2,3" * 20, name="test.xls")
