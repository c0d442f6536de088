import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.responses.curve import LoadCurve

LOADS = np.linspace(0.0, 5000.0, 11)


def displacement(load):
    return 3.0 * np.sqrt(1.0 + load / 400.0) - 3.0 + load / 400.0


@given(st.floats(500.0, 5000.0))
def test_secant_and_tangent_of_a_known_curve(load):
    point = LoadCurve(displacement(LOADS), LOADS).at_load(load)
    slope = 3.0 / (800.0 * np.sqrt(1.0 + load / 400.0)) + 1.0 / 400.0
    assert point.secant_n_per_mm == pytest.approx(load / displacement(load), rel=5e-3)
    assert point.tangent_n_per_mm == pytest.approx(1.0 / slope, rel=2e-2)


@given(st.floats(1.0, 5000.0))
def test_load_and_displacement_name_the_same_point(load):
    curve = LoadCurve(displacement(LOADS), LOADS)
    point = curve.at_load(load)
    again = curve.at_displacement(point.displacement_mm)
    assert again.load_n == pytest.approx(load, rel=1e-6)


def test_beyond_the_curve_there_is_no_point():
    curve = LoadCurve(displacement(LOADS), LOADS)
    assert curve.at_load(5001.0) is None
    assert curve.at_displacement(25.0) is None
    assert curve.at_displacement(0.0) is None
    assert curve.at_load(5000.0).secant_n_per_mm == pytest.approx(5000.0 / displacement(5000.0))


@pytest.mark.parametrize("loads", [LOADS[:3], LOADS[::-1], np.zeros(5)])
def test_points_that_are_not_a_curve_are_refused(loads):
    with pytest.raises(ValueError, match="four points"):
        LoadCurve(displacement(loads), loads)


@pytest.mark.parametrize("steps", [10, 50])
def test_a_tangent_does_not_follow_the_ripple_of_single_contact_points(steps):
    load = np.linspace(0.0, 5000.0, steps + 1)
    smooth = LoadCurve(displacement(load), load).at_load(5000.0).tangent_n_per_mm
    # contact points come on one at a time: the displacement goes up and down by 5 µm
    for phase in (0.0, 1.5, 3.0):
        ripple = 0.005 * np.sin(2 * np.pi * load / 230.0 + phase) * (load > 0)
        tangent = LoadCurve(displacement(load) + ripple, load).at_load(5000.0).tangent_n_per_mm
        assert tangent == pytest.approx(smooth, rel=0.01)
