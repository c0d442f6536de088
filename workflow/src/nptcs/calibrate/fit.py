"""Fits of hyperelastic models: constants, errors from the specimens' scatter, quality."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from nptcs.arrays import Array
from nptcs.calibrate.linear import robust_covariance
from nptcs.calibrate.observations import Observation

SCATTER = "scatter between {n} specimens (jackknife)"
REGRESSION = "scatter of the points about the fit (too few specimens of a mode for their scatter)"


class HyperelasticModel(Protocol):
    """What a hyperelastic model can do; incompressible, stresses nominal, MPa."""

    @property
    def name(self) -> str:
        """Name in tables and configuration."""

    @property
    def constants(self) -> tuple[str, ...]:
        """Names of the constants, units in the names."""

    def solve(self, data: Sequence[Observation], start: Array | None = None) -> Array:
        """Constants of the weighted least-squares fit."""

    def stress(self, mode: str, stretch: Array, constants: Array) -> Array:
        """Nominal stress, shape (n,)."""

    def jacobian(self, mode: str, stretch: Array, constants: Array) -> Array:
        """∂P/∂c, shape (n, k)."""

    def tangent(self, l1: Array, l2: Array, constants: Array) -> Array:
        """Hessian of the energy in logarithmic strains, shape (n, 2, 2)."""

    def initial_shear_modulus(self, constants: Array) -> float:
        """Shear modulus of the undeformed material, MPa."""

    def remarks(self, constants: Array) -> list[str]:
        """Say what a reader must know of these constants."""


@dataclass(frozen=True)
class ModelFit:
    """Constants of a model with their covariance and the quality of the fit.

    Parameters
    ----------
    constants : ndarray, shape (k,)
        In the order of the model's names.
    covariance : ndarray, shape (k, k)
        Of the constants.
    covariance_rule : str
        How it was estimated.
    points : int
        Points in the fit.
    rmse_mpa, r_squared : float
        Over all points, unweighted.
    largest_error_percent : float
        Largest |P_model/P - 1| where P is at least the floor's fraction of its largest value.
    """

    constants: Array
    covariance: Array
    covariance_rule: str
    points: int
    rmse_mpa: float
    largest_error_percent: float
    r_squared: float

    @property
    def standard_errors(self) -> Array:
        """Square roots of the covariance's diagonal, shape (k,)."""
        return np.sqrt(np.diag(self.covariance))


def fit_model(
    model: HyperelasticModel, data: Sequence[Observation], error_floor: float
) -> ModelFit:
    """Fit a model to all observations together.

    Parameters
    ----------
    model : HyperelasticModel
        Neo-Hookean, Mooney–Rivlin, Yeoh or Ogden.
    data : sequence of Observation
        One per specimen, of one mode or of several.
    error_floor : float
        Fraction of the largest stress below which relative errors are not evaluated.

    Returns
    -------
    ModelFit
        The covariance is the delete-one jackknife over specimens within each mode,
        Σ_h (n_h - 1)/n_h Σ_i (c_hi - c̄_h)(c_hi - c̄_h)ᵀ, which is s²/n for a mean; with a
        single specimen in some mode it is the regression's (HC1), and the rule says so. The errors
        of the strain origins are added: with scatter between specimens only their common part.

    Examples
    --------
    >>> from nptcs.calibrate.invariants import NEO_HOOKEAN
    >>> stretch = np.linspace(1.01, 1.15, 8)
    >>> stress = 2 * 1.18 * (stretch - stretch**-2)
    >>> data = [Observation("R75-1", "rubber_tension", stretch, stress, np.ones(8))]
    >>> fit_model(NEO_HOOKEAN, data, error_floor=0.1).constants.round(6).tolist()
    [1.18]
    """
    constants = model.solve(data)
    stress = np.concatenate([o.stress for o in data])
    residual = _residuals(model, data, constants)
    covariance, rule = _covariance(model, data, constants)
    large = np.abs(stress) >= error_floor * np.abs(stress).max()
    total = float(((stress - stress.mean()) ** 2).sum())
    return ModelFit(
        constants,
        covariance,
        rule,
        len(stress),
        float(np.sqrt(np.mean(residual**2))),
        float(100 * np.max(np.abs(residual[large] / stress[large]))),
        1.0 - float(residual @ residual) / total if total > 0 else float("nan"),
    )


def _residuals(model: HyperelasticModel, data: Sequence[Observation], constants: Array) -> Array:
    return np.concatenate([model.stress(o.mode, o.stretch, constants) - o.stress for o in data])


def _covariance(
    model: HyperelasticModel, data: Sequence[Observation], constants: Array
) -> tuple[Array, str]:
    counts = Counter(o.mode for o in data)
    if min(counts.values()) > 1:
        covariance, rule = _jackknife(model, data, constants), SCATTER.format(n=len(data))
        # each specimen's own error of the origin is in their scatter; the common one is not
        steps = [o.origin.model_error for o in data]
        moved = _change(model, data, constants, steps)
        added = np.outer(moved, moved)
        return covariance + added, _origin_rule(rule, steps)
    jacobian = np.concatenate([model.jacobian(o.mode, o.stretch, constants) for o in data])
    weight = np.concatenate([o.weight for o in data])
    covariance = robust_covariance(jacobian, _residuals(model, data, constants), weight)
    errors = [o.origin.error for o in data]
    for index, error in enumerate(errors):
        alone = [error if i == index else 0.0 for i in range(len(data))]
        moved = _change(model, data, constants, alone)
        covariance = covariance + np.outer(moved, moved)
    return covariance, _origin_rule(REGRESSION, errors)


def _origin_rule(rule: str, errors: Sequence[float]) -> str:
    if not any(errors):
        return rule
    return f"{rule}, and strain origins ± {max(errors):.2g}"


def _change(
    model: HyperelasticModel,
    data: Sequence[Observation],
    constants: Array,
    strains: Sequence[float],
) -> Array:
    """Half the change of the constants from strains added to those subtracted, shape (k,)."""
    if not any(strains):
        return np.zeros(len(constants))
    ends = [
        model.solve(
            [o.moved(sign * strain) for o, strain in zip(data, strains, strict=True)],
            start=constants,
        )
        for sign in (1.0, -1.0)
    ]
    return (ends[0] - ends[1]) / 2


def _jackknife(model: HyperelasticModel, data: Sequence[Observation], constants: Array) -> Array:
    total = np.zeros((len(constants), len(constants)))
    for mode in {o.mode for o in data}:
        left_out = [i for i, o in enumerate(data) if o.mode == mode]
        estimates = np.array(
            [model.solve([*data[:i], *data[i + 1 :]], start=constants) for i in left_out]
        )
        deviation = estimates - estimates.mean(axis=0)
        n = len(left_out)
        total += (n - 1) / n * deviation.T @ deviation
    return total
