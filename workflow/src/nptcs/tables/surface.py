"""Contracts of the response-surface tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.surface.fit import Surface
from nptcs.surface.terms import parse


class SurfaceTable(pa.DataFrameModel):
    """``STUDY_surface.csv``: coefficients of the response surfaces, a row a solver and term."""

    solver: Series[str]
    term: Series[str]
    coefficient_natural: Series[float] = pa.Field(description="N/mm per unit of the term")
    coefficient_coded: Series[float] = pa.Field(description="N/mm, factors scaled to [-1, 1]")
    standard_error: Series[float] = pa.Field(ge=0, description="Of coefficient_natural")
    standard_error_coded: Series[float] = pa.Field(ge=0)
    published_coefficient: Series[float] = pa.Field(nullable=True, description="As printed")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceQuality(pa.DataFrameModel):
    """``surface_quality.csv``: how well each surface follows its cases."""

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    points: Series[int] = pa.Field(gt=0)
    terms: Series[int] = pa.Field(gt=0)
    r_squared: Series[float] = pa.Field(le=1)
    adjusted_r_squared: Series[float] = pa.Field(le=1)
    leave_one_out_r_squared: Series[float] = pa.Field(le=1)
    ten_fold_r_squared: Series[float] = pa.Field(le=1)
    residual_sd: Series[float] = pa.Field(ge=0, description="N/mm, √(SSE / (points - terms))")
    largest_residual: Series[float] = pa.Field(ge=0, description="N/mm")
    condition_number_natural: Series[float] = pa.Field(ge=1)
    condition_number_coded: Series[float] = pa.Field(ge=1)
    rule: Series[str] = pa.Field(description="How it was fitted")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


def surface_table(
    surfaces: Mapping[str, Surface], published: Mapping[tuple[int, ...], float]
) -> pd.DataFrame:
    """Lay the surfaces of a study, by solver, out as `SurfaceTable`.

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
    """Lay the quality of a study's surfaces, by solver, out as `SurfaceQuality`."""
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


def by_powers(printed: pd.DataFrame, factors: Sequence[str]) -> dict[tuple[int, ...], float]:
    """Map the powers of each printed term (`PublishedCoefficients`) to its coefficient."""
    powers = parse(list(printed["term"]), factors).exponents
    return dict(zip(powers, printed["coefficient"], strict=True))
