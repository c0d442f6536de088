"""Further cases where a surface is least sure."""

from __future__ import annotations

from itertools import product

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.doe.points import space_filling
from nptcs.doe.whole_plates import whole_plates
from nptcs.errors import InputError
from nptcs.surface.response_surface import ResponseSurface, box, inside_box

ALREADY = 1e-6
"""Share of a factor's range within which a candidate counts as one of the cases."""


CANDIDATES = 1024
DIGITS = 6
"""Significant digits of the candidates' values."""


def candidates_in_box(surface: ResponseSurface, tyre: TyreGeometry | None = None) -> Array:
    """Spread candidates over the box of a surface's cases, corners included, shape (m, n).

    With a tyre, each spacing is one that gives a whole number of plates.
    """
    lower, upper = box(surface.x)
    inner = space_filling("sobol", CANDIDATES, len(lower), seed=1)
    corners = np.array(list(product([-1.0, 1.0], repeat=len(lower))))
    points = (lower + upper) / 2 + np.vstack([corners, inner]) * (upper - lower) / 2
    rounded = np.vectorize(lambda value: float(f"{value:.{DIGITS}g}"))(points)
    rounded = np.clip(rounded, lower, upper)
    if tyre is not None:
        rounded = whole_plates(rounded, list(surface.factors), tyre)
    return np.unique(rounded[inside_box(surface, rounded)], axis=0)


def augment(surface: ResponseSurface, candidates: Array, cases: int) -> tuple[Array, Array]:
    """Choose candidates one after the other where the prediction interval is widest.

    After each choice the surface is fitted again as if the new case had returned the predicted
    value, so that the next choice is elsewhere.

    Parameters
    ----------
    surface : ResponseSurface
        A surface of any kind.
    candidates : ndarray of shape (m, n)
        Points in natural units, inside the box of the cases.
    cases : int
        Number of points to choose.

    Returns
    -------
    points : ndarray of shape (cases, n)
    half_widths : ndarray of shape (cases,)
        Half width of the prediction interval at each point just before it is chosen.

    Raises
    ------
    InputError
        When fewer unsolved candidates remain than `cases`.
    """
    span = np.ptp(surface.x, axis=0)
    free = np.array(
        [np.abs((surface.x - point) / span).max(axis=1).min() > ALREADY for point in candidates]
    )
    left = candidates[free]
    if len(left) < cases:
        raise InputError(
            f"only {len(left)} candidates are not solved yet",
            column="cases",
            value=cases,
            remedy="ask for fewer cases or give more candidates",
        )
    points, half_widths = [], []
    for _ in range(cases):
        low, high = surface.interval(left)
        widest = int(np.argmax(high - low))
        point = left[[widest]]
        points.append(point[0])
        half_widths.append(float(high[widest] - low[widest]) / 2)
        guess = np.append(surface.y, surface.predict(point))
        surface = surface.refit(np.vstack([surface.x, point]), guess)
        left = np.delete(left, widest, axis=0)
    return np.array(points), np.array(half_widths)
