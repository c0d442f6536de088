"""Tables that a person reads at once: turned, annotated, with units in cells, with mixed marks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openpyxl
import pytest

from nptcs.errors import InputError
from nptcs.ingest.reading.text.decimal_marks import one_decimal_mark
from nptcs.ingest.reading.text.turned_tables import upright_lines

E_MPA = 60_000.0
TIME = np.arange(0, 60, 0.5)
STRAIN = 2.5e-4 * TIME
FORCE = 10 * E_MPA * STRAIN
COLUMNS = (TIME, FORCE, 100 * STRAIN)


def lines(form: str = "{:.6g}", mark: str = ";", decimal: str = ".") -> list[str]:
    rows = zip(*COLUMNS, strict=True)
    return [mark.join(form.format(v).replace(".", decimal) for v in row) for row in rows]


def workbook(path: Path, rows: list[list[object]]) -> None:
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    book.save(path)


def check(lab, folder: Path, name: str, note: str = "") -> None:
    done = lab.ingest(folder, name)
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-4)
    assert len(done.curve) == len(TIME)
    assert any(note in text for text in done.record.files[0].notes)


@pytest.mark.parametrize(
    ("mark", "decimal", "labels"),
    [
        (",", ".", ["Time (s)", "Load (N)", "Strain (%)"]),
        ("\t", ",", ["Zeit\ts", "Kraft\tN", "Dehnung\t%"]),
        (";", ",", ["Temps [s]", "Charge [N]", "Déformation [%]"]),
    ],
)
def test_a_table_along_the_rows_is_turned(lab, tmp_path, mark, decimal, labels):
    rows = [
        mark.join([label, *(f"{value:.6g}".replace(".", decimal) for value in column)])
        for label, column in zip(labels, COLUMNS, strict=True)
    ]
    text = "\n".join([f"Specimen{mark}A-1", "", *rows]) + "\n"
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    check(lab, tmp_path, "a.csv", "along the rows")


def test_a_sheet_along_the_rows_is_turned(lab, tmp_path):
    labels = ("Time (s)", "Load (N)", "Strain (%)")
    rows = [[label, *map(float, column)] for label, column in zip(labels, COLUMNS, strict=True)]
    workbook(tmp_path / "a.xlsx", [["Specimen", "A-1"], *rows])
    check(lab, tmp_path, "a.xlsx", "along the rows")


@pytest.mark.parametrize(
    "text",
    [
        ["Specimen;1;2;3;4", "Width;10;10.1;9.9;10", "Thickness;1;1;1;1"],
        ["Time;Load;Strain", *(f"{row};{2 * row};{3 * row}" for row in range(30))],
        [";".join(["Load", *map(str, range(30))]), ";".join(["Strain", *map(str, range(29))])],
    ],
    ids=["a table of dimensions", "a table of columns", "rows of two lengths"],
)
def test_other_tables_are_not_turned(text):
    assert upright_lines(text) is text


@pytest.mark.parametrize("place", [0, 1, 2])
def test_columns_with_another_decimal_mark_are_read_by_their_own(lab, tmp_path, place):
    cells = [line.split(";") for line in lines("{:.5f}")]
    for row in cells:
        row[place] = row[place].replace(".", ",")
    table = ["Time [s];Load [N];Strain [%]", *(";".join(row) for row in cells)]
    (tmp_path / "a.csv").write_text("\n".join(table))
    check(lab, tmp_path, "a.csv", "each read with its own mark")


@pytest.mark.parametrize(
    "rows",
    [
        ["0,5;1.250;0.1"] * 9,
        ["0,5;1.250", "0,7;2.250", "0,9;3.250"] * 3,
        ["0,5;1.5", "0.6;1,5", "0,7;1.6"] * 3,
        ["1.5,2.5,3"] * 9,
    ],
    ids=["third proves only itself", "thousands", "both in one column", "comma is the delimiter"],
)
def test_marks_that_may_be_thousands_are_left_to_the_dialect(rows):
    assert one_decimal_mark(rows) == (rows, "")


@pytest.mark.parametrize(
    ("units", "form"),
    [
        (("s", "N", "%"), "{:.5f} {}"),
        (("s", "N", "%"), "{:.5f}{}"),
        (("sec", "N", "pct"), "{:g} {}"),
    ],
)
@pytest.mark.parametrize("decimal", [".", ","])
def test_cells_of_a_sheet_with_a_unit_behind_the_number(lab, tmp_path, units, form, decimal):
    rows = [
        [form.format(v, unit).replace(".", decimal) for v, unit in zip(row, units, strict=True)]
        for row in zip(*COLUMNS, strict=True)
    ]
    workbook(tmp_path / "a.xlsx", [["Time", "Load", "Strain"], *rows])
    check(lab, tmp_path, "a.xlsx", "stored as text")


def test_cells_of_a_sheet_in_two_units_are_refused(lab, tmp_path):
    rows = [
        [t, f"{f:.2f} N" if f < 4000 else f"{f / 1e3:.5f} kN", e]
        for t, f, e in zip(*(map(float, c) for c in COLUMNS), strict=True)
    ]
    workbook(tmp_path / "a.xlsx", [["Time (s)", "Load", "Strain (%)"], *rows])
    with pytest.raises(InputError, match=r"a number in kN, where the column's unit is N"):
        lab.ingest(tmp_path, "a.xlsx")


@pytest.mark.parametrize(
    "notes",
    [
        {4: [None, "redo this one"]},
        {1: [None, "Fmax", 8925.0], 2: [None, "E", 60.1]},
        {row: [row * 0.5] for row in range(60)},
    ],
    ids=["a remark", "a summary", "a column without a name"],
)
def test_what_is_to_the_right_of_a_sheets_table_is_left_out(lab, tmp_path, notes):
    rows = [
        list(map(float, row)) + notes.get(i, []) for i, row in enumerate(zip(*COLUMNS, strict=True))
    ]
    workbook(tmp_path / "a.xlsx", [["Time (s)", "Load (N)", "Strain (%)"], *rows])
    check(lab, tmp_path, "a.xlsx", "")


def test_a_summary_to_the_right_in_a_text_is_left_out_if_the_names_are_as_wide(lab, tmp_path):
    body = [f"{line};;" for line in lines()]
    body[2] = body[2][:-2] + ";Fmax;8925"
    (tmp_path / "a.csv").write_text("\n".join(["Time [s];Load [N];Strain [%];;", *body]))
    check(lab, tmp_path, "a.csv", "with notes but no name left out")


def test_a_full_column_without_a_name_stays_refused_in_a_text(lab, tmp_path):
    body = [f"{row};{line}" for row, line in enumerate(lines())]
    (tmp_path / "a.csv").write_text("\n".join(["Time [s];Load [N];Strain [%];", *body]))
    with pytest.raises(InputError, match="not clear which column has no name"):
        lab.ingest(tmp_path, "a.csv")


@pytest.mark.parametrize("before", ["# ", "# columns: ", "#columns: "])
def test_names_behind_a_comment_mark_are_the_names(lab, tmp_path, before):
    text = [f"{before}Time [s];Load [N];Strain [%]", *lines()]
    (tmp_path / "a.csv").write_text("\n".join(text), encoding="utf-8")
    check(lab, tmp_path, "a.csv")
