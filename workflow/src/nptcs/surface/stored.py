"""Fitted surfaces as a JSON file, for the stages that use them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nptcs.errors import InputError
from nptcs.files import REWRITE, read_stored
from nptcs.seal import BrokenSealError, open_object, sealed_object
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
    return sealed_object(content, "Surfaces")


def read_surfaces(path: str | Path) -> dict[str, Surface]:
    """Read a file of surfaces, by the name of their solver.

    Raises
    ------
    InputError
        For a file that is missing, damaged or edited.
    """
    try:
        return load(read_stored(path, "file of surfaces"))
    except BrokenSealError as error:
        raise InputError(f"these surfaces are not sound: {error}", REWRITE, path) from None


def load(text: str) -> dict[str, Surface]:
    """Read what `dump` has written.

    Raises
    ------
    BrokenSealError
        For a text that was damaged or edited.
    """
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
        for solver, content in open_object(text, "Surfaces").items()
    }
