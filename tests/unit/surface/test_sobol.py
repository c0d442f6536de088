"""Sobol indices against Ishigami's function and closed forms; near ties; failed cases."""

from itertools import product

import numpy as np
import pandas as pd
import pytest
from SALib.analyze import sobol as salib_analysis
from SALib.sample import sobol as salib_sample

from nptcs.config.studies.sensitivity import NormalFactor, Sensitivity, Sobol, UniformFactor
from nptcs.errors import InputError
from nptcs.surface.fit import fit
from nptcs.surface.sensitivity.saltelli import RESAMPLES, estimates
from nptcs.surface.sensitivity.sobol import factor_distribution, main_effect, sobol_indices
from nptcs.surface.sensitivity.sobol_tables import variance_shares
from nptcs.surface.sensitivity.ties import near_ties
from nptcs.tables.analysis.sobol import MainEffects, SobolIndices
from nptcs.tables.io import check

A, B = 7.0, 0.1


def ishigami(x):
    return np.sin(x[:, 0]) + A * np.sin(x[:, 1]) ** 2 + B * x[:, 2] ** 4 * np.sin(x[:, 0])


def uniform(names, low, high):
    return {name: factor_distribution(name, low, high, None) for name in names}


def test_ishigami():
    found = sobol_indices(ishigami, uniform("abc", -np.pi, np.pi), Sobol(points=4096))
    v1 = 0.5 * (1 + B * np.pi**4 / 5) ** 2
    v2 = A**2 / 8
    v13 = B**2 * np.pi**8 * (1 / 18 - 1 / 50)
    total = v1 + v2 + v13

    assert found.sd == pytest.approx(np.sqrt(total), rel=0.01)
    np.testing.assert_allclose(found.first, np.array([v1, v2, 0]) / total, atol=0.02)
    np.testing.assert_allclose(found.total, np.array([v1 + v13, v2, v13]) / total, atol=0.02)
    assert found.second[0, 2] == pytest.approx(v13 / total, abs=0.03)
    error = np.abs(found.total - np.array([v1 + v13, v2, v13]) / total)
    assert (error < 2 * found.total_confidence).all()


@pytest.mark.parametrize("interactions", [True, False])
@pytest.mark.parametrize("confidence", [0.95, 0.6])
def test_indices_and_bootstrap_are_those_of_salib(interactions, confidence):
    problem = {"num_vars": 3, "names": list("abc"), "bounds": [[-np.pi, np.pi]] * 3}
    points = salib_sample.sample(problem, 256, calc_second_order=interactions, seed=5)
    response = 1000.0 + ishigami(points)
    theirs = salib_analysis.analyze(
        problem,
        response,
        calc_second_order=interactions,
        num_resamples=RESAMPLES,
        conf_level=confidence,
        seed=7,
    )
    ours = estimates(response, 3, interactions, confidence, 7)
    for name, found, width in (
        ("S1", ours.first, ours.first_confidence),
        ("ST", ours.total, ours.total_confidence),
        *([("S2", ours.second, ours.second_confidence)] if interactions else []),
    ):
        np.testing.assert_array_equal(found, theirs[name])
        np.testing.assert_allclose(width, theirs[f"{name}_conf"], rtol=1e-12)


def test_a_seed_of_zero_is_a_seed():
    found = [
        sobol_indices(ishigami, uniform("abc", -np.pi, np.pi), Sobol(points=64, seed=0))
        for _ in range(2)
    ]
    np.testing.assert_array_equal(found[0].total_confidence, found[1].total_confidence)


def test_normal_factors_share_the_variance_by_the_square_of_their_spread():
    # a linear response of independent normals: S_i = (c_i s_i)² / Σ
    inputs = {
        "a": factor_distribution("a", -40, 40, NormalFactor(kind="normal", mean=0, sd=1)),
        "b": factor_distribution("b", -40, 40, NormalFactor(kind="normal", mean=5, sd=2)),
    }
    found = sobol_indices(lambda x: 3 * x[:, 0] + x[:, 1], inputs, Sobol(points=4096))
    np.testing.assert_allclose(found.total, [9 / 13, 4 / 13], atol=0.02)
    assert found.sd == pytest.approx(np.sqrt(13), rel=0.02)


def test_distributions_are_cut_to_the_cases_and_say_so():
    half = factor_distribution("a", 0, 10, NormalFactor(kind="normal", mean=10, sd=1))
    assert half.cut_percent == pytest.approx(50, abs=0.01)
    third = factor_distribution("a", 0, 10, UniformFactor(kind="uniform", low=5, high=20))
    assert (third.low, third.high) == (5, 10)
    assert third.cut_percent == pytest.approx(100 * 2 / 3)
    with pytest.raises(InputError, match="outside the cases") as refusal:
        factor_distribution("a", 0, 10, UniformFactor(kind="uniform", low=20, high=30))
    assert "sensitivity.distributions.a" in str(refusal.value)


def test_main_effect_of_a_product_is_flat():
    inputs = list(uniform("ab", -1.0, 1.0).values())
    values, effect = main_effect(lambda x: x[:, 0] * x[:, 1] + x[:, 0], inputs, 1, Sobol())
    np.testing.assert_allclose(effect, 0, atol=0.01)
    values, effect = main_effect(lambda x: x[:, 0] * x[:, 1] + x[:, 0], inputs, 0, Sobol())
    np.testing.assert_allclose(effect, values, atol=0.01)


def test_a_surface_that_does_not_vary_is_refused():
    with pytest.raises(InputError, match="has no indices"):
        sobol_indices(lambda x: np.ones(len(x)), uniform("ab", 0, 1), Sobol())


def surfaces(slope):
    points = pd.DataFrame(list(product([0.0, 1.0, 2.0], repeat=2)), columns=["a", "b"])
    y = 10 * points["a"] + slope * points["b"] + points["a"] * points["b"]
    return {"polynomial": fit(points, y, ["a", "b"], ["1", "a", "b", "a*b"])}


def test_tables_say_what_is_near_and_what_failed():
    models = {"s": {"one": surfaces(9.0), "two": surfaces(2.0)}}
    settings = Sensitivity(distributions={"a": NormalFactor(kind="normal", mean=1, sd=0.1)})
    shares = variance_shares(models, {("s", "one"): 0, ("s", "two"): 3}, settings)
    indices = check(shares.indices, SobolIndices, "sobol")
    check(shares.effects, MainEffects, "effects")
    alone = indices[(indices["partner"] == "") & (indices["inputs"] == "uniform")]

    assert set(alone["near_tie_with"]) == {"a", "b"}
    assert alone.groupby("solver")["failed_cases"].first().to_dict() == {"one": 0, "two": 3}
    given = indices[(indices["partner"] == "") & (indices["inputs"] == "given")]
    # a scatters by 0.1 only: b leads, and no ranking disagrees
    assert set(given.loc[given["rank"] == 1, "factor"]) == {"b"}
    assert set(given["near_tie_with"]) == {""}
    assert shares.problems.empty


def test_an_order_that_rankings_disagree_on_is_a_near_tie():
    table = pd.DataFrame(
        {
            "rule": ["r1"] * 3 + ["r2"] * 3,
            "factor": ["s", "t", "a"] * 2,
            "impact": [-50.0, 10.0, 15.0, 50.0, 15.0, -5.0],
        }
    )
    ties = near_ties(table, ["rule"], "factor", "impact", 0.8)
    assert ties.tolist() == ["", "a", "t", "", "a", "t"]
    assert near_ties(table[:3], ["rule"], "factor", "impact", 0.8).tolist() == ["", "", ""]
    assert near_ties(table[:3], ["rule"], "factor", "impact", 0.6).tolist() == ["", "a", "t"]
