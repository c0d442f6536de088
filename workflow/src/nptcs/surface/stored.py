"""Fitted surfaces of every kind as JSON, for the stages that use them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from nptcs.errors import InputError
from nptcs.files import REWRITE, read_stored
from nptcs.seal import BrokenSealError, open_object, sealed_object
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.gaussian_process import GaussianProcess, MeanSurface
from nptcs.surface.kinds.lamination import Lamination
from nptcs.surface.kinds.linked import LinkedSurface
from nptcs.surface.kinds.spoke_process import SpokeProcess
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.surface.response_surface import ResponseSurface
from nptcs.terms import Polynomial


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
        raise InputError(f"these surfaces cannot be used: {error}", REWRITE, path) from None


def load(text: str) -> dict[str, Surface]:
    """Read what `dump` has written.

    Raises
    ------
    BrokenSealError
        For a text that was damaged or edited.
    """
    content = open_object(text, "Surfaces")
    return {solver: _polynomial(polynomial) for solver, polynomial in content.items()}


def read_registry(path: str | Path) -> SurfaceRegistry:
    """Read all fitted surfaces of a study.

    Raises
    ------
    InputError
        For a file that is missing, damaged or edited.
    """
    try:
        return load_registry(read_stored(path, "file of surfaces"))
    except BrokenSealError as error:
        raise InputError(f"these surfaces cannot be used: {error}", REWRITE, path) from None


def read_models(path: str | Path) -> dict[str, dict[str, ResponseSurface]]:
    """Read the surfaces of a study's stiffness at its load, by solver and name.

    Raises
    ------
    InputError
        As `read_registry`.
    """
    return read_registry(path).by_solver(Response(STIFFNESS))


def dump_registry(registry: SurfaceRegistry) -> str:
    """Write the surfaces of a study, of any kind and response, as JSON text."""
    surfaces = [
        {
            "solver": fitted.solver,
            "name": fitted.name,
            "response": asdict(fitted.response),
            "realised": list(fitted.realised),
            "not_assessed": fitted.not_assessed,
            "failed": fitted.failed,
            "left_out_rms": _number(fitted.left_out_rms),
            "left_out_largest": _number(fitted.left_out_largest),
            "surface": to_plain(fitted.surface),
        }
        for fitted in registry.surfaces
    ]
    return sealed_object({"study": registry.study, "surfaces": surfaces}, "FittedSurfaces")


def load_registry(text: str) -> SurfaceRegistry:
    """Read what `dump_registry` has written.

    Raises
    ------
    BrokenSealError
        For a text that was damaged or edited.
    """
    content = open_object(text, "FittedSurfaces")
    study = content["study"]
    return SurfaceRegistry(study, tuple(_fitted(study, plain) for plain in content["surfaces"]))


def _fitted(study: str, plain: Mapping[str, Any]) -> FittedSurface:
    missing = float("nan")
    return FittedSurface(
        study=study,
        solver=plain["solver"],
        name=plain["name"],
        response=Response(**plain["response"]),
        surface=from_plain(plain["surface"]),
        realised=tuple(plain["realised"]),
        not_assessed=plain["not_assessed"],
        failed=plain["failed"],
        left_out_rms=missing if plain["left_out_rms"] is None else plain["left_out_rms"],
        left_out_largest=missing
        if plain["left_out_largest"] is None
        else plain["left_out_largest"],
    )


def _number(value: float) -> float | None:
    """JSON has no NaN: a number that was not assessed is null."""
    return value if np.isfinite(value) else None


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
        mean=None if content["mean"] is None else MEANS[content["mean"]["kind"]](content["mean"]),
        theta=np.array(content["theta"]),
        spread=np.array(content["spread"]),
    )


def _spoke_process(content: Mapping[str, Any]) -> SpokeProcess:
    return SpokeProcess(
        factor_names=tuple(content["factor_names"]),
        x=np.array(content["x"]),
        y=np.array(content["y"]),
        ply=content["ply"],
        degree=content["degree"],
        theta=np.array(content["theta"]),
    )


MEANS: dict[str, Callable[[Mapping[str, Any]], MeanSurface]] = {
    Surface.__name__: _polynomial,
    LinkedSurface.__name__: _linked,
    Lamination.__name__: _lamination,
}

READERS: dict[str, Callable[[Mapping[str, Any]], ResponseSurface]] = {
    **MEANS,
    GaussianProcess.__name__: _process,
    SpokeProcess.__name__: _spoke_process,
}
