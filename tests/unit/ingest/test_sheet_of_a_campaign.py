"""`new-sheet` for folders as laboratories keep them: series, frames, dates in names, limits."""

from __future__ import annotations

import csv
import io

import numpy as np
import pandas as pd
import pytest

from nptcs.config.materials.ingest import FileLimits, IngestSettings, limits_in
from nptcs.errors import InputError
from nptcs.ingest.check_files import check_files
from nptcs.ingest.file_names import series_names, tokens
from nptcs.ingest.fill_sheet import fill_text, kept_cells, parse_fill, read_rows
from nptcs.ingest.folder import is_there
from nptcs.ingest.new_sheet import propose_sheet
from nptcs.tables.laboratory.specimens import read_sheet

TIME = np.arange(0, 30.0, 0.5)
STRAIN = 2e-4 * TIME
FORCE = 1.2e6 * STRAIN


def machine(lab, path, scale=1.0, rows=60):
    path.parent.mkdir(parents=True, exist_ok=True)
    columns = {"Time (s)": TIME, "Load (N)": scale * FORCE, "Crosshead (mm)": TIME}
    lab.write(path, {name: values[:rows] for name, values in columns.items()})


def camera(lab, path, scale=1.0):
    path.parent.mkdir(parents=True, exist_ok=True)
    columns = {"Time_0 [s]": TIME, "exx [1]": STRAIN, "eyy [1]": -0.3 * STRAIN,
               "Force": scale * FORCE}  # fmt: skip
    lab.write(path, columns, ";")


def table_of(proposal):
    return pd.read_csv(io.StringIO(proposal.text()), dtype=str).fillna("")


def test_a_series_is_filled_in_once_and_then_accepted(lab, profiles, tmp_path):
    for number in range(1, 5):
        machine(lab, tmp_path / "MTS" / f"MTS_UD_{number}.csv", 1 + 0.01 * number)
        machine(lab, tmp_path / "MTS" / f"MTS_TD_{number}.csv", 2 + 0.01 * number)
        camera(lab, tmp_path / "DIC" / f"DIC_UD_{number}.csv", 1 + 0.01 * number)
    for name in ("UD", "TD"):
        rows = "\n".join(f"{n},10.1,10.2,1.{n}" for n in range(1, 5))
        (tmp_path / f"Dimensions{name}.csv").write_text(f"Sample,W1,W2,T\n{rows}\n")
    proposal = propose_sheet(tmp_path, profiles)
    wanted = ["test", "material", "orientation_deg"]
    assert proposal.open_series() == {"UD": (4, wanted), "TD": (4, wanted)}
    told = ["gauge_length_mm" in row["remarks"] for row in proposal.rows if "TD" in row["specimen"]]
    assert told == [True] * 4  # no camera: the crosshead's travel needs a length
    fills = [
        parse_fill("UD: test=tension material=cfrp orientation_deg=0"),
        parse_fill("TD: test=tension, material=cfrp, orientation_deg=90"),
    ]
    (tmp_path / "specimens.csv").write_text(fill_text(proposal.text(), fills))
    specimens, errors = read_sheet(tmp_path / "specimens.csv")
    assert not errors
    assert [s.orientation_deg for s in specimens if "TD" in s.specimen] == [90.0] * 4
    assert not any("fill in" in s.remarks for s in specimens)
    assert [bool(s.strain_file) for s in specimens if "UD" in s.specimen] == [True] * 4


def test_what_is_filled_in_by_hand_stays():
    text = 'specimen;test;force_file;remarks\nA;shear;A_1.csv;mine\nB;;A_2.csv;"fill in test; x"\n'
    filled = fill_text(text, [parse_fill("A: test=tension material=m")])
    table = pd.read_csv(io.StringIO(filled), sep=";")
    assert table["test"].tolist() == ["shear", "tension"]
    assert table["material"].tolist() == ["m", "m"]
    assert table["remarks"].tolist() == ["mine", "x"]


def test_what_was_proposed_by_words_gives_way_to_what_is_stated():
    proposed = "proposed by words, to be checked: test, orientation_deg"
    text = (
        "specimen,test,orientation_deg,width_mm,force_file,remarks\n"
        f'A_1,tension,0,25.1,A_1.csv,"{proposed}; fill in material"\n'
    )
    fills = [parse_fill("A: orientation_deg=90 material=m width_mm=25")]
    (row,) = csv.DictReader(io.StringIO(fill_text(text, fills)))
    assert (row["orientation_deg"], row["material"], row["width_mm"]) == ("90", "m", "25.1")
    assert row["remarks"] == "proposed by words, to be checked: test"
    assert kept_cells(read_rows(text)[2], fills) == [
        "A_1: width_mm stays 25.1, not 25; change it in the sheet"
    ]
    assert kept_cells(read_rows(text)[2], [parse_fill("A: width_mm=25.1")]) == []


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("UD test=tension", "is not a series"),
        ("UD: tension", "is not a series"),
        ("UD: tests=tension", "unknown column"),
    ],
)
def test_a_fill_that_cannot_be_read_is_refused(text, match):
    with pytest.raises(InputError, match=match):
        parse_fill(text)


def test_a_series_that_is_not_there_names_those_that_are():
    text = "specimen,test,force_file,remarks\nA,,A_1.csv,\n"
    with pytest.raises(InputError, match="series: A"):
        fill_text(text, [parse_fill("B: test=tension")])


def test_series_of_equal_names_in_two_folders_are_two():
    files = ["dry/MTS_UD_1.csv", "wet/MTS_UD_1.csv", "wet/PM45_1.csv", "wet/PM45_2.csv"]
    assert series_names(files) == {
        "dry/MTS_UD_1.csv": "dry/UD",
        "wet/MTS_UD_1.csv": "wet/UD",
        "wet/PM45_1.csv": "PM45",
        "wet/PM45_2.csv": "PM45",
    }


@pytest.mark.parametrize(
    "names",
    [
        ("CFRP_T90_3_20240502.csv", "20240503_CFRP_T90_3_dic.csv"),
        ("2024-05-02_UD_1.csv", "UD_1_2024-05-07_vic3d.csv"),
        ("02.05.2024/UD_1.csv", "03.05.2024/UD_01.csv"),
        ("UD_1_20240502_1030.csv", "UD_1_20240502_1412.csv"),
    ],
)
def test_dates_in_names_do_not_separate_machine_and_camera(lab, profiles, tmp_path, names):
    machine(lab, tmp_path / "mts" / names[0])
    camera(lab, tmp_path / "dic" / names[1])
    (row,) = table_of(propose_sheet(tmp_path, profiles)).to_dict("records")
    assert row["strain_file"] == f"dic/{names[1]}"


def test_a_name_that_is_nothing_but_a_date_keeps_it():
    assert tokens("20240502.csv") == {"20240502": 1}


def test_a_folder_of_frames_is_one_strain_file(lab, profiles, tmp_path):
    for number in (1, 2):
        machine(lab, tmp_path / "MTS" / f"UD_{number}.csv", number)
        for frame in range(6):
            path = tmp_path / "DIC" / f"UD_{number}" / f"UD_{number}-{frame:04d}_0.csv"
            path.parent.mkdir(parents=True, exist_ok=True)
            x, y = (a.ravel().astype(float) for a in np.mgrid[0:4, 0:5])
            columns = {"x [mm]": x, "y [mm]": y, "exx [1]": x * 0 + 0.001 * frame,
                       "eyy [1]": x * 0 - 0.0003 * frame}  # fmt: skip
            lab.write(path, columns)
    table = table_of(propose_sheet(tmp_path, profiles))
    pairs = dict(zip(table["force_file"], table["strain_file"], strict=True))
    assert pairs == {"MTS/UD_1.csv": "DIC/UD_1", "MTS/UD_2.csv": "DIC/UD_2"}
    assert is_there(tmp_path, "DIC/UD_1")


def test_limits_are_those_of_the_configuration(lab, profiles, tmp_path):
    config = tmp_path / "mine.yaml"
    config.write_text("ingest: {limits: {rows: 30}}\nstudies: []\n")
    assert limits_in(config) == FileLimits(rows=30)
    assert limits_in(tmp_path / "none.yaml") == FileLimits()
    machine(lab, tmp_path / "lab" / "a.csv")
    machine(lab, tmp_path / "lab" / "b.csv", 2.0, rows=20)
    proposal = propose_sheet(tmp_path / "lab", profiles, limits_in(config))
    assert [row["force_file"] for row in proposal.rows] == ["b.csv"]
    assert "lines, 30 are allowed" in proposal.left["a.csv"]
    config.write_text("ingest: {limits: {rows: few}}\n")
    with pytest.raises(InputError, match="rows"):
        limits_in(config)


def check(folder, profiles):
    specimens, errors = read_sheet(folder / "specimens.csv")
    assert not errors
    return check_files(specimens, folder / "specimens.csv", IngestSettings(), profiles)


def sheet_of(folder, rows):
    head = "specimen,test,material,orientation_deg,width_mm,thickness_mm,gauge_length_mm,force_file"
    (folder / "specimens.csv").write_text("\n".join([head, *rows]) + "\n")


def test_check_finds_equal_data_in_other_bytes(lab, profiles, tmp_path):
    machine(lab, tmp_path / "a.csv")
    machine(lab, tmp_path / "b.csv", 2.0, rows=40)
    text = (tmp_path / "a.csv").read_text().replace(",", ";")
    (tmp_path / "c.csv").write_text("Exported again\n" + text)
    sheet_of(tmp_path, [f"{n},tension,m,0,10,1,5000,{n}.csv" for n in "abc"])
    faults, notes = check(tmp_path, profiles)
    assert [fault.specimen for fault in faults] == ["c"]
    assert not notes


def test_check_names_a_missing_length_and_a_file_that_cannot_be_read(lab, profiles, tmp_path):
    """A travel or an extension in mm needs the length over which it occurs."""
    time = np.arange(0, 30, 0.5)
    pull = {"Time (s)": time, "Load (N)": 40 * time}
    lab.write(tmp_path / "r.csv", pull | {"Extensometer (mm)": 0.5 * time})
    lab.write(tmp_path / "s.csv", pull | {"Stroke (mm)": 0.51 * time})
    lab.write(tmp_path / "t.csv", pull | {"Crosshead (mm)": 0.02 * time})
    lab.write(tmp_path / "p.csv", pull | {"Crosshead (mm)": 0.021 * time})
    lab.write(tmp_path / "e.csv", pull | {"Extensometer (mm)": 0.002 * time})
    across = {"Axial strain (%)": 0.01 * time, "Transverse extensometer (mm)": -0.0003 * time}
    lab.write(tmp_path / "q.csv", {"Time (s)": time, "Load (N)": 41 * time} | across)
    (tmp_path / "w.csv").write_text("a report, no table\n")
    sheet_of(
        tmp_path,
        [
            "R,rubber_tension,r,,6,2,,r.csv",
            "S,rubber_tension,r,,6,2,,s.csv",
            "T,tension,m,0,10,1,,t.csv",
            "E,tension,m,0,10,1,,e.csv",
            "Q,tension,m,0,10,1,,q.csv",
            "W,tension,m,0,10,1,,w.csv",
            "P,shear,m,45,10,1,,p.csv",
        ],
    )
    faults, notes = check(tmp_path, profiles)
    told = {fault.specimen: fault.message for fault in faults}
    assert told["R"] == told["E"] == "gauge_length_mm is empty: extension cannot become strain"
    assert told["S"] == "gauge_length_mm is empty: displacement cannot become strain"
    assert "no table" in told["W"]
    assert set(told) == {"R", "S", "E", "W"}
    assert notes[0].startswith("T: no strain: gauge_length_mm is empty")
    assert notes[2].startswith("P: no strain: ")
    assert "a shear test needs" in notes[2]
    assert notes[1].startswith("Q: no transverse strain: column 'Transverse extensometer'")


def write_names(lab, folder, names):
    for number, name in enumerate(names):
        machine(lab, folder / name, 1 + 0.01 * number)


@pytest.mark.parametrize(
    ("names", "series"),
    [
        (["2024-05-01_CFRP_01.txt", "2024-05-02_CFRP_02.txt"], {"CFRP": 2}),
        (["T0-1/machine.csv", "T0-2/machine.csv"], {"T0": 2}),
        (["0deg/1.csv", "0deg/2.csv", "90deg/1.csv"], {"0deg": 2, "90deg": 1}),
        (["S1/run1.csv", "S1/run2.csv", "S2/run1.csv", "S2/run2.csv"], {"S": 4}),
        ([f"UD{k}.is_tens_RawData/Specimen_RawData_1.csv" for k in (1, 2)], {"UD1": 1, "UD2": 1}),
    ],
)
def test_series_of_folders_and_dates(lab, profiles, tmp_path, names, series):
    write_names(lab, tmp_path, names)
    proposal = propose_sheet(tmp_path, profiles)
    assert {name: count for name, (count, _) in proposal.open_series().items()} == series
    ids = [row["specimen"] for row in proposal.rows]
    assert len(set(ids)) == len(ids)
    assert not any("RawData" in one or one.endswith("specimen") for one in ids)


def test_cameras_that_count_from_zero_are_not_paired_by_number(lab, profiles, tmp_path):
    write_names(lab, tmp_path, [f"MTS/sp_{number}.csv" for number in (1, 2, 3)])
    for number in (0, 1, 2):
        camera(lab, tmp_path / "DIC" / f"sp_{number}.csv")
    proposal = propose_sheet(tmp_path, profiles)
    assert not any(row.get("strain_file") for row in proposal.rows)
    assert "pair them by hand" in proposal.left["DIC/sp_0.csv"]


def test_a_table_of_dimensions_may_be_transposed(lab, profiles, tmp_path):
    write_names(lab, tmp_path, ["UD-1.csv", "UD-2.csv"])
    table = "Specimen,UD-1,UD-2\nWidth (mm),10,10.1\nThickness (mm),1,1.02\n"
    (tmp_path / "dimensions.csv").write_text(table)
    rows = propose_sheet(tmp_path, profiles).rows
    assert [(row["width_mm"], row["thickness_mm"]) for row in rows] == [
        ("10", "1"), ("10.1", "1.02")]  # fmt: skip


def test_a_length_or_span_that_is_needed_is_listed(lab, profiles, tmp_path):
    pull = {"Time (s)": TIME, "Load (N)": FORCE}
    lab.write(tmp_path / "TPU_75A_1.csv", pull | {"Extensometer (mm)": TIME})
    lab.write(tmp_path / "3PB_1.csv", pull | {"Deflection (mm)": 0.1 * TIME})
    lab.write(tmp_path / "zug_1.csv", pull | {"Crosshead (mm)": 0.1 * TIME, "Strain (%)": TIME})
    series = propose_sheet(tmp_path, profiles).open_series()
    wanted = {name: cells for name, (_, cells) in series.items()}
    assert "gauge_length_mm" in wanted["TPU_75A"]
    assert "span_mm" in wanted["3PB"]
    assert "gauge_length_mm" not in wanted["zug"]
