from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from nptcs.calibrate import c10_against_range, calibrate_rubber, compare_models
from nptcs.config.materials.calibration import CalibrationSettings, RubberSettings

Make = Callable[..., Any]
STRAIN = np.linspace(0, 1.2, 1201)


def yeoh(strain: Any, scale: float = 1.0) -> Any:
    stretch = 1 + strain
    i1 = stretch**2 + 2 / stretch - 3
    return 2 * scale * (stretch - stretch**-2) * (1.18 - 0.3 * i1 + 0.09 * i1**2)


@pytest.fixture
def rubber(make_rubber: Make, make_curve: Make) -> tuple[dict[str, Any], list[Any]]:
    scales = {"R-1": 0.98, "R-2": 1.0, "R-3": 1.02}
    curves = {name: make_curve(STRAIN, yeoh(STRAIN, s)) for name, s in scales.items()}
    return curves, [make_rubber(name) for name in scales]


def test_every_model_is_fitted_to_the_same_points(rubber: Any) -> None:
    settings = CalibrationSettings(rubber=RubberSettings(comparison_range=(0.0, 1.0)))
    table = compare_models("rubber_75A", *rubber, settings)
    assert list(table["model"].unique()) == ["neo_hookean", "mooney_rivlin", "yeoh", "ogden"]
    assert len(set(table["points"])) == 1
    by = table.set_index(["model", "constant"])
    for constant, value in {"c10_mpa": 1.18, "c20_mpa": -0.15, "c30_mpa": 0.03}.items():
        assert by.loc[("yeoh", constant), "value"] == pytest.approx(value, rel=1e-6)
        # specimens differ by a factor: the error of the mean is 2 %/√3 of each constant
        assert by.loc[("yeoh", constant), "standard_error"] == pytest.approx(
            abs(value) * 0.02 / np.sqrt(3), rel=1e-6
        )
    assert by.loc[("neo_hookean", "c10_mpa"), "value"] == pytest.approx(0.977, abs=1e-3)
    rmse = table.groupby("model")["rmse_mpa"].first()
    assert rmse["yeoh"] < rmse["ogden"] < rmse["mooney_rivlin"] < rmse["neo_hookean"]
    assert not table["in_card"].any()


def test_the_cards_row_equals_the_card(rubber: Any) -> None:
    settings = CalibrationSettings()
    table = compare_models("rubber_75A", *rubber, settings)
    (row,) = [row for _, row in table.iterrows() if row["in_card"]]
    card = calibrate_rubber("rubber_75A", *rubber, settings)
    c10 = card.constants["c10_mpa"]
    assert row["value"] == pytest.approx(c10.value, rel=1e-9)
    assert row["standard_error"] == pytest.approx(c10.standard_error, rel=1e-9)
    largest = card.fit_quality["largest_error_percent"]
    assert row["largest_error_percent"] == pytest.approx(largest, rel=1e-9)
    assert bool(row["drucker_stable"])


def test_a_model_that_the_data_cannot_determine_is_a_row_that_says_so(
    make_rubber: Make, make_curve: Make
) -> None:
    curves = {"R-1": make_curve([0.0, 0.05, 0.1, 0.2], yeoh(np.array([0.0, 0.05, 0.1, 0.2])))}
    table = compare_models("rubber_75A", curves, [make_rubber("R-1")], CalibrationSettings())
    lacking = table[table["remarks"].str.startswith("not fitted")]
    assert set(lacking["model"]) == {"yeoh", "ogden"}
    assert lacking["value"].isna().all()
    assert lacking["drucker_stable"].isna().all()


def test_unstable_and_uncertain_constants_are_named(make_rubber: Make, make_curve: Make) -> None:
    stretch = 1 + STRAIN
    # Mooney–Rivlin with C01 < 0: 2(λ - λ⁻²)(1.5 - 0.6/λ)
    stress = 2 * (stretch - stretch**-2) * (1.5 - 0.6 / stretch)
    table = compare_models(
        "rubber_75A", {"R-1": make_curve(STRAIN, stress)}, [make_rubber("R-1")],
        CalibrationSettings(rubber=RubberSettings(comparison_range=(0.0, 1.2))),
    )  # fmt: skip
    row = table[table["constant"] == "c01_mpa"].iloc[0]
    assert row["value"] == pytest.approx(-0.6)
    assert not row["drucker_stable"]
    assert "not stable: equibiaxial tension from strain" in row["remarks"]
    rng = np.random.default_rng(4)
    noisy = {"R-1": make_curve(STRAIN, 2 * (stretch - stretch**-2) + rng.normal(0, 0.05, 1201))}
    table = compare_models("rubber_75A", noisy, [make_rubber("R-1")], CalibrationSettings())
    for _, rows in table.groupby("model"):
        uncertain = rows[rows["standard_error"] > rows["value"].abs()]["constant"]
        said = rows["remarks"].str.contains("larger than the value").any()
        assert said == (len(uncertain) > 0)
        assert all(name in rows["remarks"].iloc[0] for name in uncertain)
    assert table["remarks"].str.contains("larger than the value").any()


def test_c10_against_range_of_the_yeoh_rubber(rubber: Any) -> None:
    table = c10_against_range("rubber_75A", *rubber, CalibrationSettings())
    together = table[table["specimen"] == "all"].set_index("strain_high")["c10_mpa"]
    for high, published in ((0.05, 1.179), (0.15, 1.169), (1.0, 0.977)):
        assert together[high] == pytest.approx(published, abs=1e-3)
    assert list(table[table["in_card"]]["strain_high"].unique()) == [0.15]
    one = table[(table["specimen"] == "R-3") & (table["strain_high"] == 0.05)].iloc[0]
    assert one["c10_mpa"] == pytest.approx(1.02 * together[0.05])


def test_specimens_that_do_not_cover_a_range_are_rows_that_say_so(
    rubber: Any, make_rubber: Make, make_curve: Make
) -> None:
    curves, sheet = rubber
    short = np.linspace(0, 0.4, 11)
    curves["R-4"] = make_curve(short, yeoh(short))
    table = c10_against_range(
        "rubber_75A",
        curves,
        [*sheet, make_rubber("R-4"), make_rubber("R-5")],
        CalibrationSettings(),
    )
    rows = table[table["specimen"] == "R-4"].set_index("strain_high")
    assert "2 points in the strain range 0 to 0.05" in rows.loc[0.05, "remarks"]
    assert "strain ends at 0.4, before 0.5" in rows.loc[0.5, "remarks"]
    assert np.isnan(rows.loc[0.5, "c10_mpa"])
    together = table[table["specimen"] == "all"].set_index("strain_high")["remarks"]
    assert together[0.5].startswith("3 specimens")
    assert together[0.3].startswith("4 specimens")
    alone = c10_against_range(
        "rubber_75A", {"R-4": curves["R-4"]}, [make_rubber("R-4")], CalibrationSettings()
    )
    last = alone[(alone["specimen"] == "all") & (alone["strain_high"] == 1.0)].iloc[0]
    assert last["remarks"] == "no specimen covers this range"


def test_three_modes_are_fitted_together(make_rubber: Make, make_curve: Make) -> None:
    stretch = 1 + STRAIN
    c10, c01 = 0.9, 0.25
    curves = {
        "U-1": make_curve(STRAIN, 2 * (stretch - stretch**-2) * (c10 + c01 / stretch)),
        "B-1": make_curve(STRAIN, 2 * (stretch - stretch**-5) * (c10 + c01 * stretch**2)),
        "P-1": make_curve(STRAIN, 2 * (stretch - stretch**-3) * (c10 + c01)),
    }
    sheet = [
        make_rubber("U-1"),
        make_rubber("B-1", "rubber_equibiaxial"),
        make_rubber("P-1", "rubber_pure_shear"),
    ]
    settings = CalibrationSettings(
        rubber=RubberSettings(model="mooney_rivlin", strain_range=(0.0, 1.0))
    )
    card = calibrate_rubber("rubber_75A", curves, sheet, settings)
    assert card.constants["c10_mpa"].value == pytest.approx(c10)
    assert card.constants["c01_mpa"].value == pytest.approx(c01)
    assert "too few specimens of a mode" in card.constants["c10_mpa"].rule
    assert card.covariance is not None
