"""Diagnostics against printed analyses: R's rsm (ChemReact, heli) and SAS's PROC RSREG (MBT)."""

from itertools import combinations, product

import numpy as np
import pandas as pd
import pytest
from scipy import linalg

from nptcs.surface.diagnostics.anova import Noise, anova, noise_of_replicates
from nptcs.surface.diagnostics.influence import influence, press, term_tests
from nptcs.surface.diagnostics.stationary import ridge_path, stationary_points
from nptcs.surface.fit import fit
from nptcs.surface.kinds.selection import backward_steps
from nptcs.terms import parse

CHEM_REACT = pd.DataFrame(
    [
        [80, 170, 1, 80.5], [80, 180, 1, 81.5], [90, 170, 1, 82.0], [90, 180, 1, 83.5],
        [85, 175, 1, 83.9], [85, 175, 1, 84.3], [85, 175, 1, 84.0],
        [85, 175, 2, 79.7], [85, 175, 2, 79.8], [85, 175, 2, 79.5],
        [92.07, 175, 2, 78.4], [77.93, 175, 2, 75.6], [85, 182.07, 2, 78.5], [85, 167.93, 2, 77.0],
    ],
    columns=["time", "temp", "block", "y"],
)  # fmt: skip
MBT = pd.DataFrame(
    [
        [4.0, 250, 83.8], [20.0, 250, 81.7], [12.0, 250, 82.4], [12.0, 250, 82.9],
        [12.0, 220, 84.7], [12.0, 280, 57.9], [12.0, 250, 81.2], [6.3, 229, 81.3],
        [6.3, 271, 83.1], [17.7, 229, 85.3], [17.7, 271, 72.7], [4.0, 250, 82.0],
    ],
    columns=["time", "temp", "y"],
)  # fmt: skip
HELI_TIMES = (
    "367 369 374 370 372 355 397 377 350 373 358 363 344 355 370 362 377 375 "
    "361 364 355 373 361 360 380 360 370 368 369 366"
)


def helicopter():
    """Box, Hunter & Hunter (2005), table 12.5: a central composite design in two blocks."""
    cube = [point[::-1] for point in product([-1, 1], repeat=4)]
    axial = [tuple(side * (axis == place) for place in range(4))
             for axis in range(4) for side in (-2, 2)]  # fmt: skip
    points = [*cube, *[(0,) * 4] * 2, *axial, *[(0,) * 4] * 4]
    table = pd.DataFrame(points, columns=["x1", "x2", "x3", "x4"], dtype=float)
    return table.assign(block=[1.0] * 18 + [2.0] * 12, y=[float(t) for t in HELI_TIMES.split()])


def second_order(table, factors, blocks=()):
    pairs = [f"{a}*{b}" for a, b in combinations(factors, 2)]
    terms = ["1", *blocks, *factors, *pairs, *(f"{name}^2" for name in factors)]
    return fit(table, table["y"], [*blocks, *factors], terms)


def rows_of(surface, blocks=()):
    return {row.source: row for row in anova(surface, blocks)}


def test_chem_react_as_printed_by_rsm():
    surface = second_order(CHEM_REACT, ["time", "temp"], ["block"])
    rows = rows_of(surface, ["block"])

    def printed(source, df, squares, f_value, p_value):
        row = rows[source]
        assert row.df == df
        assert row.sequential == pytest.approx(squares, abs=5.1e-4)
        assert row.f_value == pytest.approx(f_value, abs=5.1e-5)
        assert row.p_value == pytest.approx(p_value, rel=5e-4)

    printed("blocks", 1, 69.531, 2611.0950, 2.879e-10)
    printed("linear", 2, 9.626, 180.7341, 9.450e-07)
    printed("interactions of degree 2", 1, 0.063, 2.3470, 0.1694)
    printed("powers of degree 2", 2, 17.791, 334.0539, 1.135e-07)
    printed("lack of fit", 3, 0.053, 0.5307, 0.6851)
    assert rows["residual"].sequential == pytest.approx(0.186, abs=5.1e-4)
    assert rows["pure error"].sequential == pytest.approx(0.133, abs=5.1e-4)
    (point,) = stationary_points(surface)
    np.testing.assert_allclose(point.point[1:], [86.86147699, 176.67190102], atol=5e-9)
    assert point.kind == "maximum"
    assert point.inside
    # rsm codes by 5, our box reaches to 7.07
    np.testing.assert_allclose(point.curvatures / 1.414**2, [-0.9233027, -1.3186949], atol=5.1e-8)
    np.testing.assert_allclose(np.abs(point.axes[0][1:]), [0.1601375, 0.9870947], atol=5.1e-8)


def test_terms_of_chem_react_as_printed_by_rsm():
    tests = term_tests(second_order(CHEM_REACT, ["time", "temp"], ["block"]))
    # rsm's block is 0 and 1, so that its intercept and that of our centred block differ
    printed_t = [-51.103, 16.162, 10.012, 1.532, -21.786, -15.541]
    printed_p = [2.877e-10, 8.444e-07, 2.122e-05, 0.1694, 1.083e-07, 1.104e-06]
    # R rounds twice: to four decimals, then to five digits
    np.testing.assert_allclose(tests.t_value[1:], printed_t, atol=5.6e-4)
    np.testing.assert_allclose(tests.p_value[1:], printed_p, rtol=5e-4)


def test_helicopter_as_printed_by_rsm():
    surface = second_order(helicopter(), ["x1", "x2", "x3", "x4"], ["block"])
    rows = rows_of(surface, ["block"])
    printed = {
        "blocks": (16.81, 1.7281, 0.209786),
        "linear": (1510.00, 38.8175, 1.965e-07),
        "interactions of degree 2": (1114.00, 19.0917, 5.355e-06),
        "powers of degree 2": (282.54, 7.2634, 0.002201),
        "lack of fit": (125.40, 4.6660, 0.075500),
    }
    for source, (squares, f_value, p_value) in printed.items():
        assert rows[source].sequential == pytest.approx(squares, abs=5.1e-3)
        assert rows[source].f_value == pytest.approx(f_value, abs=5.1e-5)
        assert rows[source].p_value == pytest.approx(p_value, rel=5e-4)
    (point,) = stationary_points(surface)
    expected = [0.8607107, -0.3307115, -0.8394866, -0.1161465]
    np.testing.assert_allclose(point.point[1:], expected, atol=5.1e-8)
    assert point.kind == "saddle"
    eigenvalues = [3.258222, -1.198324, -3.807935, -4.651963]
    np.testing.assert_allclose(point.curvatures / 4, eigenvalues, atol=5.1e-7)


def test_mbt_as_printed_by_rsreg():
    surface = second_order(MBT, ["time", "temp"])
    rows = rows_of(surface)
    assert surface.residual_sd == pytest.approx(4.6159636, abs=5.1e-8)
    assert rows["linear"].sequential == pytest.approx(313.585803, abs=5.1e-7)
    assert rows["linear"].p_value == pytest.approx(0.0243, abs=5.1e-5)
    assert rows["powers of degree 2"].sequential == pytest.approx(146.768144, abs=5.1e-7)
    assert rows["lack of fit"].sequential == pytest.approx(124.696, abs=5.1e-4)
    assert rows["pure error"].sequential == pytest.approx(3.1467, abs=5.1e-5)
    assert rows["pure error"].df == 3
    residual = surface.y - surface.predict(surface.x)
    total = np.sum((surface.y - surface.y.mean()) ** 2)
    assert 1 - residual @ residual / total == pytest.approx(0.800257, abs=5.1e-7)
    (point,) = stationary_points(surface)
    assert point.kind == "saddle"
    np.testing.assert_allclose(surface.coded(point.point), [-0.441758, -0.309976], atol=5.1e-7)
    np.testing.assert_allclose(point.point, [8.465935, 240.700718], atol=6e-7)
    assert point.response == pytest.approx(83.741940, abs=5.1e-7)
    np.testing.assert_allclose(point.curvatures, [2.528816, -9.996940], atol=5.1e-7)
    np.testing.assert_allclose(
        np.abs(point.axes), [[0.953223, 0.302267], [0.302267, 0.953223]], atol=5.1e-7
    )


def test_the_ridge_path_is_the_one_of_the_lagrange_equations():
    surface = second_order(MBT, ["time", "temp"])
    b0, time, temp, cross, time2, temp2 = surface.coefficients_coded
    b, matrix = np.array([time, temp]), np.array([[time2, cross / 2], [cross / 2, temp2]])
    for radius, point, response in ridge_path(surface, "maximum", [0.3, 1.0]):
        coded = (point - surface.coding()[0]) / surface.coding()[1]
        assert np.linalg.norm(coded) == pytest.approx(radius)
        # (B - μ) x = -b/2 with μ above the largest eigenvalue: the maximum on the sphere
        multiplier = coded @ (matrix @ coded + b / 2) / radius**2
        np.testing.assert_allclose((matrix @ coded + b / 2), multiplier * coded, atol=1e-5)
        assert multiplier > linalg.eigvalsh(matrix).max()
        assert response == pytest.approx(b0 + b @ coded + coded @ matrix @ coded)


def test_partial_sums_leave_out_cook_and_press_by_fitting_again():
    surface = second_order(MBT, ["time", "temp"])
    terms = surface.polynomial.names
    sse = surface.residual_sd**2 * (surface.points - len(terms))
    without = fit(MBT, MBT["y"], ["time", "temp"], [t for t in terms if t != "time*temp"])
    more = without.residual_sd**2 * (without.points - len(terms) + 1) - sse
    found = influence(surface)

    assert rows_of(surface)["time*temp"].partial == pytest.approx(more)
    left_out = []
    for case in range(len(MBT)):
        rest = MBT.drop(index=case)
        other = fit(rest, rest["y"], ["time", "temp"], terms)
        left_out.append(MBT["y"][case] - other.predict(surface.x[[case]])[0])
        shift = surface.predict(surface.x) - other.predict(surface.x)
        cook = shift @ shift / len(terms) / surface.residual_sd**2
        assert found.cook[case] == pytest.approx(cook, rel=1e-6)
        externally = found.residual[case] / other.residual_sd / np.sqrt(1 - found.leverage[case])
        assert found.studentised[case] == pytest.approx(externally, rel=1e-6)
    np.testing.assert_allclose(found.left_out, left_out, rtol=1e-7)
    assert press(surface)[0] == pytest.approx(np.sum(np.square(left_out)))


def test_variance_inflation_equals_one_over_one_minus_r_squared():
    surface = second_order(MBT, ["time", "temp"])
    matrix = surface.polynomial.matrix(surface.coded(surface.x))
    inflation = term_tests(surface).vif
    assert np.isnan(inflation[0])
    for column in range(1, matrix.shape[1]):
        others = np.delete(matrix, column, axis=1)
        fitted = others @ np.linalg.lstsq(others, matrix[:, column])[0]
        spread = np.sum((matrix[:, column] - matrix[:, column].mean()) ** 2)
        rest = np.sum((matrix[:, column] - fitted) ** 2)
        assert inflation[column] == pytest.approx(spread / rest)


def test_what_the_cases_say_about_noise():
    x = pd.DataFrame({"x": [0.0, 1.0, 1.0, 2.0, 3.0]})
    noisy = fit(x, pd.Series([0.0, 1.0, 1.2, 2.0, 3.1]), ["x"], ["1", "x"])
    equal = fit(x, pd.Series([0.0, 1.0, 1.0, 2.0, 3.1]), ["x"], ["1", "x"])
    single = fit(x.drop(index=1), pd.Series([0.0, 1.0, 2.0, 3.1]), ["x"], ["1", "x"])

    assert [noise_of_replicates(s) for s in (noisy, equal, single)] == list(Noise)
    assert np.isnan(rows_of(equal)["lack of fit"].f_value)
    assert "lack of fit" not in rows_of(single)


def test_stationary_points_of_a_cubic_are_all_found():
    # f = x³ - x has a maximum at -1/√3 and a minimum at 1/√3; y adds a valley at 0.25
    points = np.array(list(product(np.linspace(-1, 1, 5), repeat=2)))
    y = points[:, 0] ** 3 - points[:, 0] + (points[:, 1] - 0.25) ** 2
    table = pd.DataFrame(points, columns=["x", "z"])
    surface = fit(table, pd.Series(y), ["x", "z"], ["1", "x", "z", "x^2", "z^2", "x^3"])

    found = {point.kind: point.point for point in stationary_points(surface)}

    assert set(found) == {"saddle", "minimum"}
    np.testing.assert_allclose(found["minimum"], [3**-0.5, 0.25], atol=1e-6)
    np.testing.assert_allclose(found["saddle"], [-(3**-0.5), 0.25], atol=1e-6)


def test_a_plane_has_no_stationary_point_and_a_trough_is_a_ridge():
    points = pd.DataFrame(list(product([-1.0, 0.0, 1.0], repeat=2)), columns=["x", "z"])
    plane = fit(points, points["x"] + 2 * points["z"], ["x", "z"], ["1", "x", "z"])
    assert stationary_points(plane) == []
    trough = fit(points, points["x"] ** 2, ["x", "z"], ["1", "x", "z", "x^2", "z^2", "x*z"])
    assert all(point.kind == "ridge of a minimum" for point in stationary_points(trough))


@pytest.mark.parametrize("choose", ["aicc", "press"])
def test_terms_without_effect_go_and_hierarchy_is_kept(choose):
    rng = np.random.default_rng(5)
    table = pd.DataFrame(rng.uniform(-1, 1, (60, 3)), columns=["a", "b", "c"])
    y = 1 + 2 * table["a"] * table["b"] + rng.normal(0, 0.05, 60)
    terms = ["1", "a", "b", "c", "a*b", "a*c", "b*c", "c^2"]
    polynomial = parse(terms, ["a", "b", "c"])

    steps = backward_steps(polynomial, table.to_numpy(), y.to_numpy(), choose)
    best = min(steps, key=lambda step: getattr(step, choose))

    assert {(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)} <= set(best.exponents)
    assert len(best.exponents) < len(terms)
    for step in steps:
        for powers in step.exponents:
            below = [tuple(np.subtract(powers, unit)) for unit in np.eye(3, dtype=int)]
            assert all(lower in step.exponents for lower in below if min(lower) >= 0)
