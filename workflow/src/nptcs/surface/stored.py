"""Fitted surfaces of every kind as JSON, for the stages that use them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from nptcs.errors import InputError
from nptcs.files import REWRITE, read_stored
from nptcs.seal import BrokenSealError, open_object, sealed_object
from nptcs.surface.fit import Surface
from nptcs.surface.gaussian_process import GaussianProcess
from nptcs.surface.lamination import Lamination
from nptcs.surface.linked import LinkedSurface
from nptcs.surface.response_surface import ResponseSurface
from nptcs.terms import Polynomial

Models = Mapping[str, Mapping[str, ResponseSurface]]
"""Surfaces by solver and name."""


def dump(surfaces: Mapping[str, Surface]) -> str:
    """Write polynomials, by the name of their solver, as JSON text."""
    content = {solver: surface.content() for solver, surface in surfaces.items()}
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
    content = open_object(text, "Surfaces")
    return {solver: _polynomial(polynomial) for solver, polynomial in content.items()}


def read_models(path: str | Path) -> dict[str, dict[str, ResponseSurface]]:
    """Read a file of surfaces of any kind, by solver and name.

    Raises
    ------
    InputError
        For a file that is missing, damaged or edited.
    """
    try:
        return load_models(read_stored(path, "file of surfaces"))
    except BrokenSealError as error:
        raise InputError(f"these surfaces are not sound: {error}", REWRITE, path) from None


def dump_models(models: Models) -> str:
    """Write surfaces of any kind, by solver and name, as JSON text."""
    content = {
        solver: {name: to_plain(surface) for name, surface in named.items()}
        for solver, named in models.items()
    }
    return sealed_object(content, "Models")


def load_models(text: str) -> dict[str, dict[str, ResponseSurface]]:
    """Read what `dump_models` has written."""
    return {
        solver: {name: from_plain(content) for name, content in named.items()}
        for solver, named in open_object(text, "Models").items()
    }


def to_plain(surface: ResponseSurface) -> dict[str, Any]:
    """Return a surface of any kind as plain values."""
    plain = {"kind": type(surface).__name__, **surface.content()}
    if isinstance(surface, GaussianProcess):
        plain["mean"] = None if surface.mean is None else to_plain(surface.mean)
    return plain


def from_plain(plain: Mapping[str, Any]) -> ResponseSurface:
    """Read what `to_plain` has written."""
    return READERS[plain["kind"]](plain)


def _polynomial(content: Mapping[str, Any]) -> Surface:
    return Surface(
        polynomial=Polynomial(tuple(content["factors"]), tuple(map(tuple, content["exponents"]))),
        x=np.array(content["x"]),
        y=np.array(content["y"]),
        coefficients_coded=np.array(content["coefficients_coded"]),
        coefficients_natural=np.array(content["coefficients_natural"]),
        covariance_coded=np.array(content["covariance_coded"]),
        residual_sd=content["residual_sd"],
        through_origin=content["through_origin"],
    )


def _linked(content: Mapping[str, Any]) -> LinkedSurface:
    inner = _polynomial(content["inner"])
    return LinkedSurface(content["link"], inner, np.array(content["y"]))


def _lamination(content: Mapping[str, Any]) -> Lamination:
    return Lamination(
        x=np.array(content["x"]),
        y=np.array(content["y"]),
        ply=content["ply"],
        shape=tuple(content["shape"]),
        parameters=np.array(content["parameters"]),
        covariance=np.array(content["covariance"]),
        residual_sd=content["residual_sd"],
    )


def _process(content: Mapping[str, Any]) -> GaussianProcess:
    return GaussianProcess(
        factor_names=tuple(content["factor_names"]),
        x=np.array(content["x"]),
        y=np.array(content["y"]),
        mean=None if content["mean"] is None else from_plain(content["mean"]),
        theta=np.array(content["theta"]),
    )


READERS: dict[str, Callable[[Mapping[str, Any]], ResponseSurface]] = {
    Surface.__name__: _polynomial,
    LinkedSurface.__name__: _linked,
    Lamination.__name__: _lamination,
    GaussianProcess.__name__: _process,
}
