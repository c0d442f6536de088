"""Fit the surface that a configuration describes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import assert_never

from nptcs.arrays import Array
from nptcs.config.studies.study import Study
from nptcs.config.studies.surface import (
    GaussianProcessModel,
    LaminationModel,
    PolynomialModel,
    SpokeProcessModel,
    SurfaceModel,
    surface_name,
)
from nptcs.errors import InputError
from nptcs.surface.fit import Surface, fit_points
from nptcs.surface.kinds.gaussian_process import GaussianProcess, MeanSurface, fit_process
from nptcs.surface.kinds.lamination import Lamination, fit_lamination
from nptcs.surface.kinds.linked import LinkedSurface, fit_linked
from nptcs.surface.kinds.selection import chosen_terms
from nptcs.surface.kinds.spoke_process import fit_spoke_process
from nptcs.surface.response_surface import ResponseSurface
from nptcs.terms import parse

MOST_PROCESS_CASES = 2000
"""Most cases that a Gaussian process is fitted to."""


@dataclass(frozen=True)
class FitCases:
    """What a surface is fitted to.

    Parameters
    ----------
    x, y : ndarray of shape (m, n) and (m,)
        Factors, as the solver realised them, and response of the solved cases.
    factors : sequence of str
        Names of the columns of `x`.
    terms : sequence of str
        Terms of the study, for polynomials without terms of their own.
    ply : mapping of str to float or None
        Constants of the plates' ply.
    """

    x: Array
    y: Array
    factors: Sequence[str]
    terms: Sequence[str]
    ply: Mapping[str, float] | None = None


def models_of(study: Study) -> dict[str, SurfaceModel]:
    """Name the surfaces of a study: the polynomial of its terms, then those that it lists."""
    first = [PolynomialModel(kind="polynomial")] if study.terms else []
    return {surface_name(model): model for model in [*first, *study.surfaces]}


def fit_surface(model: SurfaceModel, cases: FitCases) -> ResponseSurface:
    """Fit the surface that the configuration describes.

    Raises
    ------
    InputError
        When it cannot be fitted to these cases; see the kinds of surfaces.
    """
    match model:
        case PolynomialModel():
            return _polynomial(model, cases)
        case LaminationModel():
            return _lamination(model, cases)
        case GaussianProcessModel():
            return _process(model, cases)
        case SpokeProcessModel():
            return fit_spoke_process(cases.x, cases.y, cases.factors, cases.ply, model.degree)
        case _:
            assert_never(model)


def _polynomial(model: PolynomialModel, cases: FitCases) -> Surface | LinkedSurface:
    terms = model.terms or cases.terms
    polynomial = parse(terms, cases.factors, model.through_origin)
    if model.choose != "as_given":
        polynomial = chosen_terms(polynomial, cases.x, cases.y, model)
    if model.link == "identity":
        return fit_points(cases.x, cases.y, polynomial, model.through_origin)
    return fit_linked(model.link, cases.x, cases.y, polynomial, model.through_origin)


def _lamination(model: LaminationModel, cases: FitCases) -> Lamination:
    return fit_lamination(cases.x, cases.y, cases.factors, cases.ply, model.coefficients)


def _process(model: GaussianProcessModel, cases: FitCases) -> GaussianProcess:
    if len(cases.y) > MOST_PROCESS_CASES:
        raise InputError(
            f"a Gaussian process is not fitted to {len(cases.y):,} cases: its time grows with the "
            f"cube of their number, its memory with the square (at most {MOST_PROCESS_CASES:,})",
            "leave it out of this study's surfaces, or take fewer levels",
            column="surfaces",
        )
    mean = model.mean
    fit_mean = None if mean is None else (lambda: _mean(mean, cases))
    return fit_process(cases.x, cases.y, tuple(cases.factors), fit_mean)


def _mean(model: PolynomialModel | LaminationModel, cases: FitCases) -> MeanSurface:
    match model:
        case PolynomialModel():
            return _polynomial(model, cases)
        case LaminationModel():
            return _lamination(model, cases)
        case _:
            assert_never(model)
