"""Arguments are refused while they are read, with the value and what is allowed."""

import argparse
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.arguments import (
    existing_file,
    existing_folder,
    number_type,
    output_file,
    output_folder,
    whole_number_type,
)
from nptcs.cli import main
from nptcs.ranges import RANGES, Range

REFUSED = argparse.ArgumentTypeError


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_a_number_is_taken_exactly_if_it_lies_in_the_range(value):
    allowed = Range(0, 10, "mm", open_low=True)
    if 0 < value <= 10:
        assert number_type(allowed)(repr(value)) == value
    else:
        with pytest.raises(REFUSED, match=r"above 0 and at most 10 mm, got"):
            number_type(allowed)(repr(value))


@pytest.mark.parametrize("text", ["1.5", "0", "-1", "9", "ten", ""])
def test_whole_numbers(text):
    with pytest.raises(REFUSED, match="between 1 and 8, got"):
        whole_number_type(1, 8)(text)


@pytest.mark.parametrize(("name", "bad"), [("angle_deg", 300), ("load_n", 0), ("thickness_mm", -1)])
def test_the_ranges_of_a_design_name_their_unit(name, bad):
    assert RANGES[name].unit in RANGES[name].fault(bad)
    assert str(bad) in RANGES[name].fault(bad)


def test_files_and_folders(tmp_path):
    file = tmp_path / "a.csv"
    file.touch()
    assert existing_file(str(file)) == str(file)
    assert existing_folder(str(tmp_path)) == tmp_path
    assert output_folder(str(tmp_path / "new")) == tmp_path / "new"
    assert output_file(".csv")(str(tmp_path / "b.CSV")) == str(tmp_path / "b.CSV")
    for read, text, why in (
        (existing_file, tmp_path, "is a folder"),
        (existing_file, tmp_path / "none", "does not exist"),
        (existing_folder, file, "is a file"),
        (existing_folder, tmp_path / "none", "does not exist"),
        (output_folder, file, "is a file"),
        (output_folder, tmp_path / "no" / "new", "does not exist; make it first"),
        (output_file(".csv"), tmp_path / "no" / "b.csv", "does not exist; make it first"),
        (output_file(".csv", ".txt"), tmp_path / "b.bmp", "must end in .csv or .txt"),
        (output_file(), tmp_path, "is a folder"),
    ):
        with pytest.raises(REFUSED, match=why):
            read(str(text))


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_takes_no_files_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(REFUSED, match="no permission"):
        output_file()(str(tmp_path / "a.csv"))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["fe-picture", "x.bmp"], "FIGURE: the name must end in .png, .svg or .pdf, got 'x.bmp'"),
        (["fe-export", "no/where"], "FOLDER: the folder no does not exist"),
        (["deck", "d.csv", "c", "-o", "x.inp", "--angle", "91"], "--angle: must be between -90"),
        (["deck", "d.csv", "c", "-o", "x.inp", "--solver", "ansys"], "invalid choice: 'ansys'"),
        (["deck", "d.csv", "c", "-o", "x.txt"], "-o/--output: the name must end in .inp"),
        (["design", "--with-probability", "1"], "--with-probability: must be above 0 and below 1"),
        (["design", "--top", "0"], "--top: must be between 1 and 50, got 0"),
        (["augment", "a", "--solver", "b", "--cases", "0"], "--cases: must be between 1 and 100"),
        (["verify", "d.csv", "--jobs", "0"], "--jobs: must be at least 1, got 0"),
        (["verify", "d.csv", "--within", "-1"], "--within: must be between 0 and 1, got -1"),
        (["example", "here", "--seed", "-1"], "--seed: must be at least 0, got -1"),
        (
            ["surrogate", "solve", "d.csv", "-o", "o.csv", "-j", "0"],
            "--workers: must be at least 1",
        ),
        (["fe-calibrate", "d.csv", "d.csv", "--rounds", "0"], "--rounds: must be between 1 and 50"),
        (["inspect", "gone.csv"], "file: the file gone.csv does not exist"),
        (["new-sheet", "gone"], "folder: the folder gone does not exist"),
        (["archive", "study.tar"], "archive: the name must end in .zip, got 'study.tar'"),
        (["retry", "--results", "gone"], "--results: the folder gone does not exist"),
        (["check", "gone.yaml"], "config: the file gone.yaml does not exist"),
    ],
)
def test_a_wrong_argument_is_one_line_with_its_name(tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "d.csv").write_text("case_id\nc\n", encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    assert main(words) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert sorted(tmp_path.iterdir()) == before
