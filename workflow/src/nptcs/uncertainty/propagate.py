"""Mean, variance and distribution of a response over uncertain inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats
from scipy.stats import qmc

from nptcs.arrays import Array
from nptcs.uncertainty.inputs import SourceKind, UncertainInput
from nptcs.uncertainty.response_model import ResponseModel

NODES = {"normal": (np.sqrt(3.0), 1 / 6), "uniform": (np.sqrt(0.6), 5 / 18)}
"""Outer node of the three-point Gauss rule and its weight; the middle node has the rest.

Gauss–Hermite for a standard normal, Gauss–Legendre for a uniform on [-1, 1]: exact for
polynomials up to the fifth degree.
"""

MOST_DESIGNS = 1000
"""Most designs whose nodes are evaluated at a time."""

SURFACE = UncertainInput(
    name="surface",
    kind=SourceKind.SURFACE,
    source="prediction interval of the surface, at least its error at left-out cases",
    quantities=(),
    root=np.zeros((0, 1)),
)
"""The surface's own error as a source."""


@dataclass(frozen=True)
class Moments:
    """Mean and variance of a response at m designs.

    Parameters
    ----------
    nominal, mean : ndarray of shape (m,)
        Response at the nominal values, and averaged over the inputs.
    variances : ndarray of shape (m, k + 1)
        Variance by each input alone, the others at their nominal values; the last column is the
        surface's own.
    """

    nominal: Array
    mean: Array
    variances: Array

    @property
    def sd(self) -> Array:
        """Standard deviation, shape (m,): inputs are independent and nearly additive."""
        deviation: Array = np.sqrt(self.variances.sum(axis=1))
        return deviation


def assessed(
    model: ResponseModel, inputs: Sequence[UncertainInput]
) -> tuple[list[UncertainInput], list[UncertainInput]]:
    """Divide inputs into those whose effect a model can follow and those that it cannot."""
    known = [bool(model.knows & set(one.quantities)) for one in inputs]
    followed = [one for one, can in zip(inputs, known, strict=True) if can]
    return followed, [one for one, can in zip(inputs, known, strict=True) if not can]


def moments(model: ResponseModel, inputs: Sequence[UncertainInput], x: Array) -> Moments:
    """Propagate each input alone by a three-point Gauss rule.

    Exact where the response is at most quadratic in each input and inputs do not interact; both
    are nearly true for tolerances, and `distribution` shows how nearly.

    Parameters
    ----------
    model : ResponseModel
    inputs : sequence of UncertainInput
        Those that the model can follow (`assessed`).
    x : ndarray of shape (m, n)
        Designs, inside the model's box.

    Returns
    -------
    Moments
    """
    parts = [x[start : start + MOST_DESIGNS] for start in range(0, len(x), MOST_DESIGNS)]
    found = [_moments(model, inputs, part) for part in parts]
    return Moments(
        np.concatenate([part.nominal for part in found]),
        np.concatenate([part.mean for part in found]),
        np.vstack([part.variances for part in found]),
    )


def _moments(model: ResponseModel, inputs: Sequence[UncertainInput], x: Array) -> Moments:
    """Evaluate the model once, at all nodes of all designs together."""
    columns = [(one, column) for one in inputs for column in one.root.T]
    blocks = 1 + 2 * len(columns)
    changes = {name: np.zeros((blocks, len(x))) for one in inputs for name in one.quantities}
    for place, (one, column) in enumerate(columns):
        node = NODES[one.shape][0]
        for name, step in zip(one.quantities, column, strict=True):
            scale = x[:, model.factors.index(name)] if one.relative else 1.0
            changes[name][1 + 2 * place] = node * step * scale
            changes[name][2 + 2 * place] = -node * step * scale
    flat = {name: steps.ravel() for name, steps in changes.items()}
    values = model.value(np.tile(x, (blocks, 1)), flat).reshape(blocks, len(x))
    nominal = values[0]
    shifts, variances = [], []
    for place, (one, _) in enumerate(columns):
        above, below = values[1 + 2 * place] - nominal, values[2 + 2 * place] - nominal
        weight = NODES[one.shape][1]
        shifts.append(weight * (above + below))
        variances.append(weight * (above**2 + below**2) - shifts[-1] ** 2)
    by_input = [
        np.sum(
            [v for v, (other, _) in zip(variances, columns, strict=True) if other is one], axis=0
        )
        for one in inputs
    ]
    return Moments(
        nominal,
        nominal + np.sum(shifts, axis=0) if shifts else nominal.copy(),
        np.column_stack([*by_input, model.own_sd(x) ** 2]),
    )


def shares_percent(variances: Array) -> Array:
    """Return the share of each variance in their sum, in percent; 0 where all are 0.

    The division comes first: ``100 * v / v`` can be 100.00000000000001.

    Examples
    --------
    >>> shares_percent(np.array([3.0, 1.0]))
    array([75., 25.])
    """
    total = variances.sum()
    return 100.0 * (variances / total) if total > 0.0 else np.zeros_like(variances)


def distribution(
    models: Sequence[ResponseModel],
    inputs: Sequence[UncertainInput],
    x: Array,
    samples: int,
    seed: int,
) -> Array:
    """Sample several responses of one design together.

    All are responses of the same tyre and share the samples of the inputs. The errors of their
    surfaces are independent of each other.

    Parameters
    ----------
    models : sequence of ResponseModel
        Models of the same factors.
    inputs : sequence of UncertainInput
        A model ignores an input that it cannot follow.
    x : ndarray of shape (n,)
        The design.
    samples : int
        A power of two.
    seed : int
        Seed of the scrambled Sobol sequence.

    Returns
    -------
    ndarray of shape (samples, responses)
    """
    sizes = [one.root.shape[1] for one in inputs]
    dimensions = sum(sizes) + len(models)
    unit = qmc.Sobol(dimensions, rng=np.random.default_rng(seed)).random(samples)
    unit = np.clip(unit, 1e-12, 1 - 1e-12)
    changes: dict[str, Array] = {}
    start = 0
    for one, size in zip(inputs, sizes, strict=True):
        part = unit[:, start : start + size]
        start += size
        z = stats.norm.ppf(part) if one.shape == "normal" else 2 * part - 1
        for name, row in zip(one.quantities, one.root, strict=True):
            scale = x[models[0].factors.index(name)] if one.relative else 1.0
            changes[name] = changes.get(name, 0.0) + scale * (z @ row)
    points = np.repeat(x[None, :], samples, axis=0)
    own = stats.norm.ppf(unit[:, start:])
    return np.column_stack(
        [
            model.value(points, changes) + own[:, place] * model.own_sd(x[None, :])[0]
            for place, model in enumerate(models)
        ]
    )
