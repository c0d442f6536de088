"""Any curve that keeps its contract gives a table or an error with a remedy, never a crash."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import nptcs.reduce
from nptcs.config.materials.reduction import (
    AstmD412,
    AstmD3039,
    AstmD3518,
    AstmD6641,
    ReductionSettings,
)
from nptcs.errors import InputError
from nptcs.tables.laboratory.properties import PropertiesTable

Make = Callable[..., Any]
# most curves here end at their largest force: the ingest saw the break
reduce_specimen = partial(nptcs.reduce.reduce_specimen, failure_seen=True)
# the fixtures only hand out functions, nothing that an example could change
PURE_FIXTURES = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
COLUMNS = list(PropertiesTable.to_schema().columns)
TESTS = ("tension", "compression", "shear", "rubber_tension", "rubber_pure_shear")
SETTINGS = ReductionSettings()
NAMES = {
    "tension": {"modulus", "poisson_ratio", "strength", "ultimate_strain"},
    "compression": {"modulus", "poisson_ratio", "strength", "ultimate_strain", "bending_percent"},
    "shear": {"shear_modulus", "offset_shear_strength", "shear_strength"},
    "rubber_tension": {"stress_at_100_percent", "strength", "strain_energy_density"},
    "rubber_pure_shear": {"stress_at_100_percent", "strength", "strain_energy_density"},
}
# finite or empty; sizes that tests of laminates and rubbers have
strains = st.one_of(st.just(float("nan")), st.floats(-0.02, 0.02), st.floats(-0.5, 3.0))
rows = st.tuples(st.floats(-2000.0, 2000.0), strains, strains, strains)

NAN = float("nan")
ONLY_A_PEAK = [(0.0, NAN, NAN, NAN), (-1.0, NAN, NAN, NAN), (1.0, 0.0, NAN, NAN)]
"""A strain at the largest force only, in a loading after the one that is reduced."""


@pytest.mark.parametrize("test", TESTS)
@settings(deadline=None, max_examples=60, suppress_health_check=PURE_FIXTURES)
@given(
    readings=st.lists(rows, min_size=1, max_size=40),
    method=st.sampled_from(["nearest_points", "interpolated", "least_squares"]),
    with_time=st.booleans(),
)
@example(readings=ONLY_A_PEAK, method="nearest_points", with_time=False)
def test_any_curve(
    test: str,
    readings: Any,
    method: Any,
    with_time: bool,
    make_specimen: Make,
    make_curve: Make,
) -> None:
    stress, axial, across, back = np.array(readings).T
    times = np.arange(len(stress)) * 1.0 if with_time else np.nan
    table = make_curve(axial, stress, across, strain_axial_back=back, time_s=times)
    chosen = ReductionSettings(
        astm_d3039=AstmD3039(chord_method=method),
        astm_d6641=AstmD6641(chord_method=method),
        astm_d3518=AstmD3518(chord_method=method),
        astm_d412=AstmD412(),
    )
    if (-stress if test == "compression" else stress).max() <= 0:
        with pytest.raises(InputError, match="Remedy: check the test type"):
            reduce_specimen(table, make_specimen("X-1", test), chosen)
        return
    properties = reduce_specimen(table, make_specimen("X-1", test), chosen)
    assert list(properties.columns) == COLUMNS
    assert NAMES[test] <= set(properties["property"])
    empty = properties["value"].isna()
    assert properties.loc[empty, "flags"].str.contains("not assessed").all()
    assert not properties.loc[~empty, "flags"].str.startswith("not assessed").any()
    assert np.isfinite(properties.loc[~empty, "value"]).all()


def test_scaling_force_scales_moduli_and_strengths_alone(
    make_specimen: Make, make_curve: Make
) -> None:
    rng = np.random.default_rng(6)
    strain = np.linspace(0, 0.012, 241)
    stress = 128000 * strain + rng.normal(0, 3, 241)
    first = reduce_specimen(make_curve(strain, stress, -0.3 * strain), make_specimen(), SETTINGS)
    second = reduce_specimen(
        make_curve(strain, 4.448 * stress, -0.3 * strain), make_specimen(), SETTINGS
    )
    ratio = pd.Series((second["value"] / first["value"]).to_numpy(), first["property"])
    assert ratio[["modulus", "strength"]].tolist() == pytest.approx([4.448, 4.448])
    assert ratio[["poisson_ratio", "ultimate_strain"]].tolist() == pytest.approx([1.0, 1.0])
