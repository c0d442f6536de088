"""Sobol indices and main effects of all surfaces of a run, as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.config.studies.sensitivity import Sensitivity
from nptcs.errors import InputError
from nptcs.surface.response_surface import ResponseSurface, box
from nptcs.surface.sensitivity.sobol import (
    FactorDistribution,
    Indices,
    factor_distribution,
    main_effect,
    sobol_indices,
)
from nptcs.surface.sensitivity.ties import near_ties
from nptcs.tables.analysis.sobol import MainEffects, SobolIndices
from nptcs.tables.problems import problems_table

Models = Mapping[str, Mapping[str, Mapping[str, ResponseSurface]]]
"""Surfaces by study, solver and name."""


@dataclass(frozen=True)
class VarianceShares:
    """What `variance_shares` makes.

    Parameters
    ----------
    indices, effects : DataFrame
        `SobolIndices` and `MainEffects`.
    problems : DataFrame
        `nptcs.tables.problems.Problems`: surfaces without indices.
    """

    indices: pd.DataFrame
    effects: pd.DataFrame
    problems: pd.DataFrame


def variance_shares(
    models: Models, failed: Mapping[tuple[str, str], int], settings: Sensitivity
) -> VarianceShares:
    """Divide the variance of every surface among its factors.

    Parameters
    ----------
    models : mapping
        Surfaces by study, solver and name.
    failed : mapping of (study, solver) to int
        Cases without a result.
    settings : Sensitivity
        Sampling, distributions and what counts as a near tie.
    """
    indices: list[dict[str, object]] = []
    effects: list[pd.DataFrame] = []
    problems = []
    for key, surface in _each(models):
        for name in ("uniform", "given") if _given(surface, settings) else ("uniform",):
            about = {**key, "inputs": name}
            try:
                inputs = _inputs(surface, settings if name == "given" else None)
                found = sobol_indices(surface.predict, inputs, settings.sobol)
            except InputError as error:
                place = f"{key['solver']}, {key['surface']}"
                problems.append(("surface", key["study"], place, "refused", str(error)))
                continue
            cases = {"samples": found.samples, "cases": len(surface.y)}
            cases["failed_cases"] = failed[key["study"], key["solver"]]
            indices += [{**about, **row, **cases} for row in _rows(found, inputs)]
            effects += _effects(about, surface, inputs, settings)
    table = pd.DataFrame(indices, columns=list(SobolIndices.to_schema().columns))
    return VarianceShares(
        _with_ties(table, settings.near_tie_ratio),
        pd.concat(effects)
        if effects
        else pd.DataFrame(columns=list(MainEffects.to_schema().columns)),
        problems_table(problems),
    )


def _each(models: Models) -> Iterator[tuple[dict[str, str], ResponseSurface]]:
    for study, by_solver in models.items():
        for solver, named in by_solver.items():
            for name, surface in named.items():
                yield {"study": study, "solver": solver, "surface": name}, surface


def _given(surface: ResponseSurface, settings: Sensitivity) -> bool:
    return any(factor in settings.distributions for factor in surface.factors)


def _inputs(
    surface: ResponseSurface, settings: Sensitivity | None
) -> dict[str, FactorDistribution]:
    """How each factor is sampled; without settings uniform over the box."""  # noqa: D401
    distributions = settings.distributions if settings is not None else {}
    lower, upper = box(surface.x)
    return {
        factor: factor_distribution(factor, float(low), float(high), distributions.get(factor))
        for factor, low, high in zip(surface.factors, lower, upper, strict=True)
    }


def _rows(found: Indices, inputs: Mapping[str, FactorDistribution]) -> Iterator[dict[str, object]]:
    """One row per factor, then one per pair."""  # noqa: D401
    ranks = (-found.total).argsort().argsort() + 1
    for axis, (factor, given) in enumerate(inputs.items()):
        yield {
            "factor": factor,
            "partner": "",
            "distribution": given.words,
            "cut_percent": given.cut_percent,
            "index": found.first[axis],
            "index_confidence": found.first_confidence[axis],
            "total": found.total[axis],
            "total_confidence": found.total_confidence[axis],
            "effect_n_per_mm": np.sqrt(max(found.total[axis], 0.0)) * found.sd,
            "rank": ranks[axis],
        }
    names = list(inputs)
    for row, column in zip(*np.triu_indices(len(names), 1), strict=True):
        yield {
            "factor": names[row],
            "partner": names[column],
            "distribution": "",
            "index": found.second[row, column],
            "index_confidence": found.second_confidence[row, column],
        }


def _effects(
    about: Mapping[str, str],
    surface: ResponseSurface,
    inputs: Mapping[str, FactorDistribution],
    settings: Sensitivity,
) -> list[pd.DataFrame]:
    tables = []
    for axis, factor in enumerate(surface.factors):
        values, effect = main_effect(surface.predict, list(inputs.values()), axis, settings.sobol)
        columns = {"factor": factor, "value": values, "effect_n_per_mm": effect}
        tables.append(pd.DataFrame({**about, **columns}))
    return tables


def _with_ties(table: pd.DataFrame, ratio: float) -> pd.DataFrame:
    """Say which factors of a study are near ties, over all its solvers and surfaces."""
    table = table.assign(near_tie_with="")
    alone = table["partner"] == ""
    keys = ["solver", "surface"]
    for (study, name), rows in table[alone].groupby(["study", "inputs"]):
        of_study = alone & (table["study"] == study) & (table["inputs"] == name)
        ties = near_ties(rows, keys, "factor", "effect_n_per_mm", ratio)
        table.loc[of_study, "near_tie_with"] = ties
    return table[list(SobolIndices.to_schema().columns)]
