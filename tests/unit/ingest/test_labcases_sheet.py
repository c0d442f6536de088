"""The same data twice, proposed sheets, and limits: the labcases, and further inputs."""

from __future__ import annotations

import io
import os
import shutil
import zipfile

import numpy as np
import pandas as pd
import pytest

from nptcs.config.materials.ingest import FileLimits, IngestSettings
from nptcs.errors import InputError
from nptcs.ingest import ingest_specimen
from nptcs.ingest.account import account_for_files
from nptcs.ingest.check_files import check_files
from nptcs.ingest.file_names import proposed_test
from nptcs.ingest.inspect import inspect_file, inspection_text
from nptcs.ingest.new_sheet import propose_sheet
from nptcs.ingest.reading.raw_file import read_raw
from nptcs.ingest.repeats import counted_once
from nptcs.tables.laboratory.specimens import read_sheet

TIME = np.arange(0, 30.0, 0.5)
STRAIN = 0.0002 * (TIME / 0.5)
FORCE = 1.2e6 * STRAIN


def records(lab, folder, profiles):
    specimens, errors = read_sheet(folder / "specimens.csv")
    assert not errors
    done = [ingest_specimen(one, folder, IngestSettings(), profiles).record for one in specimens]
    return specimens, done


def test_the_same_data_twice_are_counted_once(lab, profiles):
    folder = lab.cases / "same_data_twice"
    specimens, done = records(lab, folder, profiles)
    counted = counted_once(specimens, done)
    assert [one.specimen for one in counted if one.include] == ["S1", "S3"]
    assert counted[1].reason == "the same data as S1"
    faults, _ = check_files(specimens, folder / "specimens.csv", IngestSettings(), profiles)
    assert [fault.specimen for fault in faults] == ["S2", "S4"]
    table = account_for_files(folder / "specimens.csv", done).set_index("file")
    assert table.loc["b.csv", "status"] == "repeated"
    assert table.loc["c.csv", "status"] == "used"
    assert "S4 repeats the data of S3" in table.loc["c.csv", "reason"]


SHEET = "specimen,test,material,orientation_deg,width_mm,thickness_mm,force_file,include,reason\n"


@pytest.mark.parametrize(
    ("second", "scale", "delimiter", "again"),
    [
        ("Load [N]", 1.0, ";", True),
        ("Load [kN]", 1e-3, ",", True),
        ("Load [N]", 1.0001, ",", False),
    ],
)
def test_equal_curves_in_other_bytes_are_the_same_data(
    lab, profiles, tmp_path, second, scale, delimiter, again
):
    """Saved again with another delimiter or unit; and a curve that differs in the fourth digit."""
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * STRAIN})
    other = {"Time [s]": TIME + 7, second: scale * FORCE, "Strain [%]": 100 * STRAIN}
    lab.write(tmp_path / "b.csv", other, delimiter)
    rows = "A,tension,m,0,10,1,a.csv,yes,\nB,tension,m,0,12,1,b.csv,yes,\n"
    (tmp_path / "specimens.csv").write_text(SHEET + rows)
    specimens, done = records(lab, tmp_path, profiles)
    assert [one.include for one in counted_once(specimens, done)] == [True, not again]


def test_a_repeat_that_is_left_out_by_hand_keeps_the_other(lab, profiles, tmp_path):
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * STRAIN})
    rows = "A,tension,m,0,10,1,a.csv,no,wrong file\nB,tension,m,0,10,1,a.csv,yes,\n"
    (tmp_path / "specimens.csv").write_text(SHEET + rows)
    specimens, done = records(lab, tmp_path, profiles)
    assert [one.include for one in counted_once(specimens, done)] == [False, True]


def proposed(folder, profiles):
    """Proposed sheet as a table, and the specimens that `check` would accept of it."""
    proposal = propose_sheet(folder, profiles)
    return pd.read_csv(io.StringIO(proposal.text()), dtype=str).fillna(""), proposal


def accepted(folder, proposal, **filled):
    """Fill in what no file states, and read the sheet as `check` does."""
    for row in proposal.rows:
        row |= {key: value for key, value in filled.items() if not row.get(key)}
    (folder / "specimens.csv").write_text(proposal.text())
    specimens, errors = read_sheet(folder / "specimens.csv")
    assert not errors
    return specimens


COUPON = {"test": "tension", "material": "m", "orientation_deg": "0", "width_mm": "10",
          "thickness_mm": "1"}  # fmt: skip


def test_one_name_in_two_folders_gives_two_ids(lab, profiles, tmp_path):
    folder = tmp_path / "lab"
    shutil.copytree(lab.cases / "same_name_in_two_folders", folder)
    table, proposal = proposed(folder, profiles)
    assert len(set(table["specimen"].str.lower())) == len(table) == 2
    specimens = accepted(folder, proposal, **COUPON)
    assert [one.include for one in specimens] == [True, False]
    faults, _ = check_files(specimens, folder / "specimens.csv", IngestSettings(), profiles)
    assert not faults


def test_machine_and_camera_of_parallel_folders_are_one_specimen(lab, profiles, tmp_path):
    folder = tmp_path / "lab"
    shutil.copytree(lab.cases / "machine_and_camera_folders", folder)
    table, proposal = proposed(folder, profiles)
    (row,) = table.to_dict("records")
    assert row["force_file"] == "MTS/MTS_UD_1.csv"
    assert row["strain_file"] == "DIC/DIC_UD_1.csv"
    (specimen,) = accepted(folder, proposal, **COUPON)
    assert specimen.mean_width_mm == pytest.approx(10.05)
    assert specimen.mean_thickness_mm == pytest.approx(1.005)


@pytest.mark.parametrize("name", ["mts_channel_names", "spanish_names", "channel_prefix"])
def test_a_sheet_is_proposed_for_any_known_export(lab, profiles, tmp_path, name):
    folder = tmp_path / "lab"
    shutil.copytree(lab.cases / name, folder)
    table, proposal = proposed(folder, profiles)
    assert len(table) == {"mts_channel_names": 2}.get(name, 1)
    accepted(folder, proposal, **COUPON)
    if name == "spanish_names":
        assert table.loc[0, ["width_mm", "thickness_mm", "gauge_length_mm"]].tolist() == [
            "5.72", "1.92", "67.7"
        ]  # fmt: skip


def machine_file(lab, path, seed, **options):
    path.parent.mkdir(parents=True, exist_ok=True)
    scale = 1 + 0.01 * seed
    columns = {"Time [s]": TIME, "Load [N]": scale * FORCE, "Displacement [mm]": TIME}
    lab.write(path, columns, **options)


def camera_file(lab, path, seed):
    path.parent.mkdir(parents=True, exist_ok=True)
    scale = 1 + 0.01 * seed
    columns = {"Time_0 [s]": TIME, "exx [1]": STRAIN, "eyy [1]": -0.3 * STRAIN,
               "Force": scale * FORCE}  # fmt: skip
    lab.write(path, columns, ";")


def test_a_campaign_of_32_specimens_in_parallel_folders(lab, profiles, tmp_path):
    """Machine and camera in separate folders, one table of dimensions per series."""
    series = ("UD_0deg", "UD_90deg", "IPS_pm45", "Compression_0deg")
    seed = 0
    for name in series:
        for number in range(1, 9):
            seed += 1
            machine_file(lab, tmp_path / "MTS" / name / f"MTS_{name}_{number:02d}.csv", seed)
            if number != 5:
                camera_file(lab, tmp_path / "DIC" / name / f"{name}-{number}_vic3d.csv", seed)
        rows = [f"{n},{10 + n / 100},{10 + n / 50},{1 + n / 1000}" for n in range(1, 9)]
        text = "Specimen,Width 1 [mm],Width 2 [mm],Thickness [mm]\n" + "\n".join(rows)
        (tmp_path / f"Dimensions_{name}.csv").write_text(text)
    (tmp_path / "Results_summary.csv").write_text(
        "Specimen,Load (N),Strain (%)\n" + "\n".join(f"{n},{9000 + n},1.{n}" for n in range(1, 9))
    )
    (tmp_path / "notes.txt").write_text("humid on the second day")
    table, proposal = proposed(tmp_path, profiles)
    assert len(table) == 32
    assert (table["strain_file"] != "").sum() == 28
    assert (table["width_mm"] != "").all()
    row = table.set_index("force_file").loc["MTS/UD_90deg/MTS_UD_90deg_03.csv"]
    assert (row["width_mm"], row["thickness_mm"]) == ("10.03;10.06", "1.003")
    assert row["strain_file"] == "DIC/UD_90deg/UD_90deg-3_vic3d.csv"
    assert row["orientation_deg"] == "90"
    proposals = table.groupby(table["force_file"].str.split("/").str[1])["test"].unique()
    assert proposals["IPS_pm45"].tolist() == ["shear"]
    assert proposals["Compression_0deg"].tolist() == ["compression"]
    assert proposals["UD_0deg"].tolist() == [""]
    assert "Results_summary.csv" in proposal.left
    assert "notes.txt" in proposal.left
    assert set(proposal.open_cells()) <= {"test", "material", "orientation_deg"}
    accepted(tmp_path, proposal, **COUPON)


def test_numbers_pair_across_naming_schemes_and_never_by_order(lab, profiles, tmp_path):
    for number in (1, 2, 11, 12):
        machine_file(lab, tmp_path / "Zwick" / f"CFRP-T{number:03d}.csv", number)
        camera_file(lab, tmp_path / "Aramis" / f"cfrp_t{number}.csv", number)
    table, _ = proposed(tmp_path, profiles)
    pairs = dict(zip(table["force_file"], table["strain_file"], strict=True))
    assert pairs == {f"Zwick/CFRP-T{n:03d}.csv": f"Aramis/cfrp_t{n}.csv" for n in (1, 2, 11, 12)}
    assert set(table["material"]) == {"cfrp"}


def test_two_cameras_of_one_specimen_are_left_to_a_person(lab, profiles, tmp_path):
    machine_file(lab, tmp_path / "T1.csv", 1)
    camera_file(lab, tmp_path / "dic" / "T1.csv", 2)
    camera_file(lab, tmp_path / "vic3d" / "T1.csv", 3)
    table, proposal = proposed(tmp_path, profiles)
    assert table["strain_file"].tolist() == [""]
    assert all("one of 2 strain files" in reason for reason in proposal.left.values())


def test_a_missing_unit_is_reported(lab, profiles, tmp_path):
    columns = {"Time [s]": TIME, "Load": FORCE, "Strain [%]": 100 * STRAIN}
    lab.write(tmp_path / "a.csv", columns)
    table, _ = proposed(tmp_path, profiles)
    assert "no unit for force ('Load')" in table.loc[0, "remarks"]
    inspection = inspect_file(tmp_path / "a.csv", profiles)
    assert not inspection.usable
    assert "no unit for force" in inspection.obstacle()


@pytest.mark.parametrize(
    ("columns", "word"),
    [
        (("Time [s]", "Load [N]", "Zzz [%]"), "'Zzz' in %"),
        (("Time [s]", "Prüfkraft [kN]", "Quux [mm]"), "'Quux' in mm"),
        (("Time [s]", "Load (10 N)", "Strain [%]"), "'Load (10 N)' in no unit"),
    ],
)
def test_inspect_says_which_of_load_and_strain_it_did_not_read(
    lab, profiles, tmp_path, columns, word
):
    lab.write(tmp_path / "a.csv", dict(zip(columns, (TIME, FORCE, 100 * STRAIN), strict=True)))
    inspection = inspect_file(tmp_path / "a.csv", profiles)
    assert inspection.usable  # next to another file
    assert word in inspection.unread()
    assert word in inspection_text(inspection)


@pytest.mark.parametrize("names", [("Time [s]", "Load [N]"), ("Time [s]", "exx [1]", "eyy [1]")])
def test_a_file_of_load_or_strain_alone_has_nothing_unread(lab, profiles, tmp_path, names):
    lab.write(tmp_path / "a.csv", dict(zip(names, (TIME, FORCE, 0.3 * STRAIN), strict=False)))
    assert inspect_file(tmp_path / "a.csv", profiles).unread() == ""


def test_inspect_names_the_columns_that_it_saw(lab, profiles, tmp_path):
    lab.write(tmp_path / "a.csv", {"alpha [V]": TIME, "beta [V]": FORCE})
    inspection = inspect_file(tmp_path / "a.csv", profiles)
    assert not inspection.usable
    assert "'alpha', 'beta'" in inspection.obstacle()


def refused(path, profiles, match, **limits):
    with pytest.raises(InputError, match=match):
        read_raw(path, profiles, limits=FileLimits(**limits))


@pytest.mark.parametrize(
    ("limits", "match"),
    [
        ({"rows": 50}, "61 lines|62 lines"),
        ({"file_mb": 1e-4}, "MB"),
        ({"line_length": 20}, "characters in a line"),
        ({"columns": 2}, "3 columns"),
    ],
)
def test_a_text_beyond_a_limit_is_refused(lab, profiles, tmp_path, limits, match):
    path = tmp_path / "a.csv"
    lab.write(path, {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * STRAIN})
    refused(path, profiles, match, **limits)


def test_a_packed_bomb_is_refused_before_it_is_unpacked(profiles, tmp_path):
    path = tmp_path / "bomb.xlsx"
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("xl/worksheets/sheet1.xml", "w", force_zip64=True) as part,
    ):
        for _ in range(30):
            part.write(b"<c><v>1</v></c>" * 70_000)
    assert path.stat().st_size < 1e6
    refused(path, profiles, "unpacks to", unpacked_mb=20)


@pytest.mark.parametrize(("cell", "limit"), [("A5000", {"rows": 1000}), ("ZZ1", {"columns": 100})])
def test_a_sheet_beyond_a_limit_is_refused(profiles, tmp_path, cell, limit):
    from openpyxl import Workbook

    book = Workbook()
    book.active["A1"] = 1
    book.active[cell] = 2
    book.save(tmp_path / "a.xlsx")
    refused(tmp_path / "a.xlsx", profiles, "has more than", **limit)


def test_no_file_behind_a_link_out_of_the_folder_is_read(lab, profiles, tmp_path):
    outside = tmp_path / "outside"
    outside.mkdir()
    machine_file(lab, outside / "secret.csv", 1)
    folder = tmp_path / "lab"
    machine_file(lab, folder / "T1.csv", 2)
    (folder / "T2.csv").symlink_to(outside / "secret.csv")
    (folder / "more").symlink_to(outside)
    table, proposal = proposed(folder, profiles)
    assert table["force_file"].tolist() == ["T1.csv"]
    assert proposal.left == {}


@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_a_pipe_or_a_device_is_refused_and_not_waited_for(profiles, tmp_path, kind):
    path = tmp_path / "a.csv"
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")
    with pytest.raises(InputError, match="not a file"):
        read_raw(path, profiles)


@pytest.mark.parametrize(
    ("name", "test"),
    [
        ("Zug_90grad_1.csv", "tension"), ("Druck_0grad_1.csv", "compression"),
        ("Biegung_1.csv", "flexure"), ("CLC/P_2.csv", "compression"), ("3PB-4.csv", "flexure"),
        ("Gummi Druck 2.csv", "rubber_compression"), ("Ausdruck_1.csv", ""),
    ],
)  # fmt: skip
def test_short_words_of_a_name_propose_the_test(name, test):
    assert proposed_test(name, []) == test


def test_the_lock_of_an_open_document_is_not_data(lab, profiles, tmp_path):
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * STRAIN})
    shutil.copy(tmp_path / "a.csv", tmp_path / "~$a.csv")
    assert [row["force_file"] for row in propose_sheet(tmp_path, profiles).rows] == ["a.csv"]


@pytest.mark.parametrize(("unit", "word"), [("[N]", ""), ("", "'Load') is not known"), ("[V]", "")])
def test_a_camera_file_with_the_force_of_the_machine_is_a_separate_test(
    lab, profiles, tmp_path, unit, word
):
    lab.write(tmp_path / "m_2.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": STRAIN})
    columns = {f"Load {unit}".strip(): FORCE, "exx": STRAIN, "eyy": -0.3 * STRAIN}
    lab.write(tmp_path / "a_1.csv", columns)
    table, proposal = proposed(tmp_path, profiles)
    if unit == "[N]":
        assert set(table["force_file"]) == {"a_1.csv", "m_2.csv"}
    else:
        assert word in proposal.left["a_1.csv"]
