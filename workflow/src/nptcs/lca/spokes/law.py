"""Spokes whose force is not a straight line: a measured or simulated force–displacement curve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from nptcs.arrays import Floating
from nptcs.errors import InputError
from nptcs.lca.spokes.linear import LinearSpokes


@dataclass(frozen=True)
class SpokeLaw:
    """Force of one spoke against its elongation, and how many spokes there are.

    The curve is interpolated monotonically and with a continuous slope (PCHIP) on each side of
    the origin. At the origin the slope may jump, as that of two straight lines does.

    Parameters
    ----------
    elongation_mm, force_n : array, shape (n,)
        Increasing points of the curve, one of them the origin; tension is positive.
    count : int
        Number N of spokes.
    """

    elongation_mm: Floating
    force_n: Floating
    count: int = 60

    def __post_init__(self) -> None:
        x, f = (np.asarray(v, dtype=float) for v in (self.elongation_mm, self.force_n))
        object.__setattr__(self, "elongation_mm", x)
        object.__setattr__(self, "force_n", f)
        _check_curve(x, f)
        if self.count < 3:
            raise InputError(
                "a wheel needs at least three spokes", column="spoke_count", value=self.count
            )
        zero = int(np.flatnonzero(x == 0)[0])
        sides = (slice(0, zero + 1), slice(zero, None))
        object.__setattr__(self, "_sides", [PchipInterpolator(x[s], f[s]) for s in sides])

    @classmethod
    def linear(cls, spokes: LinearSpokes, reach_mm: float) -> SpokeLaw:
        """Return the law of two straight lines, known up to `reach_mm` on both sides."""
        force = [-spokes.compression_n_per_mm * reach_mm, 0.0, spokes.tension_n_per_mm * reach_mm]
        return cls(np.array([-reach_mm, 0.0, reach_mm]), np.array(force), spokes.count)

    @classmethod
    def from_curves(
        cls,
        tension_mm: ArrayLike,
        tension_n: ArrayLike,
        compression_mm: ArrayLike,
        compression_n: ArrayLike,
        count: int = 60,
    ) -> SpokeLaw:
        """Join a tension and a compression test, both given with positive numbers from zero.

        Parameters
        ----------
        tension_mm, tension_n : array-like, shape (n,)
            Elongation and force; the first point is the origin.
        compression_mm, compression_n : array-like, shape (m,)
            Shortening and force; the first point is the origin.
        count : int
            Number of spokes.

        Examples
        --------
        >>> law = SpokeLaw.from_curves([0, 2, 4], [0, 60, 130], [0, 10, 20], [0, 120, 300])
        >>> force, slope = law.evaluate(4.0)
        >>> float(force), law.range_mm
        (130.0, (-20.0, 4.0))
        """
        left = [np.asarray(v, dtype=float)[:0:-1] for v in (compression_mm, compression_n)]
        right = [np.asarray(v, dtype=float) for v in (tension_mm, tension_n)]
        x, f = (np.concatenate([-a, b]) for a, b in zip(left, right, strict=True))
        return cls(x, f, count)

    @property
    def range_mm(self) -> tuple[float, float]:
        """Lowest and highest elongation of the curve."""
        return float(self.elongation_mm[0]), float(self.elongation_mm[-1])

    def evaluate(self, elongation_mm: ArrayLike) -> tuple[Floating, Floating]:
        """Return force (N) and slope (N/mm); beyond its ends the curve continues straight.

        The solver refuses a result that needs the straight ends; they only keep its iterations
        defined.
        """
        e = np.asarray(elongation_mm, dtype=float)
        low, high = self.range_mm
        inside = np.clip(e, low, high)
        left, right = self.__dict__["_sides"]
        force = np.where(inside < 0, left(inside.clip(max=0)), right(inside.clip(min=0)))
        slope = np.where(inside < 0, left(inside.clip(max=0), 1), right(inside.clip(min=0), 1))
        return force + slope * (e - inside), slope

    def __eq__(self, other: Any) -> bool:
        """Two laws are equal if their points and the number of spokes are."""
        return (
            isinstance(other, SpokeLaw)
            and self.count == other.count
            and np.array_equal(self.elongation_mm, other.elongation_mm)
            and np.array_equal(self.force_n, other.force_n)
        )


def _check_curve(x: Floating, f: Floating) -> None:
    """Raise `InputError` unless the points form an increasing curve through the origin."""
    if x.ndim != 1 or x.shape != f.shape or not (np.isfinite(x).all() and np.isfinite(f).all()):
        raise InputError(
            "elongation and force must be two lists of finite numbers of equal length",
            remedy="remove gaps from the spoke's curve",
        )
    for name, values in (("elongation_mm", x), ("force_n", f)):
        wrong = np.flatnonzero(np.diff(values) <= 0)
        if len(wrong):
            raise InputError(
                "the spoke's curve must increase from point to point",
                remedy="sort it by elongation; smooth it if the force falls",
                column=name,
                value=tuple(float(v) for v in values[wrong[0] : wrong[0] + 2]),
            )
    zero = np.flatnonzero(x == 0)
    if len(zero) != 1 or f[zero[0]] != 0 or zero[0] in (0, len(x) - 1):
        raise InputError(
            "the spoke's curve must contain the origin with points on both sides",
            remedy="give tension and compression, both starting from zero displacement and force",
        )
