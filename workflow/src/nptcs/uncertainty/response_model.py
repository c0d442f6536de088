"""A response of the tyre as a function of factors, ply constants and rubbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy import stats

from nptcs.arrays import Array, Mask
from nptcs.surface.kinds.gaussian_process import GaussianProcess
from nptcs.surface.kinds.lamination import FACTORS as LAMINATION_FACTORS
from nptcs.surface.kinds.lamination import Lamination
from nptcs.surface.response_surface import ResponseSurface, box, inside_box

ANGLE = "angle_deg"
EDGE_STEP = 1e-3
"""Step, as a share of a factor's range, of the slope at the edge of the box."""

ONE_SD = 0.6826894921370859
"""Confidence of the interval whose half width is one standard deviation of a normal."""

Changes = Mapping[str, Array]
"""Change of each quantity at each of m points, shape (m,); absent quantities do not change."""


class ResponseModel(Protocol):
    """What the propagation of uncertainty and the search for designs need of a response.

    Attributes
    ----------
    factors : tuple of str
        Names of the n columns of the points.
    knows : frozenset of str
        Quantities whose change it can follow: factors, ply constants, rubbers.
    lower, upper : ndarray of shape (n,)
        Box of its cases.
    """

    @property
    def factors(self) -> tuple[str, ...]: ...  # noqa: D102

    @property
    def knows(self) -> frozenset[str]: ...  # noqa: D102

    @property
    def lower(self) -> Array: ...  # noqa: D102

    @property
    def upper(self) -> Array: ...  # noqa: D102

    def value(self, x: Array, changes: Changes) -> Array:
        """Evaluate the response at designs of shape (m, n) whose quantities have changed."""
        ...

    def own_sd(self, x: Array) -> Array:
        """Return the standard deviation of the model's own error, shape (m, n) → (m,)."""
        ...

    def inside(self, x: Array) -> Mask:
        """Tell which points are in the box of its cases."""
        ...


@dataclass(frozen=True)
class RubberEffect:
    """Relative change of a response with the rubbers, from another study's surface.

    Parameters
    ----------
    surface : ResponseSurface
        Its factors are rubbers.
    nominal : mapping of str to float
        C10 of the rubbers of the design, MPa.
    """

    surface: ResponseSurface
    nominal: Mapping[str, float]

    def ratio(self, changes: Changes, points: int) -> Array:
        """Return response with changed rubbers over response with the nominal ones, (m,)."""
        middle = np.array([[self.nominal[name] for name in self.surface.factors]])
        moved = np.repeat(middle, points, axis=0)
        for axis, name in enumerate(self.surface.factors):
            moved[:, axis] += changes.get(name, 0.0)
        ratio: Array = continued(self.surface, moved) / continued(self.surface, middle)
        return ratio


@dataclass(frozen=True)
class SurfaceResponse:
    """A fitted surface with the effects of ply and rubbers.

    Parameters
    ----------
    surface : ResponseSurface
    least_sd : float
        Root mean square error at left-out cases: the model's own error is never stated smaller.
    lamination : Lamination or None
        Lamination form of the same response: it gives the effect of the ply's constants.
    rubbers : RubberEffect or None
        For rubbers that are not factors of the surface.
    """

    surface: ResponseSurface
    least_sd: float
    lamination: Lamination | None = None
    rubbers: RubberEffect | None = None

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return self.surface.factors

    @property
    def lower(self) -> Array:
        """Smallest value of each factor among the cases."""
        return box(self.surface.x)[0]

    @property
    def upper(self) -> Array:
        """Largest value of each factor among the cases."""
        return box(self.surface.x)[1]

    @property
    def knows(self) -> frozenset[str]:
        """Factors, and the quantities that the effects add."""
        ply = self.lamination.ply if self.lamination is not None else {}
        rubbers = self.rubbers.surface.factors if self.rubbers is not None else ()
        return frozenset({*self.factors, *ply, *rubbers})

    def value(self, x: Array, changes: Changes) -> Array:
        """Evaluate the response; beyond the edge of the box it continues along the slope there."""
        moved = x.copy()
        for axis, name in enumerate(self.factors):
            moved[:, axis] += changes.get(name, 0.0)
        moved = folded(moved, self.factors)
        response = continued(self.surface, moved)
        if self.lamination is not None and any(name in changes for name in self.lamination.ply):
            response = response + self._ply_effect(self.lamination, moved, changes)
        if self.rubbers is not None and any(
            name in changes and name not in self.factors for name in self.rubbers.surface.factors
        ):
            response = response * self.rubbers.ratio(changes, len(x))
        return response

    def own_sd(self, x: Array) -> Array:
        """Return half the width of the 68 % interval, or the error at left-out cases if larger."""
        low, high = self.surface.interval(x, ONE_SD)
        return np.maximum((high - low) / 2, self.least_sd)

    def inside(self, x: Array) -> Mask:
        """Tell which points are in the box of the cases."""
        return inside_box(self.surface, x)

    def _ply_effect(self, form: Lamination, x: Array, changes: Changes) -> Array:
        ordered = x[:, [self.factors.index(name) for name in LAMINATION_FACTORS]]
        ply = {name: value + changes.get(name, 0.0) for name, value in form.ply.items()}
        return form.predict_with(ordered, ply) - form.predict(ordered)


def lamination_of(surface: ResponseSurface) -> Lamination | None:
    """Return the lamination form in a surface: itself, or the mean under a Gaussian process."""
    if isinstance(surface, Lamination):
        return surface
    if isinstance(surface, GaussianProcess) and surface.mean is not None:
        return lamination_of(surface.mean)
    return None


def folded(x: Array, factors: tuple[str, ...]) -> Array:
    """Bring fibre angles back to 0 to 90 degrees: [+A/-A] and its mirror image are equal."""
    if ANGLE not in factors:
        return x
    axis = factors.index(ANGLE)
    angle = np.abs((x[:, axis] + 90.0) % 180.0 - 90.0)
    # values inside the range stay as they are, to the last digit
    inside = (x[:, axis] >= 0.0) & (x[:, axis] <= 90.0)
    moved = x.copy()
    moved[:, axis] = np.where(inside, x[:, axis], angle)
    return moved


def continued(surface: ResponseSurface, x: Array) -> Array:
    """Evaluate a surface; beyond the edge of its box, continue along the slope at the edge.

    For points that a tolerance moves a little way out of the box; designs outside are refused.
    """
    lower, upper = box(surface.x)
    inner = np.clip(x, lower, upper)
    edge = surface.predict(inner)
    response = edge.copy()
    for axis in range(x.shape[1]):
        beyond = x[:, axis] - inner[:, axis]
        out = beyond != 0.0
        if not out.any():
            continue
        step = EDGE_STEP * (upper[axis] - lower[axis]) * np.sign(beyond[out])
        back = inner[out].copy()
        back[:, axis] -= step
        slope = (edge[out] - surface.predict(back)) / step
        response[out] += slope * beyond[out]
    return response


def normal_half_width(confidence: float) -> float:
    """Return the half width of a normal interval, in standard deviations."""
    return float(stats.norm.ppf(0.5 + confidence / 2))
