"""Numbers that many surfaces of a page share are written once.

The covariance of a polynomial's coefficients is its residual variance times (XᵀX)⁻¹, which depends
on the cases and the terms alone: all polynomials of a study, of any response, have the same one.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from nptcs.arrays import Array

Plain = dict[str, Any]

SAME = 1e-12
"""Largest difference of two such matrices, as a share of the largest number in them."""


def share_covariances(part: Any, shared: list[list[float]]) -> None:
    """Replace each covariance in plain values by its place in a list of matrices, in place.

    Parameters
    ----------
    part : object
        Plain values with surfaces anywhere in them.
    shared : list of list of float
        Covariances in units of the residual variance; new ones are added. One whose variance is
        zero or too small to divide by stays where it is.
    """
    if isinstance(part, list):
        for inner in part:
            share_covariances(inner, shared)
    elif isinstance(part, dict):
        if isinstance(part.get("covariance"), list):
            part["covariance"] = _place(part["covariance"], part["sd"], shared)
        for inner in part.values():
            share_covariances(inner, shared)


def _place(covariance: list[float], sd: float, shared: list[list[float]]) -> list[float] | int:
    variance = sd**2
    if not variance > np.finfo(float).tiny:
        return covariance
    unit = np.array(covariance) / variance
    for place, known in enumerate(shared):
        if _same(unit, np.array(known)):
            return place
    shared.append(unit.tolist())
    return len(shared) - 1


def _same(one: Array, other: Array) -> bool:
    return one.shape == other.shape and bool(
        np.abs(one - other).max() <= SAME * np.abs(other).max()
    )
