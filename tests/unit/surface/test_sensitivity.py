"""Impact values against integrals done by hand and against table 9 of the paper."""

from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.compare.impact import with_published
from nptcs.surface.fit import fit
from nptcs.surface.sensitivity.gradients import impact
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.io import check

PUBLISHED = Path(__file__).parents[3] / "raw_data" / "published"


def published_surface(table, coefficients):
    cases = pd.read_csv(PUBLISHED / table)
    factors = [name for name in cases if name not in ("case", "stiffness_n_per_mm")]
    terms = list(pd.read_csv(PUBLISHED / coefficients, dtype={"term": str})["term"])
    return cases, fit(cases, cases["stiffness_n_per_mm"], factors, terms)


def gradients(table, coefficients, rule):
    cases, surface = published_surface(table, coefficients)
    return impact(surface, rule).set_index("factor")["gradient"]


def test_mean_of_an_absolute_derivative_that_changes_sign():
    # f = x² on [-1, 3]: the mean of |2x| is (1 + 9)/4, the mean of 2x is 2
    x = pd.DataFrame({"x": np.linspace(-1, 3, 5)})
    surface = fit(x, x["x"] ** 2, ["x"], ["1", "x", "x^2"])

    absolute = impact(surface, "domain_mean_absolute").iloc[0]
    signed = impact(surface, "domain_mean_signed").iloc[0]
    points = impact(surface, "design_mean_absolute").iloc[0]

    assert absolute["gradient"] == pytest.approx(2.5, rel=1e-6)
    assert signed["gradient"] == pytest.approx(2.0, rel=1e-6)
    assert points["gradient"] == pytest.approx((2 + 0 + 2 + 4 + 6) / 5)
    assert absolute["range"] == 4
    assert absolute["impact"] == pytest.approx(10.0, rel=1e-6)


def test_mean_over_a_domain_of_two_factors_by_hand():
    # f = x y on [-1, 1] × [0, 2]: |∂f/∂x| = |y| has mean 1, |∂f/∂y| = |x| has mean 1/2
    x = pd.DataFrame(list(product([-1.0, 0.0, 1.0], [0.0, 1.0, 2.0])), columns=["x", "y"])
    surface = fit(x, x["x"] * x["y"], ["x", "y"], ["1", "x", "y", "x*y"])

    table = impact(surface, "domain_mean_absolute").set_index("factor")

    assert table.loc["x", "gradient"] == pytest.approx(1.0, rel=1e-6)
    assert table.loc["y", "gradient"] == pytest.approx(0.5, rel=1e-6)


def test_signed_means_of_the_published_surfaces_equal_their_integrals():
    plate = gradients("table5_plate_doe.csv", "table6_plate_coefficients.csv", "domain_mean_signed")
    _, surface = published_surface("table5_plate_doe.csv", "table6_plate_coefficients.csv")
    c = dict(zip(surface.polynomial.names, surface.coefficients_natural, strict=True))
    by_hand = (
        c["angle_deg"]
        + 2 * c["angle_deg^2"] * 45
        + c["thickness_mm*angle_deg"] * 1.8
        + c["spacing_mm*angle_deg"] * 15
        + 3 * c["angle_deg^3"] * 90**2 / 3
    )
    assert plate["angle_deg"] == pytest.approx(by_hand, rel=1e-4)
    assert plate["spacing_mm"] == pytest.approx(-5.4908, abs=5e-5)
    assert plate["thickness_mm"] == pytest.approx(12.185, abs=5e-4)


@pytest.mark.parametrize(
    "rule", ["domain_mean_absolute", "design_mean_absolute", "domain_mean_signed"]
)
def test_ranking_is_that_of_the_paper_under_every_rule(rule):
    tables = []
    for table, coefficients in (
        ("table5_plate_doe.csv", "table6_plate_coefficients.csv"),
        ("table7_rubber_doe.csv", "table8_rubber_coefficients.csv"),
    ):
        cases, surface = published_surface(table, coefficients)
        tables.append(impact(surface, rule))
    ranked = pd.concat(tables).assign(size=lambda t: t["impact"].abs())

    # thickness and angle change places under the signed rule, where the angle's slopes cancel
    order = list(ranked.sort_values("size", ascending=False)["factor"])
    assert order[:3] == ["spoke_c10_mpa", "spacing_mm", "shear_band_c10_mpa"]
    if rule != "domain_mean_signed":
        assert order[3:] == ["angle_deg", "thickness_mm"]


def test_printed_values_are_given_only_for_the_same_range():
    ours = pd.DataFrame(
        {
            "solver": "s",
            "study": "plate",
            "factor": ["spacing_mm", "thickness_mm", "other"],
            "rule": "domain_mean_absolute",
            "gradient": [-5.0, 13.0, 1.0],
            "range": [9.8, 2.0, 1.0],
            "nominal_range": [10.0, 2.0, 1.0],
            "values_used": "",
            "cases": 9,
            "failed_cases": 0,
            "near_tie_with": "",
            "impact": [-50.0, 26.0, 1.0],
        }
    )
    table = with_published(ours, pd.read_csv(PUBLISHED / "table9_impact.csv"))

    assert table["published_impact"].tolist()[0] == 54.93
    assert table["published_impact"].isna().tolist() == [False, True, True]
    assert table["difference_percent"].iloc[0] == pytest.approx(100 * (50 / 54.93 - 1))


def test_ranks_are_among_the_factors_that_have_a_printed_value():
    ours = pd.DataFrame(
        {
            "solver": "s",
            "study": ["plate", "plate", "plate", "rubber", "rubber"],
            "factor": [
                "spacing_mm",
                "thickness_mm",
                "angle_deg",
                "shear_band_c10_mpa",
                "spoke_c10_mpa",
            ],
            "rule": "domain_mean_signed",
            "gradient": 1.0,
            # another range of the thickness: it is compared with nothing
            "range": [10.0, 2.0, 90.0, 1.0, 4.0],
            "nominal_range": [10.0, 2.0, 90.0, 1.0, 4.0],
            "values_used": "",
            "cases": 9,
            "failed_cases": 0,
            "near_tie_with": "",
            "impact": [-50.0, 900.0, -60.0, 38.0, 300.0],
        }
    )
    other = ours[ours["study"] == "rubber"].assign(solver="t", impact=[40.0, 30.0])
    printed = pd.read_csv(PUBLISHED / "table9_impact.csv")
    table = check(with_published(pd.concat([ours, other]), printed), Impact, "impact.csv")

    assert table["rank"].fillna(0).tolist() == [3, 0, 2, 4, 1, 1, 2]
    # S-C 319.83 > spacing 54.93 > T-C 38.60 > angle 21.91
    assert table["published_rank"].fillna(0).tolist() == [2, 0, 4, 3, 1, 2, 1]
