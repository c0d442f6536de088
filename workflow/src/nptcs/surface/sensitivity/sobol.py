"""Sobol indices and main effects of any surface, for independent factors."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, assert_never

import numpy as np
from SALib.sample import sobol as sobol_sample
from scipy import stats

from nptcs.arrays import Array
from nptcs.config.studies.sensitivity import Distribution, NormalFactor, Sobol, UniformFactor
from nptcs.errors import InputError
from nptcs.surface.sensitivity.saltelli import Estimates, estimates

EFFECT_POINTS = 11
"""Values of a factor at which its main effect is given."""


@dataclass(frozen=True)
class FactorDistribution:
    """One factor as it is sampled.

    Parameters
    ----------
    low, high : float
        Range, inside the box of the cases.
    kind : str
        ``unif`` or ``truncnorm``, as SALib names them.
    bounds : tuple of float
        As SALib takes them: low and high, then mean and standard deviation of a normal.
    words : str
        The distribution in words.
    cut_percent : float
        Share of the distribution outside the range: it is cut off.
    """

    low: float
    high: float
    kind: str
    bounds: tuple[float, ...]
    words: str
    cut_percent: float = 0.0


@dataclass(frozen=True)
class Indices(Estimates):
    """Sobol indices of a response, whose intervals are those of a bootstrap.

    Parameters
    ----------
    sd : float
        Standard deviation of the response over the inputs.
    samples : int
        Evaluations of the surface.
    """

    sd: float
    samples: int


def factor_distribution(
    factor: str, low: float, high: float, given: Distribution | None
) -> FactorDistribution:
    """Return how a factor is sampled: uniform over its range, or as given, cut to the range.

    Raises
    ------
    InputError
        For a distribution that lies outside the range of the cases.
    """
    bounds: tuple[float, ...]
    match given:
        case None:
            return FactorDistribution(
                low, high, "unif", (low, high), f"uniform {low:.6g} to {high:.6g}"
            )
        case UniformFactor():
            bottom, top = max(low, given.low), min(high, given.high)
            inside = max(top - bottom, 0.0) / (given.high - given.low)
            words = f"uniform {given.low:g} to {given.high:g}"
            kind, bounds = "unif", (bottom, top)
        case NormalFactor():
            bottom, top = low, high
            normal = stats.norm(given.mean, given.sd)
            inside = float(normal.cdf(high) - normal.cdf(low))
            words = f"normal, mean {given.mean:g}, SD {given.sd:g}"
            kind, bounds = "truncnorm", (low, high, given.mean, given.sd)
        case _:
            assert_never(given)
    if inside < 0.01:
        raise InputError(
            f"this distribution is outside the cases ({low:g} to {high:g})",
            column=f"sensitivity.distributions.{factor}",
            value=words,
            remedy="give a distribution inside the range of the levels",
        )
    return FactorDistribution(bottom, top, kind, bounds, words, 100 * (1 - inside))


def sobol_indices(
    predict: Callable[[Array], Array],
    inputs: Mapping[str, FactorDistribution],
    settings: Sobol,
    interactions: bool = True,
) -> Indices:
    """Estimate first-order, second-order and total indices (Saltelli's scheme, SALib).

    Parameters
    ----------
    predict : callable
        Points of shape (m, n) → responses of shape (m,).
    inputs : mapping of str to FactorDistribution
        The n factors in the order of the columns of the points.
    settings : Sobol
        Points, confidence and seed.
    interactions : bool
        Whether to estimate second-order indices, which cost as much again.

    Returns
    -------
    Indices

    Raises
    ------
    InputError
        When the response does not vary, or is not a number somewhere.
    """
    given = tuple(inputs.items())
    response = predict(_points(given, settings.points, settings.seed, interactions))
    if not np.isfinite(response).all() or np.ptp(response) == 0:
        raise InputError(
            "the surface is the same everywhere, or not a number somewhere, and has no indices",
            value=float(response.min()),
            remedy="look at surface_comparison.csv",
        )
    found = estimates(response, len(given), interactions, settings.confidence, settings.seed)
    return Indices(**vars(found), sd=float(np.std(response)), samples=len(response))


def main_effect(
    predict: Callable[[Array], Array],
    inputs: Sequence[FactorDistribution],
    axis: int,
    settings: Sobol,
) -> tuple[Array, Array]:
    """Mean of the response over all other factors at values of one, minus its overall mean.

    Returns
    -------
    values, effects : ndarray of shape (11,)
        Evenly spaced over the factor's range; in the unit of the response.
    """
    given = tuple((str(number), one) for number, one in enumerate(inputs))
    points = _points(given, settings.points, settings.seed, False)[:: len(inputs) + 2].copy()
    values = np.linspace(inputs[axis].low, inputs[axis].high, EFFECT_POINTS)
    overall = float(predict(points).mean())
    means = []
    for value in values:
        points[:, axis] = value
        means.append(float(predict(points).mean()))
    return values, np.array(means) - overall


@lru_cache(maxsize=8)
def _points(
    inputs: tuple[tuple[str, FactorDistribution], ...], count: int, seed: int, interactions: bool
) -> Array:
    """Saltelli's sample of these inputs, which the surfaces of a solver share."""  # noqa: D401
    sample: Array = sobol_sample.sample(
        _problem(inputs), count, calc_second_order=interactions, seed=seed
    )
    sample.flags.writeable = False
    return sample


def _problem(inputs: tuple[tuple[str, FactorDistribution], ...]) -> dict[str, Any]:
    """Describe the inputs as SALib does."""
    return {
        "num_vars": len(inputs),
        "names": [name for name, _ in inputs],
        "bounds": [list(one.bounds) for _, one in inputs],
        "dists": [one.kind for _, one in inputs],
    }
