"""Mean, variance and distribution of a response over uncertain inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats
from scipy.stats import qmc

from nptcs.arrays import Array
from nptcs.uncertainty.inputs import SourceKind, UncertainInput
from nptcs.uncertainty.response_model import Changes, ResponseModel

NODES = {"normal": (np.sqrt(3.0), 1 / 6), "uniform": (np.sqrt(0.6), 5 / 18)}
"""Outer node and its weight of the three-point Gauss rule; the rest of the weight is in between.

Gauss–Hermite for a standard normal, Gauss–Legendre for a uniform on [-1, 1]: exact for
polynomials of the fifth degree.
"""

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
    hold for tolerances, and `distribution` shows how far.

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
    nominal = model.value(x, {})
    mean = nominal.copy()
    variances = []
    for one in inputs:
        node, weight = NODES[one.shape]
        variance = np.zeros(len(x))
        for column in one.root.T:
            above = model.value(x, _changes(one, column * node, len(x))) - nominal
            below = model.value(x, _changes(one, -column * node, len(x))) - nominal
            shift = weight * (above + below)
            mean += shift
            variance += weight * (above**2 + below**2) - shift**2
        variances.append(variance)
    variances.append(model.own_sd(x) ** 2)
    return Moments(nominal, mean, np.column_stack(variances))


def distribution(
    models: Sequence[ResponseModel],
    inputs: Sequence[UncertainInput],
    x: Array,
    samples: int,
    seed: int,
) -> Array:
    """Sample several responses of one design together.

    The same tyre has all responses: they share the samples of the inputs. The errors of their
    surfaces are independent of each other.

    Parameters
    ----------
    models : sequence of ResponseModel
    inputs : sequence of UncertainInput
        A model ignores an input that it cannot follow.
    x : ndarray of shape (n,)
        The design.
    samples : int
        A power of two.
    seed : int
        Of the scrambled Sobol sequence.

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
            changes[name] = changes.get(name, 0.0) + z @ row
    points = np.repeat(x[None, :], samples, axis=0)
    own = stats.norm.ppf(unit[:, start:])
    return np.column_stack(
        [
            model.value(points, changes) + own[:, place] * model.own_sd(x[None, :])[0]
            for place, model in enumerate(models)
        ]
    )


def _changes(one: UncertainInput, steps: Array, points: int) -> Changes:
    return {name: np.full(points, step) for name, step in zip(one.quantities, steps, strict=True)}
