"""Fitted surfaces as the tables of coefficients, of quality and of their comparison."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from nptcs.surface.diagnostics.comparison import (
    MOST_REFITS,
    LevelError,
    directions,
    leave_one_level_out,
)
from nptcs.surface.diagnostics.quality import assess
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.gaussian_process import GaussianProcess
from nptcs.surface.kinds.lamination import Lamination
from nptcs.surface.kinds.linked import LinkedSurface
from nptcs.surface.kinds.spoke_process import SpokeProcess
from nptcs.surface.registry import STIFFNESS
from nptcs.surface.response_surface import ResponseSurface, box
from nptcs.surface.study import StudySurfaces, SurfaceFit
from nptcs.tables.analysis.surface import (
    SurfaceByFactor,
    SurfaceComparison,
    SurfaceQuality,
    SurfaceTable,
)

ALL_ANEW = (
    "terms or form kept, all parameters and hyperparameters fitted anew without each case or level"
)
COMPARISON_RULE: Mapping[type[ResponseSurface], str] = {
    Surface: ALL_ANEW,
    LinkedSurface: ALL_ANEW,
    Lamination: ALL_ANEW,
    GaussianProcess: ALL_ANEW,
    SpokeProcess: "hyperparameters kept, all else fitted anew without each spoke or level",
}

NOT_LEFT_OUT = (
    f"levels left out; no case left out alone: there are more than {MOST_REFITS:,} of them"
)


def surface_table(
    surfaces: Mapping[str, Surface], published: Mapping[tuple[int, ...], float]
) -> pd.DataFrame:
    """Make the `SurfaceTable` of a study's polynomials, by solver.

    `published` maps the powers of a term to the coefficient published in the paper.
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


def quality_table(done: StudySurfaces) -> pd.DataFrame:
    """Make the `SurfaceQuality` of a study's polynomials, one row per solver."""
    rows = [
        {
            "study": done.study,
            "solver": solver,
            "response": STIFFNESS,
            "failed_cases": done.solved[solver].failed,
            "same_cases": done.solved[solver].same,
            "realised_factors": ", ".join(done.solved[solver].changed),
            **assess(surface),
            "rule": "ordinary least squares in coded units, solved cases only",
        }
        for solver, surface in done.polynomials.items()
    ]
    return pd.DataFrame(rows, columns=list(SurfaceQuality.to_schema().columns))


def comparison_tables(done: StudySurfaces) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Make the `SurfaceComparison` and the `SurfaceByFactor` of all surfaces of a study."""
    comparison, by_factor = [], []
    for fit in done.of_stiffness():
        key = {"study": done.study, "solver": fit.solver, "surface": fit.name}
        axes = range(len(fit.surface.factors))
        levels = [leave_one_level_out(fit.surface, axis) for axis in axes]
        comparison.append({**key, **_compared(fit, levels)})
        changed = done.solved[fit.solver].changed
        by_factor += [{**key, **row} for row in _factors(fit.surface, levels, changed)]
    return (
        pd.DataFrame(comparison, columns=list(SurfaceComparison.to_schema().columns)),
        pd.DataFrame(by_factor, columns=list(SurfaceByFactor.to_schema().columns)),
    )


def form_of(surface: ResponseSurface) -> str:
    """Describe a surface by its terms, shape parameters or hyperparameters.

    Raises
    ------
    TypeError
        For anything that is not a kind of surface.
    """
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
    if isinstance(surface, SpokeProcess):
        response = "log of the response" if surface.logarithmic else "response"
        return (
            f"{response} on one spoke of degree {surface.degree} in the ring's logarithms; "
            f"{len(surface.theta)} processes over spokes"
        )
    raise TypeError(f"not a kind of surface: {type(surface).__name__}")


def _compared(fit: SurfaceFit, levels: list[LevelError]) -> dict[str, object]:
    """Fit, leave-one-out and level errors of one surface."""
    surface, left_out = fit.surface, fit.left_out
    worst = [level.largest for level in levels if np.isfinite(level.largest)]
    names = zip(surface.factors, levels, strict=True)
    return {
        "response": fit.response.name,
        **fit_measures(surface),
        "leave_one_out_largest": left_out.largest,
        "leave_one_out_rms": left_out.rms,
        "leave_one_out_not_fitted": (
            len(surface.y) - len(left_out.known) if left_out.assessed else 0
        ),
        "coverage_percent": left_out.coverage_percent,
        "level_out_largest": max(worst, default=np.nan),
        "level_out_not_fitted": ", ".join(name for name, level in names if level.refused),
        "outside_the_box": surface.outside.value,
        "fit_cpu_s": fit.cpu_s,
        "leave_one_out_cpu_s": left_out.cpu_s,
        "rule": COMPARISON_RULE[type(surface)] if left_out.assessed else NOT_LEFT_OUT,
    }


def fit_measures(surface: ResponseSurface) -> dict[str, object]:
    """How a surface follows its cases: points, coefficients, form, R² and the largest residual."""
    residual = surface.y - surface.predict(surface.x)
    return {
        "points": len(surface.y),
        "coefficients": surface.coefficients,
        "form": form_of(surface),
        "r_squared": 1 - float(residual @ residual / np.sum((surface.y - surface.y.mean()) ** 2)),
        "largest_residual": float(np.abs(residual).max()),
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
