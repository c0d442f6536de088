"""Contracts of the tables that compare hyperelastic models and strain ranges."""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series


class ModelComparison(pa.DataFrameModel):
    """Models fitted to the same points: one row per rubber, model and constant.

    The columns from ``points`` on repeat for the constants of a model. A model whose constants
    the data cannot determine has empty values and the reason in ``remarks``.
    """

    rubber: Series[str]
    model: Series[str]
    constant: Series[str]
    value: Series[float] = pa.Field(nullable=True)
    unit: Series[str]
    standard_error: Series[float] = pa.Field(nullable=True, ge=0)
    in_card: Series[bool] = pa.Field(description="Model and range of the material card")
    strain_low: Series[float]
    strain_high: Series[float]
    weights: Series[str]
    specimens: Series[str]
    points: Series[int] = pa.Field(ge=0)
    rmse_mpa: Series[float] = pa.Field(nullable=True, ge=0)
    largest_error_percent: Series[float] = pa.Field(nullable=True, ge=0)
    r_squared: Series[float] = pa.Field(nullable=True, le=1)
    initial_shear_modulus_mpa: Series[float] = pa.Field(nullable=True)
    drucker_stable: Series[pd.BooleanDtype] = pa.Field(nullable=True)
    standard_error_rule: Series[str]
    remarks: Series[str]

    class Config:
        """Refuse unknown columns, coerce types, keep the order."""

        strict = True
        coerce = True
        ordered = True


class RangeTable(pa.DataFrameModel):
    """Neo-Hookean C10 against the upper end of the strain range.

    ``specimen`` is an id, or "all" for the joint fit of the specimens that reach the range.
    """

    rubber: Series[str]
    specimen: Series[str]
    strain_low: Series[float]
    strain_high: Series[float]
    c10_mpa: Series[float] = pa.Field(nullable=True)
    standard_error_mpa: Series[float] = pa.Field(nullable=True, ge=0)
    points: Series[int] = pa.Field(ge=0)
    rmse_mpa: Series[float] = pa.Field(nullable=True, ge=0)
    largest_error_percent: Series[float] = pa.Field(nullable=True, ge=0)
    in_card: Series[bool] = pa.Field(description="Range of the material card")
    remarks: Series[str]

    class Config:
        """Refuse unknown columns, coerce types, keep the order."""

        strict = True
        coerce = True
        ordered = True
