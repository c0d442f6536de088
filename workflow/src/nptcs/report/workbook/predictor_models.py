"""The polynomials that the predictor evaluates, and the inputs that they take."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from nptcs.arrays import Array
from nptcs.config.studies.study import Level, MeasuredRubber, Study
from nptcs.config.studies.surface import Link
from nptcs.language import translatable
from nptcs.report.data import Results
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.linked import LinkedSurface
from nptcs.surface.registry import FittedSurface

INPUTS: Mapping[str, tuple[str, str, str]] = {
    "spacing_mm": ("S", translatable("plate spacing"), "mm"),
    "thickness_mm": ("T", translatable("plate thickness"), "mm"),
    "angle_deg": ("A", translatable("fibre angle"), "°"),
    "shear_band_c10_mpa": ("T-C", translatable("C10 of the shear band"), "MPa"),
    "spoke_c10_mpa": ("S-C", translatable("C10 of the spokes"), "MPa"),
}
"""Symbol, name and unit of the five inputs, by the names of the factors."""

SPACING = "spacing_mm"
CONFIDENCE = 0.95


@dataclass(frozen=True)
class PredictorModel:
    """A polynomial of the response or of a function of it.

    Parameters
    ----------
    fitted : FittedSurface
        Response, study, solver and the values that the solver realised.
    inner : Surface
        The polynomial in coded units.
    link : str
        What the polynomial describes: the response itself, its logarithm or its reciprocal.
    fixed : mapping of str to float
        Values that all cases of the study share.
    snaps : bool
        Whether the solver turns the spacing into that of a whole number of plates.
    """

    fitted: FittedSurface
    inner: Surface
    link: Link
    fixed: Mapping[str, float]
    snaps: bool

    @property
    def t_quantile(self) -> float:
        """Factor of the prediction interval: Student's t for the degrees of freedom of the fit."""
        return float(stdtrit(self.inner.points - self.inner.coefficients, 0.5 + CONFIDENCE / 2))

    def bounds(self) -> tuple[Array, Array]:
        """Lowest and highest value of each factor among the cases of the fit."""
        return self.inner.lower, self.inner.upper


def predictor_models(results: Results) -> tuple[list[PredictorModel], dict[str, int]]:
    """Find the polynomials of a run whose factors are among the inputs.

    Returns
    -------
    models : list of PredictorModel
        In the order of the studies and of their surfaces.
    others : dict of str to int
        Surfaces that no formula of a sheet evaluates: how many of each kind.
    """
    models: list[PredictorModel] = []
    others: dict[str, int] = {}
    for name, registry in results.models.items():
        fixed = fixed_values(results.config.study(name), results)
        for fitted in registry.surfaces:
            polynomial = _polynomial(fitted)
            if polynomial is None or not set(fitted.factors) <= set(INPUTS):
                others[fitted.name] = others.get(fitted.name, 0) + 1
            else:
                whole = results.solvers[fitted.solver].whole_plates or SPACING in fitted.realised
                models.append(PredictorModel(fitted, *polynomial, fixed, whole))
    return models, others


def _polynomial(fitted: FittedSurface) -> tuple[Surface, Link] | None:
    """Return the polynomial of a surface with its link; none for another kind."""
    surface = fitted.surface
    if isinstance(surface, LinkedSurface):
        return surface.inner, surface.link
    return (surface, "identity") if isinstance(surface, Surface) else None


def fixed_values(study: Study, results: Results) -> dict[str, float]:
    """Return the values that all cases of a study share, a tested rubber as its C10 in MPa."""
    return {name: _number(level, results) for name, level in study.fixed.items() if name in INPUTS}


def _number(level: Level, results: Results) -> float:
    if isinstance(level, MeasuredRubber):
        return results.card.rubbers[level.rubber].constants["c10_mpa"].value
    return float(level)


def start_values(results: Results, models: Sequence[PredictorModel]) -> dict[str, float]:
    """Choose the initial values of the inputs.

    The reference design of the first study that has one, and the values that it holds fixed; then
    those of other studies, or the middle of the box of the first model with this factor.
    """
    found: dict[str, float] = {}
    studies = sorted(results.config.studies, key=lambda study: not study.reference)
    for study in studies:
        for name, value in {**study.reference, **fixed_values(study, results)}.items():
            found.setdefault(name, value)
    for model in models:
        middle = np.mean(model.bounds(), axis=0)
        for name, value in zip(model.fitted.factors, middle, strict=True):
            found.setdefault(name, float(value))
    return {name: found[name] for name in INPUTS if name in found}
