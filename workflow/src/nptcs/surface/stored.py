"""Fitted surfaces as a JSON file, for the stages that use them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nptcs.surface.fit import Surface
from nptcs.surface.terms import Polynomial


def dump(surfaces: Mapping[str, Surface]) -> str:
    """Write surfaces, by the name of their solver, as JSON text."""
    content = {
        solver: {
            "factors": surface.polynomial.factors,
            "exponents": surface.polynomial.exponents,
            "terms": surface.polynomial.names,
            "lower": surface.lower.tolist(),
            "upper": surface.upper.tolist(),
            "coefficients_coded": surface.coefficients_coded.tolist(),
            "coefficients_natural": surface.coefficients_natural.tolist(),
            "covariance_coded": surface.covariance_coded.tolist(),
            "points": surface.points,
            "residual_sd": surface.residual_sd,
        }
        for solver, surface in surfaces.items()
    }
    return json.dumps(content, indent=1)


def read_surfaces(path: str | Path) -> dict[str, Surface]:
    """Read a file of surfaces, by the name of their solver."""
    return load(Path(path).read_text(encoding="utf-8"))


def load(text: str) -> dict[str, Surface]:
    """Read what `dump` has written."""
    return {
        solver: Surface(
            polynomial=Polynomial(
                tuple(content["factors"]), tuple(map(tuple, content["exponents"]))
            ),
            lower=np.array(content["lower"]),
            upper=np.array(content["upper"]),
            coefficients_coded=np.array(content["coefficients_coded"]),
            coefficients_natural=np.array(content["coefficients_natural"]),
            covariance_coded=np.array(content["covariance_coded"]),
            points=content["points"],
            residual_sd=content["residual_sd"],
        )
        for solver, content in json.loads(text).items()
    }
