"""Diagnostics of all polynomials of a run, as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.studies.surface import Choice
from nptcs.surface.diagnostics.anova import MEANING, anova, noise_of_replicates
from nptcs.surface.diagnostics.influence import influence, term_tests
from nptcs.surface.diagnostics.stationary import Direction, ridge_path, stationary_points
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.selection import backward_steps
from nptcs.surface.response_surface import inside_box
from nptcs.tables.analysis.diagnostics import (
    SurfaceAnova,
    SurfaceInfluence,
    SurfaceSelection,
    SurfaceStationary,
    SurfaceTests,
)

Surfaces = Mapping[str, Mapping[str, Surface]]
"""Polynomials by study and solver."""

RADII = tuple(np.linspace(0.0, 1.0, 11))
"""Radii of the ridge paths in coded units."""

DIRECTIONS: tuple[Direction, ...] = ("maximum", "minimum")
CRITERIA: tuple[Choice, ...] = ("aicc", "press")


def tests_table(surfaces: Surfaces) -> pd.DataFrame:
    """Make `SurfaceTests`."""
    tables = []
    for key, surface in _each(surfaces):
        tests = term_tests(surface)
        columns = {
            "term": surface.polynomial.names,
            "coefficient_coded": surface.coefficients_coded,
            "t_value": tests.t_value,
            "p_value": tests.p_value,
            "confidence_low": tests.low,
            "confidence_high": tests.high,
            "vif": tests.vif,
        }
        tables.append(pd.DataFrame({**key, **columns, **_noise(surface)}))
    return _joined(tables, SurfaceTests)


def anova_table(surfaces: Surfaces) -> pd.DataFrame:
    """Make `SurfaceAnova`."""
    rows = [
        {
            **key,
            "source": row.source,
            "kind": row.kind,
            "df": row.df,
            "sequential_ss": row.sequential,
            "partial_ss": row.partial,
            "mean_square": row.sequential / row.df if row.df else np.nan,
            "f_value": row.f_value,
            "p_value": row.p_value,
            **_noise(surface),
        }
        for key, surface in _each(surfaces)
        for row in anova(surface)
    ]
    return pd.DataFrame(rows, columns=list(SurfaceAnova.to_schema().columns))


def influence_table(surfaces: Surfaces) -> pd.DataFrame:
    """Make `SurfaceInfluence`."""
    tables = []
    for key, surface in _each(surfaces):
        found = influence(surface)
        columns = {
            "point": [_point(surface, point) for point in surface.x],
            "response": surface.y,
            "residual": found.residual,
            "leverage": found.leverage,
            "left_out_residual": found.left_out,
            "standardised_residual": found.standardised,
            "studentised_residual": found.studentised,
            "cook_distance": found.cook,
        }
        tables.append(pd.DataFrame({**key, **columns}))
    return _joined(tables, SurfaceInfluence)


def stationary_table(surfaces: Surfaces) -> pd.DataFrame:
    """Make `SurfaceStationary`: one row per point and factor."""
    rows = []
    for key, surface in _each(surfaces):
        centre, half = surface.coding()
        points = [
            ("stationary point", float(np.linalg.norm((found.point - centre) / half)),
             found.point, found.response, found.kind,
             ", ".join(f"{value:.6g}" for value in found.curvatures))
            for found in stationary_points(surface)
        ]  # fmt: skip
        points += [
            (f"path of the {direction}", radius, point, response, "", "")
            for direction in DIRECTIONS
            for radius, point, response in ridge_path(surface, direction, RADII)
        ]
        rows += [row for found in _numbered(points) for row in _by_factor(key, surface, *found)]
    return pd.DataFrame(rows, columns=list(SurfaceStationary.to_schema().columns))


def selection_table(surfaces: Surfaces) -> pd.DataFrame:
    """Make `SurfaceSelection`: the order in which terms are dropped by AICc and by PRESS."""
    rows = []
    for key, surface in _each(surfaces):
        for criterion in CRITERIA:
            steps = backward_steps(
                surface.polynomial, surface.x, surface.y, criterion, surface.through_origin
            )
            best = min(steps, key=lambda s: s.press if criterion == "press" else s.aicc)
            rows += [
                {
                    **key,
                    "criterion": criterion,
                    "step": number,
                    "dropped": step.dropped,
                    "terms": len(step.exponents),
                    "aicc": step.aicc,
                    "press": step.press,
                    "chosen": step is best,
                }
                for number, step in enumerate(steps)
            ]
    return pd.DataFrame(rows, columns=list(SurfaceSelection.to_schema().columns))


def _each(surfaces: Surfaces) -> Iterator[tuple[dict[str, str], Surface]]:
    for study, by_solver in surfaces.items():
        for solver, surface in by_solver.items():
            yield {"study": study, "solver": solver}, surface


def _noise(surface: Surface) -> dict[str, str]:
    noise = noise_of_replicates(surface)
    return {"noise": noise.value, "p_meaning": MEANING[noise]}


def _joined(tables: list[pd.DataFrame], contract: Any) -> pd.DataFrame:
    columns = list(contract.to_schema().columns)
    return pd.concat(tables)[columns] if tables else pd.DataFrame(columns=columns)


def _point(surface: Surface, point: Array) -> str:
    values = zip(surface.factors, point, strict=True)
    return ", ".join(f"{name} {value:.6g}" for name, value in values)


def _numbered(points: list[tuple[Any, ...]]) -> Iterator[tuple[Any, ...]]:
    """Add to each point its number within its path."""
    counts: dict[str, int] = {}
    for path, *rest in points:
        counts[path] = counts.get(path, 0) + 1
        yield (path, counts[path], *rest)


def _by_factor(
    key: Mapping[str, str],
    surface: Surface,
    path: str,
    number: int,
    radius: float,
    point: Array,
    response: float,
    kind: str,
    curvatures: str,
) -> list[dict[str, object]]:
    inside = bool(inside_box(surface, point[None, :])[0])
    return [
        {
            **key,
            "path": path,
            "number": number,
            "radius_coded": radius,
            "factor": factor,
            "value": value,
            "response": response,
            "kind": kind,
            "curvatures": curvatures,
            "inside_box": inside,
        }
        for factor, value in zip(surface.factors, point, strict=True)
    ]
