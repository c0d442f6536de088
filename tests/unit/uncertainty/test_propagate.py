"""Propagation against closed forms and against Sobol indices."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from SALib.analyze import sobol as sobol_analysis
from SALib.sample import sobol as sobol_sample
from scipy import stats

from nptcs.tables.analysis.uncertainty import SourceKind
from nptcs.uncertainty.inputs import UncertainInput
from nptcs.uncertainty.propagate import assessed, distribution, moments, shares_percent


class Model:
    """f(x + changes) of given factors; the model itself has no error unless stated."""

    def __init__(self, function, factors, sd=0.0):
        self.function, self.factors, self.sd = function, factors, sd
        self.knows = frozenset(factors)
        self.lower, self.upper = np.full(len(factors), -1e9), np.full(len(factors), 1e9)

    def value(self, x, changes):
        moved = [x[:, n] + changes.get(name, 0.0) for n, name in enumerate(self.factors)]
        return self.function(*moved)

    def own_sd(self, x):
        return np.full(len(x), self.sd)

    def inside(self, x):
        return np.ones(len(x), dtype=bool)


def source(name, root, shape="normal"):
    names = (name,) if isinstance(name, str) else tuple(name)
    root = np.atleast_2d(np.array(root, dtype=float))
    return UncertainInput(", ".join(names), SourceKind.TOLERANCE, "test", names, root, shape)


def test_correlated_inputs_of_a_linear_response_have_the_variance_of_their_covariance():
    covariance = np.array([[4.0, -1.5], [-1.5, 1.0]])
    root = np.linalg.cholesky(covariance)
    model = Model(lambda a, b, c: 3 * a + 2 * b - c, ("a", "b", "c"), sd=0.5)
    inputs = [source(("a", "b"), root), source("c", 0.7)]
    found = moments(model, inputs, np.zeros((1, 3)))
    g = np.array([3.0, 2.0])
    np.testing.assert_allclose(found.variances[0], [g @ covariance @ g, 0.49, 0.25])
    np.testing.assert_allclose(found.sd[0] ** 2, g @ covariance @ g + 0.49 + 0.25)


def test_a_parabola_has_its_mean_shift_and_variance():
    # x ~ N(1, s²): E x² = 1 + s², Var x² = 4 s² + 2 s⁴; uniform ± h: Var x² by moments
    model = Model(lambda a: a**2, ("a",))
    found = moments(model, [source("a", 0.3)], np.array([[1.0]]))
    np.testing.assert_allclose(found.mean, 1 + 0.09)
    np.testing.assert_allclose(found.variances[0, 0], 4 * 0.09 + 2 * 0.09**2)
    found = moments(model, [source("a", 0.3, "uniform")], np.array([[1.0]]))
    np.testing.assert_allclose(found.mean, 1 + 0.03)
    np.testing.assert_allclose(found.variances[0, 0], 4 * 0.03 + 0.3**4 * (1 / 5 - 1 / 9))


def test_at_an_extremum_the_variance_is_not_zero():
    """A gradient alone would say that an angle of 0 degrees needs no tolerance."""
    model = Model(lambda a: 300 - 0.5 * a**2, ("a",))
    assert moments(model, [source("a", 1.0)], np.zeros((1, 1))).sd[0] == pytest.approx(0.5**0.5)


def test_shares_agree_with_sobol_indices_and_interactions_show():
    def function(a, b, c):
        return np.exp(0.2 * a) * (5 + b) + 0.3 * c**2

    model = Model(function, ("a", "b", "c"))
    inputs = [source("a", 0.5), source("b", 0.8), source("c", 0.4)]
    found = moments(model, inputs, np.array([[1.0, 2.0, 1.0]]))
    problem = {
        "num_vars": 3,
        "names": ["a", "b", "c"],
        "bounds": [[1, 0.5], [2, 0.8], [1, 0.4]],
        "dists": ["norm"] * 3,
    }
    points = sobol_sample.sample(problem, 8192, calc_second_order=False, seed=1)
    indices = sobol_analysis.analyze(
        problem, function(*points.T), calc_second_order=False, num_resamples=20, seed=1
    )
    samples = distribution([model], inputs, np.array([1.0, 2.0, 1.0]), 8192, 1)[:, 0]
    variance = samples.var()
    np.testing.assert_allclose(found.variances[0, :3] / variance, indices["S1"], atol=0.02)
    interaction = 1 - found.variances.sum() / variance
    assert interaction == pytest.approx(1 - indices["S1"].sum(), abs=0.02)


def test_the_distribution_has_the_stated_one():
    model = Model(lambda a: 2 * a, ("a",), sd=0.3)
    samples = distribution([model], [source("a", 0.2)], np.array([1.0]), 4096, 1)[:, 0]
    expected = stats.norm(2, np.hypot(0.4, 0.3))
    np.testing.assert_allclose(
        np.quantile(samples, [0.025, 0.5, 0.975]), expected.ppf([0.025, 0.5, 0.975]), atol=0.02
    )


def test_responses_of_one_design_share_the_inputs_and_not_the_surfaces_errors():
    one, other = Model(lambda a: a, ("a",)), Model(lambda a: 3 * a, ("a",))
    samples = distribution([one, other], [source("a", 1.0)], np.zeros(1), 1024, 1)
    np.testing.assert_allclose(samples[:, 1], 3 * samples[:, 0])
    noisy = Model(lambda a: a * 0, ("a",), sd=1.0)
    samples = distribution([noisy, noisy], [], np.zeros(1), 1024, 1)
    assert abs(np.corrcoef(samples.T)[0, 1]) < 0.05


def test_an_input_without_a_known_effect_is_set_apart():
    model = Model(lambda a: a, ("a",))
    inputs = [source("a", 1.0), source("e1_mpa", 2000.0)]
    followed, rest = assessed(model, inputs)
    assert [one.name for one in followed] == ["a"]
    assert [one.name for one in rest] == ["e1_mpa"]


@given(st.lists(st.floats(0.0, 1e12), min_size=1, max_size=8))
def test_a_share_is_never_more_than_the_whole(variances):
    shares = shares_percent(np.array(variances))
    assert (shares >= 0.0).all()
    assert (shares <= 100.0).all()
    assert shares.sum() == pytest.approx(100.0 if any(variances) else 0.0)


def test_the_only_source_has_the_whole():
    alone = np.linspace(0.01, 0.9, 1000)
    assert max(shares_percent(np.array([one, 0.0])).max() for one in alone) == 100.0
    assert (100 * alone / alone).max() > 100.0  # what the order of the division is for
