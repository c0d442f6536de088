import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.config.materials.reduction import ChordMethod
from nptcs.reduce.curve.chord import chord_slope, fit_line

METHODS: tuple[ChordMethod, ...] = ("nearest_points", "interpolated", "least_squares")


@pytest.mark.parametrize("method", METHODS)
@settings(deadline=None)
@given(
    slope=st.floats(1.0, 2e5),
    intercept=st.floats(-100.0, 100.0),
    points=st.integers(60, 400),
)
def test_straight_line_gives_its_slope_by_every_method(
    method: ChordMethod, slope: float, intercept: float, points: int
) -> None:
    x = np.linspace(0.0, 0.008, points)
    chord = chord_slope(x, intercept + slope * x, 0.001, 0.003, method)
    # rounding of y = intercept + slope x over a rise of slope × 0.002
    tolerance = 1e-12 * (1 + abs(intercept) / (0.002 * slope)) * 10
    assert chord.slope == pytest.approx(slope, rel=max(tolerance, 1e-10))


def test_methods_differ_on_a_curved_line_exactly_as_the_calculus_says() -> None:
    # y = a x - b x²: the chord between 1 and 3 mm/m is a - b (x1 + x2), and so is the
    # least-squares slope for symmetric spacing
    x = np.linspace(0.0, 0.004, 41)
    y = 1000 * x - 20000 * x**2
    expected = 1000 - 20000 * 0.004
    for method in METHODS:
        assert chord_slope(x, y, 0.001, 0.003, method).slope == pytest.approx(expected, rel=1e-12)


def test_nearest_points_and_interpolation_differ_between_readings() -> None:
    x = np.array([0.0, 0.0009, 0.0019, 0.0031, 0.005])
    y = 1e6 * x**2
    nearest = chord_slope(x, y, 0.001, 0.003, "nearest_points")
    interpolated = chord_slope(x, y, 0.001, 0.003, "interpolated")
    assert nearest.slope == pytest.approx(1e6 * (0.0009 + 0.0031))
    assert (nearest.x_low, nearest.x_high, nearest.points) == (0.0009, 0.0031, 2)
    y1 = y[1] + 0.1 * (y[2] - y[1])
    y2 = y[2] + (0.0011 / 0.0012) * (y[3] - y[2])
    assert interpolated.slope == pytest.approx((y2 - y1) / 0.002)
    assert interpolated.points == 3


def test_r_squared_is_that_of_the_points_in_the_range_whatever_the_method() -> None:
    rng = np.random.default_rng(1)
    x = np.linspace(0, 0.005, 101)
    y = 1e5 * x + rng.normal(0, 5, 101)
    inside = (x >= 0.001) & (x <= 0.003)
    expected = np.corrcoef(x[inside], y[inside])[0, 1] ** 2
    for method in METHODS:
        assert chord_slope(x, y, 0.001, 0.003, method).r_squared == pytest.approx(expected)


@pytest.mark.parametrize("method", METHODS)
def test_standard_error_is_the_scatter_seen_over_repetitions(method: ChordMethod) -> None:
    rng = np.random.default_rng(7)
    x = np.linspace(0, 0.005, 101)
    chords = [
        chord_slope(x, 1e5 * x + rng.normal(0, 2.0, 101), 0.001, 0.003, method) for _ in range(1500)
    ]
    seen = np.std([c.slope for c in chords])
    stated = np.sqrt(np.mean([c.standard_error**2 for c in chords]))
    # 1500 repetitions fix a standard deviation within 2 % (one sigma)
    assert stated == pytest.approx(seen, rel=0.08)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("low", "high", "words"), [(0.001, 0.02, "ends"), (-0.01, 0.003, "begins")]
)
def test_a_curve_that_does_not_cover_the_range_is_not_assessed(
    method: ChordMethod, low: float, high: float, words: str
) -> None:
    x = np.linspace(0, 0.008, 81)
    chord = chord_slope(x, 1e5 * x, low, high, method)
    assert np.isnan(chord.slope)
    assert chord.flags[0].startswith("not assessed")
    assert words in chord.flags[0]


def test_sparse_readings_are_flagged_and_one_reading_is_not_a_chord() -> None:
    x = np.array([0.0, 0.0014, 0.0029, 0.006])
    chord = chord_slope(x, x, 0.001, 0.003, "nearest_points")
    assert "nearest to 0.001 is 0.0014" in chord.flags[0]
    alone = chord_slope(np.array([0.0, 0.002, 0.009]), np.zeros(3), 0.0011, 0.003, "nearest_points")
    assert "same recorded point" in alone.flags[0]
    few = chord_slope(x, x, 0.001, 0.003, "least_squares")
    assert "fewer than three" in few.flags[0]


def test_unloading_inside_the_range_is_flagged() -> None:
    x = np.concatenate([np.linspace(0, 0.0025, 26), np.linspace(0.0024, 0.001, 15)])
    x = np.concatenate([x, np.linspace(0.0011, 0.006, 50)])
    assert "goes back by 0.0015" in chord_slope(x, x, 0.001, 0.003, "nearest_points").flags[0]
    up = np.linspace(0, 0.006, 61)
    assert chord_slope(up, up, 0.001, 0.003, "nearest_points").flags == ()


def test_readings_after_the_first_passage_do_not_matter() -> None:
    up = np.linspace(0, 0.004, 41)
    back = np.linspace(0.004, 0.0, 40)
    x, y = np.concatenate([up, back]), np.concatenate([1e5 * up, 2e5 * back])
    for method in METHODS:
        assert chord_slope(x, y, 0.001, 0.003, method).slope == pytest.approx(1e5)


def test_line_with_a_large_offset_keeps_its_digits() -> None:
    x = 1e6 + np.arange(50.0)
    line = fit_line(x, 3.0 + 0.25 * x)
    assert line.slope == pytest.approx(0.25, rel=1e-12)
    assert line.r_squared == pytest.approx(1.0)
