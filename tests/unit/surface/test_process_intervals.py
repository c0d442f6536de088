"""A Gaussian process's interval: its mean's coefficients, its variance, undetermined lengths."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.surface import GaussianProcessModel, LaminationModel, PolynomialModel
from nptcs.errors import InputError
from nptcs.surface.diagnostics.comparison import leave_one_level_out, leave_one_out
from nptcs.surface.kinds.gaussian_process import GaussianProcess, bounds_of, fit_process
from nptcs.surface.kinds.lengths import lengths_as_likely, restricted_variance
from nptcs.surface.kinds.matern import MaternLikelihood, covariance
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

UNIT = Path(__file__).parents[1]
PUBLISHED = Path(__file__).parents[3] / "raw_data" / "published"
PLATES = ("spacing_mm", "thickness_mm", "angle_deg")
RUBBERS = ("shear_band_c10_mpa", "spoke_c10_mpa")
LEVELS = np.stack(np.meshgrid([-1.0, 0.0, 1.0], np.linspace(-1, 1, 9)), -1).reshape(-1, 2)


def our_cases():
    table = pd.read_csv(UNIT / "uncertainty" / "fe_plate_stiffness.csv", comment="#")
    x = table[list(PLATES)].to_numpy(float)
    return FitCases(x, table["stiffness_n_per_mm"].to_numpy(float), PLATES, (), PUBLISHED_PLY)


@pytest.fixture(scope="module")
def plates():
    mean = LaminationModel(kind="lamination", coefficients=7)
    return fit_surface(GaussianProcessModel(kind="gaussian_process", mean=mean), our_cases())


def drawn(length_along, seed, points):
    """A sample of a Matérn process with the stated length along the first axis."""
    spread = covariance(np.log([1.0, length_along, 0.7]), points, points)
    spread += 1e-10 * np.eye(len(points))
    return np.linalg.cholesky(spread) @ np.random.default_rng(seed).normal(size=len(points))


def test_one_value_of_a_length_where_the_cases_determine_it_two_where_they_do_not():
    theta = np.log([1.0, 0.05, 0.7])
    y = drawn(0.05, 3, LEVELS)
    likelihood = MaternLikelihood(LEVELS, y, 1e-8, noisy=False)
    found = lengths_as_likely(likelihood, theta, bounds_of(2, noisy=False))
    assert found.shape == (2, 3)
    np.testing.assert_allclose(found[:, [0, 2]], theta[[0, 2]][None].repeat(2, 0))
    assert np.exp(found[0, 1]) == pytest.approx(0.05)
    assert 0.2 < np.exp(found[1, 1]) < 3.0

    dense = np.stack(np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9)), -1).reshape(-1, 2)
    surface = fit_process(dense, drawn(0.7, 3, dense), ("a", "b"))
    assert len(surface.spread) == 1


def test_between_levels_the_interval_has_its_stated_coverage():
    """Many functions, cases at three levels of one factor: half of the points lie between them."""
    between = np.stack(
        np.meshgrid(np.linspace(-0.9, 0.9, 7), np.linspace(-0.95, 0.95, 6)), -1
    ).reshape(-1, 2)
    together = np.vstack([LEVELS, between])
    inside = []
    for seed in range(20):
        y = drawn(0.6, seed, together)
        cases = FitCases(LEVELS, y[: len(LEVELS)], ("a", "b"), ("1", "a", "b", "a^2"))
        mean = PolynomialModel(kind="polynomial")
        surface = fit_surface(GaussianProcessModel(kind="gaussian_process", mean=mean), cases)
        low, high = surface.interval(between)
        truth = y[len(LEVELS) :]
        inside.append(np.mean((low <= truth) & (truth <= high)))
    assert 0.85 <= np.mean(inside) <= 0.99


def test_far_from_all_cases_the_interval_has_the_error_of_the_means_coefficients():
    """A process that reaches no other case leaves the prediction interval of least squares."""
    rng = np.random.default_rng(2)
    x = np.linspace(0.0, 1.0, 5)[:, None]
    y = 1 + 2 * x[:, 0] + rng.normal(0, 0.1, 5)
    line = fit_surface(PolynomialModel(kind="polynomial"), FitCases(x, y, ("x",), ("1", "x")))
    theta = np.log([1.0, 0.05])
    surface = GaussianProcess(("x",), x, y, line, theta, np.zeros((1, 2)))
    between = x[:-1] + np.diff(x, axis=0) / 2
    ours, exact = (np.ptp(one.interval(between), axis=0) for one in (surface, line))
    np.testing.assert_allclose(ours, exact, rtol=0.02)


def test_the_variance_does_not_depend_on_the_number_of_coefficients():
    rng = np.random.default_rng(4)
    basis = np.vander(np.linspace(-1, 1, 12), 5)
    projected = np.eye(12) - basis @ np.linalg.pinv(basis)
    found = [
        restricted_variance(np.eye(12), basis, projected @ rng.normal(size=12)) for _ in range(2000)
    ]
    assert np.mean(found) == pytest.approx(1.0, abs=0.05)


def test_unseen_spacings_and_left_out_cases_of_the_finite_elements(plates):
    left_out = leave_one_out(plates)
    assert left_out.largest <= 0.2
    assert 90 <= left_out.coverage_percent <= 99


def test_two_spacings_do_not_determine_how_spacing_acts(plates):
    kept = plates.x[:, 0] != np.unique(plates.x[:, 0])[1]
    cases = FitCases(plates.x[kept], plates.y[kept], PLATES, (), PUBLISHED_PLY)
    with pytest.raises(InputError, match="do not determine the 7 coeff.*2 of spacing_mm"):
        fit_surface(LaminationModel(kind="lamination", coefficients=7), cases)
    for surface in (plates, plates.mean):
        level = leave_one_level_out(surface, 0)
        assert np.isnan(level.largest)
        assert "do not determine" in level.refused
        assert leave_one_level_out(surface, 1).largest <= 3.0


def test_the_interval_holds_for_the_fifteen_cases_of_table_7():
    table = pd.read_csv(PUBLISHED / "table7_rubber_doe.csv")
    terms = pd.read_csv(PUBLISHED / "table8_rubber_coefficients.csv", dtype={"term": str})["term"]
    x, y = table[list(RUBBERS)].to_numpy(float), table["stiffness_n_per_mm"].to_numpy(float)
    model = GaussianProcessModel(kind="gaussian_process", mean=PolynomialModel(kind="polynomial"))
    surface = fit_surface(model, FitCases(x, y, RUBBERS, list(terms)))
    assert leave_one_out(surface).coverage_percent >= 90
