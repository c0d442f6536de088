"""Digits of the least-squares fit against exact fractions: NIST's sets and sets like them."""

import importlib.util
from fractions import Fraction
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.surface.fit import fit

NIST = Path(__file__).parents[4] / "shared" / "labdata" / "nist-regression"
DIGITS = 11
WAMPLER_ERRORS = [759, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 1838, -2048, 2048]
WAMPLER_ERRORS += WAMPLER_ERRORS[-2::-1]


def load_benchmark():
    path = Path(__file__).parents[3] / "benchmarks" / "surface_digits.py"
    spec = importlib.util.spec_from_file_location("surface_digits", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


benchmark = load_benchmark()


def digits(computed, exact):
    """Digits that agree, in the worst coefficient."""
    relative = np.abs(computed - exact) / np.abs(exact)
    return -np.log10(max(relative.max(), 1e-17))


def of_powers(x, y, degree):
    terms = ["1", *(f"x^{power}" for power in range(1, degree + 1))]
    return fit(pd.DataFrame({"x": x}), pd.Series(y), ["x"], terms).coefficients_natural


def of_degree_five(size):
    """NIST's Wampler sets: coefficients of one under errors of a given size, orthogonal to them."""
    x = np.arange(21.0)
    return x, sum(x**power for power in range(6)) + size * np.array(WAMPLER_ERRORS, dtype=float)


@pytest.mark.parametrize("size", [0, 1, 100, 10_000])
def test_coefficients_hold_under_residuals_a_million_times_larger(size):
    x, y = of_degree_five(size)
    assert digits(of_powers(x, y, 5), np.ones(6)) >= DIGITS


def test_the_same_digits_where_long_double_is_double(monkeypatch):
    monkeypatch.setattr(np, "longdouble", np.float64)
    x, y = of_degree_five(10_000)
    assert digits(of_powers(x, y, 5), np.ones(6)) >= DIGITS


def test_factors_far_from_zero_as_years_are(exact_solution):
    rng = np.random.default_rng(3)
    year = np.arange(1947.0, 1963.0)
    other = 200_000 + 20_000 * (year - 1947) + rng.integers(-9000, 9000, len(year))
    y = (60_000 + 800 * (year - 1947) + rng.integers(-900, 900, len(year))).astype(float)
    rows = [[Fraction(1), Fraction(a), Fraction(b)] for a, b in zip(year, other, strict=True)]
    exact = exact_solution(rows, [Fraction(value) for value in y])
    design = pd.DataFrame({"year": year, "other": other})

    surface = fit(design, pd.Series(y), ["year", "other"], ["1", "year", "other"])

    assert digits(surface.coefficients_natural, exact) >= DIGITS


def test_a_surface_through_the_origin_equals_the_exact_one(exact_solution):
    x, y = [60, 61, 62, 63, 64], [130, 131, 133, 135, 138]
    rows = [[Fraction(value), Fraction(value) ** 2] for value in x]
    exact = exact_solution(rows, [Fraction(value) for value in y])
    design = pd.DataFrame({"x": np.array(x, dtype=float)})

    surface = fit(design, pd.Series(y, dtype=float), ["x"], ["x", "x^2"], through_origin=True)

    assert digits(surface.coefficients_natural, exact) >= DIGITS
    assert surface.predict(np.array([[0.0]]))[0] == 0.0


@pytest.mark.skipif(not NIST.is_dir(), reason="NIST's sets (../shared/labdata) are absent")
@pytest.mark.parametrize("name", benchmark.SETS)
def test_digits_of_the_nist_sets(name):
    surface, certified = benchmark.fit_set(NIST, name)
    coefficients = certified[certified.index != "resid_sd"].to_numpy()
    assert digits(surface.coefficients_natural, coefficients) >= DIGITS
    residual_sd = certified["resid_sd"]
    assert surface.residual_sd == pytest.approx(residual_sd, rel=1e-9, abs=1e-9)
