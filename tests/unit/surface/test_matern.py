"""Covariance and likelihood of a Matérn process against scikit-learn's, slopes by differences."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

from nptcs.surface.kinds.gaussian_process import has_noise
from nptcs.surface.kinds.matern import ROWS, MaternLikelihood, covariance

NUGGET = 1e-8


def cases(noisy):
    points = np.random.default_rng(3).uniform(-1, 1, (14, 2))
    if noisy:
        points[7:] = points[:7]
    values = np.sin(3 * points[:, 0]) + points[:, 1] ** 2
    return points, values + noisy * np.random.default_rng(4).normal(0, 0.1, 14)


def their_kernel(noisy):
    kernel = ConstantKernel(1.0) * Matern([1.0, 1.0], nu=2.5)
    return kernel + WhiteKernel(1e-2) if noisy else kernel


def test_the_covariance_is_that_of_scikit_learn():
    rng = np.random.default_rng(1)
    points, others = rng.uniform(-1, 1, (ROWS + 7, 2)), rng.uniform(-1, 1, (9, 2))
    theta = np.array([0.4, -1.0, 0.7])
    theirs = their_kernel(False).clone_with_theta(theta)(points, others)
    np.testing.assert_allclose(covariance(theta, points, others), theirs, rtol=1e-12)


def test_equal_cases_with_different_responses_have_noise():
    points, values = cases(True)
    assert has_noise(points, values)
    assert not has_noise(points, np.tile(values[:7], 2))
    assert not has_noise(*cases(False))
    assert has_noise(points[[0, 3, 8, 0]], np.array([1.0, 2.0, 3.0, 1.1]))
    assert not has_noise(points[[0, 3, 8, 0]], np.array([1.0, 2.0, 3.0, 1.0 + 1e-7]))


@pytest.mark.parametrize("noisy", [False, True])
@settings(max_examples=30, deadline=None)
@given(logarithms=st.lists(st.floats(-2.0, 2.0), min_size=4, max_size=4))
def test_value_and_slope_are_those_of_scikit_learn(noisy, logarithms):
    points, values = cases(noisy)
    kernel = their_kernel(noisy)
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
