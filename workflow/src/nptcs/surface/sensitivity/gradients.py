"""Average gradients of a response surface and comprehensive impact values, section 4.2.3."""

from __future__ import annotations

from typing import assert_never

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.studies.sensitivity import AveragingRule
from nptcs.surface.fit import Surface

GRID_POINTS = 2_000_000
"""Points of the midpoint rule over the domain; its relative error is then below 1e-4."""


def impact(surface: Surface, rule: AveragingRule) -> pd.DataFrame:
    """Average the gradient of each factor and multiply it by the factor's range.

    The comprehensive impact value of section 4.2.3 is (average gradient) × (range). The paper
    does not say how it averages; the rules are

    - ``domain_mean_absolute``: mean of |∂f/∂x| over the box of all factor ranges,
    - ``design_mean_absolute``: mean of |∂f/∂x| over the cases that the surface was fitted to,
    - ``domain_mean_signed``: mean of ∂f/∂x over the box.

    Parameters
    ----------
    surface : Surface
        Fitted polynomial; its factors and their ranges are those that the solver realised.
    rule : str
        Averaging rule.

    Returns
    -------
    DataFrame
        ``factor, rule, gradient, range, impact``; the impact carries the sign of the gradient,
        in the unit of the response.

    Examples
    --------
    The slope of 2 a over 0 to 4 is 2 everywhere, its impact 2 · 4; b has none:

    >>> from itertools import product
    >>> from nptcs.surface.fit import fit
    >>> design = pd.DataFrame(product([0.0, 2.0, 4.0], [1.0, 2.0]), columns=["a", "b"])
    >>> surface = fit(design, 2 * design["a"], ["a", "b"], ["1", "a", "b"])
    >>> table = impact(surface, "domain_mean_absolute").round(6)
    >>> print(table[["factor", "gradient", "range", "impact"]].to_string(index=False))
    factor  gradient  range  impact
         a       2.0    4.0     8.0
         b       0.0    1.0     0.0
    """
    factors = surface.factors
    gradients = []
    for factor in factors:
        match rule:
            case "design_mean_absolute":
                gradient = abs(surface.gradient(surface.x, factor))
            case "domain_mean_absolute":
                gradient = abs(_gradient_over_domain(surface, factor))
            case "domain_mean_signed":
                gradient = _gradient_over_domain(surface, factor)
            case _:
                assert_never(rule)
        gradients.append(float(np.mean(gradient)))
    ranges = surface.upper - surface.lower
    return pd.DataFrame(
        {
            "factor": factors,
            "rule": rule,
            "gradient": gradients,
            "range": ranges,
            "impact": gradients * ranges,
        }
    )


def _gradient_over_domain(surface: Surface, factor: str) -> Array:
    """Evaluate ∂f/∂(factor) at the cell midpoints of a grid over the box of all ranges.

    The derivative is a polynomial, so the grid of n axes is filled axis by axis from the tensor
    of its coefficients; n axes of m midpoints give an array of shape (m, …, m).
    """
    polynomial = surface.polynomial
    axis = polynomial.factors.index(factor)
    powers = np.array(polynomial.exponents)
    tensor = np.zeros(powers.max(axis=0) + 1)
    for exponents, coefficient in zip(powers, surface.coefficients_coded, strict=True):
        if exponents[axis]:
            lowered = exponents - np.eye(len(exponents), dtype=int)[axis]
            tensor[tuple(lowered)] += exponents[axis] * coefficient
    cells = max(2, round(GRID_POINTS ** (1 / len(powers[0]))))
    midpoints = -1 + 2 * (np.arange(cells) + 0.5) / cells
    for _ in range(tensor.ndim):
        values = np.vander(midpoints, tensor.shape[0], increasing=True)
        tensor = np.tensordot(tensor, values, axes=(0, 1))
    return tensor / surface.coding()[1][axis]
