"""Canonical analysis of a polynomial: stationary points with their kind, and the ridge path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Literal

import numpy as np
from scipy import optimize

from nptcs.arrays import Array, Index
from nptcs.surface.fit import Surface
from nptcs.surface.response_surface import inside_box

FLAT = 1e-6
"""Share of the largest curvature below which a direction counts as flat."""

SAME = 1e-6
"""Distance in coded units within which two stationary points count as one."""

STARTS_PER_AXIS = 5
DIRECTIONS_TRIED = 2000
"""Directions (fixed seed) among which the start of the search on a sphere is chosen."""

Direction = Literal["maximum", "minimum"]


@dataclass(frozen=True)
class StationaryPoint:
    """A point at which the surface has no slope.

    Parameters
    ----------
    point : ndarray of shape (n,)
        Natural units; a factor that the analysis holds is at its middle.
    response : float
        Value of the surface.
    curvatures : ndarray of shape (k,)
        Eigenvalues of half the Hessian in coded units, the largest first.
    axes : ndarray of shape (k, n)
        Their directions in coded units.
    kind : str
        maximum, minimum, saddle, ridge of a maximum or ridge of a minimum.
    inside : bool
        Whether it lies in the box of the cases.
    """

    point: Array
    response: float
    curvatures: Array
    axes: Array
    kind: str
    inside: bool


def stationary_points(surface: Surface) -> list[StationaryPoint]:
    """Find where the surface has no slope in the factors that it is curved in.

    Factors with linear terms alone, such as those that stand for blocks, are held: they move the
    surface and not its stationary point. A second-order surface has one point, wherever it lies;
    of surfaces of higher order the points inside the box are found, from a grid of starts.
    """
    axes = curved_axes(surface)
    if not axes:
        return []
    if max(sum(powers) for powers in surface.polynomial.exponents) == 2:
        origin = np.zeros(len(surface.factors))
        hessian = _hessian(surface, origin)[np.ix_(axes, axes)]
        if np.linalg.cond(hessian) > 1 / np.finfo(float).eps:
            return []
        origin[axes] = np.linalg.solve(hessian, -_slope(surface, origin)[axes])
        return [_described(surface, origin, axes)]
    found: list[Array] = []
    for start in product(np.linspace(-1, 1, STARTS_PER_AXIS), repeat=len(axes)):
        point = _root(surface, np.array(start), axes)
        if point is not None and all(np.abs(point - other).max() > SAME for other in found):
            found.append(point)
    return [_described(surface, point, axes) for point in found]


def curved_axes(surface: Surface) -> list[int]:
    """Find the columns of the factors that appear in a term of second order or higher."""
    curved = [powers for powers in surface.polynomial.exponents if sum(powers) > 1]
    return [axis for axis in range(len(surface.factors)) if any(powers[axis] for powers in curved)]


def ridge_path(
    surface: Surface, direction: Direction, radii: Sequence[float], held: Sequence[str] = ()
) -> list[tuple[float, Array, float]]:
    """Follow the largest or smallest response on spheres about the centre, in coded units.

    Parameters
    ----------
    surface : Surface
        The fitted polynomial.
    direction : str
        ``maximum`` or ``minimum``.
    radii : sequence of float
        Growing radii in coded units; 1 reaches the middle of the box's faces.
    held : sequence of str
        Factors that stay at their middle, such as those that stand for blocks.

    Returns
    -------
    list of (radius, point of shape (n,) in natural units, response)
    """
    axes = [axis for axis, name in enumerate(surface.factors) if name not in held]
    sign = -1.0 if direction == "maximum" else 1.0
    centre, half = surface.coding()
    directions = np.random.default_rng(0).normal(size=(DIRECTIONS_TRIED, len(axes)))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    path = []
    for radius in radii:
        tried = np.zeros((len(directions), len(surface.factors)))
        tried[:, axes] = radius * directions
        values = surface.polynomial.matrix(tried) @ surface.coefficients_coded
        start = directions[np.argmin(sign * values)]
        coded = _whole(surface, radius * _best_direction(surface, sign, start, radius, axes), axes)
        value = float(surface.polynomial.matrix(coded[None, :])[0] @ surface.coefficients_coded)
        path.append((float(radius), centre + half * coded, value))
    return path


def _best_direction(
    surface: Surface, sign: float, start: Array, radius: float, axes: list[int]
) -> Array:
    """Find the unit vector along which the surface is extreme at a radius, from a good start."""

    def value_and_slope(vector: Array) -> tuple[float, Array]:
        length = float(np.linalg.norm(vector))
        unit = vector / length
        coded = _whole(surface, radius * unit, axes)
        value = surface.polynomial.matrix(coded[None, :])[0] @ surface.coefficients_coded
        slope = _slope(surface, coded)[axes] * radius
        return sign * float(value), sign * (slope - unit * (unit @ slope)) / length

    if radius == 0:
        return start
    found = optimize.minimize(value_and_slope, start, jac=True, method="BFGS", tol=1e-10)
    return np.asarray(found.x / np.linalg.norm(found.x), dtype=float)


def _root(surface: Surface, start: Array, axes: list[int]) -> Array | None:
    """Search for a point without slope inside the box; None if the search ends elsewhere."""
    found = optimize.least_squares(
        lambda coded: _slope(surface, _whole(surface, coded, axes))[axes],
        start,
        jac=lambda coded: _hessian(surface, _whole(surface, coded, axes))[np.ix_(axes, axes)],
        bounds=(-1 - SAME, 1 + SAME),
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
    )
    if np.abs(found.fun).max() > SAME * np.abs(surface.coefficients_coded[1:]).max():
        return None
    return _whole(surface, found.x, axes)


def _described(surface: Surface, coded: Array, axes: list[int]) -> StationaryPoint:
    values, vectors = np.linalg.eigh(_hessian(surface, coded)[np.ix_(axes, axes)] / 2)
    directions = np.zeros((len(axes), len(coded)))
    directions[:, axes] = vectors.T[::-1]
    centre, half = surface.coding()
    point = centre + half * coded
    return StationaryPoint(
        point=point,
        response=float(surface.predict(point[None, :])[0]),
        curvatures=values[::-1],
        axes=directions,
        kind=_kind(values),
        inside=bool(inside_box(surface, point[None, :])[0]),
    )


def _kind(curvatures: Array) -> str:
    flat = np.abs(curvatures) < FLAT * np.abs(curvatures).max()
    steep = curvatures[~flat]
    if (steep > 0).any() and (steep < 0).any():
        return "saddle"
    kind = "maximum" if steep.max() < 0 else "minimum"
    return f"ridge of a {kind}" if flat.any() else kind


def _whole(surface: Surface, coded: Array, axes: list[int]) -> Array:
    """Return a whole point from the coded values of some factors, the others at their middle."""
    point = np.zeros(len(surface.factors))
    point[axes] = coded
    return point


def _slope(surface: Surface, coded: Array) -> Array:
    """∂f/∂c at a coded point, shape (n,)."""
    first, _ = _derivatives(surface.polynomial.exponents)
    slope: Array = _evaluated(first, coded) @ surface.coefficients_coded
    return slope


def _hessian(surface: Surface, coded: Array) -> Array:
    """∂²f/∂c∂c at a coded point, shape (n, n)."""
    _, second = _derivatives(surface.polynomial.exponents)
    hessian: Array = _evaluated(second, coded) @ surface.coefficients_coded
    return hessian


@dataclass(frozen=True)
class _Derivatives:
    """Derivatives of p terms: a factor of each, and the powers that are left, (..., p, n)."""

    factors: Array
    powers: Index


@lru_cache(maxsize=32)
def _derivatives(exponents: tuple[tuple[int, ...], ...]) -> tuple[_Derivatives, _Derivatives]:
    """First derivatives of terms by each of n factors, (n, p), and second ones, (n, n, p)."""
    powers = np.array(exponents)
    unit = np.eye(powers.shape[1], dtype=int)
    once = powers - unit[:, None, :]
    twice = powers - unit[:, None, None, :] - unit[None, :, None, :]
    first = powers.T.astype(float)
    second = first[:, None, :] * (powers.T[None, :, :] - unit[:, :, None])
    return (
        _Derivatives(first, np.maximum(once, 0)),
        _Derivatives(second, np.maximum(twice, 0)),
    )


def _evaluated(derivatives: _Derivatives, coded: Array) -> Array:
    found: Array = derivatives.factors * np.prod(coded**derivatives.powers, axis=-1)
    return found
