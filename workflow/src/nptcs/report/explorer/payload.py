"""What the explorer computes from: stored surfaces, their cases, and their known errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from nptcs.arrays import Array
from nptcs.config.studies.goals import GoalKind
from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.explorer.models import CONFIDENCE, plain_surface
from nptcs.report.explorer.ring import ring_payload
from nptcs.report.explorer.shared import Plain, share_covariances
from nptcs.report.explorer.words import page_words
from nptcs.report.tables.response_titles import RESPONSE_TITLES
from nptcs.report.words.surfaces import surface_words
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.tables.published.stiffness import DIFFERENCE, StiffnessAgainstPublished
from nptcs.tables.status import Status
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.tyre_responses import TyreResponses

KEYS = {
    "spacing_mm": "s",
    "thickness_mm": "t",
    "angle_deg": "a",
    "shear_band_c10_mpa": "tc",
    "spoke_c10_mpa": "sc",
}
"""Keys of the factors in the address of the page, in the order of the sliders."""

LABELS = {
    "spacing_mm": ("plate spacing S", "mm"),
    "thickness_mm": ("plate thickness T", "mm"),
    "angle_deg": ("fibre angle A", "deg"),
    "shear_band_c10_mpa": ("shear band C10 (T-C)", "MPa"),
    "spoke_c10_mpa": ("spoke C10 (S-C)", "MPa"),
}
"""Label and unit of a factor that no study with surfaces varies."""

WANTED = ("contact_length", "plate_largest_mises", "plate_mass")
"""Responses that a reader looks for besides the stiffness: those not fitted are named."""

SECANT = "secant_stiffness"


ROUNDING = 1e-12
"""Left-out error, as a share of the largest response, up to which it is only rounding."""


def explorer_payload(results: Results) -> Plain:
    """Collect all that the explorer of a run needs, as plain values.

    Parameters
    ----------
    results : Results
        Everything that a run has made, including its stored surfaces.

    Returns
    -------
    dict
        ``studies`` is empty where no study has a surface.
    """
    config = results.config
    tyre = config.tyre
    studies = [
        _study(results, study, results.models[study.name])
        for study in config.studies
        if study.name in results.models and results.models[study.name].surfaces
    ]
    covariances: list[list[float]] = []
    share_covariances(studies, covariances)
    return {
        "confidence": CONFIDENCE,
        "factors": _factors(config.studies),
        "tyre": {"width_mm": tyre.tread_width_mm, "plate_width_mm": tyre.plate_width_mm},
        "studies": studies,
        "models": {
            fitted.name: surface_words(fitted.name)
            for registry in results.models.values()
            for fitted in registry.surfaces
        },
        "covariances": covariances,
        "ring": ring_payload(results),
        "words": page_words(),
    }


def _factors(studies: tuple[Study, ...]) -> list[Plain]:
    """Describe the five design variables, then any others that studies have."""
    found = {
        name: {"name": name, "key": key, "label": tr(LABELS[name][0]), "unit": LABELS[name][1]}
        for name, key in KEYS.items()
    }
    for study in studies:
        for factor in study.factors:
            key = found.get(factor.name, {"key": factor.name})["key"]
            found[factor.name] = {
                "name": factor.name,
                "key": key,
                "label": tr(factor.label),
                "unit": factor.unit,
            }
    return list(found.values())


def _study(results: Results, study: Study, registry: SurfaceRegistry) -> Plain:
    solvers = list(dict.fromkeys(fitted.solver for fitted in registry.surfaces))
    return {
        "name": study.name,
        "title": tr(study.title),
        "load_n": study.load_n,
        "factors": [factor.name for factor in study.factors],
        "fixed": _fixed(results, study),
        "reference": dict(study.reference),
        "band": _band(study),
        "steps": _steps(study),
        "solvers": [_solver(results, study, registry, solver) for solver in solvers],
    }


def _fixed(results: Results, study: Study) -> dict[str, float]:
    """Values that all cases of a study share, rubbers as their C10."""
    cases = results.table(Cases)
    rows = cases[cases["study"] == study.name]
    numbers = {name: value for name, value in study.fixed.items() if isinstance(value, float)}
    held = {name: rows[name].dropna() for name in study.fixed if name in rows}
    return numbers | {name: float(found.iloc[0]) for name, found in held.items() if len(found)}


def _band(study: Study) -> list[float] | None:
    """Return the target of the study's first decision about its stiffness at its load."""
    for decision in study.decisions:
        for goal in decision.goals():
            at_load = goal.response.at in ("", f"{study.load_n:g} N")
            if goal.kind is GoalKind.TARGET and goal.response.name == SECANT and at_load:
                return [float(limit) for limit in goal.limits]
    return None


def _steps(study: Study) -> dict[str, float]:
    """Return the steps of values that can be made, as the study's decisions state them."""
    return {name: step for decision in study.decisions for name, step in decision.steps.items()}


def _solver(results: Results, study: Study, registry: SurfaceRegistry, solver: str) -> Plain:
    facts = results.solvers[solver]
    names = [factor.name for factor in study.factors]
    by_response: dict[Response, list[FittedSurface]] = {}
    for fitted in registry.surfaces:
        if fitted.solver == solver:
            by_response.setdefault(_as_secant(fitted.response, study), []).append(fitted)
    points: list[Array] = []
    responses = [
        _response(response, surfaces, names, points) for response, surfaces in _ordered(by_response)
    ]
    fitted_names = {response.name for response in by_response}
    return {
        "name": solver,
        "about": tr(facts.about),
        "synthetic": results.study_is_synthetic(study, solver),
        "whole_plates": facts.whole_plates,
        "bias": _bias(results, study, solver),
        "points": [block.tolist() for block in points],
        "responses": responses,
        "constants": list(_constants(results, study, solver, fitted_names)),
    }


def _as_secant(response: Response, study: Study) -> Response:
    """Name the study's own response as what it is: the secant stiffness at its load."""
    return Response.stiffness(study.load_n) if response.name == STIFFNESS else response


def _ordered(
    by_response: Mapping[Response, list[FittedSurface]],
) -> list[tuple[Response, list[FittedSurface]]]:
    """Secant stiffness by load first, then the others in the order of the configuration."""
    return sorted(
        by_response.items(),
        key=lambda item: (
            item[0].name != SECANT,
            (item[0].load_n or 0.0) * (item[0].name == SECANT),
        ),
    )


def _response(
    response: Response, surfaces: list[FittedSurface], names: list[str], points: list[Array]
) -> Plain:
    """Describe a response with its surfaces; its cases are kept once for all that share them."""
    first = surfaces[0]
    columns = [first.factors.index(name) for name in names]
    x = first.surface.x[:, columns]
    place = next((i for i, kept in enumerate(points) if np.array_equal(kept, x)), len(points))
    if place == len(points):
        points.append(x)
    return {
        "name": response.name,
        "at": response.at,
        "load_n": response.load_n,
        "unit": "" if response.unit == "1" else response.unit,
        "title": tr(RESPONSE_TITLES[response.name]),
        "points": place,
        "values": first.surface.y.tolist(),
        "not_assessed": first.not_assessed,
        "surfaces": [_surface(fitted) for fitted in surfaces],
    }


def _surface(fitted: FittedSurface) -> Plain:
    return {
        "name": fitted.name,
        "outside": fitted.surface.outside.value,
        "rms": _left_out(fitted),
        "realised": list(fitted.realised),
        "plain": plain_surface(fitted.surface),
    }


def _left_out(fitted: FittedSurface) -> float | None:
    """Return the left-out error; zero if it is only rounding, None where it is not known."""
    if not np.isfinite(fitted.left_out_rms):
        return None
    rounding = ROUNDING * float(np.abs(fitted.surface.y).max())
    return float(fitted.left_out_rms) if fitted.left_out_rms > rounding else 0.0


def _bias(results: Results, study: Study, solver: str) -> Plain | None:
    """Differences from the published stiffness of cases on which no solver was calibrated."""
    table = results.table(StiffnessAgainstPublished)
    rows = table[
        (table["study"] == study.name)
        & (table["solver"] == solver)
        & ~table["used_for_calibration"].astype(bool)
    ]
    found = rows[DIFFERENCE].dropna()
    if found.empty:
        return None
    return {
        "cases": len(found),
        "mean_percent": float(found.mean()),
        "low_percent": float(found.min()),
        "high_percent": float(found.max()),
    }


def _constants(results: Results, study: Study, solver: str, fitted: set[str]) -> Iterator[Plain]:
    """Responses that readers look for and that have no surface: their constant value, or why."""
    table = results.table(TyreResponses)
    rows = table[(table["study"] == study.name) & (table["solver"] == solver)]
    for name in WANTED:
        if name in fitted:
            continue
        known = rows[(rows["response"] == name) & (rows["status"] == Status.OK.value)]
        values = known["value"].to_numpy(float)
        same = bool(len(values)) and bool(np.ptp(values) <= 1e-12 * np.abs(values).max())
        yield {
            "name": name,
            "title": tr(RESPONSE_TITLES[name]),
            "unit": str(known["unit"].iloc[0]) if len(known) else "",
            "solved": len(known),
            "value": float(values[0]) if same else None,
        }
