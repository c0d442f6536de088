"""Surfaces of every kind on table 5: how they predict, where they refuse, what is stored."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.surface import (
    GaussianProcessModel,
    LaminationModel,
    PolynomialModel,
    surface_name,
)
from nptcs.errors import InputError
from nptcs.surface.cases import SolvedCases
from nptcs.surface.diagnostics.comparison import directions, leave_one_level_out, leave_one_out
from nptcs.surface.diagnostics.influence import influence
from nptcs.surface.kinds.gaussian_process import fit_process
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.surface.registry import FittedSurface, SurfaceRegistry
from nptcs.surface.response_surface import predict
from nptcs.surface.stored import dump_registry, load_registry
from nptcs.surface.study import RESPONSE, StudySurfaces, SurfaceFit
from nptcs.surface.tables import comparison_tables
from nptcs.tables.analysis.surface import SurfaceComparison
from nptcs.tables.io import check
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

PUBLISHED = Path(__file__).parents[3] / "raw_data" / "published"
FACTORS = ("spacing_mm", "thickness_mm", "angle_deg")
LAMINATION = LaminationModel(kind="lamination", coefficients=7)
MODELS = [
    PolynomialModel(kind="polynomial"),
    PolynomialModel(kind="polynomial", link="log"),
    PolynomialModel(kind="polynomial", link="reciprocal"),
    LAMINATION,
    GaussianProcessModel(kind="gaussian_process"),
    GaussianProcessModel(kind="gaussian_process", mean=LAMINATION),
]
SOLVED = SolvedCases(pd.DataFrame(), (), 0, 0)
OUTSIDE = np.array([[25.0, 1.8, 45.0]])


def table_5(order=FACTORS):
    table = pd.read_csv(PUBLISHED / "table5_plate_doe.csv")
    terms = pd.read_csv(PUBLISHED / "table6_plate_coefficients.csv", dtype={"term": str})["term"]
    x, y = table[list(order)].to_numpy(float), table["stiffness_n_per_mm"].to_numpy(float)
    return FitCases(x, y, order, list(terms), PUBLISHED_PLY)


@pytest.fixture(scope="module")
def fitted():
    return {surface_name(model): fit_surface(model, table_5()) for model in MODELS}


def worst_level(surface):
    return max(leave_one_level_out(surface, axis).largest for axis in range(3))


def test_the_lamination_form_predicts_unseen_cases_with_seven_coefficients(fitted):
    surface = fitted["lamination 7"]
    left_out = leave_one_out(surface)
    assert surface.coefficients == 7
    assert np.abs(left_out.error).max() <= 1.3
    assert worst_level(surface) <= 3.0
    rising, falling = np.transpose(directions(surface))
    assert rising[0] == 0  # softer with the spacing
    assert falling[1] == 0  # stiffer with the thickness


def test_the_gaussian_process_on_it_is_better_and_its_interval_has_its_coverage(fitted):
    surface = fitted["gaussian process on lamination 7"]
    left_out = leave_one_out(surface)
    assert np.abs(left_out.error).max() <= 0.35
    assert 90 <= 100 * left_out.covered.mean() <= 99
    assert worst_level(surface) <= 3.0
    np.testing.assert_allclose(surface.predict(surface.x), surface.y, atol=1e-4)


def test_the_polynomial_is_not_monotone_and_loses_whole_levels(fitted):
    surface = fitted["polynomial"]
    rising, falling = directions(surface)[1]
    assert 100 * falling == pytest.approx(13, abs=1.5)
    assert np.isnan(leave_one_level_out(surface, 0).largest)
    assert "cannot estimate" in leave_one_level_out(surface, 0).refused
    assert leave_one_level_out(surface, 2).largest == pytest.approx(9.61, abs=0.005)


def test_leave_one_out_by_refits_equals_the_closed_form(fitted):
    closed = -influence(fitted["polynomial"]).left_out
    np.testing.assert_allclose(leave_one_out(fitted["polynomial"]).error, closed, rtol=1e-6)


@pytest.mark.parametrize("model", MODELS, ids=surface_name)
def test_a_stored_surface_of_any_kind_is_the_same(fitted, model):
    surface = fitted[surface_name(model)]
    fitted = FittedSurface("study", "s", "m", RESPONSE, surface)
    again = load_registry(dump_registry(SurfaceRegistry("study", (fitted,)))).surfaces[0].surface
    x = surface.x[::5] * 0.99 + 0.01 * surface.x.mean(axis=0)
    np.testing.assert_allclose(again.predict(x), surface.predict(x), rtol=1e-12)
    for side, stored in zip(surface.interval(x), again.interval(x), strict=True):
        np.testing.assert_allclose(stored, side, rtol=1e-9)


@pytest.mark.parametrize("model", MODELS, ids=surface_name)
def test_outside_the_box_a_prediction_is_refused_or_flagged(fitted, model):
    surface = fitted[surface_name(model)]
    inside = predict(surface, surface.x[:3] * 0.5 + surface.x.mean(axis=0) * 0.5)
    assert inside.inside.all()
    assert (inside.low < inside.value).all()
    assert (inside.value < inside.high).all()
    if model.kind == "lamination":
        flagged = predict(surface, OUTSIDE)
        assert not flagged.inside[0]
        assert np.isfinite(flagged.value[0])
        assert np.isnan(flagged.low[0])
        return
    with pytest.raises(InputError, match="10 to 20") as refusal:
        predict(surface, OUTSIDE)
    assert refusal.value.column == "spacing_mm"
    assert refusal.value.value == 25.0


def test_the_order_of_the_factors_does_not_matter(fitted):
    order = ("angle_deg", "spacing_mm", "thickness_mm")
    model = GaussianProcessModel(kind="gaussian_process", mean=LAMINATION)
    surface = fit_surface(model, table_5(order))
    x = np.array([[37.5, 12.5, 1.5]])
    expected = fitted[surface_name(model)].predict(x[:, [1, 2, 0]])
    assert surface.predict(x)[0] == pytest.approx(expected[0], abs=0.02)
    errors = leave_one_level_out(surface, 1)
    assert errors.largest == pytest.approx(
        leave_one_level_out(fitted[surface_name(model)], 0).largest, abs=0.2
    )


def test_the_compliance_of_a_made_up_tyre_is_recovered():
    exact = fit_surface(LAMINATION, table_5())
    made = FitCases(exact.x, exact.predict(exact.x), FACTORS, [], PUBLISHED_PLY)
    again = fit_surface(LAMINATION, made)
    assert again.shape == exact.shape
    np.testing.assert_allclose(again.parameters, exact.parameters, rtol=1e-4)


@pytest.mark.parametrize("coefficients", [6, 7, 8])
def test_the_lamination_forms_slopes_are_those_of_differences(coefficients):
    surface = fit_surface(LaminationModel(kind="lamination", coefficients=coefficients), table_5())
    points = np.array([[10.0, 1.2, 0.0], [15.0, 1.8, 45.0], [18.3, 2.1, 80.0]])
    for place, value in enumerate(surface.parameters):
        step = np.zeros(coefficients)
        step[place] = 1e-5 * (abs(value) if place < 3 else 1.0)
        above, below = (
            replace(surface, parameters=surface.parameters + side * step).predict(points)
            for side in (1, -1)
        )
        slope = (above - below) / (2 * step[place])
        np.testing.assert_allclose(surface.slopes(points)[:, place], slope, rtol=1e-5)


def test_the_lamination_form_refuses_what_it_is_not_made_for():
    cases = table_5()
    for wrong, match in (
        (FitCases(cases.x, cases.y, ("a", "b", "c"), [], PUBLISHED_PLY), "has the factors"),
        (FitCases(cases.x, cases.y, FACTORS, [], None), "needs the constants"),
        (FitCases(cases.x, -cases.y, FACTORS, [], PUBLISHED_PLY), "positive stiffness"),
        (FitCases(cases.x[:5], cases.y[:5], FACTORS, [], PUBLISHED_PLY), "5 solved cases"),
    ):
        with pytest.raises(InputError, match=match):
            fit_surface(LAMINATION, wrong)


def test_log_and_reciprocal_need_a_positive_response():
    cases = table_5()
    shifted = FitCases(cases.x, cases.y - 250, FACTORS, cases.terms)
    for link in ("log", "reciprocal"):
        with pytest.raises(InputError, match=f"the {link} link needs a positive response"):
            fit_surface(PolynomialModel(kind="polynomial", link=link), shifted)


def test_repeated_cases_that_differ_give_the_process_a_noise():
    rng = np.random.default_rng(7)
    x = np.repeat(np.linspace(0, 1, 12), 3)[:, None]
    truth = np.sin(4 * x[:, 0])
    surface = fit_process(x, truth + rng.normal(0, 0.1, len(x)), ("x",))
    between = np.linspace(0.05, 0.95, 10)[:, None]

    low, high = surface.interval(between)

    assert len(surface.theta) == 3
    assert np.abs(surface.predict(between) - np.sin(4 * between[:, 0])).max() < 0.15
    # the interval of a further case contains the noise: ± 1.96 · 0.1 at least
    assert np.median(high - low) == pytest.approx(0.39, rel=0.35)


def test_a_polynomial_chosen_by_press_predicts_at_least_as_well():
    cases = table_5()
    terms = [*cases.terms, "thickness_mm*angle_deg^2", "angle_deg^4", "angle_deg^5", "angle_deg^6"]
    wide = FitCases(cases.x, cases.y, FACTORS, terms)
    every = fit_surface(PolynomialModel(kind="polynomial"), wide)
    chosen = fit_surface(PolynomialModel(kind="polynomial", choose="press"), wide)
    rms = [np.sqrt(np.mean(influence(s).left_out ** 2)) for s in (every, chosen)]
    assert rms[1] <= rms[0]
    assert len(chosen.polynomial) <= len(every.polynomial)


def test_what_cannot_be_assessed_is_not_a_number():
    x = np.linspace(0, 1, 12)[:, None]
    cases = FitCases(x, x[:, 0] ** 2, ("x",), ["1", "x", "x^2"])
    surface = fit_surface(PolynomialModel(kind="polynomial"), cases)
    level = leave_one_level_out(surface, 0)
    assert np.isnan(level.largest)
    assert level.refused == "not assessed: 12 values and no levels"
    few = fit_surface(
        PolynomialModel(kind="polynomial"),
        FitCases(x[:4], x[:4, 0] ** 3, ("x",), ["1", "x", "x^2"]),
    )
    assert np.isnan(leave_one_out(few).error).all()
    done = StudySurfaces(
        "study", (SurfaceFit("s", "polynomial", RESPONSE, few),), {"s": SOLVED}, None
    )
    comparison, _ = comparison_tables(done)
    row = check(comparison, SurfaceComparison, "comparison").iloc[0]
    assert np.isnan(row["coverage_percent"])
    assert row["leave_one_out_not_fitted"] == 4


@pytest.mark.parametrize("link", ["identity", "log", "reciprocal"])
def test_left_out_errors_of_many_cases_are_those_of_fitting_again(link, monkeypatch):
    surface = fit_surface(PolynomialModel(kind="polynomial", link=link), table_5())
    at_once = leave_one_out(surface)
    monkeypatch.setattr("nptcs.surface.diagnostics.comparison.MANY_CASES", 1000)
    again = leave_one_out(surface)
    np.testing.assert_allclose(at_once.error, again.error, rtol=1e-7, atol=1e-9)
    assert np.array_equal(at_once.covered, again.covered)
