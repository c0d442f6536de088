"""Surfaces of every response as tables: how they predict, and what each factor does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pandera.pandas as pa
from scipy.stats import qmc

from nptcs.arrays import Array
from nptcs.config.studies.sensitivity import Sensitivity
from nptcs.errors import InputError
from nptcs.surface.registry import FittedSurface, SurfaceRegistry
from nptcs.surface.response_surface import box
from nptcs.surface.sensitivity.sobol import factor_distribution, sobol_indices
from nptcs.surface.sensitivity.sobol_tables import variance_shares
from nptcs.surface.sensitivity.ties import near_ties
from nptcs.surface.study import RESPONSE, StudySurfaces, SurfaceFit
from nptcs.surface.tables import fit_measures
from nptcs.tables.analysis.response_surfaces import ResponseImpact, ResponseSurfaces
from nptcs.tables.analysis.sobol import MainEffects, SobolIndices
from nptcs.tables.problems import Problems, problems_table

GRADIENT_POINTS = 4096
"""Points of a scrambled Sobol sequence over which slopes are averaged."""

STEP = 1e-3
"""Half the distance of the difference that gives a slope, in ranges of the factor."""


def response_surfaces(done: StudySurfaces) -> pd.DataFrame:
    """Make the `ResponseSurfaces` of a study, its stiffness first."""
    rows = [_row(done, fit) for fit in done.fits]
    return pd.DataFrame(rows, columns=list(ResponseSurfaces.to_schema().columns))


def _row(done: StudySurfaces, fit: SurfaceFit) -> dict[str, object]:
    surface, left_out = fit.surface, fit.left_out
    with np.errstate(divide="ignore"):
        percent = np.abs(100 * left_out.error / surface.y)
    percent = percent[np.isfinite(percent)]
    return {
        "study": done.study,
        "solver": fit.solver,
        "response": fit.response.name,
        "at": fit.response.at,
        "unit": fit.response.unit,
        "surface": fit.name,
        **fit_measures(surface),
        "not_assessed_cases": fit.not_assessed,
        "failed_cases": done.solved[fit.solver].failed,
        "smallest": surface.y.min(),
        "largest": surface.y.max(),
        "left_out": left_out.what,
        "left_out_largest": left_out.largest,
        "left_out_rms": left_out.rms,
        "left_out_largest_percent": percent.max() if len(percent) else np.nan,
        "left_out_rms_percent": np.sqrt(np.mean(percent**2)) if len(percent) else np.nan,
        "coverage_percent": left_out.coverage_percent,
        "outside_the_box": surface.outside.value,
    }


@dataclass(frozen=True)
class ResponseImpacts:
    """`ResponseImpact` of all studies, and the surfaces without one (`Problems`)."""

    table: pd.DataFrame
    problems: pd.DataFrame


def response_impacts(
    registries: Sequence[SurfaceRegistry], settings: Sensitivity
) -> ResponseImpacts:
    """Rank the factors of every response of every study.

    Parameters
    ----------
    registries : sequence of SurfaceRegistry
        One per study.
    settings : Sensitivity
        Sampling of the Sobol indices, and what counts as a near tie.
    """
    rows: list[dict[str, object]] = []
    problems = []
    for registry in registries:
        for fitted in _best(registry):
            try:
                rows += _ranked(fitted, settings)
            except InputError as error:
                about = f"{fitted.solver}, {fitted.response}, {fitted.name}"
                problems.append(("surface", registry.study, about, "refused", str(error)))
    table = pd.DataFrame(rows, columns=list(ResponseImpact.to_schema().columns))
    for _, part in table.groupby(["study", "response", "at"]):
        ties = near_ties(part, ["solver"], "factor", "effect", settings.near_tie_ratio)
        table.loc[part.index, "near_tie_with"] = ties
    return ResponseImpacts(table, problems_table(problems))


def sensitivity_tables(
    registries: Mapping[str, SurfaceRegistry], quality: pd.DataFrame, settings: Sensitivity
) -> dict[str, tuple[pd.DataFrame, type[pa.DataFrameModel]]]:
    """Make the variance shares of the stiffness and the ranks of every response, with contracts.

    Parameters
    ----------
    registries : mapping of str to SurfaceRegistry
        By study.
    quality : DataFrame
        `nptcs.tables.analysis.surface.SurfaceQuality` of all studies.
    settings : Sensitivity

    Returns
    -------
    dict
        ``indices``, ``effects``, ``impacts`` and ``problems``.
    """
    surfaces = {study: registry.by_solver(RESPONSE) for study, registry in registries.items()}
    keys = zip(quality["study"], quality["solver"], strict=True)
    failed = dict(zip(keys, quality["failed_cases"], strict=True))
    shares = variance_shares(surfaces, failed, settings)
    ranked = response_impacts(list(registries.values()), settings)
    return {
        "indices": (shares.indices, SobolIndices),
        "effects": (shares.effects, MainEffects),
        "impacts": (ranked.table, ResponseImpact),
        "problems": (pd.concat([shares.problems, ranked.problems]), Problems),
    }


def _best(registry: SurfaceRegistry) -> Iterator[FittedSurface]:
    """Of each response and solver, the surface that predicts left-out cases best."""
    for response in registry.responses():
        for solver in dict.fromkeys(s.solver for s in registry.of_response(response)):
            yield registry.find(response, solver)


def _ranked(fitted: FittedSurface, settings: Sensitivity) -> list[dict[str, object]]:
    surface = fitted.surface
    inputs = {
        name: factor_distribution(name, *limits, None) for name, limits in fitted.box().items()
    }
    found = sobol_indices(surface.predict, inputs, settings.sobol, interactions=False)
    mean_size, mean = mean_slopes(fitted, settings.sobol.seed)
    ranks = (-found.total).argsort().argsort() + 1
    return [
        {
            "study": fitted.study,
            "solver": fitted.solver,
            "response": fitted.response.name,
            "at": fitted.response.at,
            "unit": fitted.response.unit,
            "surface": fitted.name,
            "factor": factor,
            "lowest": limits.low,
            "highest": limits.high,
            "impact": mean_size[axis],
            "signed_impact": mean[axis],
            "first_index": found.first[axis],
            "total_index": found.total[axis],
            "total_confidence": found.total_confidence[axis],
            "effect": np.sqrt(max(found.total[axis], 0.0)) * found.sd,
            "rank": ranks[axis],
            "near_tie_with": "",
            "cases": len(surface.y),
            "not_assessed_cases": fitted.not_assessed,
            "failed_cases": fitted.failed,
        }
        for axis, (factor, limits) in enumerate(inputs.items())
    ]


def mean_slopes(fitted: FittedSurface, seed: int) -> tuple[Array, Array]:
    """Mean of |∂f/∂x| and of ∂f/∂x over the box, each by the factor's range, of shape (n,).

    Central differences at the points of a scrambled Sobol sequence; near the box's faces the
    points are moved inwards by the step.
    """
    lower, upper = box(fitted.surface.x)
    span = upper - lower
    points = qmc.Sobol(len(lower), rng=np.random.default_rng(seed)).random(GRADIENT_POINTS)
    points = lower + (STEP + (1 - 2 * STEP) * points) * span
    slopes = []
    for axis in range(len(lower)):
        step = np.zeros(len(lower))
        step[axis] = STEP * span[axis]
        above, below = (fitted.surface.predict(points + side * step) for side in (1, -1))
        slopes.append((above - below) / (2 * STEP))
    found = np.array(slopes)
    return np.abs(found).mean(axis=1), found.mean(axis=1)
