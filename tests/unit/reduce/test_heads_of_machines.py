"""Headers as machines write them: read correctly, down to the properties, or refused with a remedy.

Test and export are those of `written_exports`, as in `test_vendor_quirks`; all numbers are made up.
"""

from __future__ import annotations

import numpy as np
import pytest
from written_exports import (
    ACROSS,
    E_MPA,
    EXTENSION,
    FORCE,
    FULL,
    KN,
    LENGTH,
    MICRO,
    PERCENT,
    STRAIN,
    TIME,
    TRAVEL,
    export,
    reduced,
)

from nptcs.errors import InputError
from nptcs.ingest.inspect import inspect_file

TONS = FORCE / 9806.65
POUNDS = FORCE / 4.4482216152605
CLOCK = {"Time (s)": TIME}
NEWTON = CLOCK | {"Load (N)": FORCE}
STRAINS = {
    **{f"{name} (mm)": EXTENSION for name in ("E0", "E1", "Ext1", "Extn", "COD", "AVE", "Estens1")},
    **{name: PERCENT for name in ("E1 (%)", "Extension-1 (%)", "StrainPercentage", "PctStrain")},
    **{name: MICRO for name in (
        "StrainMicro", "Strain_micro", "Strain micro", "Micro_Strain", "uStrain", "microstrain_1",
        "Axial microstrain", "eps_micro", "Strain (µ)", "ひずみ(μ)", "Strain (10^-6 mm/mm)",
    )},
    **{name: 1e3 * STRAIN for name in ("StrainMilli", "Milli Strain", "Strain (um/mm)")},
}  # fmt: skip
LOADS = {
    **{f"Load ({unit})": TONS for unit in ("tonne", "t", "tf", "metric ton", "吨")},
    **{f"Load ({unit})": FORCE / 9.80665 for unit in ("Kgs", "kg.f", "kilograms")},
    **{f"Load ({unit})": POUNDS for unit in ("Lbs.", "pound-force")},
    "Load (klbs)": POUNDS / 1e3, "Force (gmf)": FORCE / 9.80665e-3,
    "Load (kN) - 100kN cell": KN, "100kN Load Cell (N)": FORCE, "Load(Linear:Load) (kN)": KN,
}  # fmt: skip


@pytest.mark.parametrize("name", STRAINS)
def test_a_strain_under_a_short_name_is_read(tmp_path, profiles, name):
    content = export(NEWTON | {"Stroke (mm)": TRAVEL, name: STRAINS[name]})
    table, record = reduced(tmp_path, profiles, content, **LENGTH)
    for key, value in FULL.items():
        assert table.loc[key, "value"] == pytest.approx(value, rel=0.02), (key, record.flags)
    assert "crosshead" not in " ".join(record.flags)


@pytest.mark.parametrize("name", LOADS)
def test_a_load_in_a_unit_of_some_machine_is_read(tmp_path, profiles, name):
    content = export(CLOCK | {name: LOADS[name], "Strain (%)": PERCENT})
    table, record = reduced(tmp_path, profiles, content)
    for key, value in FULL.items():
        assert table.loc[key, "value"] == pytest.approx(value, rel=0.02), (key, record.flags)


@pytest.mark.parametrize("unit", ["ton", "Ton", "tons", "tonf", "T"])
def test_a_ton_among_metric_units_is_metric_and_reported(tmp_path, profiles, unit):
    columns = CLOCK | {f"Load ({unit})": TONS, "Strain (%)": PERCENT, "Disp. (mm)": TRAVEL}
    table, record = reduced(tmp_path, profiles, export(columns))
    assert table.loc["modulus", "value"] == pytest.approx(E_MPA, rel=0.02)
    assert any("metric tons" in flag for flag in record.flags)


@pytest.mark.parametrize(
    "others",
    [{"Strain (%)": PERCENT}, {"Ext (in)": EXTENSION / 25.4},
     {"Disp. (mm)": TRAVEL, "Stress (ksi)": FORCE, "Strain (%)": PERCENT}],
)  # fmt: skip
def test_a_ton_that_may_be_one_of_several_is_refused(tmp_path, profiles, others):
    with pytest.raises(InputError, match="which ton is meant") as caught:
        reduced(tmp_path, profiles, export(CLOCK | {"Load (ton)": TONS} | others), **LENGTH)
    assert "US ton" in caught.value.remedy


@pytest.mark.parametrize(
    ("name", "readings", "words"),
    [
        ("Load x10 (N)", FORCE / 10, "contains a factor, 'x10'"),
        ("Load*10 (N)", FORCE / 10, "factor"), ("Load/10 (N)", FORCE / 10, "factor"),
        ("10*Load (N)", FORCE / 10, "factor"), ("Load (N) x10", FORCE / 10, "factor"),
        ("Force per side (N)", FORCE / 2, "factor"),
        ("Load (x10^3 N)", KN, "'Load .x10.3 N.' may be it"),
        ("Load (10N)", FORCE / 10, "its unit is not known"),
        ("Force (N/mm)", FORCE, "its unit is not known"),
        ("Load Cell 100 kN", FORCE, "no unit for force"),
        ("Load [10 kN]", KN / 10, "not a unit of force"),
    ],
)  # fmt: skip
def test_a_load_whose_scale_cannot_be_told_is_refused(tmp_path, profiles, name, readings, words):
    content = export(CLOCK | {name: readings, "Strain (%)": PERCENT})
    with pytest.raises(InputError, match=words):
        reduced(tmp_path, profiles, content)
    inspection = inspect_file(tmp_path / "a.csv", profiles)
    assert inspection.obstacle() or inspection.unread()


def test_the_sheet_settles_a_factor_in_a_name(tmp_path, profiles):
    content = export(CLOCK | {"Load x10 (N)": FORCE, "Strain (%)": PERCENT})
    table, _ = reduced(tmp_path, profiles, content, force_factor=1.0)
    assert table.loc["modulus", "value"] == pytest.approx(E_MPA, rel=0.02)


@pytest.mark.parametrize(
    ("columns", "units"),
    [
        (CLOCK | {"Load (lbf)": POUNDS, "Strain (%)": PERCENT}, ["s", "N", "%"]),
        (CLOCK | {"Load (lbf)": FORCE, "Strain (%)": PERCENT}, ["s", "N", "%"]),
        (NEWTON | {"Ext (in)": EXTENSION / 25.4}, ["s", "N", "mm"]),
        (NEWTON | {"Gage on S1-Ch2 microstrain": STRAIN}, ["s", "N", "mm/mm"]),
    ],
)
def test_two_units_for_one_column_are_refused(tmp_path, profiles, columns, units):
    with pytest.raises(InputError, match="two units for"):
        reduced(tmp_path, profiles, export(columns, units=units), **LENGTH)


@pytest.mark.parametrize("name", ["Verlängerung (mm)", "LVDT1 (mm)", "Sensor 7 (mm)"])
def test_a_gauge_that_was_not_read_next_to_a_travel_is_named(tmp_path, profiles, name):
    content = export(NEWTON | {"Stroke (mm)": TRAVEL, name: EXTENSION})
    _, record = reduced(tmp_path, profiles, content, **LENGTH)
    assert any("not read as a strain" in flag and name[:5] in flag for flag in record.flags)


def test_two_gauges_of_one_kind_are_refused_by_name(tmp_path, profiles):
    content = export(NEWTON | {"E0 (mm)": EXTENSION, "E1 (mm)": 10 * ACROSS})
    with pytest.raises(InputError, match="several may be it: 'E0' in mm, 'E1' in mm"):
        reduced(tmp_path, profiles, content, **LENGTH)


def test_a_modulus_in_the_table_is_not_a_strain(tmp_path, profiles):
    content = export(NEWTON | {"Strain (%)": PERCENT, "E (GPa)": np.full(len(TIME), 120.0)})
    table, _ = reduced(tmp_path, profiles, content)
    assert table.loc["modulus", "value"] == pytest.approx(E_MPA, rel=0.02)
