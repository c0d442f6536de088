"""Any curve that keeps its contract gives a card or an error with a remedy, never a crash."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from nptcs.calibrate import c10_against_range, calibrate_rubber, compare_models
from nptcs.config.materials.calibration import CalibrationSettings, RubberSettings
from nptcs.errors import InputError

Make = Callable[..., Any]
SETTINGS = CalibrationSettings()
# the fixtures only hand out functions, nothing that an example could change
PURE_FIXTURES = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
points = st.tuples(
    st.one_of(st.just(float("nan")), st.floats(0.0, 0.3), st.floats(-0.9, 3.0)),
    st.floats(-5.0, 50.0),
)


@settings(deadline=None, max_examples=60, suppress_health_check=PURE_FIXTURES)
# no stress above the toe, found by an earlier run
@example(readings=[[(0.0, 0.0), (0.125, 0.0), (0.0, 1.0)]], weights="specimens")
@given(
    readings=st.lists(st.lists(points, min_size=1, max_size=30), min_size=1, max_size=3),
    weights=st.sampled_from(["specimens", "points", "relative"]),
)
def test_any_curves(readings: Any, weights: Any, make_rubber: Make, make_curve: Make) -> None:
    curves = {
        f"R-{i}": make_curve(*np.array(rows, dtype=float).T) for i, rows in enumerate(readings)
    }
    sheet = [make_rubber(name) for name in curves]
    chosen = CalibrationSettings(rubber=RubberSettings(weights=weights))
    try:
        card = calibrate_rubber("rubber_75A", curves, sheet, chosen)
    except InputError as error:
        remedy = error.remedy
    else:
        remedy = "none needed"
        assert np.isfinite(card.constants["c10_mpa"].value)
    assert remedy


@pytest.mark.parametrize("seed", range(3))
def test_tables_of_noise_are_still_tables(seed: int, make_rubber: Make, make_curve: Make) -> None:
    rng = np.random.default_rng(seed)
    strain = np.sort(rng.uniform(0, 1.2, 80))
    curves = {"R-1": make_curve(strain, rng.uniform(0, 2, 80))}
    table = compare_models("rubber_75A", curves, [make_rubber()], SETTINGS)
    assert len(table) == 1 + 2 + 3 + 4
    ranges = c10_against_range("rubber_75A", curves, [make_rubber()], SETTINGS)
    assert set(ranges["specimen"]) == {"R-1", "all"}
