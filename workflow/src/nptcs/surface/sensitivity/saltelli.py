"""Saltelli's estimators of Sobol indices from the responses at SALib's sample, and their bootstrap.

The estimators are SALib's. So are the resamples of its bootstrap at the same seed, but a mean over
a resample is computed here as a sum weighted by how often the resample contains each point: all
resamples of all indices are then one product of matrices, and the half widths are equal up to
rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from SALib.analyze.sobol import first_order, second_order, separate_output_values, total_order
from scipy import stats

from nptcs.arrays import Array

RESAMPLES = 200


@dataclass(frozen=True)
class Estimates:
    """Indices of n factors, and the half widths of their confidence intervals.

    Parameters
    ----------
    first, total, first_confidence, total_confidence : ndarray of shape (n,)
    second, second_confidence : ndarray of shape (n, n)
        Interactions in the upper triangle; NaN elsewhere, and where they were not requested.
    """

    first: Array
    first_confidence: Array
    total: Array
    total_confidence: Array
    second: Array
    second_confidence: Array


def estimates(
    response: Array, factors: int, interactions: bool, confidence: float, seed: int
) -> Estimates:
    """Estimate indices (Saltelli et al. 2010; interactions: Saltelli 2002), as SALib does.

    Parameters
    ----------
    response : ndarray of shape (points × (2 n + 2),), or points × (n + 2) without interactions
        Responses at SALib's sample, which must not all be equal.
    factors : int
        Number n of factors.
    interactions : bool
        Whether the sample was made for second-order indices.
    confidence : float
        Level of the intervals.
    seed : int
        Seed of the bootstrap.
    """
    scaled = (response - response.mean()) / response.std()
    points = len(scaled) // ((2 * factors if interactions else factors) + 2)
    a, b, ab, ba = separate_output_values(scaled, factors, points, interactions)
    axes, pairs = range(factors), list(combinations(range(factors), 2)) if interactions else []
    columns = [b * (ab[:, j] - a) for j in axes]
    columns += [0.5 * (a - ab[:, j]) ** 2 for j in axes]
    columns += [ba[:, j] * ab[:, k] - a * b for j, k in pairs]
    widths = _half_widths(columns, a, b, pairs, confidence, seed)
    second, second_confidence = (np.full((factors, factors), np.nan) for _ in range(2))
    for (j, k), width in zip(pairs, widths[2 * factors :], strict=True):
        second[j, k] = second_order(a, ab[:, j], ab[:, k], ba[:, j], b)
        second_confidence[j, k] = width
    return Estimates(
        first=np.array([first_order(a, ab[:, j], b) for j in axes]),
        first_confidence=widths[:factors],
        total=np.array([total_order(a, ab[:, j], b) for j in axes]),
        total_confidence=widths[factors : 2 * factors],
        second=second,
        second_confidence=second_confidence,
    )


def _half_widths(
    columns: list[Array],
    a: Array,
    b: Array,
    pairs: list[tuple[int, int]],
    confidence: float,
    seed: int,
) -> Array:
    """Half widths of indices of which `columns` are the numerators' terms, by the bootstrap.

    Parameters
    ----------
    columns : list of ndarray of shape (points,)
        Of n first-order and n total indices, then of the pairs.
    a, b : ndarray of shape (points,)
        Responses at both independent samples; their variance is the denominator.
    """
    terms = np.column_stack([*columns, (a + b) / 2.0, (a**2 + b**2) / 2.0])
    means = _shares(len(a), seed) @ terms
    variance = means[:, -1] - means[:, -2] ** 2
    varies = variance > np.finfo(float).eps
    ratios = np.divide(
        means[:, :-2],
        variance[:, None],
        out=np.zeros((len(means), len(columns))),
        where=varies[:, None],
    )
    both = len(columns) - len(pairs)
    for place, (j, k) in enumerate(pairs):
        ratios[:, both + place] -= ratios[:, j] + ratios[:, k]
    spread: Array = stats.norm.ppf(0.5 + confidence / 2) * ratios.std(axis=0, ddof=1)
    return spread


@lru_cache(maxsize=4)
def _shares(points: int, seed: int) -> Array:
    """Share of each point in each resample, (resamples, points): SALib's draws at this seed."""
    drawn = np.random.default_rng(seed).integers(points, size=(points, RESAMPLES))
    places = drawn + points * np.arange(RESAMPLES)
    counts = np.bincount(places.ravel(), minlength=points * RESAMPLES)
    return counts.reshape(RESAMPLES, points) / points
