"""Files that a person reads at once: the labcases, and further inputs of each kind."""

from __future__ import annotations

import datetime
import zipfile

import numpy as np
import pytest
from openpyxl import Workbook

from nptcs.errors import InputError
from nptcs.ingest.reading.text.clock import clocks_to_seconds, join_grouped_digits

E_MPA = 120_000.0
TIME = np.arange(0, 30.0, 0.5)
STRAIN = 0.0002 * (TIME / 0.5)
FORCE = 10 * E_MPA * STRAIN


@pytest.mark.parametrize(
    ("folder", "file", "modulus_mpa", "profile"),
    [
        ("bluehill_german_sec", "c3.csv", 100_000, "bluehill-de"),
        ("mts793_mm_per_mm", "c4.dat", 100_000, "mts-793"),
        ("mts793_mm_per_mm", "c4.csv", 100_000, "mts-793"),
        ("channel_prefix", "c8.csv", 100_000, "plain"),
        ("workbook_dimension_tag", "tag_A1_B201.xlsx", 100_000, "plain"),
        ("workbook_dimension_tag", "tag_A1_C41.xlsx", 100_000, "plain"),
    ],
)
def test_exports_are_read(lab, folder, file, modulus_mpa, profile):
    done = lab.ingest(lab.cases / folder, file)
    assert lab.modulus(done) == pytest.approx(modulus_mpa, rel=1e-4)
    assert done.record.files[0].format == profile


@pytest.mark.parametrize(
    ("folder", "file"),
    [
        ("nbsp_thousands", "nbsp.csv"),
        ("nbsp_thousands", "narrow.csv"),
        ("clock_time", "hms.csv"),
        ("clock_time", "hms2.csv"),
        ("cyrillic_units", "ru_cp1251.csv"),
    ],
)
def test_exports_of_the_15_mm_coupon_are_read(lab, folder, file):
    done = lab.ingest(lab.cases / folder, file, width_mm=(15.0,))
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=2e-4)
    assert np.diff(done.curve["time_s"]) == pytest.approx(0.5)


def test_a_sheet_is_as_large_as_its_cells(lab):
    for name in ("tag_A1_B201.xlsx", "tag_A1_C41.xlsx"):
        assert lab.ingest(lab.cases / "workbook_dimension_tag", name).record.files[0].rows == 200


@pytest.mark.parametrize("tag", ["A1", "A1:C7", ""])
def test_any_wrong_dimension_tag_is_ignored(lab, tmp_path, tag):
    path = _workbook(tmp_path, zip(TIME, FORCE, 100 * STRAIN, strict=True))
    _edit_sheet(path, lambda xml: _with_tag(xml, tag))
    done = lab.ingest(tmp_path, path.name)
    assert done.record.files[0].rows == len(TIME)
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-6)


def _with_tag(xml: str, tag: str) -> str:
    start = xml.index("<dimension")
    end = xml.index("/>", start) + 2
    return xml[:start] + (f'<dimension ref="{tag}"/>' if tag else "") + xml[end:]


def _workbook(folder, rows, names=("Time [s]", "Load [N]", "Strain [%]")):
    book = Workbook()
    book.active.append(list(names))
    for row in rows:
        book.active.append(
            [cell if isinstance(cell, str | datetime.time) else float(cell) for cell in row]
        )
    path = folder / "book.xlsx"
    book.save(path)
    return path


def _edit_sheet(path, change):
    with zipfile.ZipFile(path) as archive:
        parts = {info.filename: archive.read(info) for info in archive.infolist()}
    name = "xl/worksheets/sheet1.xml"
    parts[name] = change(parts[name].decode()).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for part, content in parts.items():
            archive.writestr(part, content)


def test_formulas_without_values_are_reported(lab):
    with pytest.raises(InputError, match="column Strain holds formulas without stored values"):
        lab.ingest(lab.cases / "formula_without_value", "formula.xlsx", width_mm=(15.0,))


@pytest.mark.parametrize("column", [1, 2])
def test_formulas_in_any_column_are_reported(lab, tmp_path, column):
    rows = [[t, f, 100 * e] for t, f, e in zip(TIME, FORCE, STRAIN, strict=True)]
    for number, row in enumerate(rows, 2):
        row[column] = f"=A{number}*2"
    path = _workbook(tmp_path, rows)
    with pytest.raises(InputError, match="holds formulas without stored values"):
        lab.ingest(tmp_path, path.name)


def test_a_formula_that_is_not_needed_does_not_stop_the_test(lab, tmp_path):
    rows = [
        [t, f, 100 * e, f"=B{n}/10"]
        for n, (t, f, e) in enumerate(zip(TIME, FORCE, STRAIN, strict=True), 2)
    ]
    path = _workbook(tmp_path, rows, ("Time [s]", "Load [N]", "Strain [%]", "mine"))
    assert lab.modulus(lab.ingest(tmp_path, path.name)) == pytest.approx(E_MPA, rel=1e-6)


def test_times_of_day_of_a_workbook_are_seconds(lab, tmp_path):
    start = datetime.datetime(2024, 5, 2, 10, 30)  # noqa: DTZ001
    clock = [(start + datetime.timedelta(seconds=float(t))).time() for t in TIME]
    path = _workbook(
        tmp_path, zip(clock, FORCE, 100 * STRAIN, strict=True), ("Time", "Load [N]", "Strain [%]")
    )
    done = lab.ingest(tmp_path, path.name)
    assert np.diff(done.curve["time_s"]) == pytest.approx(0.5)


def test_spanish_names_and_a_speed_in_the_head(lab):
    done = lab.ingest(
        lab.cases / "spanish_names", "es.xlsx", width_mm=(5.72,), thickness_mm=(1.92,),
        test="rubber_tension", orientation_deg=None,
    )  # fmt: skip
    assert lab.flagged(done, "gauge length 67.7 mm from the file's head")
    assert done.record.files[0].columns["force"] == "Force"


@pytest.mark.parametrize(
    ("file", "strain"), [("ch.dat", "strain"), ("universal.dat", "displacement")]
)
def test_channel_names_of_mts(lab, file, strain):
    done = lab.ingest(lab.cases / "mts_channel_names", file, gauge_length_mm=50)
    assert done.record.files[0].format == "mts-793"
    assert {"force", strain} <= set(done.record.files[0].units)


NAMES = {
    "fr": ("Temps [s]", "Charge [daN]", "Déformation [%]", 0.1, 100),
    "fr2": ("temps (s)", "Effort (kN)", "Allongement relatif (%)", 1e-3, 100),
    "es": ("Tiempo [s]", "Carga [kgf]", "Deformación unitaria [mm/mm]", 1 / 9.80665, 1),
    "pt": ("Tempo (s)", "Força (N)", "Deformação (%)", 1, 100),
    "it": ("Tempo [s]", "Forza [N]", "Deformazione [%]", 1, 100),
    "it2": ("Tempo [s]", "Carico [kN]", "Deformazione assiale [mm/mm]", 1e-3, 1),
    "cs": ("Čas [s]", "Síla [N]", "Poměrné prodloužení [%]", 1, 100),
    "ru": ("Время, с", "Усилие, кН", "Деформация, %", 1e-3, 100),
    "ru2": ("Время [с]", "Нагрузка [кгс]", "Относительная деформация [мм/мм]", 1 / 9.80665, 1),
    "ja": ("時間[sec]", "荷重[kN]", "ひずみ[%]", 1e-3, 100),
    "ja2": ("時間（s）", "試験力（Ｎ）", "歪（％）", 1, 100),
    "zh": ("时间(s)", "试验力(kN)", "应变(%)", 1e-3, 100),
    "tf": ("Time (s)", "Load (tf)", "Strain (%)", 1 / 9806.65, 100),
    "prefix": ("Ch 1 Time [s]", "Primary Load [N]", "Channel 3: Strain [%]", 1, 100),
    "suffix": ("Time_Raw [s]", "Force_Filtered [N]", "Strain_Filtered [%]", 1, 100),
    "index": ("1:Time [s]", "AI 0 Force [kN]", "Sensor 2 Strain [µm/m]", 1e-3, 1e6),
}


@pytest.mark.parametrize("language", NAMES)
@pytest.mark.parametrize(("delimiter", "decimal"), [(";", ","), ("\t", ".")])
def test_labels_and_units_of_many_languages(lab, tmp_path, language, delimiter, decimal):
    time, load, strain, load_scale, strain_scale = NAMES[language]
    columns = {time: TIME, load: load_scale * FORCE, strain: strain_scale * STRAIN}
    lab.write(tmp_path / "a.csv", columns, delimiter, decimal)
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-5)
    assert done.curve["time_s"].notna().all()


@pytest.mark.parametrize(
    ("language", "encoding"),
    [("ru", "cp1251"), ("ru2", "cp1251"), ("cs", "cp1250"), ("ja", "cp932"), ("zh", "gb18030"),
     ("fr", "cp1252"), ("es", "cp1252")],
)  # fmt: skip
def test_eight_bit_encodings_are_recognised_by_known_words(lab, tmp_path, language, encoding):
    time, load, strain, load_scale, strain_scale = NAMES[language]
    columns = {time: TIME, load: load_scale * FORCE, strain: strain_scale * STRAIN}
    lab.write(tmp_path / "a.csv", columns, ";", ",", encoding=encoding)
    assert lab.modulus(lab.ingest(tmp_path, "a.csv")) == pytest.approx(E_MPA, rel=1e-5)


@pytest.mark.parametrize(
    ("name", "unit", "scale", "quantity"),
    [
        ("Axial Extensometer", "mm/mm", 1.0, "strain"),
        ("Strain 1", "mm", 25.0, "extension"),
        ("Extensometer", "%", 100.0, "strain"),
        ("Crosshead Displacement", "%", 100.0, "strain"),
    ],
)
def test_the_unit_says_what_a_channel_is(lab, tmp_path, name, unit, scale, quantity):
    columns = {"Time [s]": TIME, "Load [N]": FORCE, f"{name} [{unit}]": scale * STRAIN}
    lab.write(tmp_path / "a.csv", columns)
    done = lab.ingest(tmp_path, "a.csv", gauge_length_mm=25.0)
    assert quantity in done.record.files[0].units
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-5)
    assert (done.record.strain_source == "crosshead") == name.startswith("Crosshead")


def test_a_load_in_volts_is_not_a_force(lab, tmp_path):
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [V]": FORCE / 1e4, "Strain [1]": STRAIN})
    with pytest.raises(InputError, match="not a unit of force"):
        lab.ingest(tmp_path, "a.csv")


@pytest.mark.parametrize("delimiter", [";", ",", "|"])
def test_a_profile_whose_delimiter_the_file_does_not_keep(lab, tmp_path, delimiter):
    names = ["Running Time", "Axial Force", "Axial Strain"]
    head = [
        "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A",
        "",
        delimiter.join(names),
        delimiter.join(["s", "N", "mm/mm"]),
    ]
    rows = (
        delimiter.join(f"{x:.9g}" for x in row) for row in zip(TIME, FORCE, STRAIN, strict=True)
    )
    (tmp_path / "a.txt").write_text("\n".join([*head, *rows]))
    done = lab.ingest(tmp_path, "a.txt")
    assert done.record.files[0].format == "mts-793"
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-6)


@pytest.mark.parametrize(
    ("text", "joined"),
    [
        ("1\u00a0098,31;2", "1098,31;2"),
        ("12\u202f345\u202f678.9\t1", "12345678.9\t1"),
        ('"1\u2009098"', '"1098"'),
        ("1,1\u00a0098.3,5", "1,1098.3,5"),
        ("1,5\u00a0300,2", "1,5\u00a0300,2"),
        ("1\u00a02\u00a03", "1\u00a02\u00a03"),
        ("0.5\u00a0200\u00a0300", "0.5\u00a0200\u00a0300"),
        ("Kraft\u00a0[N]", "Kraft\u00a0[N]"),
    ],
)
def test_only_thousands_are_joined(text, joined):
    assert join_grouped_digits(text) == joined


@pytest.mark.parametrize(
    ("lines", "seconds"),
    [
        (["00:00:00.000,1,2", "00:00:00.500,1,3"], ["0.000", "0.500"]),
        (["10:30:00,5;1,0;2", "10:30:01,0;1;3"], ["37800,5", "37801,0"]),
        (["0:59.5;1;2", "1:00.5;1;2"], ["59.5", "60.5"]),
        (["23:59:59.5\t1\t2", "00:00:00.5\t1\t2"], ["86399.5", "86400.5"]),
        (["11:59:59 PM;1;2", "12:00:01 AM;1;2"], ["86399", "86401"]),
        (["2024-05-02T10:30:00.25;1;2", "2024-05-02T10:30:01.25;1;2"], ["37800.25", "37801.25"]),
        (
            ["02.05.2024 10:30:00:250;1;2", "02.05.2024 10:30:01:250;1;2"],
            ["37800.250", "37801.250"],
        ),
    ],
)
def test_clocks(lines, seconds):
    plain = clocks_to_seconds(["Time;Load;Strain", *lines])
    for line, wanted in zip(plain.lines[1:], seconds, strict=True):
        assert line.startswith(wanted)
        assert not line[len(wanted)].isdigit()
    assert plain.lines[0] == "Time;Load;Strain"


def test_a_clock_in_one_row_only_is_refused(lab, tmp_path):
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [1]": STRAIN})
    lines = (tmp_path / "a.csv").read_text().splitlines()
    cells = lines[10].split(",")
    lines[10] = ",".join([cells[0], "10:30:00", cells[2]])
    (tmp_path / "a.csv").write_text("\n".join(lines))
    with pytest.raises(InputError, match="only some rows of the table have a time"):
        lab.ingest(tmp_path, "a.csv")


def test_a_time_without_unit_does_not_stop_one_file(lab, tmp_path):
    lab.write(tmp_path / "a.csv", {"Time": TIME, "Load [N]": FORCE, "Strain [1]": STRAIN})
    done = lab.ingest(tmp_path, "a.csv")
    assert done.curve["time_s"].isna().all()
    assert any("no unit, left out" in note for note in done.record.files[0].notes)
