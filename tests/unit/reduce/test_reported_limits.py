"""Reported values pass the same limits as the curve that they come from."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

Make = Callable[..., Any]


def test_a_modulus_in_slack_is_that_of_the_material_or_not_assessed(bench: Any, run: Make) -> None:
    fields = {"width_mm": (10.0,), "gauge_length_mm": 100.0}
    table, _, _ = run(bench.labcases / "slack_before_loading", force_file="c5.csv", **fields)
    value = table.loc["modulus", "value"]
    assert np.isnan(value) or value == pytest.approx(20000, rel=1e-3)


@pytest.mark.parametrize("slack", [0.0035, 0.0015, 0.0022])
def test_slack_is_never_reduced_as_stiffness(
    bench: Any, make_specimen: Make, make_curve: Make, slack: float
) -> None:
    from nptcs.reduce import reduce_specimen

    strain = np.linspace(0, 0.014, 600)
    stress = 1.0 + 20000 * np.maximum(strain - slack, 0)
    table = reduce_specimen(make_curve(strain, stress), make_specimen(), bench.settings, "dic")
    row = table.set_index("property").loc["modulus"]
    assert np.isnan(row["value"])
    assert row["flags"].startswith("not assessed: ")


def test_no_reported_strain_is_negative(bench: Any, run: Make) -> None:
    fields = {"width_mm": (100.0,), "gauge_length_mm": 100.0}
    table, _, _ = run(bench.labcases / "travel_runs_back", force_file="c6.csv", **fields)
    value = table.loc["ultimate_strain", "value"]
    assert np.isnan(value) or value > 0
