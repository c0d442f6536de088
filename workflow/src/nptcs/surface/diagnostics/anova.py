"""Analysis of variance of a polynomial: sequential and partial sums of squares, lack of fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from scipy import linalg, stats

from nptcs.arrays import Array
from nptcs.surface.fit import Surface

NOISE_FREE = 1e-9
"""Share of the response's range below which replicates count as equal in response."""


class Noise(StrEnum):
    """What the cases say about the noise of the response."""

    REPLICATES = "replicates differ"
    EQUAL = "replicates are equal"
    UNKNOWN = "no replicates"


MEANING = {
    Noise.REPLICATES: "the chance of an effect this large from noise alone, as long as the lack of "
    "fit is not significant",
    Noise.EQUAL: "not a probability: the results have no noise, and a small p says only that the "
    "term is large compared with what the polynomial cannot follow",
    Noise.UNKNOWN: "not a probability where the results come from a deterministic solver, which "
    "has no noise: a small p then says only that the term is large compared with what the "
    "polynomial cannot follow",
}
"""What a p-value means."""


@dataclass(frozen=True)
class AnovaRow:
    """One source of variation.

    Parameters
    ----------
    source : str
        A group of terms, a term, the residual, the lack of fit, the pure error, or the total.
    kind : str
        ``group``, ``term`` or ``rest``.
    df : int
        Degrees of freedom.
    sequential, partial : float
        Sums of squares: after the sources before it, and after all others; not a number where
        there is none.
    f_value, p_value : float
        Of a group's sequential sum of squares against the residual, of a term's partial one, of
        the lack of fit against the pure error.
    """

    source: str
    kind: str
    df: int
    sequential: float
    partial: float = np.nan
    f_value: float = np.nan
    p_value: float = np.nan


def noise_of_replicates(surface: Surface) -> Noise:
    """Tell what equal cases of a surface say about the noise."""
    error, df = pure_error(surface.x, surface.y)
    if df == 0:
        return Noise.UNKNOWN
    return Noise.REPLICATES if error > (NOISE_FREE * np.ptp(surface.y)) ** 2 * df else Noise.EQUAL


def anova(surface: Surface, blocks: Sequence[str] = ()) -> list[AnovaRow]:
    """Analyse the variance of a polynomial in coded units.

    Groups come in this order: blocks, linear terms, interactions, then powers by degree.

    Parameters
    ----------
    surface : Surface
        The fitted polynomial.
    blocks : sequence of str
        Factors that stand for blocks of cases; their linear terms form a separate group.
    """
    matrix = surface.polynomial.matrix(surface.coded(surface.x))
    groups = _groups(surface, blocks)
    first = [
        column for column, powers in enumerate(surface.polynomial.exponents) if not any(powers)
    ]
    order = first + [column for members in groups.values() for column in members]
    q, r = linalg.qr(matrix[:, order], mode="economic")
    sequential = dict(zip(order, (q.T @ surface.y) ** 2, strict=True))
    spread = dict(zip(order, np.sum(linalg.inv(r) ** 2, axis=1), strict=True))
    df = surface.points - len(surface.polynomial)
    variance = surface.residual_sd**2
    rows = []
    for group, members in groups.items():
        total = float(sum(sequential[column] for column in members))
        test = _f_test(total, len(members), variance, df)
        rows.append(AnovaRow(group, "group", len(members), total, np.nan, *test))
        for column in members:
            partial = float(surface.coefficients_coded[column] ** 2 / spread[column])
            test = _f_test(partial, 1, variance, df)
            name = surface.polynomial.names[column]
            rows.append(AnovaRow(name, "term", 1, float(sequential[column]), partial, *test))
    return rows + _rest(surface, df)


def pure_error(x: Array, y: Array) -> tuple[float, int]:
    """Sum of squares within equal cases, x of shape (m, n), and its degrees of freedom."""
    places, place = np.unique(x, axis=0, return_inverse=True)
    counts = np.bincount(place.ravel())
    means = np.bincount(place.ravel(), weights=y) / counts
    return float(np.sum((y - means[place.ravel()]) ** 2)), len(y) - len(places)


def _rest(surface: Surface, df: int) -> list[AnovaRow]:
    """Residual, its two parts where there are replicates, and the total."""
    y, sse = surface.y, surface.residual_sd**2 * df
    rows = [AnovaRow("residual", "rest", df, sse)]
    error, error_df = pure_error(surface.x, y)
    if error_df:
        lack, lack_df = max(sse - error, 0.0), df - error_df
        test = (np.nan, np.nan)
        if lack_df and noise_of_replicates(surface) is Noise.REPLICATES:
            test = _f_test(lack, lack_df, error / error_df, error_df)
        rows.append(AnovaRow("lack of fit", "rest", lack_df, lack, np.nan, *test))
        rows.append(AnovaRow("pure error", "rest", error_df, error))
    if surface.through_origin:
        return [*rows, AnovaRow("total about zero", "rest", len(y), float(y @ y))]
    return [*rows, AnovaRow("total", "rest", len(y) - 1, float(np.sum((y - y.mean()) ** 2)))]


def _groups(surface: Surface, blocks: Sequence[str]) -> dict[str, list[int]]:
    """Columns of the terms, the intercept left out, by the group of their kind, in order."""
    block_axes = {surface.factors.index(name) for name in blocks}
    groups: dict[tuple[int, int], list[int]] = {}
    for column, powers in enumerate(surface.polynomial.exponents):
        axes = {axis for axis, power in enumerate(powers) if power}
        if axes:
            place = (0, 0) if axes <= block_axes else (sum(powers), int(len(axes) == 1))
            groups.setdefault(place, []).append(column)
    return {_group_name(*place): groups[place] for place in sorted(groups)}


def _group_name(degree: int, pure: int) -> str:
    if degree == 0:
        return "blocks"
    if degree == 1:
        return "linear"
    return f"powers of degree {degree}" if pure else f"interactions of degree {degree}"


def _f_test(squares: float, df: int, variance: float, rest_df: int) -> tuple[float, float]:
    """F value and p-value; infinite and zero where there is no residual."""
    f_value = squares / df / variance if variance > 0 else np.inf
    return f_value, float(stats.f.sf(f_value, df, rest_df))
