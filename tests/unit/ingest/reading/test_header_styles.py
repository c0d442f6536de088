"""Names, units and numbers as laboratories write them: all are read to the same modulus."""
# ruff: noqa: E501  (headers as they are)

from __future__ import annotations

import numpy as np
import pytest

from nptcs.errors import InputError
from nptcs.ingest.reading.unit_in_name import split_unit

E_MPA = 100_000.0
TIME = np.arange(0, 60, 0.5)
STRAIN = 2e-4 * TIME
FORCE = 10 * E_MPA * STRAIN
POUND = 4.4482216152605

# header lines; the unit of force in N, and of strain
STYLES = {
    "bluehill universal": ('"Time","Force","Tensile strain (Strain 1)"\n"(s)","(N)","(%)"', 1, 0.01),
    "bluehill french": ("Temps,Charge,Déformation en traction (Déformation 1)\n(s),(kN),(%)", 1e3, 0.01),
    "bluehill italian": ("Tempo,Carico,Deformazione a trazione (Deformazione 1)\n(s),(N),(%)", 1, 0.01),
    "zwick optical": ("Prüfzeit,Kraft,Dehnung (optisch)\ns,N,%", 1, 0.01),
    "slash": ("t/s,F/N,ε/%", 1, 0.01),
    "slash with blanks": ("t / s,F / kN,ε / %", 1e3, 0.01),
    "snake": ("time_s,load_kN,strain_percent", 1e3, 0.01),
    "dots": ("Time.s,Load.kN,Strain.pct", 1e3, 0.01),
    "dash": ("Время - с,Нагрузка - кН,Деформация - %", 1e3, 0.01),
    "blank": ("Time s,Load N,Strain %", 1, 0.01),
    "units above the names": ("s,N,%\nTime,Load,Strain", 1, 0.01),
    "types below the names": ("Time,Load,Strain\ns,N,%\nfloat,float,float", 1, 0.01),
    "words": ("Time (seconds),Load (Newton),Strain (percent)", 1, 0.01),
    "pounds": ("Time (sec),Load (lb-f),Strain (inch/inch)", POUND, 1),
    "kilograms": ("Time (sec),Load (kg-f),Strain (microstrains)", 9.80665, 1e-6),
    "millistrain": ("Time (s),Load (kN),Strain (millistrain)", 1e3, 1e-3),
    "microsiemens": ("Time (s),Load (kN),Strain (µS)", 1e3, 1e-6),
    "spaced unit": ("Time (s),Load (N),Strain (mm / mm)", 1, 1),
    "percent in the name": ("Time [s],Load [N],Percentage Strain", 1, 0.01),
    "microstrain in the name": ("Time [s],Load [N],Microstrain", 1, 1e-6),
    "percent sign before": ("Time [s],Load [N],% Strain", 1, 0.01),
    "averaged": ("Time_1 [s],Load_avg [N],Strain_avg [%]", 1, 0.01),
    "corrected": ("Time [s],Load corrected [N],Corrected strain (laser) [%]", 1, 0.01),
    "daq channels": ("cDAQ1Mod1/ai0 Time [s],Dev1/ai0 Force [N],Dev1/ai1 Strain [µm/m]", 1, 1e-6),
    "hbm channels": ("Zeit [s],MX840A_CH1 Kraft [kN],MX840A_CH2 Dehnung [µm/m]", 1e3, 1e-6),
    "russian axial": ("Время (с),Сила (кН),Деформация продольная (%)", 1e3, 0.01),
    "korean": ("시간(s),하중(N),변형률(%)", 1, 0.01),
    "turkish": ("Zaman (s),Kuvvet (N),Uzama (%)", 1, 0.01),
    "dutch": ("Tijd (s),Kracht (N),Rek (%)", 1, 0.01),
    "swedish": ("Tid (s),Kraft (N),Töjning (%)", 1, 0.01),
    "turkish unit strain": ("Zaman (sn),Yük (kN),Birim Uzama (%)", 1e3, 0.01),
    "turkish gerinim": ("Zaman [s],Kuvvet [N],Gerinim [mm/mm]", 1, 1),
    "turkish change of shape": ("Zaman [s],Kuvvet [N],Birim Şekil Değiştirme [%]", 1, 0.01),
    "hungarian": ("Idő [s],Erő [N],Fajlagos nyúlás [%]", 1, 0.01),
    "norwegian": ("Tid [s],Kraft [N],Tøyning [%],Forskyvning [mm]", 1, 0.01),
    "dutch load": ("Tijd (s),Belasting (N),Rek extensometer (%)", 1, 0.01),
    "finnish": ("Aika [s],Kuormitus [kN],Venymä (anturi) [%]", 1e3, 0.01),
    "czech extensometer": ("Čas [s],Síla [N],Příčník [mm],Průtahoměr [%]", 1, 0.01),
    "traditional chinese": ("時間(秒),荷重(公斤),應變(%)", 9.80665, 0.01),
    "chinese kilogram-force": ("时间(s),力(千克力),应变(%)", 9.80665, 0.01),
    "units named in the head": ("Time,s\nLoad,kN\nStrain,%\n\nTime,Load,Strain", 1e3, 0.01),
    "units named with a colon": ("Load: kN\nStrain: µm/m\n\nTime (s),Load,Strain", 1e3, 1e-6),
    "units in one line": ("Units: s; N; %\n\nTime,Load,Strain", 1, 0.01),
    "axes": ("Time [s],Load [N],Strain Y [%]", 1, 0.01),
}  # fmt: skip


def rows(force_unit=1.0, strain_unit=1.0, form="{:.7g}", mark=","):
    columns = (TIME, FORCE / force_unit, STRAIN / strain_unit)
    return [mark.join(form.format(v) for v in row) for row in zip(*columns, strict=True)]


@pytest.mark.parametrize("style", STYLES)
def test_header_styles(lab, tmp_path, style):
    header, force_unit, strain_unit = STYLES[style]
    width = header.splitlines()[-1].count(",") + 1
    readings = rows(force_unit, strain_unit)
    if width == 4:  # a travel that must not be taken, before the strain or after it
        last = "Forskyvning" in header
        cells = [row.split(",") for row in readings]
        readings = [",".join(c + ["7"] if last else [*c[:2], "7", c[2]]) for c in cells]
    text = "\n".join([header, *readings])
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-4)
    assert done.record.strain_source != "crosshead"
    assert np.diff(done.curve["time_s"]) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("form", "swap"),
    [
        ("{:,.4f}", str.maketrans(",.", " ,")),
        ("{:,.4f}", str.maketrans(",", "'")),
        ("{:,.4f}", str.maketrans(",", "\u2019")),
        ("{:,.4f}", str.maketrans(",.", ".,")),
    ],
)
def test_thousands_marks_of_many_countries(lab, tmp_path, form, swap):
    lines = [line.translate(swap) for line in rows(1, 0.01, form, ";")]
    (tmp_path / "a.csv").write_text("\n".join(["Time [s];Load [N];Strain [%]", *lines]))
    assert lab.modulus(lab.ingest(tmp_path, "a.csv")) == pytest.approx(E_MPA, rel=1e-3)


def test_a_minus_sign_that_is_not_a_hyphen(lab, tmp_path):
    lines = [row.replace("0,0,0", "\u22120.5,\u22121,\u22120.0001") for row in rows(1, 0.01)]
    (tmp_path / "a.csv").write_text("\n".join(["Time [s],Load [N],Strain [%]", *lines]))
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-4)


@pytest.mark.parametrize(
    "word", ["#NV", "#DIV/0!", "#WERT!", "Inf", "-inf", "n. def.", "k.A.", "—", "None", "NaN(ind)"]
)
def test_words_for_no_value(lab, tmp_path, word):
    lines = rows(1, 0.01)
    for at in (40, 41, 80):
        lines[at] = ",".join([*lines[at].split(",")[:2], word])
    (tmp_path / "a.csv").write_text("\n".join(["Time [s],Load [N],Strain [%]", *lines]))
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-4)
    assert len(done.curve) == len(TIME) - 3


@pytest.mark.parametrize("gap", ["", "\n"])
def test_a_summary_below_the_readings_is_left_out(lab, tmp_path, gap):
    end = f"{gap}Maximum,{FORCE.max()},1.19\nMean,5950,0.595\nStd. dev.,3000,0.3"
    text = "\n".join(["Time [s],Load [N],Strain [%]", *rows(1, 0.01), end])
    (tmp_path / "a.csv").write_text(text)
    done = lab.ingest(tmp_path, "a.csv")
    assert done.record.files[0].rows == len(TIME)
    assert any("'Maximum', is a summary" in note for note in done.record.files[0].notes)


def test_a_word_in_the_middle_of_the_readings_is_not_a_summary(lab, tmp_path):
    lines = rows(1, 0.01)
    lines[50] = "Maximum,1,1"
    (tmp_path / "a.csv").write_text("\n".join(["Time [s],Load [N],Strain [%]", *lines]))
    with pytest.raises(InputError, match="not a number"):
        lab.ingest(tmp_path, "a.csv")


def test_a_time_with_its_zone(lab, tmp_path):
    stamps = [f"2024-05-02T10:00:{t:06.3f}+02:00" for t in TIME]
    lines = [f"{s},{f:.6g},{100 * e:.6g}" for s, f, e in zip(stamps, FORCE, STRAIN, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["timestamp,Load [N],Strain [%]", *lines]))
    done = lab.ingest(tmp_path, "a.csv")
    assert np.diff(done.curve["time_s"]) == pytest.approx(0.5)


def test_travel_over_a_length_is_crosshead_strain_even_where_it_is_the_only_one(lab, tmp_path):
    text = "\n".join(["Time [s],Load [N],Tensile strain (Extension) [%]", *rows(1, 0.01)])
    (tmp_path / "a.csv").write_text(text)
    done = lab.ingest(tmp_path, "a.csv")
    assert done.record.strain_source == "crosshead"
    assert lab.flagged(done, "crosshead strain")


@pytest.mark.parametrize("name", ["True strain [%]", "Plastic strain [%]", "Strain rate [%]"])
def test_another_quantity_is_not_taken_for_the_strain(lab, tmp_path, name):
    (tmp_path / "a.csv").write_text("\n".join([f"Time [s],Load [N],{name}", *rows(1, 0.01)]))
    with pytest.raises(InputError, match="no column for one of strain"):
        lab.ingest(tmp_path, "a.csv")


@pytest.mark.parametrize(("last", "rubber"), [(0.35, False), (8.0, True)])
def test_a_strain_without_unit_that_may_be_percent_is_refused(lab, tmp_path, last, rubber):
    """Percent without a unit; both readings are plausible moduli, 100 times apart."""
    strain = np.linspace(0, last, 60)
    force = (0.02 if rubber else 1250.0) * 10 * strain
    lab.write(tmp_path / "a.csv", {"Time [s]": strain, "Load [N]": force, "Strain": strain})
    fields = {"test": "rubber_tension", "orientation_deg": None} if rubber else {}
    with pytest.raises(InputError, match="may be a strain or a percentage"):
        lab.ingest(tmp_path, "a.csv", **fields)


@pytest.mark.parametrize(("last", "modulus"), [(0.012, 120_000), (0.15, 200_000), (0.004, 9_000)])
def test_a_strain_without_unit_that_can_only_be_a_strain_is_flagged(lab, tmp_path, last, modulus):
    strain = np.linspace(0, last, 400)
    columns = {"Time [s]": strain, "Load [N]": modulus * 10 * strain, "Strain": strain}
    lab.write(tmp_path / "a.csv", columns)
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.modulus(done) == pytest.approx(modulus, rel=1e-4)
    assert lab.flagged(done, "strain without a unit")


@pytest.mark.parametrize(
    ("text", "name", "unit"),
    [
        ("Force [kN]", "Force", "kN"),
        ("F/N", "F", "N"),
        ("Load N", "Load", "N"),
        ("Force min", "Force min", None),
        ("Load in", "Load in", None),
        ("Channel 1", "Channel 1", None),
        ("mm/mm", "mm/mm", None),
        ("Axial strain", "Axial strain", None),
        ("Dev1/ai0 Force", "Dev1/ai0 Force", None),
        ("ForcekN", "Force", "kN"),
        ("LoadKN", "Load", "kN"),
        ("SignalkN", "SignalkN", None),
        ("ForcemN", "ForcemN", None),
        ("StressMPa", "Stress", "MPa"),
        ("LaufzGit", "LaufzGit", None),
        ("力(kN", "力", "kN"),
        ("Kraft [kN", "Kraft", "kN"),
    ],
)
def test_where_a_name_ends_and_its_unit_begins(text, name, unit):
    assert split_unit(text) == (name, unit)
