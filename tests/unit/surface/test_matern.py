"""The likelihood of a Matérn process against scikit-learn's, its slope against differences."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.gaussian_process import GaussianProcessRegressor

from nptcs.surface.kinds.gaussian_process import kernel_of
from nptcs.surface.kinds.matern import MaternLikelihood

NUGGET = 1e-8


def cases(noisy):
    points = np.random.default_rng(3).uniform(-1, 1, (14, 2))
    if noisy:
        points[7:] = points[:7]
    values = np.sin(3 * points[:, 0]) + points[:, 1] ** 2
    return points, values + noisy * np.random.default_rng(4).normal(0, 0.1, 14)


@pytest.mark.parametrize("noisy", [False, True])
@settings(max_examples=30, deadline=None)
@given(logarithms=st.lists(st.floats(-2.0, 2.0), min_size=4, max_size=4))
def test_value_and_slope_are_those_of_scikit_learn(noisy, logarithms):
    points, values = cases(noisy)
    kernel = kernel_of(points, values)
    theta = np.array(logarithms)[: len(kernel.theta)]
    theirs = GaussianProcessRegressor(kernel, alpha=NUGGET, optimizer=None).fit(points, values)
    value, slope = theirs.log_marginal_likelihood(theta, eval_gradient=True)
    ours, our_slope = MaternLikelihood(points, values, NUGGET, noisy)(theta)
    assert len(kernel.theta) == 3 + noisy
    # the covariance's condition number, up to 1e9 here, times the rounding of its entries
    size = 1 + abs(value)
    assert ours == pytest.approx(-value, abs=1e-6 * size)
    np.testing.assert_allclose(our_slope, -slope, rtol=1e-5, atol=1e-5 * size)


def test_the_slope_is_that_of_differences():
    likelihood = MaternLikelihood(*cases(True), NUGGET, True)
    theta = np.array([0.3, -0.2, 0.5, -2.0])
    steps = 1e-5 * np.eye(4)
    differences = [(likelihood(theta + s)[0] - likelihood(theta - s)[0]) / 2e-5 for s in steps]
    np.testing.assert_allclose(likelihood(theta)[1], differences, rtol=1e-6, atol=1e-6)


def test_equal_points_without_noise_have_no_likelihood():
    points, values = cases(True)
    value, slope = MaternLikelihood(points, values, 0.0, False)(np.array([0.0, 1.0, 1.0]))
    assert value == np.inf
    assert not slope.any()
