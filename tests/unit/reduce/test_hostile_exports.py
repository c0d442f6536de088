"""Exports with a fault that a person sees, from file to properties: read right, or reported."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.errors import InputError
from nptcs.ingest import ingest_specimen
from nptcs.reduce import reduce_record
from nptcs.tables.laboratory.specimens import Specimen

E_MPA, AREA_MM2, ULTIMATE = 120_000.0, 10.0, 0.012
LOADED, AFTER = 600, 15
TIME = np.arange(LOADED + AFTER) / 10
STRAIN = np.append(np.linspace(0, ULTIMATE, LOADED), np.full(AFTER, 0.3 * ULTIMATE))
RANDOM = np.random.default_rng(11)
FORCE = np.where(TIME < 60, E_MPA * AREA_MM2 * STRAIN, 15.0)
FORCE = FORCE + 1e-4 * FORCE.max() * RANDOM.standard_normal(len(TIME))
ALL = {"modulus": E_MPA, "strength": E_MPA * ULTIMATE, "ultimate_strain": ULTIMATE}
STOPPED = {"modulus": E_MPA, "strength": None, "ultimate_strain": None}
Cell = float | str


def text_of(columns: Mapping[str, Sequence[Any]], head: Sequence[str] = (), by: str = ",") -> str:
    """Write columns as a laboratory's program does: names, rows."""

    def cell(value: Any) -> str:
        return value if isinstance(value, str) else f"{value:.8g}"

    rows = [by.join(map(cell, row)) for row in zip(*columns.values(), strict=True)]
    return "\n".join([*head, by.join(columns), *rows]) + "\n"


def reduce(folder: Path, profiles: Any, files: Mapping[str, str], **fields: Any) -> Any:
    """Write, ingest and reduce files; return values and flags by property, and all ingest flags."""
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    standard: dict[str, Any] = {
        "specimen": "S", "test": "tension", "material": "m", "orientation_deg": 0,
        "width_mm": (10.0,), "thickness_mm": (1.0,), "force_file": "a.csv",
    }  # fmt: skip
    specimen = Specimen(**(standard | fields))
    done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    table = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    table = table.set_index("property")
    return table["value"], table["flags"], "; ".join(done.record.flags)


def check(values: Any, flags: Any, expected: Mapping[str, float | None]) -> None:
    for name, value in expected.items():
        if value is None:
            assert np.isnan(values[name]), (name, values[name])
            assert "not assessed" in flags[name]
        else:
            assert values[name] == pytest.approx(value, rel=0.02), (name, flags[name])


def one(force: Any = FORCE, strain: Any = STRAIN, **more: Any) -> dict[str, str]:
    columns = {"Time [s]": np.arange(len(force)) / 10, "Force [N]": force}
    return {"a.csv": text_of(columns | {"Strain [%]": 100 * np.asarray(strain)} | more)}


def both(camera: Mapping[str, Any], **machine: Any) -> dict[str, str]:
    columns = {"Time [s]": TIME, "Load [kN]": FORCE / 1000} | machine
    return {"a.csv": text_of(columns), "b.csv": text_of(camera)}


FRAMES = np.arange(0, 60, 0.5)
SEEN = np.interp(FRAMES, TIME[:LOADED], STRAIN[:LOADED])
LOAD = np.interp(FRAMES, TIME[:LOADED], FORCE[:LOADED])
CAMERA = {"exx [1]": SEEN, "eyy [1]": -0.3 * SEEN}
TICKS = [f"10:{30 + int(x // 60):02d}:{int(x % 60):02d}" for x in TIME]
UP = np.linspace(0, 0.0038, 400)
HELD = np.concatenate([1.2e6 * UP, np.full(50, 4560.0), np.linspace(4560, 0, 50)])
OFF = np.concatenate([UP, np.full(50, 0.0038), np.full(50, -0.01)])
EARLY = slice(60, LOADED + AFTER)


@pytest.mark.parametrize(
    ("name", "files", "fields", "expected", "said"),
    [
        ("gauge off at a stop", one(HELD, OFF), {}, STOPPED, "removed or slipped"),
        ("saturated early", one(strain=np.minimum(STRAIN, 0.0045)), {},
         ALL | {"ultimate_strain": None}, "stands still"),
        ("saturated with noise",
         one(strain=np.minimum(STRAIN, 0.008) + 5e-6 * RANDOM.standard_normal(len(TIME))), {},
         ALL | {"ultimate_strain": None}, "stands still"),
        ("zero set under a tenth of the load",
         one(FORCE[EARLY], np.where(TIME[EARLY] < 60, STRAIN[EARLY] - STRAIN[60], 0.003)), {},
         ALL, ""),
        ("second gauge on the other face",
         one(strain=1.1 * STRAIN, **{"Strain 2 [%]": 90 * STRAIN}), {},
         ALL | {"poisson_ratio": None}, "the other face"),
        ("contraction written positive",
         one(**{"Transverse strain [%]": 30 * STRAIN}), {},
         ALL | {"poisson_ratio": None}, "transverse_factor -1"),
        ("the same, turned by the sheet",
         one(**{"Transverse strain [%]": 30 * STRAIN}), {"transverse_factor": -1},
         ALL | {"poisson_ratio": 0.3}, "multiplied by -1"),
        ("a transverse gauge that comes off",
         one(**{"Transverse strain [%]": np.where(STRAIN < 0.0048, -30 * STRAIN, 0.0)}), {},
         ALL | {"poisson_ratio": 0.3}, ""),
        ("a camera whose second strain grows, too",
         both({"Time_0 [s]": FRAMES, "exx [1]": SEEN, "eyy [1]": 0.3 * SEEN}),
         {"strain_file": "b.csv"}, ALL | {"poisson_ratio": None}, "left out"),
        ("load cell not tared",
         one(np.append(np.zeros(50), FORCE) - 500, np.append(np.zeros(50), STRAIN)), {},
         {"modulus": E_MPA}, "not tared"),
        ("percent called mm/mm",
         {"a.csv": text_of({"Time [s]": TIME[:200], "Force [N]": FORCE[:200],
                            "Strain [mm/mm]": 100 * STRAIN[:200]})}, {}, {}, "wrong_units"),
        ("a travel in volts next to a strain", one(**{"LVDT [V]": TIME}), {}, ALL, ""),
        ("a travel in volts alone",
         {"a.csv": text_of({"Time [s]": TIME, "LVDT [mV]": TIME, "Load [N]": FORCE})}, {},
         {"strength": ALL["strength"], "modulus": None}, "no travel in a unit of length"),
        ("the raw signal next to the force", one(**{"Force [V]": FORCE / 2000}), {}, ALL, ""),
        ("a camera's force in volts",
         both({"Time_0 [s]": FRAMES + 13.3, **CAMERA, "Force [V]": LOAD / 2000 + 0.1}),
         {"strain_file": "b.csv"}, ALL | {"poisson_ratio": 0.3}, ""),
        ("clocks that tick once a second",
         {"a.csv": text_of({"Time": TICKS, "Load [N]": FORCE}),
          "b.csv": text_of({"Time": [f"10:{30 + int(x // 60):02d}:{x % 60:06.3f}" for x in FRAMES],
                            **CAMERA})},
         {"strain_file": "b.csv"}, ALL, ""),
        ("a trigger in volts and frames without a clock",
         both({"Frame": np.arange(1, 124), "exx [1]": STRAIN[::5], "eyy [1]": -0.3 * STRAIN[::5]},
              **{"Trigger [V]": 5.0 * (np.arange(len(TIME)) % 5 == 0)}),
         {"strain_file": "b.csv"}, ALL, ""),
        ("units in the head only",
         {"a.csv": text_of({"Time": TIME, "Force": FORCE / 1000, "Strain": 100 * STRAIN},
                           ["Force unit: kN", "Unit of strain: %", "Einheit Time: s"])},
         {}, ALL, ""),
        ("a strain next to a travel, in a format that names only the travel",
         {"a.csv": text_of({"Name": ["1_1"] * len(TIME), "Time": TIME, "Force": FORCE / 1000,
                            "Stroke": 0.02 * TIME, "Strain_Ext": 100 * STRAIN})
          .replace("Strain_Ext\n", "Strain_Ext\n,Sec,kN,mm,%\n")}, {}, ALL, ""),
        ("two strains that no name tells apart next to a travel",
         {"a.csv": text_of({"Time [s]": TIME, "Load [N]": FORCE, "Crosshead [mm]": 0.02 * TIME,
                            "Strainmaster 7 [%]": 100 * STRAIN, "Strainmaster A [%]": STRAIN})},
         {"gauge_length_mm": 100}, {"strength": ALL["strength"]}, "not read as a strain"),
        ("units in a row of LabVIEW's head",
         {"a.csv": "LabVIEW Measurement\nSeparator\tTab\n***End_of_Header***\n\n"
          "Y_Unit_Label\tKilonewtons\tpercent\nDelta_X\t0.1\t0.1\n***End_of_Header***\t\t\n"
          + text_of({"X_Value": TIME, "Force": FORCE / 1000, "Strain": 100 * STRAIN}, by="\t")},
         {}, ALL, ""),
        ("a row of units with a word before it",
         {"a.csv": "Test 7\nUnits,s,kN,%\nOperator,Ada\n"
          + text_of({"Time": TIME, "Force": FORCE / 1000, "Strain": 100 * STRAIN})},
         {}, ALL, ""),
        ("Fortran's exponents",
         {"a.csv": "Time [s],Force [N],Strain [%]\n"
          + "\n".join(f"{a:.6E},{b:.6E},{100 * c:.6E}".replace("E", "D")
                      for a, b, c in zip(TIME, FORCE, STRAIN, strict=True)) + "\n"},
         {}, ALL, ""),
        ("a strain field per frame without units",
         {"a.csv": text_of({"Time [s]": TIME, "Load [N]": FORCE,
                            "Frame": np.arange(len(TIME)) // 15 + 1})}
         | {f"dic/UD-0001_{k + 1}.csv": text_of({
             "x": np.arange(9.0), "y": np.arange(9.0), "exx": STRAIN[15 * k] + 1e-6 * np.arange(9),
             "eyy": -0.3 * STRAIN[15 * k] + 1e-6 * np.arange(9)}) for k in range(40)},
         {"strain_file": "dic"}, ALL | {"ultimate_strain": 0.012}, "without a unit"),
    ],
    ids=lambda value: value if isinstance(value, str) and value.islower() else "",
)  # fmt: skip
def test_an_export_is_read_correctly_or_the_fault_is_reported(
    tmp_path, profiles, name, files, fields, expected, said
):
    values, flags, words = reduce(tmp_path, profiles, files, **fields)
    check(values, flags, expected)
    assert said in words, words


@pytest.mark.parametrize("at", [0.0015, 0.002, 0.0026])
@pytest.mark.parametrize("step", [2e-4, -2e-4, 5e-4, -5e-4, 2e-3, -2e-3])
def test_a_slip_within_the_range_gives_no_modulus_or_that_before_it(tmp_path, profiles, at, step):
    slipped = STRAIN + np.where(np.arange(len(STRAIN)) > at / ULTIMATE * LOADED, step, 0.0)
    values, flags, _ = reduce(tmp_path, profiles, one(strain=slipped))
    check(values, flags, {"strength": ALL["strength"]})
    before = "chord over another range" in flags["modulus"]
    check(values, flags, {"modulus": E_MPA if before else None})


@pytest.mark.parametrize("readings", [2, 5])
def test_a_slip_over_several_readings_is_found_too(tmp_path, profiles, readings):
    time = np.arange(10 * len(FORCE)) / 100
    fine = np.interp(time, TIME, STRAIN)
    slip = 2e-4 * np.clip((np.arange(len(time)) - 1000) / readings, 0, 1)
    columns = {"Time [s]": time, "Force [N]": np.interp(time, TIME, FORCE),
               "Strain [%]": 100 * (fine + slip)}  # fmt: skip
    values, flags, _ = reduce(tmp_path, profiles, {"a.csv": text_of(columns)})
    check(values, flags, {"modulus": None})


@pytest.mark.parametrize("quantum", [2e-5, 1e-4])
def test_coarse_steps_of_a_logger_are_not_a_slip(tmp_path, profiles, quantum):
    coarse = np.round(STRAIN / quantum) * quantum
    values, flags, _ = reduce(tmp_path, profiles, one(strain=coarse))
    assert values["modulus"] == pytest.approx(E_MPA, rel=0.06), flags["modulus"]


def test_a_shear_strain_of_two_growing_strains_is_not_assessed(tmp_path, profiles):
    gamma = np.append(np.linspace(0, 0.06, 900), np.full(15, 0.02))
    tau = np.append(80 * np.tanh(4500 * gamma[:900] / 80), np.full(15, 0.5))
    columns = {"Time [s]": np.arange(915) / 10, "Load [N]": 20 * tau,
               "Axial strain [%]": 52 * gamma, "Transverse strain [%]": 48 * gamma}  # fmt: skip
    shear = {"test": "shear", "orientation_deg": 45}
    values, flags, words = reduce(tmp_path, profiles, {"a.csv": text_of(columns)}, **shear)
    check(values, flags, {"shear_modulus": None, "shear_strength": None})
    assert "transverse_factor" in words


def test_a_camera_force_in_volts_that_is_another_signal_is_refused(tmp_path, profiles):
    short = {key: value[:90] for key, value in (CAMERA | {"Force [V]": LOAD / 2000}).items()}
    files = both({"Time_0 [s]": FRAMES[:90] + 13.3, **short})
    with pytest.raises(InputError, match="does not follow the machine's force"):
        reduce(tmp_path, profiles, files, strain_file="b.csv")


def test_a_header_entry_above_the_names_is_not_a_row_of_units(tmp_path, profiles):
    files = {"a.csv": "Operator,Ada,\nThickness,1,mm\n" + one()["a.csv"]}
    values, flags, _ = reduce(tmp_path, profiles, files)
    check(values, flags, ALL)


def test_a_rubber_that_breaks_at_four_percent_is_flagged(tmp_path, profiles):
    stretch = np.linspace(1, 5, 800)
    force = np.append(24 * (stretch - stretch**-2), np.full(10, 0.1))
    strain = np.append(stretch - 1, np.full(10, 0.2))
    columns = {"Time [s]": np.arange(810) / 10, "Force [N]": force / 10, "Strain [%]": strain}
    fields = {"test": "rubber_tension", "orientation_deg": None}
    _, _, words = reduce(tmp_path, profiles, {"a.csv": text_of(columns)}, **fields)
    assert "breaks at a strain of 4 %" in words


LOST = "jump away and back"


def changed(readings: Any, rows: Any, value: float) -> Any:
    new = np.array(readings, dtype=float)
    new[rows] = value
    return new


@pytest.mark.parametrize(
    ("force", "strain"),
    [
        (changed(FORCE, slice(110, 130), 0.0), STRAIN),
        (changed(FORCE, slice(598, 600), 3 * FORCE.max()), STRAIN),
        (changed(FORCE, slice(300, 304), -200.0), STRAIN),
        (changed(FORCE, slice(28, 32), 0.0), STRAIN),
        (FORCE, changed(STRAIN, slice(30, 34), 0.0)),
        (FORCE, changed(STRAIN, slice(150, 153), 0.5)),
        (FORCE, changed(STRAIN, slice(99, 102), 0.0)),
    ],
    ids=[
        "load cell out",
        "overshoot at the break",
        "below zero",
        "out early",
        "strain out early",
        "strain up",
        "strain to zero",
    ],
)
def test_a_channel_that_drops_out_for_some_readings_is_emptied(tmp_path, profiles, force, strain):
    values, flags, words = reduce(tmp_path, profiles, one(force, strain))
    check(values, flags, ALL)
    assert LOST in words


@pytest.mark.parametrize("rows", [2, 4])
def test_a_machine_that_lets_go_and_loads_again_is_not_a_lost_cable(tmp_path, profiles, rows):
    """Force and strain leap together: a separate loading, or a step of dead weights."""
    up = np.linspace(0, 0.004, 200)
    strain = np.concatenate([up, np.zeros(rows), up, STRAIN])
    force = np.concatenate([1.2e6 * up, np.zeros(rows), 1.2e6 * up, FORCE])
    values, flags, words = reduce(tmp_path, profiles, one(force, strain))
    check(values, flags, ALL)
    assert LOST not in words


def test_a_large_shift_of_the_origin_is_flagged(tmp_path, profiles):
    strain = np.where(TIME < 60, STRAIN + 0.002, STRAIN)
    values, flags, words = reduce(tmp_path, profiles, one(FORCE, strain))
    check(values, flags, ALL)
    assert "strain origin shifted by -0.002" in words
