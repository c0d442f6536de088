import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.responses.strength import (
    PlyStrengths,
    maximum_stress_factor,
    ply_strengths,
    tsai_wu_factor,
)

PLY = PlyStrengths(2000.0, 1200.0, 50.0, 180.0, 80.0)
STRESS = st.tuples(*[st.floats(-100.0, 100.0).filter(lambda s: abs(s) > 1e-3)] * 3)


@pytest.mark.parametrize(
    ("stress", "strength"),
    [
        ((1.0, 0.0, 0.0), 2000.0),
        ((-1.0, 0.0, 0.0), 1200.0),
        ((0.0, 1.0, 0.0), 50.0),
        ((0.0, -1.0, 0.0), 180.0),
        ((0.0, 0.0, -1.0), 80.0),
    ],
)
def test_one_stress_alone_grows_to_its_strength(stress, strength):
    points = np.array([stress])
    assert maximum_stress_factor(points, PLY) == pytest.approx(strength)
    assert tsai_wu_factor(points, PLY) == pytest.approx(strength)


@given(STRESS, st.floats(0.1, 10.0))
def test_factors_fall_as_the_stress_grows(stress, times):
    points = np.array([stress])
    for factor in (maximum_stress_factor, tsai_wu_factor):
        assert factor(times * points, PLY) == pytest.approx(factor(points, PLY) / times, rel=1e-9)


@given(STRESS)
def test_at_the_factor_the_criterion_is_met(stress):
    s1, s2, t = tsai_wu_factor(np.array([stress]), PLY) * np.array(stress)
    f12 = -0.5 / np.sqrt(2000.0 * 1200.0 * 50.0 * 180.0)
    index = (1 / 2000 - 1 / 1200) * s1 + (1 / 50 - 1 / 180) * s2
    index += s1**2 / (2000 * 1200) + s2**2 / (50 * 180) + (t / 80) ** 2 + 2 * f12 * s1 * s2
    assert index == pytest.approx(1.0, rel=1e-6)


def test_the_worst_point_decides_and_no_stress_has_no_limit():
    points = np.array([[1.0, 0.0, 0.0], [0.0, 25.0, 0.0]])
    assert maximum_stress_factor(points, PLY) == pytest.approx(2.0)
    assert tsai_wu_factor(np.zeros((2, 3)), PLY) == np.inf


def statistics(**change):
    rows = [
        ("tension", 0.0, "strength", 2000.0, 1990.0),
        ("tension", 90.0, "strength", 50.0, 51.0),
        ("compression", 0.0, "strength", 1200.0, 1210.0),
        ("shear", 45.0, "shear_strength", 80.0, 81.0),
        ("tension", 0.0, "modulus", 128000.0, 128000.0),
    ]
    columns = ["test", "orientation_deg", "property", "mean", "median"]
    table = pd.DataFrame(rows, columns=columns)
    same = {"material": "cfrp", "scope": "group", "reported_statistic": "mean"}
    return table.assign(**(same | change))


def test_strengths_come_from_the_statistics_and_say_what_is_missing():
    found = ply_strengths(statistics(), "cfrp")
    assert (found.xt_mpa, found.yt_mpa, found.xc_mpa, found.s12_mpa) == (2000, 50, 1200, 80)
    assert found.missing() == ["yc"]
    assert ply_strengths(statistics(reported_statistic="median"), "cfrp").yt_mpa == 51.0
    assert len(ply_strengths(statistics(), "glass").missing()) == 5
    assert ply_strengths(statistics(mean=np.nan), "cfrp").missing() == [
        "xt", "xc", "yt", "yc", "s12",
    ]  # fmt: skip
    assert len(ply_strengths(statistics(), None).missing()) == 5


def test_factors_need_all_strengths():
    with pytest.raises(ValueError, match="not tested: yc"):
        tsai_wu_factor(np.ones((1, 3)), ply_strengths(statistics(), "cfrp"))
