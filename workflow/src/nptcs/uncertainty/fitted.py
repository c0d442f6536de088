"""Fitted models of the responses that goals name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Mask
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.goals import ResponseName
from nptcs.config.studies.surface import (
    LaminationModel,
    PolynomialModel,
    SurfaceModel,
    surface_name,
)
from nptcs.doe.whole_plates import SPACING
from nptcs.errors import InputError
from nptcs.surface.diagnostics.comparison import leave_one_out
from nptcs.surface.kinds.lamination import FACTORS as LAMINATION_FACTORS
from nptcs.surface.kinds.lamination import Lamination
from nptcs.surface.kinds.models import FitCases, fit_surface, models_of
from nptcs.surface.registry import STIFFNESS as AT_STUDY_LOAD
from nptcs.surface.registry import FittedSurface, Response, SurfaceRegistry
from nptcs.surface.response_surface import ResponseSurface, box, inside_box
from nptcs.uncertainty.answering_surface import ALWAYS
from nptcs.uncertainty.inputs import RUBBERS
from nptcs.uncertainty.response_model import (
    Changes,
    ResponseModel,
    RubberEffect,
    SurfaceResponse,
    lamination_of,
)
from nptcs.uncertainty.study_results import STIFFNESS, StudyResults

PLATE_MASS = ResponseName("plate_mass")
THICKNESS = "thickness_mm"
SAME_VOLUME = 1e-6
"""Relative difference up to which the plates' volume counts as proportional to count × T."""


@dataclass(frozen=True)
class FittedResponse:
    """A response with its model and what the model is based on.

    Parameters
    ----------
    response : ResponseName
    unit : str
    model : ResponseModel
    surface : str
        Name of the surface.
    cases, left_out : int
        Cases that it was fitted to, and solved ones that lack the response.
    notes : tuple of str
        What a reader must know, for example why an effect is not assessed.
    """

    response: ResponseName
    unit: str
    model: ResponseModel
    surface: str
    cases: int
    left_out: int = 0
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class PlateMass:
    """Mass of the plates: proportional to their number and thickness, without error.

    Parameters
    ----------
    factors : tuple of str
    lower, upper : ndarray of shape (n,)
        Box of the cases.
    kg_per_mm : float
        Mass of all plates of the tyre per plate of a leg and mm of thickness.
    tread_width_mm : float
    """

    factors: tuple[str, ...]
    lower: Array
    upper: Array
    kg_per_mm: float
    tread_width_mm: float

    @property
    def knows(self) -> frozenset[str]:
        """The thickness alone: a deviation in spacing does not change the number of plates."""
        return frozenset({THICKNESS})

    def value(self, x: Array, changes: Changes) -> Array:
        """Mass in kg."""
        plates = np.round(self.tread_width_mm / x[:, self.factors.index(SPACING)])
        thickness = x[:, self.factors.index(THICKNESS)] + changes.get(THICKNESS, 0.0)
        mass: Array = self.kg_per_mm * plates * thickness
        return mass

    def own_sd(self, x: Array) -> Array:
        """No error: the mass follows from the dimensions."""
        return np.zeros(len(x))

    def inside(self, x: Array) -> Mask:
        """Tell which points are in the box of the cases."""
        return np.asarray(((x >= self.lower - 1e-9) & (x <= self.upper + 1e-9)).all(axis=1))


def fit_response(
    results: StudyResults,
    response: ResponseName,
    surface: str,
    tyre: TyreGeometry,
    ply: Mapping[str, float] | None,
    rubbers: StudyResults | None,
    registry: SurfaceRegistry | None = None,
) -> FittedResponse:
    """Fit the model of one response.

    Parameters
    ----------
    results : StudyResults
    response : ResponseName
    surface : str
        Name of a surface of the study, for the stiffness. Other responses use their best stored
        surface, or a Gaussian process on their mean if none is stored; the plates' mass follows
        from the dimensions.
    tyre : TyreGeometry
    ply : mapping of str to float or None
        Constants of the plates' ply.
    rubbers : StudyResults or None
        Cases of the study that varies the rubbers, by the same solver.
    registry : SurfaceRegistry or None
        Surfaces of the study that are fitted already; others are fitted here.

    Raises
    ------
    InputError
        When no case has the response, the study has no such surface, or it cannot be fitted to the
        cases.
    """
    if response.name == PLATE_MASS.name:
        return _plate_mass(results, tyre)
    y = results.values(response)
    has = np.isfinite(y)
    cases = FitCases(results.points[has], y[has], results.factors, results.study.terms, ply)
    fitted = _surface(results, response, surface, cases, registry)
    lamination, no_ply = _lamination(fitted.surface, response, cases)
    effect, no_rubbers = _rubber_effect(results, response, rubbers)
    least, unknown = fitted.left_out_rms, ""
    if not np.isfinite(least):
        least, unknown = 0.0, "error at left-out cases not assessed: the surface's interval alone"
    return FittedResponse(
        response=response,
        unit=results.unit(response),
        model=SurfaceResponse(fitted.surface, least, lamination, effect),
        surface=fitted.name,
        cases=len(fitted.surface.y),
        left_out=int((~has).sum()),
        notes=tuple(filter(None, [no_ply, no_rubbers, unknown])),
    )


def _surface(
    results: StudyResults,
    response: ResponseName,
    name: str,
    cases: FitCases,
    registry: SurfaceRegistry | None,
) -> FittedSurface:
    """Return the stored surface of a response, or fit it to the same cases."""
    stored = registry_surface(registry, results, response, name)
    if stored is not None and len(stored.surface.y) == len(cases.y):
        return stored
    chosen = name if response.name in STIFFNESS else surface_name(ALWAYS)
    model = _model(results, chosen)
    if len(cases.y) < results.study.least_solved_cases():
        raise InputError(
            f"only {len(cases.y)} cases of study {results.study.name} have {response}",
            column=f"studies.{results.study.name}.least_cases",
            value=results.study.least_solved_cases(),
            remedy="solve more cases",
        )
    if stored is not None:  # cases were added: the form is kept
        chosen, surface = stored.name, stored.surface.refit(cases.x, cases.y)
    else:
        surface = fit_surface(model, cases)
    return FittedSurface(
        study=results.study.name,
        solver=results.solver,
        name=chosen,
        response=Response(response.name, response.at, results.unit(response)),
        surface=surface,
        left_out_rms=leave_one_out(surface).rms,
    )


def registry_surface(
    registry: SurfaceRegistry | None, results: StudyResults, response: ResponseName, name: str
) -> FittedSurface | None:
    """Return the stored surface of that name, or else the best one if it is not a stiffness.

    The stiffness at the study's own load is stored under a separate name.
    """
    if registry is None:
        return None
    wanted = [(response.name, response.at)]
    if response == results.at_its_load(ResponseName("secant_stiffness")):
        wanted.append((AT_STUDY_LOAD, ""))
    found = [
        one
        for one in registry.surfaces
        if one.solver == results.solver and (one.response.name, one.response.at) in wanted
    ]
    named = [one for one in found if one.name == name]
    if named:
        return named[0]
    if response.name in STIFFNESS or not found:
        return None
    return min(found, key=lambda one: np.nan_to_num(one.left_out_rms, nan=np.inf))


def _model(results: StudyResults, surface: str) -> SurfaceModel:
    models = {surface_name(ALWAYS): ALWAYS, **models_of(results.study)}
    if surface not in models:
        raise InputError(
            f"study {results.study.name} has no such surface",
            column="surface",
            value=surface,
            remedy=f"name one of: {', '.join(models)}",
        )
    return models[surface]


def _lamination(
    surface: ResponseSurface, response: ResponseName, cases: FitCases
) -> tuple[Lamination | None, str]:
    """Return the lamination form that gives the effect of the ply, or why there is none."""
    if response.name not in STIFFNESS:
        return None, "effect of the ply not assessed: the lamination form describes only stiffness"
    own = lamination_of(surface)
    if own is not None:
        return own, ""
    if sorted(cases.factors) != sorted(LAMINATION_FACTORS):
        note = "effect of the ply not assessed: the lamination form has only the factors S, T and A"
        return None, note
    try:
        form = fit_surface(LaminationModel(kind="lamination", coefficients=7), cases)
    except InputError as error:
        return None, f"effect of the ply not assessed: {error.message}"
    return lamination_of(form), ""


def _rubber_effect(
    results: StudyResults, response: ResponseName, rubbers: StudyResults | None
) -> tuple[RubberEffect | None, str]:
    """Fit the rubber study's surface of the same response, or say why there is none."""
    study = results.study
    nominal = {name: float(results.solved[name].iloc[0]) for name in RUBBERS if name in study.fixed}
    if not nominal:
        return None, ""
    if rubbers is None:
        return None, "effect of the rubbers not assessed: no study of this solver varies them"
    varied = [name for name in rubbers.factors if name in nominal]
    if varied != rubbers.factors:
        return None, "effect of the rubbers not assessed: their study varies other factors too"
    try:
        surface = _fit_rubbers(rubbers, response)
    except InputError as error:
        return None, f"effect of the rubbers not assessed: {error.message}"
    point = np.array([[nominal[name] for name in surface.factors]])
    if not inside_box(surface, point)[0]:
        low, high = box(surface.x)
        return None, (
            f"effect of the rubbers not assessed: {point[0].tolist()} is outside study "
            f"{rubbers.study.name} ({low.tolist()} to {high.tolist()})"
        )
    return RubberEffect(surface, nominal), ""


def _fit_rubbers(rubbers: StudyResults, response: ResponseName) -> ResponseSurface:
    y = rubbers.values(response)
    has = np.isfinite(y)
    cases = FitCases(rubbers.points[has], y[has], rubbers.factors, rubbers.study.terms)
    return fit_surface(PolynomialModel(kind="polynomial"), cases)


def _plate_mass(results: StudyResults, tyre: TyreGeometry) -> FittedResponse:
    """Read the mass per plate and thickness from the cases; check that all cases have the same."""
    if not {SPACING, THICKNESS} <= set(results.factors):
        raise InputError(
            f"study {results.study.name} does not vary the plates",
            column="decisions",
            value=PLATE_MASS.name,
            remedy="leave the plates' mass out of the goals",
        )
    mass, points = results.values(PLATE_MASS), results.points
    plates = np.round(tyre.tread_width_mm / points[:, results.factors.index(SPACING)])
    each = mass / plates / points[:, results.factors.index(THICKNESS)]
    each = each[np.isfinite(each)]
    if np.ptp(each) > SAME_VOLUME * each.mean():
        raise InputError(
            "the plates' mass in the cases is not proportional to their number and thickness",
            column="decisions",
            value=PLATE_MASS.name,
            remedy="use a solver whose plates all have the same length",
        )
    lower, upper = points.min(axis=0), points.max(axis=0)
    model = PlateMass(tuple(results.factors), lower, upper, float(each.mean()), tyre.tread_width_mm)
    return FittedResponse(PLATE_MASS, "kg", model, "number × dimensions × density", len(each))
