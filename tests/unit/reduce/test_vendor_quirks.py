"""Invented exports of many programs, each with a quirk: read correctly to the end, or refused.

The names are those that the programs write; all numbers are made up.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest
from written_exports import (
    ACROSS,
    AFTER,
    AREA_MM2,
    E_MPA,
    EXTENSION,
    FORCE,
    FULL,
    KN,
    LENGTH,
    LOADED,
    MICRO,
    PERCENT,
    STRAIN,
    TIME,
    TRAVEL,
    ULTIMATE,
    WITH_NU,
    export,
    reduced,
)

from nptcs.errors import InputError
from nptcs.ingest.inspect import inspect_file


def bluehill(names: Sequence[str], by: str = ",", decimal: str = ".") -> str:
    """Bluehill in a language: time, travel, force, strain of the extensometer."""
    columns = dict(zip(names, (TIME, TRAVEL, KN, PERCENT), strict=True))
    return export(columns, by, decimal, ["(s)", "(mm)", "(kN)", "(%)"], quoted=by == ",")


def blocks(head: Sequence[str], names: bool) -> str:
    """One test in blocks of 100 readings, each under its own header."""
    text = ""
    for start in range(0, len(TIME), 100):
        part = slice(start, start + 100)
        columns = {"Time [s]": TIME[part], "Load [N]": FORCE[part], "Strain [%]": PERCENT[part]}
        body = export(columns, "\t")
        text += "\n".join(head) + "\n" + (body if names else body.partition("\n")[2])
    return text


PULL = {"Time [s]": TIME, "Force [N]": FORCE}
BARS = "| {0:.2f} | {1:.4f} | {2:.6f} |"
LABVIEW = [
    *("LabVIEW Measurement", "Separator\tTab", "***End_of_Header***\t", "", "Channels\t3"),
    *("Y_Unit_Label\tNewtons\tmm\tStrain", "***End_of_Header***\t\t\t"),
]
READ: dict[str, tuple[str | bytes, Mapping[str, float | None], dict[str, Any]]] = {
    "bluehill fr": (bluehill(["Temps", "Extension", "Charge",
                              "Déformation en traction (Déformation 1)"], ";", ","), FULL, {}),
    "bluehill it": (bluehill(["Tempo", "Estensione", "Carico",
                              "Deformazione a trazione (Deformazione 1)"], ";", ","), FULL, {}),
    "bluehill pt": (bluehill(["Tempo", "Extensão", "Carga",
                              "Deformação à tração (Deformação 1)"], ";", ","), FULL, {}),
    "bluehill ja": (bluehill(["時間", "伸び", "荷重", "引張ひずみ (ひずみ 1)"]), FULL, {}),
    "bluehill zh": (bluehill(["时间", "位移", "载荷", "拉伸应变 (应变 1)"]), FULL, {}),
    "bluehill ko": (bluehill(["시간", "변위", "하중", "인장 변형률 (변형률 1)"]), FULL, {}),
    "testxpert, nominal strain next to that of the extensometer": (
        export({"Test time": TIME, "Standard force": FORCE, "Nominal strain": TRAVEL / 1.5,
                "Strain (extensometer)": PERCENT, "Standard travel": TRAVEL}, "\t",
               units=["s", "N", "%", "%", "mm"]), FULL, {}),
    "testxpert, symbols behind the names": (
        export({"Zeit t [s]": TIME, "Kraft F [N]": FORCE, "Dehnung ε [%]": PERCENT,
                "Weg s [mm]": TRAVEL}, ";", ","), FULL, {}),
    "testxpert, change of width in mm": (
        export({"Zeit [s]": TIME, "Standardkraft [N]": FORCE, "Dehnung [%]": PERCENT,
                "Breitenänderung [mm]": 10 * ACROSS}, ";", ","),
        WITH_NU, {"transverse_length_mm": 10.0}),
    "testworks, primary extension": (
        export({"Extension": TRAVEL, "Load": FORCE, "Time": TIME, "Primary Extension": EXTENSION},
               "\t", units=["mm", "N", "sec", "mm"]), FULL, LENGTH),
    "mts, a unit with a slash behind a blank": (
        export({"Time Sec": TIME, "Load N": FORCE, "Crosshead mm": TRAVEL,
                "Strain 1 mm/mm": STRAIN}, "\t"), FULL, {}),
    "mts, command and feedback": (
        export({"Time (s)": TIME, "Axial Force Command (N)": 0 * FORCE + 5,
                "Axial Force Feedback (N)": FORCE, "Axial Strain Feedback (%)": PERCENT,
                "Axial Strain Error (%)": 0 * STRAIN}), FULL, {}),
    "mts, one test in blocks": (blocks(["", "Data Header:\tTime"], names=True), FULL, {}),
    "pages that repeat the names": (blocks([""], names=True), FULL, {}),
    "trapezium, tests side by side under numbers": (
        "1 _ 1,,,,1 _ 2,,,\n" + ",".join(["Time,Force,Stroke,Strain"] * 2) + "\n"
        + ",".join(["sec,N,mm,%"] * 2) + "\n"
        + "\n".join(f"{t:.2f},{f:.4f},{d:.4f},{e:.6f},{t:.2f},{2 * f:.4f},{d:.4f},{e:.6f}"
                    for t, f, d, e in zip(TIME, FORCE, TRAVEL, PERCENT, strict=True)),
        FULL, {"force_part": "1 _ 1"}),
    "galdabini, shortened names": (
        export({"Tempo [s]": TIME, "Forza [N]": FORCE, "Corsa [mm]": TRAVEL,
                "Estens. [mm]": EXTENSION}, ";", ",", head=["Labtest", "Provino: A-1", ""]),
        FULL, LENGTH),
    "galdabini, two elongations": (
        export({"Forza (N)": FORCE, "Allungamento traversa (mm)": TRAVEL,
                "Allungamento estensimetro (mm)": EXTENSION}, "\t", ","), FULL, LENGTH),
    "hegewald, sections in the head": (
        export({"Zeit [s]": TIME, "Prüfkraft F [N]": FORCE, "Traversenweg [mm]": TRAVEL,
                "Dehnung (Feindehnung) [%]": PERCENT}, ";", ",",
               head=["[Prüfung]", "Prüfer=Ada", "[Daten]"]), FULL, {}),
    "tinius olsen, units in words": (
        export({"Time(Seconds)": TIME, "Force(Newtons)": FORCE, "Position(Millimeters)": TRAVEL,
                "Strain(%)": PERCENT}), FULL, {}),
    "lloyd, two extensions": (
        export({"Time (s)": TIME, "Load (N)": FORCE, "Machine Extension (mm)": TRAVEL,
                "Extensometer 1 (mm)": EXTENSION}, "\t"), FULL, LENGTH),
    "wdw, extensometer in words of its own": (
        export({"试验时间(秒)": TIME, "负荷(kN)": KN, "横梁位移(mm)": TRAVEL,
                "引伸计变形(mm)": EXTENSION}, "\t").encode("gbk"), FULL, LENGTH),
    "wdw, large deformation": (
        export({"时间(s)": TIME, "试验力(N)": FORCE, "大变形(mm)": EXTENSION, "位移(mm)": TRAVEL},
               "\t").encode("gbk"), FULL, LENGTH),
    "labview, units in the head": (
        export({"X_Value": TIME, "Force": FORCE, "Stroke": TRAVEL, "Strain gauge": STRAIN,
                "Comment": [""] * len(TIME)}, "\t", head=LABVIEW), FULL, {}),
    "catman, gauges along and across": (
        export({"Time  1 - default sample rate [s]": TIME, "Force_100kN [kN]": KN,
                "SG_long [µm/m]": MICRO, "SG_trans [µm/m]": -0.3 * MICRO}, "\t"), WITH_NU, {}),
    "catman, DMS quer": (
        export({"Zeit  1 - Standardmessrate [s]": TIME, "Kraft [kN]": KN,
                "DMS_längs [µm/m]": MICRO, "DMS_quer [µm/m]": -0.3 * MICRO}, "\t", ","),
        WITH_NU, {}),
    "dewesoft, channel before the name": (
        export({"Time (s)": TIME, "Force (kN)": KN, "AI 2/SG axial (um/m)": MICRO,
                "AI 3/SG lateral (um/m)": -0.3 * MICRO}), WITH_NU, {}),
    "strainsmart, numbered gauges": (
        export({"Time (s)": TIME, "Load (lbf)": FORCE / 4.4482216, "Gage 1 (µε)": MICRO,
                "Gage 2 (µε)": -0.3 * MICRO}), WITH_NU, {}),
    "gauges by letters": (
        export({"t [s]": TIME, "F [N]": FORCE, "e_l [µm/m]": MICRO, "e_t [µm/m]": -0.3 * MICRO}),
        WITH_NU, {}),
    "admet, thousandths of an inch": (
        export({"Load (lbf)": FORCE / 4.4482216, "Extensometer (mil)": EXTENSION / 0.0254,
                "Time (sec)": TIME}), FULL, LENGTH),
    "actuator and piston": (
        export({"Time [s]": TIME, "Actuator force [kN]": KN, "Piston displacement [mm]": TRAVEL,
                "Extensometer strain [%]": PERCENT}), FULL, {}),
    "brackets twice": (
        export({"Zeit (Prüfung) [s]": TIME, "Kraft (Messdose) [N]": FORCE,
                "Dehnung (Extensometer) [%]": PERCENT}, ";", ","), FULL, {}),
    "names written together with units": (
        export({"TimeS": TIME, "ForceKN": KN, "StrainPct": PERCENT}), FULL, {}),
    "names in two rows": (
        "\n".join(["Elapsed;Load;Axial", "Time;Cell;Strain", "s;N;%"])
        + "\n" + export(PULL | {"e": PERCENT}, ";").partition("\n")[2], FULL, {}),
    "names in two rows, the first cell empty": (
        "Time\tAxial\tAxial\n\tLoad\tStrain\nsec\tkN\t%\n"
        + export({"t": TIME, "f": KN, "e": PERCENT}, "\t").partition("\n")[2], FULL, {}),
    "numpy's comment before the names": (
        export({"time_s": TIME, "force_N": FORCE, "strain": STRAIN}, " ", lead="# "), FULL, {}),
    "matlab's comment before the names": (
        export({"Time (s)": TIME, "Load (N)": FORCE, "Strain (%)": PERCENT}, "\t", lead="% ",
               head=["% Test of 5 March"]), FULL, {}),
    "bars around the cells": (
        "| Time [s] | Force [N] | Strain [%] |\n|---|---|---|\n"
        + export(PULL | {"e": PERCENT}, row=BARS).partition("\n")[2], FULL, {}),
    "bars and rules": (
        "+---+---+---+\n| Time [s] | Force [N] | Strain [%] |\n+---+---+---+\n"
        + export(PULL | {"e": PERCENT}, row=BARS).partition("\n")[2] + "+---+---+---+\n",
        FULL, {}),
    "units behind the numbers": (
        export({"Time": TIME, "Force": FORCE, "Strain": PERCENT},
               row="{0:.2f} s,{1:.4f} N,{2:.6f} %"), FULL, {}),
    "units glued to the numbers": (
        export({"Time": TIME, "Force": FORCE, "Strain": PERCENT}, ";",
               row="{0:.2f}s;{1:.4f}N;{2:.6f}%"), FULL, {}),
    "the newest reading first": (
        export({"Time [s]": TIME[::-1], "Force [N]": FORCE[::-1], "Strain [%]": PERCENT[::-1]}),
        FULL, {}),
    "space that was reserved and not filled": (
        export(PULL | {"Strain [%]": PERCENT}).encode() + bytes(512), FULL, {}),
    "a note next to the readings": (
        export(PULL | {"Strain [%]": PERCENT, "Stress": [""] * 3 + ["1440"] + [""] * 308}),
        FULL, {}),
}  # fmt: skip
UNITS = {
    **dict.fromkeys(("10^-6", "E-6", "×10-6", "10-6 m/m", "ppm"), 1e6),
    **dict.fromkeys(("%o", "x10-3", "mStrain"), 1e3),
    "per cent": 1e2,
}
for written, factor in UNITS.items():
    scaled = export(PULL | {f"Strain [{written}]": factor * STRAIN})
    READ[f"strain in {written}"] = (scaled, FULL, {})


@pytest.mark.parametrize("name", READ)
def test_a_quirk_is_read_correctly(tmp_path, profiles, name):
    content, expected, fields = READ[name]
    table, record = reduced(tmp_path, profiles, content, **fields)
    for key, value in expected.items():
        assert table.loc[key, "value"] == pytest.approx(value, rel=0.02), (key, record.flags)
    assert inspect_file(tmp_path / "a.csv", profiles).usable


REFUSED = {
    "units that change": (
        export({"Time": TIME, "Force": [f"{f:.3f} N" if f < 9e3 else f"{f / 1e3:.6f} kN"
                                        for f in FORCE], "Strain": PERCENT}), "a number in kN"),
    "only a largest value": (export({"Time [s]": TIME, "Peak Load [N]": FORCE,
                                     "Strain [%]": PERCENT}), "no column for one of force"),
    "a ton of some country": (export({"Time [s]": TIME, "Force [ton]": FORCE,
                                      "Strain [%]": PERCENT}), "which ton is meant"),
    "a gauge with its sign turned": (export(PULL | {"Strain [%]": -PERCENT}), "falls while"),
    "a stretch in percent": (export(PULL | {"Stretch [%]": 100 + PERCENT}),
                             "not a unit of stretch"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_could_mean_two_things_is_refused(tmp_path, profiles, name):
    content, words = REFUSED[name]
    with pytest.raises(InputError, match=words):
        reduced(tmp_path, profiles, content)


def test_blocks_that_begin_at_zero_again_stay_separate_tests(tmp_path, profiles):
    again = export(PULL | {"Strain [%]": PERCENT}) + "\n" + export(PULL | {"Strain [%]": PERCENT})
    with pytest.raises(InputError, match="holds 2 tests"):
        reduced(tmp_path, profiles, again)


@pytest.mark.parametrize(
    "name", ["Transverse extensometer (mm)", "Lateral displacement (mm)", "Change in width (mm)"]
)
def test_a_transverse_length_gives_no_ratio_without_its_length(tmp_path, profiles, name):
    content = export(PULL | {"Axial strain (%)": PERCENT, name: 10 * ACROSS})
    table, record = reduced(tmp_path, profiles, content)
    assert np.isnan(table.loc["poisson_ratio", "value"])
    assert any("transverse_length_mm" in flag for flag in record.flags)
    table, _ = reduced(tmp_path, profiles, content, transverse_length_mm=10.0)
    assert table.loc["poisson_ratio", "value"] == pytest.approx(0.3, rel=0.02)


def toe(depth: float, softest: float = 0.5) -> tuple[Any, Any]:
    """Strain and stress of a line whose slope grows from `softest` times E up to `depth`."""
    strain = np.linspace(0, ULTIMATE, LOADED)
    slope = E_MPA * np.where(strain < depth, softest + (1 - softest) * strain / depth, 1.0)
    rise = np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(strain))
    return strain, np.append(0.0, rise)


def record_of(strain: Any, stress: Any) -> str:
    force = np.append(AREA_MM2 * stress, np.full(AFTER, 15.0))
    force = force + np.random.default_rng(5).standard_normal(len(force))
    columns = {"Time [s]": TIME, "Force [N]": force}
    return export(columns | {"Strain [%]": 100 * np.append(strain, np.full(AFTER, 0.0036))})


@pytest.mark.parametrize("softest", [0.5, 0.7, 0.8])
@pytest.mark.parametrize("depth", [0.002, 0.003, 0.004, 0.006])
def test_a_toe_that_reaches_into_the_range_is_reported(tmp_path, profiles, depth, softest):
    table, record = reduced(tmp_path, profiles, record_of(*toe(depth, softest)))
    value, flags = table.loc["modulus", ["value", "flags"]]
    close = abs(value / E_MPA - 1) < 0.03
    assert close or "toe" in flags or np.isnan(value), (value, record.flags)


@pytest.mark.parametrize("growth", [0.0, 10.0, 20.0])
def test_fibres_that_stiffen_are_not_a_toe(tmp_path, profiles, growth):
    strain = np.linspace(0, ULTIMATE, LOADED)
    content = record_of(strain, E_MPA * (strain + growth * strain**2 / 2))
    table, _ = reduced(tmp_path, profiles, content)
    assert "toe" not in table.loc["modulus", "flags"]


def stopped(readings: int, seconds: float, back: float) -> str:
    """A run to 0.38 % whose force falls to nothing over some readings; `back`: share of strain."""
    up = np.linspace(0, 0.0038, 400)
    down = np.linspace(1, 0, readings + 2)[1:]
    force = np.concatenate([up, 0.0038 * down, np.zeros(20)]) * E_MPA * AREA_MM2
    strain = np.concatenate(
        [up, 0.0038 * (1 - back * (1 - down)), np.full(20, 0.0038 * (1 - back))]
    )
    force = force + np.random.default_rng(5).standard_normal(len(force))
    return export({"Time [s]": seconds * np.arange(len(force)), "Force [N]": force,
                   "Strain [%]": 100 * strain})  # fmt: skip


@pytest.mark.parametrize(
    ("readings", "seconds", "back", "broken"),
    [
        (1, 0.1, 1.0, False), (2, 0.1, 1.0, False), (3, 0.1, 1.0, False), (6, 0.1, 1.0, False),
        (0, 1.0, 1.0, False), (0, 0.1, 1.0, True), (0, 1.0, 0.3, True), (2, 0.1, 0.2, True),
    ],
)  # fmt: skip
def test_a_quick_return_of_the_machine_is_not_a_break(
    tmp_path, profiles, readings, seconds, back, broken
):
    table, _ = reduced(tmp_path, profiles, stopped(readings, seconds, back))
    assert table.loc["modulus", "value"] == pytest.approx(E_MPA, rel=0.02)
    assert np.isfinite(table.loc["strength", "value"]) == broken, table.loc["strength", "flags"]
