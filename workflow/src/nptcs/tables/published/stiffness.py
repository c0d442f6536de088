"""Contracts that compare computed with published stiffness: tables 5 and 7 of the paper."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.tables.solver_names import PUBLISHED as PUBLISHED
from nptcs.tables.status import Status

STIFFNESS = "vertical_stiffness_n_per_mm"
COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS, DIFFERENCE = (
    "computed_stiffness_n_per_mm",
    "published_stiffness_n_per_mm",
    "difference_percent",
)


class StiffnessAgainstPublished(pa.DataFrameModel):
    """Computed and published vertical stiffness, one row per case and solver.

    Factors and fixed values are to the right, as in ``cases.csv``. A case that failed is a row
    with its status and without a computed value.
    """

    study: Series[str]
    case_id: Series[str]
    case: Series[int] = pa.Field(ge=1, description="Number in the study")
    solver: Series[str]
    status: Series[str] = pa.Field(isin=list(Status), description="Of the computed case")
    computed_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, gt=0)
    published_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, gt=0)
    difference_percent: Series[float] = pa.Field(
        nullable=True, description="(computed - published) / published"
    )
    used_for_calibration: Series[bool] = pa.Field(
        description="Whether the solver was calibrated on this case (study key calibration_cases)"
    )

    class Config:
        """Factors differ from study to study."""

        strict = False
        coerce = True
        unique = ["solver", "case_id"]


class StiffnessErrors(pa.DataFrameModel):
    """Differences of ``stiffness_against_published.csv``, summarised by study and solver.

    Blind cases are kept apart from those on which the solver was calibrated.
    """

    study: Series[str]
    solver: Series[str]
    group: Series[str] = pa.Field(isin=["blind", "calibration"])
    cases: Series[int] = pa.Field(ge=1)
    compared: Series[int] = pa.Field(ge=0, description="Cases with both values")
    mean_percent: Series[float] = pa.Field(nullable=True, description="Signed mean")
    mean_absolute_percent: Series[float] = pa.Field(nullable=True, ge=0)
    largest_percent: Series[float] = pa.Field(
        nullable=True, description="Difference of the largest magnitude, with its sign"
    )
    largest_case_id: Series[str] = pa.Field(description="Case of the largest difference")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class StiffnessByLevel(pa.DataFrameModel):
    """Main effects: means over the cases at one level of a factor, computed and published.

    All means of a factor are over the same combinations of the other factors: those at which
    every level has both values. Otherwise a case that failed would look like a trend.
    """

    study: Series[str]
    solver: Series[str]
    factor: Series[str]
    level: Series[float] = pa.Field(description="In the unit of the factor")
    compared: Series[int] = pa.Field(ge=1, description="Cases over which the means are taken")
    computed_mean_n_per_mm: Series[float] = pa.Field(gt=0)
    published_mean_n_per_mm: Series[float] = pa.Field(gt=0)
    computed_change_percent: Series[float] = pa.Field(
        description="Of the computed mean, from the factor's lowest level"
    )
    published_change_percent: Series[float] = pa.Field(
        description="Of the published mean, from the factor's lowest level"
    )
    mean_difference_percent: Series[float] = pa.Field(description="Mean of the cases' differences")
    lowest_difference_percent: Series[float]
    highest_difference_percent: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class StiffnessExponents(pa.DataFrameModel):
    """Exponents d ln K / d ln C10 of the stiffness with respect to each modulus.

    One row over all levels of the factor, by least squares, and one for each step between two
    levels, at each combination of the other factors. For a tyre made only of rubbers the exponents
    of all moduli add up to 1.
    """

    study: Series[str]
    solver: Series[str]
    factor: Series[str] = pa.Field(description="A modulus: its name ends in _mpa")
    held: Series[str] = pa.Field(description="Levels of the other factors")
    low_mpa: Series[float] = pa.Field(gt=0, description="Lowest level")
    high_mpa: Series[float] = pa.Field(gt=0, description="Highest level")
    levels: Series[int] = pa.Field(ge=2, description="Levels over which the exponent is taken")
    computed_exponent: Series[float]
    published_exponent: Series[float]
    exponent_difference: Series[float] = pa.Field(description="Computed - published")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
