import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import nptcs
import nptcs.reduce
from nptcs.config.materials.reduction import AstmD3039, Iso527, ReductionSettings
from nptcs.errors import InputError
from nptcs.tables.io import read_table, write_table
from nptcs.tables.laboratory.properties import PropertiesTable

Make = Callable[..., Any]
# most curves here end at their largest force: the ingest saw the break
reduce_specimen = partial(nptcs.reduce.reduce_specimen, failure_seen=True)
SETTINGS = ReductionSettings()


def test_tension_recovers_modulus_poisson_ratio_and_strength(
    make_specimen: Make, make_curve: Make, value_of: Make
) -> None:
    strain = np.linspace(0, 0.012, 241)
    table = reduce_specimen(
        make_curve(strain, 128000 * strain, -0.357 * strain), make_specimen(), SETTINGS, "dic"
    )
    assert value_of(table, "modulus") == pytest.approx(128000, rel=1e-12)
    assert value_of(table, "poisson_ratio") == pytest.approx(0.357, rel=1e-12)
    assert value_of(table, "strength") == pytest.approx(1536)
    assert value_of(table, "ultimate_strain") == pytest.approx(0.012)
    assert value_of(table, "strain_rate") == pytest.approx(0.006)
    assert value_of(table, "time_to_failure") == pytest.approx(2.0)
    assert (table["flags"] == "").all()
    row = table.set_index("property").loc["modulus"]
    assert row["rule"] == "ASTM D3039 chord, nearest_points"
    assert row["range"] == "strain 0.001 to 0.003"
    assert (row["range_low"], row["range_high"]) == pytest.approx((0.001, 0.003))
    assert row["r_squared"] == pytest.approx(1.0)


def test_low_ultimate_strain_moves_the_chord_to_25_to_50_percent(
    make_specimen: Make, make_curve: Make, value_of: Make
) -> None:
    # y = a x - b x²: the chord slope tells which range was used
    strain = np.linspace(0, 0.005, 1001)
    curve = make_curve(strain, 9000 * strain - 1e5 * strain**2, -0.02 * strain)
    specimen = make_specimen(orientation_deg=90.0)
    table = reduce_specimen(curve, specimen, SETTINGS)
    assert value_of(table, "modulus") == pytest.approx(9000 - 1e5 * 0.00375, rel=1e-9)
    row = table.set_index("property").loc["modulus"]
    assert row["range"] == "25 to 50 % of the ultimate strain (below 0.006)"
    assert (row["range_low"], row["range_high"]) == pytest.approx((0.00125, 0.0025))
    iso = reduce_specimen(curve, specimen, ReductionSettings(tension_standard="iso_527_4"))
    assert value_of(iso, "modulus") == pytest.approx(9000 - 1e5 * 0.003, rel=1e-9)


def test_iso_527_range_is_its_own_and_each_range_is_configurable(
    make_specimen: Make, make_curve: Make, value_of: Make
) -> None:
    strain = np.linspace(0, 0.01, 1001)
    curve = make_curve(strain, 9000 * strain - 1e5 * strain**2)
    iso = ReductionSettings(tension_standard="iso_527_4")
    table = reduce_specimen(curve, make_specimen(), iso)
    assert value_of(table, "modulus") == pytest.approx(9000 - 1e5 * 0.003, rel=1e-9)
    assert set(table["rule"].str.split(" chord|,").str[0]) == {"ISO 527-4"}
    own = ReductionSettings(
        tension_standard="iso_527_4", iso_527_4=Iso527(chord_range=(0.002, 0.004))
    )
    table = reduce_specimen(curve, make_specimen(), own)
    assert value_of(table, "modulus") == pytest.approx(9000 - 1e5 * 0.006, rel=1e-9)


def test_what_the_data_cannot_give_is_a_row_that_says_why(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    strain = np.linspace(0, 0.012, 241)
    seen = np.where(strain <= 0.002, strain, np.nan)
    curve = make_curve(seen, 128000 * strain, time_s=np.nan)
    table = reduce_specimen(curve, make_specimen(), SETTINGS)
    assert value_of(table, "strength") == pytest.approx(1536)
    for name, words in {
        "modulus": "ends at 0.002",
        "poisson_ratio": "no transverse strain",
        "ultimate_strain": "up to 0.002 only",
        "strain_rate": "no usable times",
        "time_to_failure": "no usable times",
    }.items():
        assert np.isnan(value_of(table, name))
        assert flags_of(table, name).startswith("not assessed: ")
        assert words in flags_of(table, name)


def test_deviations_from_the_standard_go_with_every_value(
    make_specimen: Make, make_curve: Make
) -> None:
    strain = np.linspace(0, 0.012, 241)
    curve = make_curve(strain, 128000 * strain, time_s=np.linspace(0, 1200, 241))
    specimen = make_specimen(width_mm=(12.5, 12.5), thickness_mm=(2.0, 2.0, 2.0))
    table = reduce_specimen(curve, specimen, SETTINGS, "crosshead", ["toe not corrected"])
    for words in (
        "width 12.5 mm, ASTM D3039 recommends 14.25 to 15.75 mm",
        "width measured at 2 of 3 stations",
        "thickness 2 mm",
        "failure after 20 min",
        "crosshead strain",
        "toe not corrected",
    ):
        assert table["flags"].str.contains(words).all(), words


def test_crosshead_strain_is_named_once(make_specimen: Make, make_curve: Make) -> None:
    strain = np.linspace(0, 0.012, 241)
    told = ["crosshead strain: modulus and strains include the compliance of machine and grips"]
    table = reduce_specimen(
        make_curve(strain, 1e5 * strain), make_specimen(), SETTINGS, "crosshead", told
    )
    assert (table["flags"].str.count("crosshead strain") == 1).all()


def test_compression_is_positive_and_uses_both_faces(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    strain = np.linspace(0, 0.010, 201)
    # faces at mean ± 5 %: B = 100 (1.05 - 0.95)/2 = 5 %
    curve = make_curve(
        -1.05 * strain, -120000 * strain, 0.3 * strain, strain_axial_back=-0.95 * strain
    )
    specimen = make_specimen("C0-1", "compression", width_mm=(12.0,))
    table = reduce_specimen(curve, specimen, SETTINGS, "strain_gauge")
    assert value_of(table, "modulus") == pytest.approx(120000, rel=1e-12)
    assert value_of(table, "poisson_ratio") == pytest.approx(0.3, rel=1e-12)
    assert value_of(table, "strength") == pytest.approx(1200)
    assert value_of(table, "ultimate_strain") == pytest.approx(0.01)
    assert value_of(table, "bending_percent") == pytest.approx(5.0)
    assert value_of(table, "bending_at_failure_percent") == pytest.approx(5.0)
    assert (table["flags"] == "").all()
    swapped = curve.rename(
        columns={"strain_axial": "strain_axial_back", "strain_axial_back": "strain_axial"}
    )
    table = reduce_specimen(swapped, specimen, SETTINGS, "strain_gauge")
    assert value_of(table, "bending_percent") == pytest.approx(-5.0)
    assert value_of(table, "modulus") == pytest.approx(120000, rel=1e-12)


def test_bending_beyond_the_limit_is_flagged_and_one_face_is_not_zero(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    strain = np.linspace(0, 0.010, 201)
    specimen = make_specimen("C0-1", "compression", width_mm=(12.0,))
    bent = make_curve(-1.2 * strain, -120000 * strain, strain_axial_back=-0.8 * strain)
    table = reduce_specimen(bent, specimen, SETTINGS, "dic")
    assert value_of(table, "bending_percent") == pytest.approx(20.0)
    assert "bending 20 % beyond 10 %" in flags_of(table, "modulus")
    one = reduce_specimen(make_curve(-strain, -120000 * strain), specimen, SETTINGS, "dic")
    assert np.isnan(value_of(one, "bending_percent"))
    assert "not assessed: strain on one face only" in flags_of(one, "bending_percent")
    assert "bending not assessed" in flags_of(one, "modulus")
    assert value_of(one, "modulus") == pytest.approx(120000)


def shear_curve(make_curve: Make, modulus: float = 3147.0, limit: float = 60.0) -> pd.DataFrame:
    # Ramberg–Osgood-like: τ = τ_y tanh(G γ/τ_y), smooth, with slope G at the origin
    gamma = np.linspace(0, 0.08, 4001)
    tau = limit * np.tanh(modulus * gamma / limit)
    return make_curve(0.6 * gamma, 2 * tau + gamma, -0.4 * gamma)


def test_shear_modulus_offset_strength_and_cut_at_5_percent(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    curve = shear_curve(make_curve)
    specimen = make_specimen("S-1", "shear", width_mm=(25.0,) * 3, thickness_mm=(2.4,) * 3)
    table = reduce_specimen(curve, specimen, SETTINGS, "dic")

    def tau(gamma: Any) -> Any:
        return 60.0 * np.tanh(3147.0 * gamma / 60.0) + gamma / 2

    g12 = (tau(0.006) - tau(0.002)) / 0.004
    assert value_of(table, "shear_modulus") == pytest.approx(g12, rel=1e-9)
    assert value_of(table, "shear_strength") == pytest.approx(tau(0.05), rel=1e-6)
    assert value_of(table, "ultimate_shear_strain") == pytest.approx(0.05)
    assert "still rising" in flags_of(table, "shear_strength")
    # the intersection, found independently by bisection
    low, high = 0.006, 0.08
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if tau(middle) > g12 * (middle - 0.002) else (low, middle)
    assert value_of(table, "offset_shear_strength") == pytest.approx(tau(low), rel=1e-6)


def test_iso_14129_takes_its_range_and_has_no_offset_strength(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    specimen = make_specimen("S-1", "shear")
    table = reduce_specimen(
        shear_curve(make_curve), specimen, ReductionSettings(shear_standard="iso_14129")
    )
    g12 = (60 * (np.tanh(3147 * 0.005 / 60) - np.tanh(3147 * 0.001 / 60)) + 0.002) / 0.004
    assert value_of(table, "shear_modulus") == pytest.approx(g12, rel=1e-9)
    assert np.isnan(value_of(table, "offset_shear_strength"))
    assert "defines no offset" in flags_of(table, "offset_shear_strength")


def test_shear_that_fails_early_or_lacks_a_strain(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    specimen = make_specimen("S-1", "shear")
    gamma = np.linspace(0, 0.01, 201)
    early = make_curve(0.6 * gamma, 2 * 3000 * gamma, -0.4 * gamma)
    table = reduce_specimen(early, specimen, SETTINGS)
    assert value_of(table, "shear_modulus") == pytest.approx(3000)
    assert value_of(table, "shear_strength") == pytest.approx(30)
    assert value_of(table, "ultimate_shear_strain") == pytest.approx(0.01)
    assert "not reached before shear strain 0.01" in flags_of(table, "offset_shear_strength")
    table = reduce_specimen(make_curve(gamma, gamma), specimen, SETTINGS)
    assert table["value"][:4].isna().all()
    assert table["flags"][:4].str.contains("needs axial and transverse strain").all()


def test_recorded_shear_chord_outside_the_standard_is_flagged(
    make_specimen: Make, make_curve: Make, flags_of: Make
) -> None:
    gamma = np.concatenate([np.arange(0, 0.005, 0.0001), [0.0057, 0.0068, 0.008]])
    curve = make_curve(0.6 * gamma, 6000 * gamma, -0.4 * gamma)
    table = reduce_specimen(curve, make_specimen("S-1", "shear"), SETTINGS)
    assert "chord spans 0.0037, ASTM D3518 requires 0.0038 to 0.0042" in flags_of(
        table, "shear_modulus"
    )


def test_wrong_sign_of_the_load_is_an_error(make_specimen: Make, make_curve: Make) -> None:
    strain = np.linspace(0, 0.01, 50)
    with pytest.raises(InputError, match=r"specimen C0-1.*no compressive load"):
        reduce_specimen(
            make_curve(strain, 1e5 * strain), make_specimen("C0-1", "compression"), SETTINGS
        )
    with pytest.raises(InputError, match="no tensile load"):
        reduce_specimen(make_curve(-strain, -1e5 * strain), make_specimen(), SETTINGS)


def test_property_table_survives_a_csv_round_trip(
    make_specimen: Make, make_curve: Make, tmp_path: Any
) -> None:
    strain = np.linspace(0, 0.012, 241)
    table = reduce_specimen(make_curve(strain, 1e5 * strain), make_specimen("001"), SETTINGS)
    pd.testing.assert_frame_equal(PropertiesTable.validate(table), table)
    file = tmp_path / "specimens.csv"
    write_table(file, table, PropertiesTable)
    pd.testing.assert_frame_equal(read_table(file, PropertiesTable), table)
    assert list(PropertiesTable.to_schema().columns)[:10] == [
        *("specimen", "test", "material", "property", "value"),
        *("unit", "rule", "range", "points", "flags"),
    ]


def test_an_interval_that_runs_backwards_is_refused() -> None:
    with pytest.raises(
        ValueError, match=r"chord_range\n.*must run from low to high, got 0.003 to 0.001"
    ):
        AstmD3039(chord_range=(0.003, 0.001))


def test_reduction_of_a_specimen_imports_neither_scipy_nor_matplotlib() -> None:
    program = (
        "import sys, nptcs.reduce; "
        "print([m for m in ('scipy', 'matplotlib', 'sklearn') if m in sys.modules])"
    )
    source = Path(nptcs.__file__).parents[1]
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={"PYTHONPATH": str(source)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == "[]"
