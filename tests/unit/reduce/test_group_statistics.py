from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.config.materials.reduction import ReductionSettings, StatisticsSettings
from nptcs.errors import InputError
from nptcs.reduce.groups.sample import b_basis_factor, describe_sample, mnr_critical
from nptcs.reduce.groups.statistics import group_statistics
from nptcs.tables.laboratory.properties import PropertiesTable

Make = Callable[..., Any]
SETTINGS = ReductionSettings()
TRAVEL = "crosshead strain: modulus and strains include the compliance of machine and grips"


def properties(
    values: Sequence[float], test: str = "tension", prefix: str = "T", **columns: Any
) -> pd.DataFrame:
    rows = [
        {
            "specimen": f"{prefix}-{i}",
            "test": test,
            "material": "cfrp",
            "property": "modulus",
            "value": value,
            "unit": "MPa",
            "rule": "ASTM D3039 chord, nearest_points",
            "range": "strain 0.001 to 0.003",
            "points": 2,
            "flags": "",
            "orientation_deg": 0.0,
            "r_squared": 0.999,
            "standard_error": 1.0,
            "origin": "measured",
            "range_low": 0.001,
            "range_high": 0.003,
            "origin_effect_percent": np.nan,
        }
        | columns
        for i, value in enumerate(values, start=1)
    ]
    return PropertiesTable.validate(pd.DataFrame(rows))


def sheet(table: pd.DataFrame, make_specimen: Make, **out: str) -> list[Any]:
    rows = table.drop_duplicates("specimen")
    return [
        make_specimen(
            row["specimen"],
            row["test"],
            include=row["specimen"] not in out,
            reason=out.get(row["specimen"], ""),
        )
        for _, row in rows.iterrows()
    ]


@pytest.mark.parametrize(
    ("n", "published"), [(3, 1.154), (5, 1.715), (6, 1.887), (10, 2.290), (30, 2.908), (200, 3.606)]
)
def test_mnr_critical_values_are_those_of_cmh_17_table_8_5_7(n: int, published: float) -> None:
    assert mnr_critical(n) == pytest.approx(published, abs=6e-4)


@pytest.mark.parametrize(
    ("n", "published"), [(3, 6.157), (5, 3.407), (10, 2.355), (18, 1.974), (30, 1.778)]
)
def test_b_basis_factors_are_those_of_cmh_17_table_8_5_10(n: int, published: float) -> None:
    # the handbook's table is itself good to two units of its last digit
    assert b_basis_factor(n) == pytest.approx(published, abs=2e-3)


def test_known_sample(make_specimen: Make) -> None:
    table = properties([21.0, 22.0, 23.0, 24.0, 30.0])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["n"] == row["group_size"] == 5
    assert row["mean"] == 24.0
    assert row["median"] == 23.0
    assert row["standard_deviation"] == pytest.approx(np.sqrt(50 / 4))
    assert row["cv_percent"] == pytest.approx(100 * np.sqrt(12.5) / 24)
    # t(0.975, 4) = 2.776
    half = 2.7764 * np.sqrt(12.5) / np.sqrt(5)
    assert (row["ci95_low"], row["ci95_high"]) == pytest.approx((24 - half, 24 + half), abs=1e-3)
    assert row["mnr"] == pytest.approx(6 / np.sqrt(12.5))
    assert row["outlier_specimens"] == ""
    assert row["b_basis"] == pytest.approx(24 - 3.407 * np.sqrt(12.5), abs=1e-2)
    assert "provisional: n = 5 < 18" in row["notes"]


def test_a_basis_value_that_would_be_negative_is_not_given(make_specimen: Make) -> None:
    table = properties([1.0, 2.0, 3.0, 4.0, 10.0])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert np.isnan(row["b_basis"])
    assert row["k_b"] > 0
    assert "no B-basis: not above zero" in row["notes"]


def test_outlier_is_flagged_and_stays_in(make_specimen: Make) -> None:
    table = properties([100.0, 101.0, 99.0, 100.5, 99.5, 130.0])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["outlier_specimens"] == "T-6"
    assert row["n"] == 6
    assert "not normally distributed" in row["notes"]


def test_leaving_out_is_the_sheets_decision_and_is_shown(make_specimen: Make) -> None:
    table = properties([1.0, 2.0, 3.0, 4.0, 100.0])
    specimens = sheet(table, make_specimen, **{"T-5": "tab debonded"})
    row = group_statistics(table, specimens, SETTINGS).iloc[0]
    assert (row["n"], row["mean"]) == (4, 2.5)
    assert row["left_out"] == "T-5: tab debonded"
    assert np.isnan(row["b_basis"])
    assert "n = 4, ASTM D3039 requires 5" in row["notes"]
    assert "no B-basis: n = 4, at least 5" in row["notes"]


def test_values_not_assessed_are_named_and_empty_groups_stay(make_specimen: Make) -> None:
    table = properties([1.0, np.nan, 3.0])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert (row["n"], row["mean"]) == (2, 2.0)
    assert "assessed: 2 of 3; not assessed: T-2" in row["notes"]
    assert row["group_size"] == 3
    assert row["not_assessed"].startswith("T-2: ")
    table = properties([np.nan])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["n"] == 0
    assert np.isnan(row["mean"])


def test_one_specimen_has_no_scatter_and_equal_values_no_outlier(make_specimen: Make) -> None:
    table = properties([5.0])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["mean"] == 5.0
    assert np.isnan(row["standard_deviation"])
    table = properties([5.0] * 5)
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert (row["standard_deviation"], row["cv_percent"], row["b_basis"]) == (0.0, 0.0, 5.0)
    assert np.isnan(row["mnr"])


def test_ranges_that_differ_inside_a_group_are_reported(make_specimen: Make) -> None:
    other = properties([2.0], prefix="U", range="25 to 50 % of the ultimate strain (below 0.006)")
    table = pd.concat([properties([1.0, 2.0]), other])
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert "ranges differ between specimens" in row["notes"]
    assert " | " in row["range"]


def test_crosshead_strain_is_named_wherever_the_modulus_shows(make_specimen: Make) -> None:
    table = properties([1.0, 2.0, 3.0])
    table["flags"] = TRAVEL
    table.loc[2, "flags"] += "; failure after 20 min"
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert "crosshead strain: T-1, T-2, T-3" in row["notes"]
    assert "flagged: T-1, T-2, T-3" in row["notes"]
    assert row["mean"] == pytest.approx(2.0)


@pytest.mark.parametrize("test", ["tension", "compression", "shear"])
def test_no_mean_mixes_travel_with_sensors(test: str, make_specimen: Make) -> None:
    """A modulus from crosshead travel is a third of the others: it is not one of them."""
    table = properties([90.0, 92.0, 30.0, 91.0], test)
    table.loc[2, "flags"] = TRAVEL
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["mean"] == pytest.approx(91.0)
    assert "T-3: crosshead strain, where other specimens of the group have" in row["not_assessed"]
    assert "assessed: 3 of 4" in row["notes"]


def test_a_strength_needs_no_sensor(make_specimen: Make) -> None:
    table = properties([90.0, 92.0, 91.0]).assign(property="strength")
    table.loc[2, "flags"] = TRAVEL
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["mean"] == pytest.approx(91.0)
    assert row["not_assessed"] == ""


def test_rubber_groups_have_no_orientation_and_report_the_median(make_specimen: Make) -> None:
    table = properties(
        [1.0, 2.0, 6.0], "rubber_tension", "R", orientation_deg=np.nan, material="rubber_75A"
    )
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert np.isnan(row["orientation_deg"])
    assert (row["median"], row["reported_statistic"]) == (2.0, "median")


def test_speed_of_testing_has_no_b_basis_and_strengths_are_not_pooled(
    make_specimen: Make,
) -> None:
    table = properties([1.0, 2.0, 3.0, 4.0, 5.0], property="strain_rate")
    row = group_statistics(table, sheet(table, make_specimen), SETTINGS).iloc[0]
    assert row["mean"] == 3.0
    assert np.isnan(row["b_basis"])
    assert row["notes"] == ""
    table = pd.concat(
        [
            properties([1.0, 2.0], property="strength"),
            properties([3.0, 4.0], "compression", "C", property="strength"),
        ]
    )
    assert set(group_statistics(table, sheet(table, make_specimen), SETTINGS)["scope"]) == {"group"}


def test_specimen_that_the_sheet_does_not_know_is_an_error(make_specimen: Make) -> None:
    table = properties([1.0, 2.0])
    with pytest.raises(InputError, match="specimen T-2: has properties but no row"):
        group_statistics(table, sheet(table, make_specimen)[:1], SETTINGS)


def test_pooled_scatter_is_that_within_the_groups(make_specimen: Make) -> None:
    table = pd.concat(
        [properties([10.0, 12.0, 14.0]), properties([11.0, 12.0, 13.0], "compression", "C")]
    )
    rows = group_statistics(table, sheet(table, make_specimen), SETTINGS)
    pooled = rows[rows["scope"] == "pooled"].set_index("test")
    assert list(pooled.index) == ["tension", "compression", "tension+compression"]
    assert pooled["standard_deviation"].tolist() == pytest.approx([np.sqrt((8 + 2) / 4)] * 3)
    assert pooled["n"].tolist() == [3, 3, 6]
    assert pooled["mean"].tolist() == [12.0, 12.0, 12.0]
    assert pooled["k_b"].tolist() == pytest.approx(
        [b_basis_factor(3, 4), b_basis_factor(3, 4), b_basis_factor(6, 4)]
    )
    # t(0.975, 4) = 2.776, four degrees of freedom also for the groups of three
    assert pooled.loc["tension", "ci95_high"] == pytest.approx(
        12 + 2.7764 * np.sqrt(2.5 / 3), abs=1e-3
    )
    assert "equal means p = 1" in pooled.loc["tension+compression", "notes"]
    assert not pooled["notes"].str.contains("do not pool|is wrong").any()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ([31.0, 32.0, 33.0], "the means differ: one mean for all is wrong"),
        ([10.0, 12.0, 60.0, 100.0, -90.0], "the variances differ: do not pool"),
    ],
)
def test_groups_that_differ_are_reported_as_not_poolable(
    values: list[float], words: str, make_specimen: Make
) -> None:
    tension = properties([10.0, 12.0, 14.0, 11.0, 12.5, 11.5])
    table = pd.concat([tension, properties(values, "compression", "C")])
    rows = group_statistics(table, sheet(table, make_specimen), SETTINGS)
    assert words in rows.iloc[-1]["notes"]


def test_pooled_b_basis_holds_for_every_group_in_95_of_100() -> None:
    rng = np.random.default_rng(9)
    sizes, free, repetitions = (3, 4, 6), 10, 20000
    groups = [rng.normal(0.0, 1.0, (repetitions, n)) for n in sizes]
    pooled = np.sqrt(sum(g.var(1, ddof=1) * (g.shape[1] - 1) for g in groups) / free)
    for group, n in zip(groups, sizes, strict=True):
        below = group.mean(1) - b_basis_factor(n, free) * pooled <= -1.2815516
        assert below.mean() == pytest.approx(0.95, abs=3 * np.sqrt(0.05 * 0.95 / repetitions))


def test_confidence_interval_contains_the_truth_and_b_basis_is_valid_in_95_of_100() -> None:
    rng = np.random.default_rng(3)
    truth, scatter, tenth = 100.0, 4.0, 100.0 - 1.281552 * 4.0
    repetitions, inside, below = 2000, 0, 0
    settings = StatisticsSettings()
    names = [str(i) for i in range(6)]
    for _ in range(repetitions):
        numbers, _ = describe_sample(rng.normal(truth, scatter, 6), names, settings)
        inside += numbers["ci95_low"] <= truth <= numbers["ci95_high"]
        below += numbers["b_basis"] <= tenth
    # three standard deviations of a binomial share at p = 0.95
    margin = 3 * np.sqrt(0.95 * 0.05 / repetitions)
    assert inside / repetitions == pytest.approx(0.95, abs=margin)
    assert below / repetitions == pytest.approx(0.95, abs=margin)


def test_mnr_flags_5_of_100_clean_samples() -> None:
    rng = np.random.default_rng(5)
    samples = rng.normal(0, 1, (20000, 5))
    mnr = np.abs(samples - samples.mean(1, keepdims=True)).max(1) / samples.std(1, ddof=1)
    share = float((mnr > mnr_critical(5)).mean())
    assert share == pytest.approx(0.05, abs=3 * np.sqrt(0.05 * 0.95 / 20000))


@settings(deadline=None)
@given(
    values=st.lists(st.floats(1.0, 1e6), min_size=1, max_size=12),
    factor=st.floats(1e-3, 1e3),
)
def test_units_do_not_change_the_statistics(values: list[float], factor: float) -> None:
    names = [str(i) for i in range(len(values))]
    one, _ = describe_sample(np.array(values), names, StatisticsSettings())
    other, _ = describe_sample(factor * np.array(values), names, StatisticsSettings())
    for key in ("mean", "standard_deviation", "ci95_low", "b_basis", "median"):
        scale = factor * max(values)
        assert other[key] == pytest.approx(factor * one[key], abs=1e-9 * scale, nan_ok=True)
