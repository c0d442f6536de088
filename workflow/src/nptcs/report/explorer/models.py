"""Every kind of stored surface as the numbers that a browser needs to evaluate it.

A prediction is written with what its formula needs: coefficients and their covariance, or the
cases, hyperparameters and weights of a process. Factors of a Cholesky decomposition are left out,
because they are the bulk of a process; the browser decomposes its matrix when it needs an interval.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.special import ndtri, stdtrit

from nptcs.arrays import Array
from nptcs.report.explorer.shared import Plain
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.gaussian_process import NUGGET, GaussianProcess
from nptcs.surface.kinds.lamination import ABSENT, REFERENCE_SPACING_MM, Lamination
from nptcs.surface.kinds.linked import LinkedSurface
from nptcs.surface.kinds.spoke_process import SPOKE, SpokeProcess
from nptcs.surface.response_surface import ResponseSurface

CONFIDENCE = 0.95
"""Confidence of all intervals."""


def plain_surface(surface: ResponseSurface) -> Plain:
    """Return a surface as plain values, with its factors in the order of its points.

    Raises
    ------
    KeyError
        For a kind without a writer; `WRITERS` has all kinds.
    """
    return {
        "kind": type(surface).__name__,
        "factors": list(surface.factors),
        **WRITERS[type(surface)](surface),
    }


def _student(freedom: int) -> float:
    return float(stdtrit(freedom, 0.5 + CONFIDENCE / 2))


def _normal() -> float:
    return float(ndtri(0.5 + CONFIDENCE / 2))


def _upper(matrix: Array) -> list[float]:
    """Return a symmetric matrix row by row, each from its diagonal on."""
    rows, columns = np.triu_indices(len(matrix))
    return [float(value) for value in matrix[rows, columns]]


def _polynomial(surface: Surface) -> Plain:
    centre, half = surface.coding()
    return {
        "exponents": [list(powers) for powers in surface.polynomial.exponents],
        "centre": centre.tolist(),
        "half": half.tolist(),
        "coefficients": surface.coefficients_coded.tolist(),
        "covariance": _upper(surface.covariance_coded),
        "sd": float(surface.residual_sd),
        "quantile": _student(surface.points - len(surface.polynomial)),
    }


def _linked(surface: LinkedSurface) -> Plain:
    return {"link": surface.link, "inner": plain_surface(surface.inner)}


def _lamination(surface: Lamination) -> Plain:
    return {
        "ply": {name: float(value) for name, value in surface.ply.items()},
        "shape": list(surface.shape),
        "absent": {"m": ABSENT["m"]},
        "reference": REFERENCE_SPACING_MM,
        "parameters": surface.parameters.tolist(),
        "covariance": _upper(surface.covariance),
        "sd": float(surface.residual_sd),
        "quantile": _student(len(surface.y) - surface.coefficients),
    }


def _process(surface: GaussianProcess) -> Plain:
    fitted = surface.regressor()
    return {
        "centre": fitted.centre.tolist(),
        "half": fitted.half.tolist(),
        "components": [
            {
                "theta": one.theta.tolist(),
                "weights": one.weights.tolist(),
                "mean_covariance": _upper(one.mean_covariance),
            }
            for one in fitted.components
        ],
        "scale": fitted.scale,
        "nugget": NUGGET,
        "mean": float(surface.y.mean()) if surface.mean is None else plain_surface(surface.mean),
        "quantile": fitted.factor,
    }


def _spoke_process(surface: SpokeProcess) -> Plain:
    parts = surface.parts()
    return {
        "ply": {name: float(value) for name, value in surface.ply.items()},
        "spoke": [surface.factors.index(name) for name in SPOKE],
        "ring": list(parts.ring_columns),
        "exponents": [list(powers) for powers in parts.exponents],
        "low": parts.low.tolist(),
        "high": parts.high.tolist(),
        "logarithmic": surface.logarithmic,
        "mean": parts.mean.tolist(),
        "directions": parts.directions.tolist(),
        "misfit": parts.misfit,
        "middle": parts.middle.tolist(),
        "spread": parts.spread.tolist(),
        "unit": parts.unit.tolist(),
        "processes": [
            {
                "theta": theta.tolist(),
                "weights": process.weights.tolist(),
                "middle": process.middle,
                "spread": process.spread,
                "inflation": process.inflation,
                "nugget": process.nugget,
            }
            for theta, process in zip(surface.theta, parts.processes, strict=True)
        ],
        "quantile": _normal(),
    }


WRITERS: Mapping[type, Callable[[Any], Plain]] = {
    Surface: _polynomial,
    LinkedSurface: _linked,
    Lamination: _lamination,
    GaussianProcess: _process,
    SpokeProcess: _spoke_process,
}
"""One writer per kind of surface; those of `nptcs.surface.stored.READERS`."""
