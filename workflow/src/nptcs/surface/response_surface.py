"""What every kind of surface offers, and predictions that respect the range of validity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Protocol, Self

import numpy as np

from nptcs.arrays import Array, Index, Mask
from nptcs.errors import InputError

INSIDE_TOLERANCE = 1e-9
"""Share of a factor's range by which a point may be outside because of rounding."""


class Outside(StrEnum):
    """What happens outside the box of the cases that a surface was fitted to."""

    REFUSED = "refused"
    FLAGGED = "flagged"


@dataclass(frozen=True)
class Groups:
    """Cases that are left out together.

    Parameters
    ----------
    labels : ndarray of shape (m,)
        Number of the group of each case.
    what : str
        What a group is, in words.
    """

    labels: Index
    what: str


def single_cases(y: Array) -> Groups:
    """Each case is a separate group."""
    return Groups(np.arange(len(y)), "a case")


class ResponseSurface(Protocol):
    """A surface fitted to n factors and one response.

    Attributes
    ----------
    factors : tuple of str
        Names of the n factors.
    x, y : ndarray of shape (m, n) and (m,)
        The cases that it was fitted to.
    coefficients : int
        Fitted coefficients, without the hyperparameters of a Gaussian process.
    outside : Outside
        What happens outside the cases' box.
    """

    @property
    def factors(self) -> tuple[str, ...]: ...  # noqa: D102

    @property
    def x(self) -> Array: ...  # noqa: D102

    @property
    def y(self) -> Array: ...  # noqa: D102

    @property
    def coefficients(self) -> int: ...  # noqa: D102

    @property
    def outside(self) -> Outside: ...  # noqa: D102

    def predict(self, x: Array) -> Array:
        """Evaluate the surface at points in natural units, shape (m, n) → (m,)."""
        ...

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval of a further case, shape (m, n) → two of (m,)."""
        ...

    def refit(self, x: Array, y: Array) -> Self:
        """Fit the same surface to other cases: terms or form kept, parameters fitted again."""
        ...

    def groups(self) -> Groups:
        """Tell which cases are left out together when the surface is tested."""
        ...

    def content(self) -> dict[str, Any]:
        """Everything that `nptcs.surface.stored` needs to read it back, as plain values."""
        ...


@dataclass(frozen=True)
class Prediction:
    """Predictions of a surface at m points.

    Parameters
    ----------
    value : ndarray of shape (m,)
        In the unit of the response.
    low, high : ndarray of shape (m,)
        Prediction interval; not a number outside the cases' box, where it is not assessed: there
        the interval of every kind of surface is far too narrow.
    inside : ndarray of shape (m,)
        Whether the point lies in the box.
    """

    value: Array
    low: Array
    high: Array
    inside: Mask


def box(x: Array) -> tuple[Array, Array]:
    """Return the smallest and the largest value of each factor, shape (m, n) → two of (n,)."""
    return x.min(axis=0), x.max(axis=0)


def inside_box(surface: ResponseSurface, x: Array) -> Mask:
    """Tell which points, shape (m, n), are in the box of the cases of a surface."""
    lower, upper = box(surface.x)
    slack = INSIDE_TOLERANCE * (upper - lower)
    return np.asarray(((x >= lower - slack) & (x <= upper + slack)).all(axis=1))


def predict(surface: ResponseSurface, x: Array, confidence: float = 0.95) -> Prediction:
    """Predict with an interval, and refuse or flag what is outside the range of validity.

    Parameters
    ----------
    surface : ResponseSurface
        Any kind.
    x : ndarray of shape (m, n)
        Points in natural units, in the order of the surface's factors.
    confidence : float
        Confidence of the interval.

    Returns
    -------
    Prediction

    Raises
    ------
    InputError
        For a point that is not finite, and for one outside the box where the kind of surface
        cannot be trusted there at all.
    """
    if not np.isfinite(x).all():
        raise InputError("a point has no number for a factor", remedy="give all factors a value")
    inside = inside_box(surface, x)
    if surface.outside is Outside.REFUSED and not inside.all():
        raise _refusal(surface, x[~inside][0])
    low, high = surface.interval(x, confidence)
    low, high = np.where(inside, low, np.nan), np.where(inside, high, np.nan)
    return Prediction(surface.predict(x), low, high, inside)


def refuse_unusable(x: Array, y: Array, factors: Sequence[str], coefficients: int) -> None:
    """Refuse cases to which no surface with this number of coefficients can be fitted.

    Raises
    ------
    InputError
        When there are no more cases than coefficients, when the response has gaps or does not
        vary, or when a factor has one level only.
    """
    if len(y) <= coefficients:
        raise InputError(
            f"{len(y)} solved cases cannot determine {coefficients} terms",
            column="terms",
            remedy="solve more cases or fit fewer terms",
        )
    if not np.isfinite(y).all():
        raise InputError(
            "solved cases have no response to fit",
            value=f"{int(np.sum(~np.isfinite(y)))} of {len(y)}",
            remedy="fit this response only for solvers that give it",
        )
    if np.ptp(y) == 0:
        raise InputError(
            "the response is the same in all cases",
            value=y[0],
            remedy="check that the solver uses the factors of this study",
        )
    lower, upper = box(x)
    if (lower == upper).any():
        constant = [name for name, same in zip(factors, lower == upper, strict=True) if same]
        raise InputError(
            "only one level of a factor has results",
            column=", ".join(constant),
            remedy="solve cases at two levels or more, or leave the factor out",
        )


def _refusal(surface: ResponseSurface, point: Array) -> InputError:
    """Name the first factor that leaves the box."""
    lower, upper = box(surface.x)
    axis = int(np.argmax(np.maximum(lower - point, point - upper) / (upper - lower)))
    return InputError(
        f"outside the cases that the surface was fitted to ({lower[axis]:g} to {upper[axis]:g})",
        column=surface.factors[axis],
        value=float(point[axis]),
        remedy="stay inside the box, or solve cases there (a lamination form of the plates is "
        "flagged there, not refused)",
    )
