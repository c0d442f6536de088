"""A specimen from its sheet row to its curve; the folder; the two commands."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.commands import inspect, new_sheet
from nptcs.config.materials.ingest import ForceZero, IngestSettings
from nptcs.errors import InputError
from nptcs.ingest import ingest_specimen
from nptcs.ingest.account import account_for_files
from nptcs.ingest.folder import find_file, natural_key
from nptcs.ingest.new_sheet import specimen_id
from nptcs.ingest.reading.profiles import load_profiles, read_profile
from nptcs.tables.laboratory.curves import Curve, IngestRecord
from nptcs.tables.laboratory.specimens import read_sheet

ROOT = Path(__file__).resolve().parents[3]
FORMATS = ROOT / "config" / "formats"
AREA = 10.0
E_MPA = 70_000.0


def export(path, unit="N", scale=1.0, stress_area=None, strain_scale=1.0, header=()):
    strain = np.linspace(0, 0.01, 60)
    force = E_MPA * strain * AREA
    data = {
        "time (s)": 10 * strain,
        f"force ({unit})": force * scale,
        "strain (1)": strain_scale * strain,
    }
    if stress_area:
        data["stress (MPa)"] = force / stress_area
    rows = [";".join(f"{value:.6f}" for value in row) for row in zip(*data.values(), strict=True)]
    path.write_text("\n".join([*header, ";".join(data), *rows]), encoding="utf-8")


def ingest(specimen, folder, profiles, settings=None):
    return ingest_specimen(specimen, folder, settings or IngestSettings(), profiles)


def test_curve_and_record(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", "kN", 1e-3)
    curve, record = (result := ingest(coupon(), tmp_path, profiles)).curve, result.record
    Curve.validate(curve)
    assert curve["stress_mpa"].max() == pytest.approx(700, rel=1e-4)
    assert np.polyfit(curve["strain_axial"], curve["stress_mpa"], 1)[0] == pytest.approx(
        E_MPA, rel=1e-3
    )
    assert record.files[0].units["force"] == "kN"
    assert record.geometry.area_mm2 == AREA
    assert [step.name for step in record.steps][-1] == "strain origin"
    assert IngestRecord(**json.loads(record.model_dump_json())) == record


def test_curve_survives_csv(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv")
    curve = ingest(coupon(), tmp_path, profiles).curve
    curve.to_csv(tmp_path / "curve.csv", index=False)
    pd.testing.assert_frame_equal(Curve.validate(pd.read_csv(tmp_path / "curve.csv")), curve)


def test_kilonewton_called_newton_is_refused(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", "N", 1e-3)
    with pytest.raises(InputError, match=r"apparent modulus 70.* force in N") as caught:
        ingest(coupon(), tmp_path, profiles)
    assert caught.value.specimen == "A-1"


def test_percent_called_dimensionless_is_refused(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", strain_scale=100)
    with pytest.raises(InputError, match="beyond 0.5"):
        ingest(coupon(), tmp_path, profiles)


def test_machine_area_that_differs_is_flagged_and_the_sheets_used(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", stress_area=11.0)
    result = ingest(coupon(), tmp_path, profiles)
    assert result.curve["stress_mpa"].max() == pytest.approx(700, rel=1e-4)
    assert any("machine area 11 mm²" in flag for flag in result.record.flags)


def test_machine_area_beyond_reason_is_refused(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", stress_area=0.1)
    with pytest.raises(InputError, match="give an area of 0.1 mm²"):
        ingest(coupon(), tmp_path, profiles)


def test_dimension_in_the_header_that_differs_is_flagged(tmp_path, coupon, profiles):
    header = ["Specimen width;12,5;mm".replace(",", ".")]
    export(tmp_path / "test.csv", header=header)
    flags = ingest(coupon(), tmp_path, profiles).record.flags
    assert any("width in test.csv is 12.5 mm, in the sheet 10 mm" in flag for flag in flags)


def test_stress_without_force_says_so(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv", stress_area=AREA)
    text = (tmp_path / "test.csv").read_text().replace("force (N)", "note (N)")
    (tmp_path / "test.csv").write_text(text)
    result = ingest(coupon(), tmp_path, profiles)
    assert result.curve["force_n"].max() == pytest.approx(7000, rel=1e-4)
    assert any("area could not be checked" in flag for flag in result.record.flags)


def test_unknown_format_names_the_choices(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv")
    with pytest.raises(InputError, match="bluehill-en"):
        ingest(coupon(force_format="bluehil"), tmp_path, profiles)


def test_steps_can_be_switched(tmp_path, coupon, profiles):
    export(tmp_path / "test.csv")
    settings = IngestSettings(force_zero=ForceZero(enabled=True))
    steps = {
        step.name: step.on for step in ingest(coupon(), tmp_path, profiles, settings).record.steps
    }
    assert steps["force zero"]
    off = ingest(coupon(), tmp_path, profiles, IngestSettings.as_recorded()).record.steps
    assert {step.name for step in off if not step.on} == {
        "dead channels",
        "spikes",
        "empty rows",
        "force zero",
        "end of test",
        "extensometer",
        "strain origin",
    }


def test_missing_file_suggests_the_similar_name(tmp_path):
    (tmp_path / "T0-1.CSV").write_text("x")
    with pytest.raises(InputError, match=r"did you mean 'T0-1\.CSV'"):
        find_file(tmp_path, "T0-1.csv")


def test_file_name_with_accents_stored_another_way(tmp_path):
    (tmp_path / "Pru\u0308fung.csv").write_text("x")
    assert find_file(tmp_path, "Pr\u00fcfung.csv").read_text() == "x"


def test_natural_order():
    assert sorted(["11", "2", "1", "12"], key=natural_key) == ["1", "2", "11", "12"]


def test_every_file_is_accounted_for(tmp_path, profiles):
    for name in ("a.csv", "b.csv", "stray.csv", "d.csv"):
        export(tmp_path / name)
    (tmp_path / "c.csv").write_text("no numbers here")
    (tmp_path / ".hidden").write_text("x")
    (tmp_path / "more").mkdir()
    for note in ("README.md", "Readme.txt", "more/README", "readme.csv", "README.md.txt"):
        (tmp_path / note).write_text("notes")
    sheet = tmp_path / "specimens.csv"
    rows = [
        "A,tension,cfrp,0,10,1,a.csv,yes,",
        "B,tension,cfrp,0,10,1,b.csv,no,grip failure",
        "C,tension,cfrp,0,10,1,c.csv,yes,",
        "D,tension,cfrp,0,10,,d.csv,yes,",
        "E,tension,cfrp,0,10,1,gone.csv,yes,",
    ]
    head = "specimen,test,material,orientation_deg,width_mm,thickness_mm,force_file,include,reason"
    sheet.write_text("\n".join([head, *rows]))
    records = []
    for specimen in read_sheet(sheet)[0]:
        try:
            records.append(ingest(specimen, tmp_path, profiles).record)
        except InputError as error:
            records.append(IngestRecord.failed(specimen.specimen, error))
    files = account_for_files(sheet, records).set_index("file")
    assert files["status"].to_dict() == {
        "a.csv": "used",
        "b.csv": "left out",
        "c.csv": "not understood",
        "d.csv": "not understood",
        "README.md": "note",
        "Readme.txt": "note",
        "more/README": "note",
        "readme.csv": "not named",
        "README.md.txt": "not named",
        "specimens.csv": "sheet",
        "stray.csv": "not named",
        "gone.csv": "missing",
    }
    assert files.loc["b.csv", "reason"] == "grip failure"
    assert "no table of numbers" in files.loc["c.csv", "reason"]
    assert files.loc["d.csv", "reason"] == "its row in the sheet has an error"
    assert files.loc["a.csv", "format"] == "plain"
    assert len(files.loc["a.csv", "sha256"]) == 64
    assert files.loc["gone.csv", "sha256"] == ""


def run(command, *arguments):
    parser = argparse.ArgumentParser()
    command.register(parser.add_subparsers())
    parsed = parser.parse_args([command.__name__.rsplit(".", 1)[1].replace("_", "-"), *arguments])
    return parsed.run(parsed)


def test_inspect_shows_what_was_detected(tmp_path, capsys):
    export(tmp_path / "a.csv", "kN", 1e-3)
    assert run(inspect, str(tmp_path / "a.csv"), "--formats", str(FORMATS)) == 0
    text = capsys.readouterr().out
    for expected in (
        "encoding ascii",
        "delimiter ';'",
        "decimal mark '.'",
        "60 rows",
        "force (kN)",
    ):
        assert expected.replace(" (kN)", "") in text
    assert "names in line 1" in text


def test_inspect_takes_the_profile_that_reads_most(tmp_path, capsys):
    """Two signatures fit; only one profile knows the columns."""
    lines = ["time (s),Standard force (N),Crosshead,Load cell,Strain (%)"]
    lines += [f"0.{n},{n}.5,1{n}.0,2{n}.0,0.0{n}" for n in range(1, 8)]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    assert run(inspect, str(tmp_path / "a.csv"), "--formats", str(FORMATS)) == 0
    text = capsys.readouterr().out
    assert "format     testxpert-en" in text
    assert "signature of 'mts-testsuite', 'testxpert-en' fits" in text


def test_inspect_of_what_is_not_understood(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("nothing")
    assert run(inspect, str(tmp_path / "a.csv"), "--formats", str(FORMATS)) == 1
    assert "problem" in capsys.readouterr().out


@pytest.mark.parametrize(
    "name", ["T90-1.csv", "T0-1_wdw.txt", "T0-1_vic3d.csv", "C0-1.TRA", "R75-1.csv"]
)
def test_drafted_profile_is_valid_and_reads_the_same(tmp_path, profiles, name, capsys):
    from nptcs.ingest.reading.raw_file import read_raw

    source = ROOT / "raw_data" / "example" / name
    draft = tmp_path / "lab-own.yaml"
    run(inspect, str(source), "--formats", str(FORMATS), "--write-profile", str(draft))
    profile = read_profile(draft)
    assert profile.name == "lab-own"
    role = "strain" if "vic3d" in name else "force and strain"
    ours = read_raw(source, profiles, declared=profile, role=role)
    theirs = read_raw(source, profiles, role=role)
    for quantity in theirs.values:
        assert ours.values[quantity] == pytest.approx(theirs.values[quantity], nan_ok=True)


def test_draft_does_not_overwrite(tmp_path):
    export(tmp_path / "a.csv")
    (tmp_path / "p.yaml").write_text("mine")
    with pytest.raises(InputError, match="exists already"):
        run(
            inspect,
            str(tmp_path / "a.csv"),
            "--formats",
            str(FORMATS),
            "--write-profile",
            str(tmp_path / "p.yaml"),
        )
    assert (tmp_path / "p.yaml").read_text() == "mine"


def test_new_sheet_pairs_by_name_and_leaves_open_what_it_cannot_know(tmp_path, capsys):
    head = ["Specimen width;12.5;mm", "Specimen thickness;2.1;mm"]
    for number in (1, 2, 11):
        export(tmp_path / f"P-{number}_instron.csv", header=head)
        lines = ["count;exx [1];eyy [1]", *(f"{n};0.00{n};-0.000{n}" for n in range(1, 9))]
        (tmp_path / f"P-{number}_vic3d.csv").write_text("\n".join(lines))
    (tmp_path / "notes.txt").write_text("see the folder")
    export(tmp_path / "README.txt", header=["An excerpt of P-1:"])
    assert run(new_sheet, str(tmp_path), "--formats", str(FORMATS)) == 0
    printed = capsys.readouterr().out
    assert "notes.txt: no table of numbers" in printed
    assert "README" not in printed
    table = pd.read_csv(tmp_path / "specimens.csv", dtype=str).fillna("")
    assert list(table["specimen"]) == ["P-1", "P-2", "P-11"]
    assert list(table["strain_file"]) == ["P-1_vic3d.csv", "P-2_vic3d.csv", "P-11_vic3d.csv"]
    assert set(table["width_mm"]) == {"12.5"}
    assert set(table["test"]) == {""}
    _, errors = read_sheet(tmp_path / "specimens.csv")
    assert len(errors) == 3
    with pytest.raises(InputError, match="exists already"):
        run(new_sheet, str(tmp_path), "--formats", str(FORMATS))


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("a/T0-1_vic3d.csv", "T0-1"),
        ("Probe 3 Kraft.txt", "Probe_3"),
        ("x_raw_data.csv", "x"),
        ("é.csv", "e"),
        ("力.csv", "specimen"),
    ],
)
def test_specimen_id_from_a_file_name(name, expected):
    assert specimen_id(name) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name: x\ntitle: t\ncolums: {}\n", "colums"),
        ("name: x\ntitle: t\nunits: {force: kpp}\n", "not a unit of force"),
        ("name: x\ntitle: t\nsignature: ['(']\n", "expression"),
        ("name: x\ntitle: t\nthousands: ','\n", "thousands"),
        ("name: x\ntitle: t\ndelimiter: ','\ndecimal: ','\n", "same"),
        ("- a\n", "not a profile"),
        ("name: [x\n", "not YAML"),
        ("name: y\ntitle: t\n", "differ"),
        ("1: y\n", "words"),
    ],
)
def test_bad_profiles_are_refused_with_the_key(tmp_path, text, message):
    (tmp_path / "x.yaml").write_text(text)
    with pytest.raises(InputError, match=message):
        load_profiles(tmp_path)


def test_every_shipped_profile_is_valid_and_named_as_its_file(profiles):
    assert len(profiles) >= 15
    assert all(profile.columns for profile in profiles.values())


def test_ingest_stays_light():
    code = (
        "import nptcs.ingest, sys;"
        "heavy = {'scipy', 'matplotlib', 'sklearn', 'openpyxl'} & set(sys.modules);"
        "assert not heavy, heavy"
    )
    environment = {"PYTHONPATH": str(ROOT / "workflow" / "src")}
    subprocess.run([sys.executable, "-c", code], check=True, env=environment)
