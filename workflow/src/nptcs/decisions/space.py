"""The designs to choose from: a box, whole numbers of plates, steps of manufacture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import ceil, floor, log10

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.doe.points import space_filling
from nptcs.doe.whole_plates import SPACING
from nptcs.errors import InputError
from nptcs.uncertainty.response_model import ResponseModel

CANDIDATES = 256
"""Designs per number of plates from which the search starts, a power of two."""

SEED = 1
ROUNDING = 1e-9


@dataclass(frozen=True)
class DesignSpace:
    """Where designs are searched for.

    Parameters
    ----------
    factors : tuple of str
        The n factors.
    lower, upper : ndarray of shape (n,)
        Box inside which all responses can be predicted.
    held : mapping of str to float
        Factors that are not free.
    steps : mapping of str to float
        Step of the values of each free factor.
    plates : tuple of int
        Possible numbers of plates of a leg; empty where the spacing is not a factor or the solver
        does not use whole numbers.
    tread_width_mm : float
    """

    factors: tuple[str, ...]
    lower: Array
    upper: Array
    held: Mapping[str, float]
    steps: Mapping[str, float]
    plates: tuple[int, ...]
    tread_width_mm: float

    @property
    def cells(self) -> tuple[int | None, ...]:
        """The numbers of plates, or one cell for all designs."""
        return self.plates or (None,)

    @property
    def free(self) -> list[int]:
        """Columns that vary within a cell."""
        fixed = {*self.held, *({SPACING} if self.plates else set())}
        return [place for place, name in enumerate(self.factors) if name not in fixed]

    def points(self, unit: Array, cell: int | None) -> Array:
        """Map points of the unit cube of the free factors to designs, (m, free) → (m, n)."""
        points = np.empty((len(unit), len(self.factors)))
        for place, name in enumerate(self.factors):
            points[:, place] = self.held.get(name, self.lower[place])
        if cell is not None:
            points[:, self.factors.index(SPACING)] = self.tread_width_mm / cell
        free = self.free
        points[:, free] = self.lower[free] + unit * (self.upper - self.lower)[free]
        return points

    def candidates(self, cell: int | None) -> Array:
        """Spread designs over a cell, its corners included, shape (m, n)."""
        if not self.free:
            return self.points(np.empty((1, 0)), cell)
        inner = (space_filling("sobol", CANDIDATES, len(self.free), SEED) + 1) / 2
        corners = np.array(list(product([0.0, 1.0], repeat=len(self.free))))
        return self.points(np.vstack([corners, inner]), cell)

    def can_be_made(self, point: Array) -> Array:
        """Return the designs around one whose free factors are whole numbers of steps, (m, n)."""
        choices = [list(self._neighbours(place, point[place])) for place in range(len(point))]
        return np.array(list(product(*choices)))

    def _neighbours(self, place: int, value: float) -> Iterator[float]:
        """Values on either side that can be made, inside the box; the value itself if held."""
        if place not in self.free:
            yield float(value)
            return
        step = self.step(place)
        counts = sorted({floor(value / step + ROUNDING), ceil(value / step - ROUNDING)})
        found = [float(f"{count * step:.10g}") for count in counts]
        slack = ROUNDING * (self.upper[place] - self.lower[place])
        low, high = self.lower[place] - slack, self.upper[place] + slack
        yield from [x for x in found if low <= x <= high] or [float(value)]

    def step(self, place: int) -> float:
        """Step of a factor: as configured, or a hundredth of the power of ten of its range."""
        name = self.factors[place]
        if name in self.steps:
            return self.steps[name]
        return float(10.0 ** (floor(log10(self.upper[place] - self.lower[place])) - 2))


def design_space(
    models: Sequence[ResponseModel],
    held: Mapping[str, float],
    steps: Mapping[str, float],
    tyre: TyreGeometry,
    whole_plates: bool,
) -> DesignSpace:
    """Return the box that all models share, without what `held` fixes.

    Parameters
    ----------
    models : sequence of ResponseModel
        Of the same factors.
    held, steps : mapping of str to float
        As in the configuration; a held spacing becomes that of a whole number of plates.
    tyre : TyreGeometry
    whole_plates : bool
        Whether the solver uses a whole number of plates.

    Raises
    ------
    InputError
        For a factor that does not exist, a held value outside the box, or a box without a whole
        number of plates.
    """
    factors = models[0].factors
    lower = np.max([model.lower for model in models], axis=0)
    upper = np.min([model.upper for model in models], axis=0)
    _check_names(factors, held, steps)
    held = dict(held)
    whole = whole_plates and SPACING in factors
    plates: tuple[int, ...] = ()
    if whole and SPACING in held:
        plates = (tyre.plates_across(held.pop(SPACING)),)
    elif whole:
        plates = _plates_inside(lower, upper, factors, tyre)
    if whole:
        spacings = [tyre.tread_width_mm / count for count in plates]
        _check_inside(SPACING, spacings, factors, lower, upper)
    for name, value in held.items():
        _check_inside(name, [value], factors, lower, upper)
    return DesignSpace(factors, lower, upper, held, dict(steps), plates, tyre.tread_width_mm)


def _plates_inside(
    lower: Array, upper: Array, factors: Sequence[str], tyre: TyreGeometry
) -> tuple[int, ...]:
    place = factors.index(SPACING)
    slack = ROUNDING * tyre.tread_width_mm
    least = ceil(tyre.tread_width_mm / (upper[place] + slack))
    most = floor(tyre.tread_width_mm / (lower[place] - slack))
    counts = tuple(range(least, most + 1))
    if not counts:
        raise InputError(
            "no whole number of plates lies between the spacings of the cases",
            column=SPACING,
            value=[float(lower[place]), float(upper[place])],
            remedy="solve cases over a wider range of spacings",
        )
    return counts


def _check_names(
    factors: Sequence[str], held: Mapping[str, float], steps: Mapping[str, float]
) -> None:
    if stray := sorted({*held, *steps} - set(factors)):
        raise InputError(
            "not a factor of this study",
            column="decisions.hold or decisions.steps",
            value=", ".join(stray),
            remedy=f"its factors are {', '.join(factors)}",
        )


def _check_inside(
    name: str, values: Sequence[float], factors: Sequence[str], lower: Array, upper: Array
) -> None:
    place = factors.index(name)
    slack = ROUNDING * (upper[place] - lower[place])
    for value in values:
        if not lower[place] - slack <= value <= upper[place] + slack:
            raise InputError(
                f"lies outside the cases ({lower[place]:g} to {upper[place]:g})",
                column=name,
                value=float(value),
                remedy="hold it at a value inside, or solve cases there",
            )
