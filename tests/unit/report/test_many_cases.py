"""Figures of many cases: a sample that says so, small, with the cases that matter among it."""

import numpy as np
import pandas as pd
import pytest

from nptcs.report.drawing import csv_of
from nptcs.report.factor_labels import FactorLabel
from nptcs.report.figures.published_stiffness import parity
from nptcs.report.figures.residuals import residual_quantiles, residuals_over_value
from nptcs.report.figures.style import MOST_MARKS, data_of, sampled, to_svg
from nptcs.report.figures.surface import STIFFNESS, contours
from nptcs.report.figures.tyre import load_displacement
from nptcs.report.plots import packed
from nptcs.report.svg import compact
from nptcs.surface.fit import fit_points
from nptcs.terms import parse

MANY = 10_000


@pytest.fixture(scope="module")
def influence():
    random = np.random.default_rng(5)
    residual = random.normal(0, 1, MANY)
    residual[4321] = 9.0
    return pd.DataFrame(
        {
            "point": [f"x {number}" for number in range(MANY)],
            "response": 300 + residual,
            "residual": residual,
            "studentised_residual": residual,
            "leverage": random.uniform(0, 0.1, MANY),
        }
    )


@pytest.fixture(scope="module")
def against():
    stiffness = np.linspace(200, 600, MANY)
    return pd.DataFrame(
        {
            "case_id": [f"c{number}" for number in range(MANY)],
            "solver": "fe_tyre",
            "used_for_calibration": False,
            "published_stiffness_n_per_mm": stiffness,
            "computed_stiffness_n_per_mm": 1.01 * stiffness,
        }
    )


@pytest.fixture(scope="module")
def curves():
    load = np.linspace(0, 5000, 6)
    parts = [
        pd.DataFrame(
            {"case_id": f"c{n}", "force_n": load, "displacement_mm": load / (250 + 0.1 * n)}
        )
        for n in range(1500)
    ]
    return pd.concat(parts, ignore_index=True)


def drawn(figure):
    return compact(to_svg(figure)), packed(csv_of(data_of(figure)))


def test_residuals_keep_the_far_case(influence):
    figure = residuals_over_value(influence, "title")
    assert 9.0 in data_of(figure)["residual_n_per_mm"].to_numpy()
    svg, csv = drawn(figure)
    assert "sampled" in svg
    assert "of 10,000 cases" in svg
    assert len(svg) + len(csv) < 60_000


def test_quantiles_and_parity_are_samples(influence, against):
    for figure in (residual_quantiles(influence, "title"), parity(against, "title", ["fe_tyre"])):
        svg, csv = drawn(figure)
        assert "sampled: 300 of 10,000" in svg
        assert len(svg) + len(csv) < 60_000


def test_curves_are_a_sample_with_the_softest_and_the_stiffest(curves):
    empty = pd.DataFrame(columns=["case_id", "load_n", "displacement_mm"])
    figure = load_displacement(curves, empty, "title")
    svg, csv = drawn(figure)
    assert "of 1,500 tyres" in svg
    assert {"c0", "c1499"} <= set(data_of(figure)["case_id"])
    assert len(svg) + len(csv) < 90_000


def test_a_sample_has_the_first_and_the_last_row():
    table = pd.DataFrame({"x": np.arange(MANY)})
    few = sampled(table)["x"]
    assert (len(few), few.iloc[0], few.iloc[-1]) == (MOST_MARKS, 0, MANY - 1)
    assert sampled(table[:7]).equals(table[:7])


def test_contours_of_many_cases_are_a_sample():
    random = np.random.default_rng(7)
    x = random.uniform([0, 0], [1, 90], (MANY, 2))
    cases = pd.DataFrame(x, columns=["a_mm", "angle_deg"])
    cases[STIFFNESS] = 300 + 10 * cases["a_mm"] - 0.1 * cases["angle_deg"]
    cases["solver"] = "lca"
    polynomial = parse(["1", "a_mm", "angle_deg"], ["a_mm", "angle_deg"])
    surface = fit_points(x, cases[STIFFNESS].to_numpy(), polynomial)
    labels = {"a_mm": FactorLabel("a", "mm"), "angle_deg": FactorLabel("A", "°")}
    svg, csv = drawn(contours(surface, cases, ("a_mm", "angle_deg"), labels))
    assert "sampled: 300 of 10,000 cases" in svg
    assert len(svg) + len(csv) < 60_000
