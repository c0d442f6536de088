"""A spoke's energy table predicted from others: principal components and Gaussian processes.

The tables' coefficients are divided by C10 and by a power law of the spoke's stiffness, so that
soft spokes count as much as stiff ones, and reduced to ten principal components; each of them is a
Gaussian process over `spoke_features`, with cos 2A for the angle and a quadratic trend. A predicted
table is for search and exploration; the design that is chosen in the end is solved with a computed
table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import qmc
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import (
    RBF,
    ConstantKernel,
    DotProduct,
    Kernel,
    WhiteKernel,
)

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.likelihood import SearchError, bounds_are_answers, maximise
from nptcs.spoke_features import spoke_features

COMPONENTS = 10
DESIGN = ("plate_count", "thickness_mm", "angle_deg", "spoke_c10_mpa")
FEWEST_TABLES = 3 * COMPONENTS
FEATURES = 6


@dataclass(frozen=True)
class PredictedTable:
    """A predicted table and its uncertainty.

    Parameters
    ----------
    table : SpokeEnergyTable
    modes : array (components, terms)
        Changes of the coefficients, each by one standard error of a component; they are
        independent.
    """

    table: SpokeEnergyTable
    modes: Array


class SpokeSurrogate:
    """Predictor of energy tables inside the box of the spokes that it was fitted to.

    Parameters
    ----------
    designs : array (n, 4)
        `DESIGN` of each computed spoke.
    tables : sequence of SpokeEnergyTable
        Their tables, all for one section, one mesh and one range.
    ply : mapping
        Constants of the ply, the same for all of them.
    kernels : sequence of kernels, optional
        Of an earlier fit; fitted by maximum likelihood if not given.
    unfitted : array (m, 4), optional
        Spokes whose tables are too short to be fitted: a design nearer to one of them than to any
        fitted spoke is refused.

    Raises
    ------
    InputError
        If there are too few tables, or their ranges differ.
    """

    def __init__(
        self,
        designs: Array,
        tables: Sequence[SpokeEnergyTable],
        ply: Mapping[str, float],
        kernels: Sequence[Kernel] | None = None,
        unfitted: Array | None = None,
    ) -> None:
        designs = np.asarray(designs, dtype=float)
        _check(designs, tables)
        self.designs, self.ply = designs, dict(ply)
        self.low, self.high = designs.min(axis=0), designs.max(axis=0)
        self.tables = list(tables)
        self.unfitted = np.empty((0, len(DESIGN))) if unfitted is None else unfitted
        self._first = tables[0]
        coefficients = np.array([table.coefficients for table in tables])
        self._law = _power_law(_inputs(designs, ply), coefficients / designs[:, 3:])
        scaled = coefficients / self._size(designs)[:, None]
        self.mean = scaled.mean(axis=0)
        self.components = np.linalg.svd(scaled - self.mean, full_matrices=False)[2][:COMPONENTS]
        features = _inputs(designs, ply)
        self._middle, self._spread = features.mean(axis=0), features.std(axis=0)
        self._spread[self._spread == 0.0] = 1.0
        scores = (scaled - self.mean) @ self.components.T
        given = kernels if kernels is not None else [None] * COMPONENTS
        self._processes = [
            _process(self._unit(designs), scores[:, place], kernel)
            for place, kernel in enumerate(given)
        ]

    @property
    def kernels(self) -> list[Kernel]:
        """The fitted kernels, to fit a surrogate to other tables without another search."""
        return [process.kernel_ for process in self._processes]

    def without(self, rows: Sequence[int]) -> SpokeSurrogate:
        """Return the surrogate of the other spokes, with the same kernels."""
        kept = np.setdiff1d(np.arange(len(self.tables)), rows)
        tables = [self.tables[row] for row in kept]
        return SpokeSurrogate(self.designs[kept], tables, self.ply, self.kernels, self.unfitted)

    def _unit(self, designs: Array) -> Array:
        unit: Array = (_inputs(designs, self.ply) - self._middle) / self._spread
        return unit

    def _size(self, designs: Array) -> Array:
        """C10 times the power law, array (n,): what the components are parts of."""
        size: Array = designs[:, 3] * np.exp(_with_constant(_inputs(designs, self.ply)) @ self._law)
        return size

    def check_inside(self, design: Array) -> None:
        """Refuse a design outside the box of the fitted spokes.

        Raises
        ------
        InputError
            Naming the variable and the box.
        """
        if len(design) != len(DESIGN) or not np.isfinite(design).all():
            raise InputError("a spoke's design is " + ", ".join(DESIGN), value=list(design))
        room = 1e-9 * (self.high - self.low)
        for name, value, low, high, slack in zip(
            DESIGN, design, self.low, self.high, room, strict=True
        ):
            if not low - slack <= value <= high + slack:
                raise InputError(
                    f"the surrogate was fitted to spokes from {low:g} to {high:g} only",
                    "compute this spoke's table, or fit the surrogate to a wider box",
                    column=name,
                    value=float(value),
                )
        if len(self.unfitted) and self._distance(design, self.unfitted) < self._distance(
            design, self.designs
        ):
            raise InputError(
                "the nearest computed spoke loses its stability early: its neighbours cannot be "
                "predicted",
                "compute this spoke's table",
                value=dict(zip(DESIGN, design.tolist(), strict=True)),
            )

    def _distance(self, design: Array, others: Array) -> float:
        """Distance to the nearest of other designs (n, 4), in standard deviations of features."""
        offset = self._unit(others) - self._unit(design[None])
        return float(np.sqrt(np.sum(offset**2, axis=1)).min())

    def predict(self, design: Sequence[float]) -> PredictedTable:
        """Predict the table of a spoke.

        Parameters
        ----------
        design : sequence of 4 float
            As `DESIGN`.

        Raises
        ------
        InputError
            If the design lies outside the box.
        """
        values = np.asarray(design, dtype=float)
        self.check_inside(values)
        return self.predict_anywhere(values)

    def predict_anywhere(self, design: Array) -> PredictedTable:
        """Predict without checking the box: for tests of spokes that were left out."""
        values = np.asarray(design, dtype=float)
        scores, errors = self._scores(values[None])
        size = float(self._size(values[None])[0])
        coefficients = size * (self.mean + scores[0] @ self.components)
        modes = size * errors[0][:, None] * self.components
        return PredictedTable(replace(self._first, coefficients=coefficients), modes)

    def _scores(self, designs: Array) -> tuple[Array, Array]:
        """Components (n, 10) and their standard errors."""
        unit = self._unit(designs)
        both = [process.predict(unit, return_std=True) for process in self._processes]
        return np.stack([mean for mean, _ in both], 1), np.stack([error for _, error in both], 1)

    def next_design(
        self, importance: Array | None = None, candidates: int = 256, seed: int = 1
    ) -> tuple[dict[str, float], float]:
        """Name the spoke whose table, once computed, would lower the mean variance in the box most.

        Parameters
        ----------
        importance : array (components,), optional
            Weight of each component's variance, for example the squares of a displacement's
            derivatives with respect to the components; 1 for all if not given.
        candidates : int
            Points of the box that are compared; the variance is averaged over as many others.
        seed : int

        Returns
        -------
        tuple
            The design by `DESIGN`, and the part of the mean variance that it would remove.
        """
        weight = np.ones(COMPONENTS) if importance is None else np.asarray(importance)
        points = qmc.Sobol(len(DESIGN), seed=seed).random(2 * candidates)
        designs = self.low + points * (self.high - self.low)
        designs[:, 0] = np.round(designs[:, 0])
        unit = self._unit(designs)
        before, gain = 0.0, np.zeros(candidates)
        for share, process in zip(weight, self._processes, strict=True):
            _, covariance = process.predict(unit, return_cov=True)
            variance = np.maximum(np.diag(covariance), 1e-300)
            before += share * float(np.mean(variance[candidates:]))
            cross = covariance[candidates:, :candidates]
            gain += share * np.mean(cross**2, axis=0) / variance[:candidates]
        best = int(np.argmax(gain))
        design = {name: float(value) for name, value in zip(DESIGN, designs[best], strict=True)}
        return design, float(gain[best] / before)


def _check(designs: Array, tables: Sequence[SpokeEnergyTable]) -> None:
    if designs.shape != (len(tables), len(DESIGN)):
        raise InputError(f"one design per table is needed, each {', '.join(DESIGN)}")
    if len(tables) < FEWEST_TABLES:
        raise InputError(
            f"{len(tables)} tables are too few for {COMPONENTS} components",
            f"compute {FEWEST_TABLES} spokes or more",
        )
    first = tables[0]
    for number, table in enumerate(tables):
        same = (
            np.array_equal(table.exponents, first.exponents)
            and np.allclose(table.low, first.low, rtol=1e-9)
            and np.allclose(table.high, first.high, rtol=1e-9)
            and np.isclose(table.narrowing, first.narrowing)
            and np.isclose(table.height_mm, first.height_mm)
            and np.isclose(table.straight_mm, first.straight_mm)
        )
        if not same:
            raise InputError(
                "the tables' ranges differ: a spoke that buckles has a shorter one",
                "leave this spoke out, or shorten the range of all",
                specimen=f"table {number}",
                value=dict(zip(DESIGN, designs[number].tolist(), strict=True)),
            )


def _inputs(designs: Array, ply: Mapping[str, float]) -> Array:
    """Give the features (n, 6) with cos 2A in place of A.

    Plies [+A/-A] are the same at -A and at 180° - A: their stiffness does not change with A at 0°
    and 90° to first order, and neither does cos 2A.
    """
    features = spoke_features(designs, ply)
    features[:, 2] = np.cos(2.0 * np.radians(designs[:, 2]))
    return features


def _with_constant(features: Array) -> Array:
    return np.column_stack([np.ones(len(features)), features])


def _power_law(features: Array, scaled: Array) -> Array:
    """Fit the logarithm of the tables' norms by a linear function of the features (n, 6).

    Parameters
    ----------
    features : array (n, 6)
    scaled : array (n, terms)
        Coefficients of the tables divided by C10.

    Returns
    -------
    array (7,)
        Constant and slopes. Over the study's box the norms differ by a factor of three.
    """
    norm = np.log(np.linalg.norm(scaled, axis=1))
    law: Array = np.linalg.lstsq(_with_constant(features), norm, rcond=None)[0]
    return law


def start_kernel() -> Kernel:
    """Kernel of a component, where its search starts.

    The trend is a polynomial of second degree with random coefficients: what a spoke outside the
    others is predicted from.
    """
    smooth = ConstantKernel(1.0, (1e-3, 1e6)) * RBF(np.ones(FEATURES), (1e-1, 1e4))
    trend = ConstantKernel(1.0, (1e-5, 1e4)) * DotProduct(1.0, "fixed") ** 2
    return smooth + trend + WhiteKernel(1e-6, (1e-12, 1e-2))


def _process(unit: Array, score: Array, kernel: Kernel | None) -> GaussianProcessRegressor:
    """Fit one component, or take a kernel as it is."""
    process = GaussianProcessRegressor(
        kernel if kernel is not None else start_kernel(),
        optimizer=maximise if kernel is None else None,
        normalize_y=True,
    )
    try:
        with bounds_are_answers():
            process.fit(unit, score)
    except SearchError as error:
        raise InputError(str(error), "compute more spokes") from None
    return process
