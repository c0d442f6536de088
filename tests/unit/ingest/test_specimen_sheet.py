"""The specimen sheet: good rows are kept, bad rows are named with line, column and remedy."""

from __future__ import annotations

import pytest

from nptcs.errors import InputError
from nptcs.tables.laboratory.specimens import Specimen, files_named, read_sheet

HEAD = "specimen,test,material,orientation_deg,width_mm,thickness_mm,force_file,include,reason"
GOOD = "T0-1,tension,cfrp,0,15.01;15.03;15.02,0.90;0.92,T0-1.csv,yes,"


def sheet(tmp_path, *rows, head=HEAD, encoding="utf-8"):
    path = tmp_path / "specimens.csv"
    path.write_text("\n".join([head, *rows]) + "\n", encoding=encoding)
    return path


def test_stations_area_and_series(tmp_path):
    (specimen,), errors = read_sheet(sheet(tmp_path, GOOD))
    assert errors == []
    assert specimen.area_mm2 == pytest.approx(15.02 * 0.91)
    assert specimen.series == "cfrp_tension_0"


def test_series_of_a_rubber_has_no_angle(tmp_path):
    row = "R-1,rubber_tension,rubber_75A,,6,2,R-1.csv,yes,"
    (specimen,), _ = read_sheet(sheet(tmp_path, row))
    assert specimen.series == "rubber_75A_rubber_tension"


@pytest.mark.parametrize(
    ("row", "column", "value"),
    [
        ("A,tenson,cfrp,0,15,0.9,a.csv,yes,", "test", "tenson"),
        ("A,tension,cfrp,0,15,,a.csv,yes,", "thickness_mm", None),
        ("A,tension,cfrp,0,15,0,a.csv,yes,", "thickness_mm", "0"),
        ("A,tension,cfrp,0,nan,0.9,a.csv,yes,", "width_mm", "nan"),
        ('A,tension,cfrp,0,"15,2",0.9,a.csv,yes,', "width_mm", "15,2"),
        ("A,tension,cfrp,0,15,0.9,a.csv,no,", "reason", None),
        ("A,tension,cfrp,0,15,0.9,a.csv,maybe,", "include", "maybe"),
        ("A,tension,cfrp,,15,0.9,a.csv,yes,", "orientation_deg", None),
        ("A,rubber_tension,r,0,15,0.9,a.csv,yes,", "orientation_deg", "0"),
        ("A b,tension,cfrp,0,15,0.9,a.csv,yes,", "specimen", "A b"),
        ("A,tension,cfrp,0,15,0.9,,yes,", "force_file", None),
        ("A,tension,cfrp,0,15,0.9,../a.csv,yes,", "force_file", "../a.csv"),
        ("A,tension,cfrp,0,15,0.9,/etc/a.csv,yes,", "force_file", "/etc/a.csv"),
        ("T0-1,tension,cfrp,0,15,0.9,b.csv,yes,", "specimen", None),
    ],
)
def test_bad_row_is_one_error_and_the_others_are_kept(tmp_path, row, column, value):
    specimens, (error,) = read_sheet(sheet(tmp_path, GOOD, row))
    assert [specimen.specimen for specimen in specimens] == ["T0-1"]
    assert (error.line, error.column, error.value) == (3, column, value)
    assert error.remedy


@pytest.mark.parametrize("head", [HEAD.replace("material", "materials"), HEAD + ",test", "a,b"])
def test_header_that_is_wrong_stops_the_sheet(tmp_path, head):
    with pytest.raises(InputError, match="column"):
        read_sheet(sheet(tmp_path, GOOD, head=head))


def test_more_cells_than_columns(tmp_path):
    _, (error,) = read_sheet(sheet(tmp_path, GOOD + ",,surplus"))
    assert error.line == 2


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_delimiters_of_spreadsheets(tmp_path, delimiter):
    row = GOOD.replace(";", "/").replace(",", delimiter)
    (specimen,), errors = read_sheet(
        sheet(tmp_path, row, head=HEAD.replace(",", delimiter), encoding="utf-8-sig")
    )
    assert errors == []
    assert len(specimen.width_mm) == 3


def test_sheet_that_is_not_utf8_names_the_line(tmp_path):
    path = sheet(tmp_path, GOOD, GOOD.replace("T0-1", "Tü"), encoding="latin-1")
    with pytest.raises(InputError, match="not UTF-8") as caught:
        read_sheet(path)
    assert caught.value.line == 3


def test_missing_and_empty_sheet(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_sheet(tmp_path / "none.csv")
    with pytest.raises(InputError, match="no rows"):
        read_sheet(sheet(tmp_path))


def test_files_of_bad_rows_are_still_known(tmp_path):
    assert files_named(sheet(tmp_path, GOOD, "B,oops,x,,,,sub\\b.csv,yes,")) == {
        "T0-1.csv": ["T0-1"],
        "sub/b.csv": ["B"],
    }


def test_section_that_is_not_a_rectangle():
    specimen = Specimen(
        specimen="S",
        test="tension",
        material="steel",
        orientation_deg=0,
        section_area_mm2=19.66,
        force_file="s.csv",
    )
    assert specimen.area_mm2 == 19.66
    assert specimen.mean_width_mm is None


LATER = HEAD + ",piece,properties,loading,failed,date,diameter_mm,platens"


def test_optional_columns_of_runs_and_conditions(tmp_path):
    rows = (
        "A-1,tension,cfrp,0,15,0.9,a.csv,yes,,A,modulus;poisson_ratio,Last,no,2026-03-31,,",
        "A-2,tension,cfrp,0,15,0.9,b.csv,yes,,A,strength,,,,,",
        "D,rubber_compression,nbr,,,,d.csv,yes,,,,4,,,29.0;29.1,lubricated",
    )
    (run, rupture, disc), errors = read_sheet(sheet(tmp_path, *rows, head=LATER))
    assert errors == []
    assert run.tested_piece == rupture.tested_piece == "A"
    assert (run.gives("modulus"), run.gives("strength")) == (True, False)
    assert (run.loading, run.failed, rupture.failed) == ("last", False, None)
    assert run.date.isoformat() == "2026-03-31"
    assert disc.tested_piece == "D"
    assert disc.area_mm2 == pytest.approx(662.8, abs=0.1)


@pytest.mark.parametrize(
    ("row", "column"),
    [
        ("A-2,tension,gfrp,0,15,0.9,b.csv,yes,,A,,,,,,", "piece"),
        ("B,tension,cfrp,0,15,0.9,b.csv,yes,,,shear_modulus,,,,,", "properties"),
        ("B,tension,cfrp,0,15,0.9,b.csv,yes,,,,0,,,,", "loading"),
        ("B,tension,cfrp,0,15,0.9,b.csv,yes,,,,,perhaps,,,", "failed"),
        ("B,tension,cfrp,0,15,0.9,b.csv,yes,,,,,,31.3.2026,,", "date"),
        ("B,flexure,cfrp,0,15,0.9,b.csv,yes,,,,,,,,", "span_mm"),
        ("B,rubber_compression,nbr,,,,b.csv,yes,,,,,,,29,oiled", "platens"),
    ],
)
def test_a_bad_optional_cell_names_its_column(tmp_path, row, column):
    good = "A-1,tension,cfrp,0,15,0.9,a.csv,yes,,A,,,,,,"
    specimens, (error,) = read_sheet(sheet(tmp_path, good, row, head=LATER))
    assert [specimen.specimen for specimen in specimens] == ["A-1"]
    assert error.column == column
    assert error.remedy
