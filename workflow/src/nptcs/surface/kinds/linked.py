"""A polynomial fitted to a function of the response: log K or 1/K."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.surface.fit import Surface, fit_points
from nptcs.surface.response_surface import Groups, Outside, single_cases
from nptcs.terms import Polynomial

Bend = Literal["log", "reciprocal"]

LINKS: Mapping[Bend, Callable[[Array], Array]] = {"log": np.log, "reciprocal": np.reciprocal}
INVERSES: Mapping[Bend, Callable[[Array], Array]] = {"log": np.exp, "reciprocal": np.reciprocal}


@dataclass(frozen=True)
class LinkedSurface:
    """A polynomial fitted to a function of a positive response, by least squares on that function.

    Parameters
    ----------
    link : str
        ``log`` or ``reciprocal``.
    inner : Surface
        The polynomial of log K or of 1/K.
    y : ndarray of shape (m,)
        The response itself.
    """

    link: Bend
    inner: Surface
    y: Array
    outside = Outside.REFUSED

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return self.inner.factors

    @property
    def x(self) -> Array:
        """The cases that it was fitted to, shape (m, n)."""
        return self.inner.x

    @property
    def coefficients(self) -> int:
        """Number of terms."""
        return self.inner.coefficients

    def predict(self, x: Array) -> Array:
        """Evaluate the response at points in natural units, shape (m, n) → (m,)."""
        return INVERSES[self.link](self.inner.predict(x))

    def slopes(self, x: Array) -> Array:
        """Differentiate the response with respect to the coefficients, shape (m, n) → (m, p)."""
        value = self.predict(x)
        by_polynomial = value if self.link == "log" else -(value**2)
        return by_polynomial[:, None] * self.inner.slopes(x)

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval: those of the polynomial, transformed back.

        Where the interval of 1/K reaches zero, K has no upper bound: infinity.
        """
        low, high = self.inner.interval(x, confidence)
        if self.link == "log":
            return np.exp(low), np.exp(high)
        positive = low > 0
        return 1 / high, np.where(positive, 1 / np.where(positive, low, 1.0), np.inf)

    def refit(self, x: Array, y: Array) -> LinkedSurface:
        """Fit the same terms to other cases."""
        return fit_linked(self.link, x, y, self.inner.polynomial, self.inner.through_origin)

    def groups(self) -> Groups:
        """Tell which cases are left out together: each alone."""
        return single_cases(self.y)

    def content(self) -> dict[str, Any]:
        """Everything that defines the surface, as plain values."""
        return {"link": self.link, "inner": self.inner.content(), "y": self.y.tolist()}


def fit_linked(
    link: Bend, x: Array, y: Array, polynomial: Polynomial, through_origin: bool = False
) -> LinkedSurface:
    """Fit a polynomial to log K or 1/K at points of shape (m, n).

    Raises
    ------
    InputError
        For a response that is not positive everywhere, and as `nptcs.surface.fit.fit_points`.
    """
    if (y <= 0).any():
        raise InputError(
            f"the {link} link needs a positive response",
            column="surfaces",
            value=float(y.min()),
            remedy="use the identity link for this response",
        )
    return LinkedSurface(link, fit_points(x, LINKS[link](y), polynomial, through_origin), y)
