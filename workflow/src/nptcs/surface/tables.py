"""Fitted surfaces as the tables of coefficients, of quality and of their comparison."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from nptcs.surface.comparison import (
    MOST_REFITS,
    LevelError,
    directions,
    leave_one_level_out,
    leave_one_out,
)
from nptcs.surface.fit import Surface
from nptcs.surface.gaussian_process import GaussianProcess
from nptcs.surface.lamination import Lamination
from nptcs.surface.linked import LinkedSurface
from nptcs.surface.quality import assess
from nptcs.surface.response_surface import ResponseSurface, box
from nptcs.surface.study import RESPONSE, StudySurfaces
from nptcs.tables.surface import SurfaceByFactor, SurfaceComparison, SurfaceQuality, SurfaceTable

COMPARISON_RULE = (
    "terms or form kept, all parameters and hyperparameters fitted anew without each case or level"
)

NOT_LEFT_OUT = (
    f"levels left out; no case left out alone: there are more than {MOST_REFITS:,} of them"
)


def surface_table(
    surfaces: Mapping[str, Surface], published: Mapping[tuple[int, ...], float]
) -> pd.DataFrame:
    """Make the `SurfaceTable` of a study's polynomials, by solver.

    `published` maps the powers of a term to the coefficient that the paper prints.
    """
    rows = [
        row
        for solver, surface in surfaces.items()
        for row in zip(
            [solver] * len(surface.polynomial),
            surface.polynomial.names,
            surface.coefficients_natural,
            surface.coefficients_coded,
            surface.natural_standard_errors(),
            surface.coded_standard_errors(),
            [published.get(powers, np.nan) for powers in surface.polynomial.exponents],
            strict=True,
        )
    ]
    return pd.DataFrame(rows, columns=list(SurfaceTable.to_schema().columns))


def quality_table(study: str, done: StudySurfaces) -> pd.DataFrame:
    """Make the `SurfaceQuality` of a study's polynomials, one row per solver."""
    rows = [
        {
            "study": study,
            "solver": solver,
            "response": RESPONSE,
            "failed_cases": done.solved[solver].failed,
            "same_cases": done.solved[solver].same,
            "realised_factors": ", ".join(done.solved[solver].changed),
            **assess(surface),
            "rule": "ordinary least squares in coded units, solved cases only",
        }
        for solver, surface in done.polynomials.items()
    ]
    return pd.DataFrame(rows, columns=list(SurfaceQuality.to_schema().columns))


def comparison_tables(study: str, done: StudySurfaces) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Make the `SurfaceComparison` and the `SurfaceByFactor` of all surfaces of a study."""
    comparison, by_factor = [], []
    for solver, named in done.models.items():
        for name, surface in named.items():
            key = {"study": study, "solver": solver, "surface": name}
            axes = range(len(surface.factors))
            levels = [leave_one_level_out(surface, axis) for axis in axes]
            cpu_s = done.fit_cpu_s[solver, name]
            comparison.append({**key, **_compared(surface, levels), "fit_cpu_s": cpu_s})
            by_factor += [
                {**key, **row} for row in _factors(surface, levels, done.solved[solver].changed)
            ]
    return (
        pd.DataFrame(comparison, columns=list(SurfaceComparison.to_schema().columns)),
        pd.DataFrame(by_factor, columns=list(SurfaceByFactor.to_schema().columns)),
    )


def form_of(surface: ResponseSurface) -> str:
    """Say of what a surface is made: its terms, shape parameters or hyperparameters."""
    if isinstance(surface, Surface):
        return " + ".join(surface.polynomial.names)
    if isinstance(surface, LinkedSurface):
        return f"{surface.link}: " + form_of(surface.inner)
    if isinstance(surface, Lamination):
        return "c0, c1, c2, " + ", ".join(surface.shape)
    if isinstance(surface, GaussianProcess):
        sizes = ", ".join(f"{value:.3g}" for value in np.exp(surface.theta))
        mean = "constant" if surface.mean is None else form_of(surface.mean)
        return f"Matérn 5/2, variance and lengths in half ranges {sizes}; mean: {mean}"
    raise TypeError(f"not a kind of surface: {type(surface).__name__}")


def _compared(surface: ResponseSurface, levels: list[LevelError]) -> dict[str, object]:
    """Fit, leave-one-out and level errors of one surface."""
    residual = surface.y - surface.predict(surface.x)
    left_out = leave_one_out(surface)
    errors = left_out.error[np.isfinite(left_out.error)]
    worst = [level.largest for level in levels if np.isfinite(level.largest)]
    names = zip(surface.factors, levels, strict=True)
    return {
        "response": RESPONSE,
        "points": len(surface.y),
        "coefficients": surface.coefficients,
        "form": form_of(surface),
        "r_squared": 1 - float(residual @ residual / np.sum((surface.y - surface.y.mean()) ** 2)),
        "largest_residual": float(np.abs(residual).max()),
        "leave_one_out_largest": float(np.abs(errors).max()) if len(errors) else np.nan,
        "leave_one_out_rms": float(np.sqrt(np.mean(errors**2))) if len(errors) else np.nan,
        "leave_one_out_not_fitted": len(surface.y) - len(errors) if left_out.assessed else 0,
        "coverage_percent": 100 * left_out.covered.sum() / len(errors) if len(errors) else np.nan,
        "level_out_largest": max(worst, default=np.nan),
        "level_out_not_fitted": ", ".join(name for name, level in names if level.refused),
        "outside_the_box": surface.outside.value,
        "leave_one_out_cpu_s": left_out.cpu_s,
        "rule": COMPARISON_RULE if left_out.assessed else NOT_LEFT_OUT,
    }


def _factors(
    surface: ResponseSurface, levels: list[LevelError], changed: tuple[str, ...]
) -> list[dict[str, object]]:
    """One row per factor: range of validity, level errors and direction."""
    lower, upper = box(surface.x)
    return [
        {
            "factor": factor,
            "values_used": "realised" if factor in changed else "given",
            "lowest": lower[axis],
            "highest": upper[axis],
            "level_out_largest": levels[axis].largest,
            "not_fitted": levels[axis].refused,
            "rising_percent": 100 * rising,
            "falling_percent": 100 * falling,
            "monotone": rising == 0 or falling == 0,
        }
        for axis, (factor, (rising, falling)) in enumerate(
            zip(surface.factors, directions(surface), strict=True)
        )
    ]
