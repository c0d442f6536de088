"""One file of each vendor, as its program writes it; values and units must come out right."""

from __future__ import annotations

import pytest

from nptcs.errors import InputError

CRLF = "\r\n"


def rows(*columns, delimiter=",", decimal=".", quote=""):
    lines = []
    for values in zip(*columns, strict=True):
        cells = [f"{quote}{value:.4f}{quote}".replace(".", decimal) for value in values]
        lines.append(delimiter.join(cells))
    return lines


TIME = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
FORCE = [0.1, 12.5, 24.75, 37.125, 49.5, 61.0]
TRAVEL = [0.0, 0.01, 0.0212, 0.031, 0.0415, 0.05]
STRAIN = [0.0, 0.021, 0.0405, 0.0615, 0.083, 0.1]


def bluehill_en():
    head = [
        "Results Table 1",
        "",
        "",
        "Results Table 2",
        "",
        "",
        "",
        "Time,Extension,Load,Strain 1",
    ]
    body = rows(TIME, TRAVEL, FORCE, STRAIN, quote='"')
    return CRLF.join([*head, "(s),(mm),(kN),(%)", *body, ""])


def bluehill_de():
    body = rows(TIME, TRAVEL, FORCE, STRAIN, delimiter=";", decimal=",", quote='"')
    return CRLF.join(["Zeit;Verfahrweg;Kraft;Dehnung 1", "(s);(mm);(kN);(%)", *body, ""])


def bluehill_pl():
    body = rows(TIME, TRAVEL, FORCE, STRAIN, delimiter=";", decimal=",")
    head = ["Czas;Wydłużenie;Siła;Odkształcenie 1", "(s);(mm);(kN);(%)"]
    return CRLF.join([*head, *body]).encode("cp1250")


def zwick_de():
    head = [
        '"Prüfnorm"\t"ISO 527"',
        '"Probendicke a0"\t0,2\t"mm"',
        '"Prüfzeit"\t"Standardweg"\t"Standardkraft"\t"Dehnung"',
        '"s"\t"mm"\t"kN"\t"%"',
    ]
    body = rows(TIME, TRAVEL, FORCE, STRAIN, delimiter="\t", decimal=",")
    return CRLF.join([*head, *body]).encode("latin-1")


def zwick_en():
    head = ['"Test time";"Standard travel";"Standard force";"Strain"', '"s";"mm";"kN";"%"']
    return CRLF.join([*head, *rows(TIME, TRAVEL, FORCE, STRAIN, delimiter=";")])


def zwick_fr():
    head = [
        '"Épaisseur de l\'éprouvette";1,5;"mm"',
        '"Temps d\'essai";"Course standard";"Force standard";"Déformation"',
        '"s";"mm";"kN";"%"',
    ]
    body = rows(TIME, TRAVEL, FORCE, STRAIN, delimiter=";", decimal=",")
    return CRLF.join([*head, *body]).encode("cp1252")


def mts_793():
    head = [
        "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A",
        "",
        "Data Acquisition\t\t\tTime:\t10.5\tSec\t3/29/2016 1:54:32 PM",
        "Running Time\tAxial Displacement\tAxial Load\tAxial Strain",
        "s\tmm\tkN\t%",
    ]
    return CRLF.join([*head, *rows(TIME, TRAVEL, FORCE, STRAIN, delimiter="\t")])


def mts_testsuite():
    head = ["Specimen 1", "", "Crosshead \tLoad \tTime \tStrain 1 ", "mm\tkN\tsec\t%"]
    return CRLF.join([*head, *rows(TRAVEL, FORCE, TIME, STRAIN, delimiter="\t")])


def trapezium():
    head = ['"Time","Force","Stroke","Strain"', '"sec","kN","mm","%"']
    return CRLF.join([*head, *rows(TIME, FORCE, TRAVEL, STRAIN, quote='"')])


def wdw_gbk():
    head = ["试样编号\tA-1", "时间(s)\t位移(mm)\t力(kN)\t应变(%)"]
    return CRLF.join([*head, *rows(TIME, TRAVEL, FORCE, STRAIN, delimiter="\t")]).encode("gbk")


def plain():
    return "\n".join(["strain_%,time_s,force_kN,travel_mm", *rows(STRAIN, TIME, FORCE, TRAVEL)])


FILES = {
    "bluehill-en": bluehill_en,
    "bluehill-de": bluehill_de,
    "bluehill-pl": bluehill_pl,
    "testxpert-de": zwick_de,
    "testxpert-en": zwick_en,
    "testxpert-fr": zwick_fr,
    "mts-793": mts_793,
    "mts-testsuite": mts_testsuite,
    "trapezium": trapezium,
    "wdw-gbk": wdw_gbk,
    "plain": plain,
}


@pytest.mark.parametrize("name", FILES)
def test_machine_export_is_detected_and_read(read, name):
    table = read(FILES[name]())
    assert table.profile.name == name
    assert table.values["time"] == pytest.approx(TIME)
    assert table.values["force"] == pytest.approx([1000 * force for force in FORCE])
    assert table.values["strain"] == pytest.approx([strain / 100 for strain in STRAIN])
    assert table.values["displacement"] == pytest.approx(TRAVEL)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("name", FILES)
def test_line_ends_do_not_matter(read, name, end):
    content = FILES[name]()
    content = content if isinstance(content, bytes) else content.encode()
    table = read(content.replace(b"\r\n", b"\n").replace(b"\n", end.encode()))
    assert table.values["force"] == pytest.approx([1000 * force for force in FORCE])


def test_vic_3d_with_group_row_phantom_column_and_lost_frame(read):
    lines = [
        '"Average";;;;"Analog";',
        '"Count";"Time [s]";"exx [1] - engr.";"eyy [1] - engr.";"Force";',
    ]
    lines += [f"{n};{n / 2};{-0.0003 * n};{0.001 * n};{1.2 * n};" for n in range(6)]
    lines[4] = "2;1.0;;;2.4;"
    table = read("\n".join(lines), role="strain")
    assert table.profile.name == "vic-3d"
    assert table.values["strain_yy"] == pytest.approx(
        [0, 0.001, float("nan"), 0.003, 0.004, 0.005], nan_ok=True
    )
    assert table.units["force"] == ""
    assert any("phantom" in note for note in table.notes)


def test_aramis_stages(read):
    lines = ["Stage;Time [s];epsilon X [%];epsilon Y [%]"]
    lines += [f"{n};{n / 2};{-0.03 * n:.2f};{0.1 * n:.2f}".replace(".", ",") for n in range(6)]
    table = read("\n".join(lines), role="strain")
    assert table.profile.name == "aramis"
    assert table.values["strain_yy"] == pytest.approx([0, 0.001, 0.002, 0.003, 0.004, 0.005])


def test_hbm_logger_of_channels(read):
    head = [
        "Probe;A-1;INSTRON",
        "Maschine [mm]\tKraft [kN]\tClip-Gauge [mm]\tMX840A_0_CH 5 [V]\tZeit [s]",
    ]
    zeros = [0.0] * 6
    table = read("\n".join([*head, *rows(TRAVEL, FORCE, STRAIN, zeros, TIME, delimiter="\t")]))
    assert table.profile.name == "hbm-logger"
    assert table.values["extension"] == pytest.approx(STRAIN)
    assert table.values["time"] == pytest.approx(TIME)


def test_mts_793_decimal_mark_of_the_first_line_wins(read):
    text = mts_793().replace("|.|", "|,|").replace("ENU", "DEU")
    with pytest.raises(InputError, match="no table of numbers"):
        read(text)
    german = "\n".join(
        line.replace(".", ",") if line[:1].isdigit() else line for line in text.splitlines()
    )
    assert read(german).values["force"][1] == pytest.approx(12500)


def test_profile_named_by_the_sheet_wins_over_detection(read, profiles):
    own = profiles["plain"].model_copy(update={"wrong_units": {"force": "N"}, "name": "own"})
    table = read(plain(), declared=own)
    assert table.values["force"] == pytest.approx(FORCE)
    assert any("instead of 'kN'" in note for note in table.notes)


def test_workbook_profile_on_a_text_is_refused(read, profiles):
    with pytest.raises(InputError, match="is a text"):
        read(plain(), declared=profiles["testxpert-workbook"])
