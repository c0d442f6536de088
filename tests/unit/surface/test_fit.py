"""Response surfaces against exact fractions, manufactured polynomials and the published tables."""

from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.errors import InputError
from nptcs.surface.diagnostics.quality import assess
from nptcs.surface.fit import fit
from nptcs.surface.stored import dump, load
from nptcs.terms import parse

PUBLISHED = Path(__file__).parents[3] / "raw_data" / "published"
PLATE_FACTORS = ["spacing_mm", "thickness_mm", "angle_deg"]
RUBBER_FACTORS = ["shear_band_c10_mpa", "spoke_c10_mpa"]


def terms_of(file):
    return list(pd.read_csv(PUBLISHED / file, dtype={"term": str})["term"])


def surface_of(table, factors, coefficients):
    cases = pd.read_csv(PUBLISHED / table)
    return cases, fit(cases, cases["stiffness_n_per_mm"], factors, terms_of(coefficients))


@pytest.mark.parametrize(
    ("table", "factors", "coefficients", "r_squared"),
    [
        ("table5_plate_doe.csv", PLATE_FACTORS, "table6_plate_coefficients.csv", 0.99361),
        ("table7_rubber_doe.csv", RUBBER_FACTORS, "table8_rubber_coefficients.csv", 0.99997),
    ],
)
def test_coefficients_equal_the_exact_rational_solution(
    table, factors, coefficients, r_squared, exact_solution
):
    text = pd.read_csv(PUBLISHED / table, dtype=str)
    rows = [[Fraction(value) for value in row] for row in text[factors].to_numpy()]
    exponents = parse(terms_of(coefficients), factors).exponents
    matrix = [
        [np.prod([x**e for x, e in zip(row, powers, strict=True)]) for powers in exponents]
        for row in rows
    ]
    exact = exact_solution(matrix, [Fraction(v) for v in text["stiffness_n_per_mm"]])

    cases, surface = surface_of(table, factors, coefficients)
    quality = assess(surface)

    np.testing.assert_allclose(surface.coefficients_natural, exact, rtol=1e-9)
    assert quality["r_squared"] == pytest.approx(r_squared, abs=5e-6)


def test_plate_surface_has_the_coefficients_at_full_precision():
    cases, surface = surface_of(
        "table5_plate_doe.csv", PLATE_FACTORS, "table6_plate_coefficients.csv"
    )
    quality = assess(surface)
    seven_digits = [338.85604, 43.790873, -0.34240873, -8.6452738, -10.621693, -0.01283239]
    seven_digits += [0.11839048, 0.26809524, -0.36214286, 0.00565794, 9.523e-5]

    np.testing.assert_allclose(surface.coefficients_natural[:-1], seven_digits[:-1], rtol=1e-6)
    assert surface.coefficients_natural[-1] == pytest.approx(9.523e-5, abs=5e-9)
    assert quality["largest_residual"] == pytest.approx(5.85, abs=0.005)
    assert quality["condition_number_coded"] == pytest.approx(9.2, abs=0.05)
    assert quality["condition_number_natural"] == pytest.approx(1.2e7, rel=0.05)


def test_printed_two_decimal_coefficients_miss_the_data():
    cases = pd.read_csv(PUBLISHED / "table5_plate_doe.csv")
    printed = pd.read_csv(PUBLISHED / "table6_plate_coefficients.csv", dtype={"term": str})
    polynomial = parse(list(printed["term"]), PLATE_FACTORS)
    coefficients = printed["coefficient"].to_numpy().copy()
    coefficients[-1] *= 1e-5  # the lost exponent of C10
    values = polynomial.matrix(cases[PLATE_FACTORS].to_numpy(float)) @ coefficients

    largest = np.abs(values - cases["stiffness_n_per_mm"]).max()

    assert 25 < largest < 30


def test_full_cubic_is_refused_and_the_aliased_terms_are_named():
    cases = pd.read_csv(PUBLISHED / "table5_plate_doe.csv")
    cubic = [powers for powers in product(range(4), repeat=3) if sum(powers) <= 3]
    terms = [
        "*".join(f"{f}^{e}" for f, e in zip(PLATE_FACTORS, powers, strict=True) if e) or "1"
        for powers in sorted(cubic, key=sum)
    ]

    with pytest.raises(InputError) as refusal:
        fit(cases, cases["stiffness_n_per_mm"], PLATE_FACTORS, terms)

    message = str(refusal.value)
    assert "rank 18" in message
    assert "all 20 terms" in message
    assert "thickness_mm^3 with thickness_mm" in message
    assert "spacing_mm^3 with spacing_mm" in message
    assert "angle_deg^3" not in message.split("aliased")[1].split("Remedy")[0]


@settings(max_examples=40, deadline=None)
@given(
    coefficients=st.lists(st.floats(-5, 5), min_size=6, max_size=6),
    shift=st.floats(-100, 100),
    scale=st.floats(0.01, 100),
)
def test_a_manufactured_surface_is_recovered_in_any_units(coefficients, shift, scale):
    points = np.array(list(product(np.linspace(-1, 1, 4), np.linspace(-1, 1, 5))))
    x = shift + scale * points
    terms = ["1", "a", "b", "a^2", "b^2", "a*b", "b^3"]
    polynomial = parse(terms, ["a", "b"])
    coefficients = [*coefficients, 1.5]  # never all zero: a constant response is refused
    y = polynomial.matrix(points) @ np.array(coefficients)  # known in coded units

    surface = fit(pd.DataFrame(x, columns=["a", "b"]), pd.Series(y), ["a", "b"], terms)

    np.testing.assert_allclose(surface.coefficients_coded, coefficients, atol=1e-9)
    np.testing.assert_allclose(surface.predict(x), y, atol=1e-9)


def test_gradient_equals_the_difference_quotient():
    _, surface = surface_of("table5_plate_doe.csv", PLATE_FACTORS, "table6_plate_coefficients.csv")
    point = np.array([[13.0, 1.5, 40.0]])
    for axis, factor in enumerate(PLATE_FACTORS):
        step = np.zeros(3)
        step[axis] = 1e-4
        quotient = (surface.predict(point + step) - surface.predict(point - step)) / 2e-4
        np.testing.assert_allclose(surface.gradient(point, factor), quotient, rtol=1e-6)


def test_standard_errors_equal_the_scatter_over_repeated_noise():
    rng = np.random.default_rng(1)
    x = pd.DataFrame(list(product([2.0, 3.0, 4.0, 5.0], [10.0, 20.0, 30.0])), columns=["a", "b"])
    terms = ["1", "a", "b", "a*b"]
    truth = 5 + 2 * x["a"] - 0.3 * x["b"]
    fits = [fit(x, truth + rng.normal(0, 0.5, len(x)), ["a", "b"], terms) for _ in range(800)]

    scatter = np.std([surface.coefficients_natural for surface in fits], axis=0)
    stated = np.sqrt(np.mean([surface.natural_standard_errors() ** 2 for surface in fits], axis=0))

    # the standard deviation of 800 draws is known to 2.5 %
    np.testing.assert_allclose(stated, scatter, rtol=0.1)


def test_prediction_interval_covers_new_cases():
    rng = np.random.default_rng(2)
    x = pd.DataFrame({"a": np.linspace(0, 1, 12)})
    new = np.array([[0.37]])
    inside = 0
    for _ in range(600):
        surface = fit(x, 1 + x["a"] + rng.normal(0, 0.1, 12), ["a"], ["1", "a"])
        fresh = 1 + 0.37 + rng.normal(0, 0.1)
        inside += abs(fresh - surface.predict(new)[0]) <= surface.prediction_half_width(new)[0]

    assert 0.92 < inside / 600 < 0.98  # 95 % ± three standard errors of the count


def test_non_hierarchical_terms_are_refused():
    with pytest.raises(InputError, match=r"add these terms") as refusal:
        parse(["1", "a", "a^3"], ["a"])
    assert "a^2" in str(refusal.value)


@pytest.mark.parametrize("term", ["a**2", "a^", "c", "2*a", "a+b", ""])
def test_a_term_that_cannot_be_read_is_named(term):
    with pytest.raises(InputError) as refusal:
        parse(["1", "a", term], ["a", "b"])
    assert repr(term) in str(refusal.value)


def test_too_few_cases_and_constant_factors_are_refused():
    few = pd.DataFrame({"a": [1.0, 2.0]})
    with pytest.raises(InputError, match="2 solved cases cannot determine 2 terms"):
        fit(few, pd.Series([1.0, 2.0]), ["a"], ["1", "a"])
    with pytest.raises(InputError, match="no response to fit"):
        fit(pd.DataFrame({"a": [1.0, 2.0, 3.0]}), pd.Series([5.0, np.nan, 6.0]), ["a"], ["1", "a"])
    with pytest.raises(InputError, match="the same in all cases"):
        fit(pd.DataFrame({"a": [1.0, 2.0, 3.0]}), pd.Series([5.0, 5.0, 5.0]), ["a"], ["1", "a"])
    constant = pd.DataFrame({"a": [1.0, 1.0, 1.0]})
    with pytest.raises(InputError, match="only one level"):
        fit(constant, pd.Series([1.0, 2.0, 3.0]), ["a"], ["1", "a"])


def test_a_stored_surface_is_the_same_surface():
    cases, surface = surface_of(
        "table7_rubber_doe.csv", RUBBER_FACTORS, "table8_rubber_coefficients.csv"
    )
    x = cases[RUBBER_FACTORS].to_numpy(float)

    again = load(dump({"published": surface}))["published"]

    np.testing.assert_allclose(again.predict(x), surface.predict(x), rtol=1e-12)
    widths = again.prediction_half_width(x), surface.prediction_half_width(x)
    np.testing.assert_allclose(*widths, rtol=1e-12)


def test_leave_one_out_equals_leaving_each_case_out():
    cases, surface = surface_of(
        "table7_rubber_doe.csv", RUBBER_FACTORS, "table8_rubber_coefficients.csv"
    )
    y = cases["stiffness_n_per_mm"]
    misses = []
    for row in cases.index:
        rest = cases.drop(index=row)
        terms = surface.polynomial.names
        other = fit(rest, rest["stiffness_n_per_mm"], RUBBER_FACTORS, terms)
        misses.append(y[row] - other.predict(cases.loc[[row], RUBBER_FACTORS].to_numpy(float))[0])
    by_hand = 1 - np.sum(np.square(misses)) / np.sum((y - y.mean()) ** 2)

    quality = assess(surface)

    assert quality["leave_one_out_r_squared"] == pytest.approx(by_hand, rel=1e-9)
