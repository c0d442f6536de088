"""D-optimal designs: cases chosen from candidates so that det(XᵀX) is as large as possible."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.errors import InputError

GAIN = 1e-9
"""Smallest increase of the logarithm of the determinant for which a case is exchanged."""

RIDGE = 1e-8
"""Added to the diagonal while a random start is still singular."""


def d_optimal(candidates: Array, cases: int, starts: int, seed: int) -> Rows:
    """Choose cases by exchanges (Fedorov), from random starts; the best start wins.

    No candidate is chosen twice: a deterministic solver would only repeat its result.

    Parameters
    ----------
    candidates : ndarray of shape (m, p)
        Terms of the surface at each candidate, in coded units.
    cases : int
        Between p and m.
    starts, seed : int
        Number of random starts, and the seed of the random numbers.

    Returns
    -------
    ndarray of shape (cases,)
        Row numbers of the chosen candidates, in increasing order.

    Raises
    ------
    InputError
        When there are fewer cases than terms or fewer candidates than cases, or when the
        candidates cannot determine the terms.
    """
    number, terms = candidates.shape
    if not terms <= cases <= number:
        raise InputError(
            f"a D-optimal design for {terms} terms needs at least {terms} cases, and at most "
            f"{number}, the number of candidates",
            column="design.cases",
            value=cases,
            remedy="change the number of cases, the terms or the levels",
        )
    if np.linalg.matrix_rank(candidates) < terms:
        raise InputError(
            "all candidates together cannot determine the terms",
            column="design.terms",
            remedy="give each factor one more level than its highest power, or drop terms",
        )
    generator = np.random.default_rng(seed)
    found = [_exchanged(candidates, generator.permutation(number)[:cases]) for _ in range(starts)]
    return np.sort(max(found, key=lambda chosen: log_determinant(candidates[chosen])))


def log_determinant(matrix: Array) -> float:
    """Return log det(XᵀX) of a design matrix; minus infinity if it is singular."""
    sign, value = np.linalg.slogdet(matrix.T @ matrix)
    return float(value) if sign > 0 else -np.inf


def _exchanged(candidates: Array, chosen: Rows) -> Rows:
    """Exchange the pair of cases that gains most, until none gains."""
    chosen = chosen.copy()
    while True:
        current = candidates[chosen]
        moment = current.T @ current
        inverse = np.linalg.inv(moment + RIDGE * np.trace(moment) * np.eye(len(moment)))
        spread = candidates @ inverse
        own = np.einsum("ij,ij->i", spread, candidates)
        mixed = spread[chosen] @ candidates.T
        # det grows by (1 + d_new)(1 - d_old) + d_mixed² when old is exchanged for new
        growth = (1 + own[None, :]) * (1 - own[chosen][:, None]) + mixed**2
        growth[:, chosen] = 0.0
        old, new = np.unravel_index(int(np.argmax(growth)), growth.shape)
        if growth[old, new] <= 1 + GAIN:
            return chosen
        before = log_determinant(current)
        exchanged = chosen.copy()
        exchanged[old] = new
        if log_determinant(candidates[exchanged]) <= before + GAIN and np.isfinite(before):
            return chosen
        chosen = exchanged
