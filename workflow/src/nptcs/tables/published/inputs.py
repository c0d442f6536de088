"""Contracts of the published tables, which come as CSV files with their source next to them."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class PublishedCoefficients(pa.DataFrameModel):
    """Coefficients of a response surface as printed (tables 6 and 8)."""

    term: Series[str]
    coefficient: Series[float]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True


class PublishedImpact(pa.DataFrameModel):
    """Average gradients and comprehensive impact values as printed (table 9)."""

    study: Series[str]
    factor: Series[str]
    gradient: Series[float]
    range: Series[float] = pa.Field(gt=0)
    impact: Series[float]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True


class PublishedRubberCases(pa.DataFrameModel):
    """Vertical stiffness of the rubber designs by finite elements (table 7)."""

    case: Series[int]
    shear_band_c10_mpa: Series[float] = pa.Field(gt=0)
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    stiffness_n_per_mm: Series[float] = pa.Field(gt=0)

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True


class PublishedSpokeStiffness(pa.DataFrameModel):
    """Tension and compression stiffness of one spoke (table 10; further columns may follow)."""

    spoke_c10_mpa: Series[float] = pa.Field(gt=0, unique=True)
    tension_stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    compression_stiffness_n_per_mm: Series[float] = pa.Field(gt=0)

    class Config:
        """R² and smeared stiffnesses are in further columns."""

        strict = False
        coerce = True


class PublishedLcaAgainstFem(pa.DataFrameModel):
    """The paper's load-bearing model against its finite elements (table 11)."""

    spoke_c10_mpa: Series[float] = pa.Field(gt=0, unique=True)
    fem_stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    theta_c_deg: Series[float] = pa.Field(gt=0)
    theta_t_deg: Series[float] = pa.Field(gt=0)
    lca_force_n: Series[float] = pa.Field(gt=0)
    lca_displacement_mm: Series[float] = pa.Field(gt=0)
    lca_stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    relative_error_percent: Series[float]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True


class PublishedLcaErrors(pa.DataFrameModel):
    """Largest error of the paper's model against its finite elements by load (section 4.3.2)."""

    load_n: Series[float] = pa.Field(gt=0, unique=True)
    largest_relative_error_percent: Series[float] = pa.Field(ge=0)

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
