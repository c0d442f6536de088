"""What the commands of the finite element route say about input that they cannot use."""

from pathlib import Path

import numpy as np
import pytest

from nptcs.cli import main
from nptcs.fe.spoke.equilibrium import SpokeError
from nptcs.fe.tyre.equilibrium import TyreError

ROOT = Path(__file__).parents[3]

TEN = "spoke_c10_mpa,tension_stiffness_n_per_mm,compression_stiffness_n_per_mm\n1,30.2,13.26\n"
FIVE = "case,spacing_mm,thickness_mm,angle_deg,stiffness_n_per_mm\n32,15,1.8,45,263.7\n"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--spacing", "4"], "'--spacing': plates 5 mm wide overlap"),
        (["--spoke-c10", "-1"], "--spoke-c10: must be above 0 and at most 1000 MPa, got -1"),
        (["--band-c10", "0"], "--band-c10: must be above 0 and at most 1000 MPa, got 0"),
        (["--angle", "300"], "--angle: must be between -90 and 90 degrees, got 300"),
        (["--thickness", "-1.8"], "--thickness: must be above 0 and at most 20 mm, got -1.8"),
        (["--load", "5e6"], "--load: must be between 1 and 100000 N, got 5e+06"),
        (["--load", "5 kN"], "--load: must be a number between 1 and 100000 N, got '5 kN'"),
        (["--spoke-c10", "rubber_1"], "--spoke-c10: the card has no such rubber"),
        (["--ply", "cfrp"], "--ply names a ply of a material card, but the published ply is used"),
        (["--card", "gone.json"], "--card: the file gone.json does not exist"),
    ],
)
def test_a_design_without_meaning_is_one_line(tmp_path, capsys, monkeypatch, words, named):
    monkeypatch.chdir(tmp_path)
    assert main(["fe-picture", str(tmp_path / "x.png"), *words]) == 2
    assert named in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["fe-picture", "fe-export"])
def test_a_tyre_that_is_not_solved_is_one_line_that_says_how_far_it_got(
    tmp_path, capsys, monkeypatch, command
):
    if command == "fe-export":
        pytest.importorskip("vtkmodules", reason="the extra nptcs[paraview] is not installed")

    def fail(*_):
        raise SpokeError(f"no equilibrium beyond u_r = {np.float64(-31.0)}")

    monkeypatch.setattr("nptcs.fe.case.energy_table", fail)
    assert main([command, str(tmp_path / "x.png")]) == 2
    said = capsys.readouterr().err
    assert "beyond u_r = -31.0" in said
    assert "Remedy: choose a smaller load" in said


def test_a_calibration_with_a_tyre_that_cannot_be_loaded_says_so(monkeypatch, tmp_path, capsys):
    def fail(*_):
        raise TyreError("no equilibrium beyond 3200 N", [])

    monkeypatch.setattr("nptcs.fe.calibration.calibrate", fail)
    published = ROOT / "raw_data/published"
    tables = ("table10_spoke_stiffness.csv", "table5_plate_doe.csv")
    assert main(["fe-calibrate", *(str(published / name) for name in tables)]) == 2
    said = capsys.readouterr().err
    assert "no equilibrium beyond 3200 N" in said
    assert "--spoke-c10" in said


@pytest.mark.parametrize(
    ("cases", "file", "named"),
    [("33", "five.csv", "column 'case'"), ("32", "ten.csv", "column 'spoke_c10_mpa'")],
)
def test_the_calibration_names_the_table_that_lacks_a_row(tmp_path, capsys, cases, file, named):
    (tmp_path / "ten.csv").write_text(TEN)
    (tmp_path / "five.csv").write_text(FIVE)
    tables = [str(tmp_path / name) for name in ("ten.csv", "five.csv")]
    assert main(["fe-calibrate", *tables, "--cases", cases]) == 2
    said = capsys.readouterr().err
    assert f"{tmp_path / file}, {named}" in said
    assert "Remedy" in said
