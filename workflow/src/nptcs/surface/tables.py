"""Fitted surfaces as the tables of coefficients and of quality."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from nptcs.surface.fit import Surface
from nptcs.tables.surface import SurfaceQuality, SurfaceTable


def surface_table(
    surfaces: Mapping[str, Surface], published: Mapping[tuple[int, ...], float]
) -> pd.DataFrame:
    """Write the surfaces of a study, by solver, as `SurfaceTable`.

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


def quality_table(study: str, quality: Mapping[str, Mapping[str, float]]) -> pd.DataFrame:
    """Write the quality of a study's surfaces, by solver, as `SurfaceQuality`."""
    rows = [
        {
            "study": study,
            "solver": solver,
            "response": "vertical_stiffness_n_per_mm",
            **numbers,
            "rule": "ordinary least squares in coded units, solved cases only",
        }
        for solver, numbers in quality.items()
    ]
    return pd.DataFrame(rows, columns=list(SurfaceQuality.to_schema().columns))
