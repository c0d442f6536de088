"""The command ``nptcs lca`` and the table behind it."""

import json

import numpy as np
import pandas as pd
import pytest

from nptcs.cli import main
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.lca.design_table import solve_table

HEADER = "name,shear_band_c10_mpa,tension_n_per_mm,compression_n_per_mm,load_n"


def write(path, *rows, header=HEADER):
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return str(path)


def test_a_table_in_and_the_same_rows_out(tmp_path, capsys):
    table = write(
        tmp_path / "in.csv",
        "a,5,30.2,13.26,5000",
        "b,5,,13.26,5000",
        "c,5,x,13,5000",
        "d,5,30.2,13.26,90000",
    )
    out = tmp_path / "out.csv"
    assert main(["lca", table, "-o", str(out)]) == 1
    result = pd.read_csv(out)
    assert list(result["name"]) == ["a", "b", "c", "d"]
    assert list(result["status"]) == ["ok", "bad_input", "bad_input", "beyond_model"]
    assert result["displacement_mm"][0] == pytest.approx(20.7413568, rel=1e-8)
    assert result["message"][1].startswith("tension_n_per_mm must be")
    assert result["message"][2] == "tension_n_per_mm is not a number: 'x'"
    assert "more than the 87.97 mm" in result["message"][3]
    assert result["displacement_mm"][1:].isna().all()
    said = capsys.readouterr()
    assert "2 bad_input" in said.out
    assert "columns copied to the output but not used: name" in said.err


def test_a_person_reads_a_table_with_units_and_reasons(tmp_path, capsys):
    table = write(tmp_path / "in.csv", "a,5,30.2,13.26,5000", "b,5,,13.26,5000")
    assert main(["lca", table]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:3] == ["row", "name", "tension"]
    assert "(N/mm)" in lines[1]
    assert lines[3].split() == ["1", "a", "30.2", "20.741", "241.06", "4.5691", "0.47984", "ok"]
    assert lines[-2] == "row 2: tension_n_per_mm must be a finite number above zero, got nothing"
    assert lines[-1] == "1 ok, 1 bad_input"


def test_a_program_reads_json_with_all_digits(tmp_path, capsys):
    table = write(tmp_path / "in.csv", "a,5,30.2,13.26,5000", "b,5,,13.26,5000")
    assert main(["lca", table, "--json"]) == 1
    rows = json.loads(capsys.readouterr().out)
    solved = solve_table(pd.read_csv(table), TyreGeometry())
    assert rows[0]["displacement_mm"] == pytest.approx(solved["displacement_mm"][0], rel=1e-12)
    assert rows[1]["displacement_mm"] is None
    assert rows[1]["status"] == "bad_input"


def test_a_long_table_is_cut_on_the_screen(tmp_path, capsys):
    rows = [f"d{number},5,30.2,13.26,{3000 + 10 * number}" for number in range(60)]
    assert main(["lca", write(tmp_path / "in.csv", *rows)]) == 0
    printed = capsys.readouterr().out
    assert "… and 10 further rows; -o OUT.csv writes all" in printed
    assert "d49" in printed
    assert "d50" not in printed


def test_all_rows_right_is_exit_code_zero(tmp_path):
    table = write(tmp_path / "in.csv", "a,5,30.2,13.26,5000")
    assert main(["lca", table, "-o", str(tmp_path / "out.csv")]) == 0


@pytest.mark.parametrize("suffix", [".svg", ".png"])
def test_drawing(tmp_path, suffix):
    table = write(tmp_path / "in.csv", "a,5,30.2,13.26,5000", "b,5,58.4,25.36,5000")
    figure = tmp_path / f"ring{suffix}"
    assert main(["lca", table, "--plot", str(figure), "--row", "2"]) == 0
    assert figure.stat().st_size > 5000


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--plot", "ring.gif"], "the name must end in .png, .svg or .pdf, got 'ring.gif'"),
        (["-o", "gone/out.csv"], "the folder gone does not exist"),
        (["-o", "out.xlsx"], "the name must end in .csv"),
        (["--row", "0"], "--row: must be at least 1, got 0"),
        (["--section", "round"], "invalid choice: 'round'"),
        (["--plot", "ring.svg", "--row", "3"], "the table has 1 rows"),
    ],
)
def test_senseless_arguments_are_one_clear_line(tmp_path, capsys, arguments, text):
    table = write(tmp_path / "in.csv", "a,5,30.2,13.26,5000")
    assert main(["lca", table, *arguments]) == 2
    assert text in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "text"),
    [
        ("", "is not a CSV table"),
        (HEADER + "\n", "the table has no rows"),
        ("shear_band_c10_mpa,load_n\n5,5000\n", "column 'tension_n_per_mm': column is missing"),
        (HEADER + ",status\na,5,30,13,5000,fine\n", "this column has the name of a result"),
    ],
)
def test_bad_tables_name_the_file(tmp_path, capsys, content, text):
    table = tmp_path / "in.csv"
    table.write_text(content, encoding="utf-8")
    assert main(["lca", str(table), "-o", str(tmp_path / "out.csv")]) == 2
    error = capsys.readouterr().err
    assert text in error
    assert "in.csv" in error
    assert not (tmp_path / "out.csv").exists()


def test_columns_replace_the_section_and_the_tyre_where_they_are_filled(tyre):
    table = pd.DataFrame(
        {
            "shear_band_c10_mpa": 5.0,
            "tension_n_per_mm": 30.2,
            "compression_n_per_mm": 13.26,
            "load_n": 5000.0,
            "spoke_count": [np.nan, 60, 30, np.nan],
            "bending_stiffness_n_mm2": [np.nan, np.nan, np.nan, 2e9],
        }
    )
    displacement = solve_table(table, tyre)["displacement_mm"]
    assert displacement[0] == pytest.approx(displacement[1], rel=1e-12)
    assert displacement[2] > 1.5 * displacement[0]
    assert displacement[3] < displacement[0]


def test_dimensions_act_through_the_section(tyre):
    table = pd.DataFrame(
        {
            "shear_band_c10_mpa": [5.0, 5.0],
            "tension_n_per_mm": 30.2,
            "compression_n_per_mm": 13.26,
            "load_n": 5000.0,
            "wire_pitch_mm": [2.0, 4.0],
        }
    )
    result = solve_table(table, tyre)
    assert result["displacement_mm"][1] > result["displacement_mm"][0]
    with pytest.raises(InputError, match="load_n"):
        solve_table(table.drop(columns="load_n"), tyre)
