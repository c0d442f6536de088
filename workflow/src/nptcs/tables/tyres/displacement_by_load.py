"""Contract of displacement against load by finite elements and by the load-bearing model."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class DisplacementByLoad(pa.DataFrameModel):
    """``displacement_by_load.csv``: one row per FE solver, spoke C10 and load, figure 15.

    The tyre is that of table 11. A load that the solver's curve does not reach, or a tyre that was
    not solved, is a row with an empty displacement and a status that says so.
    """

    solver: Series[str]
    case_id: Series[str] = pa.Field(description="Case whose curve is read; empty for none")
    shear_band_c10_mpa: Series[float] = pa.Field(gt=0)
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    load_n: Series[float] = pa.Field(gt=0)
    status: Series[str] = pa.Field(isin=["ok", "not assessed", "not reached"])
    note: Series[str] = pa.Field(description="Why there is no displacement")
    displacement_mm: Series[float] = pa.Field(
        gt=0, nullable=True, description="From the solver: a spline of its curve at the load"
    )
    lca_displacement_mm: Series[float] = pa.Field(
        gt=0, description="From our load-bearing model with the sandwich section"
    )
    lca_difference_percent: Series[float] = pa.Field(
        nullable=True, description="Stiffness of the load-bearing model against the solver's"
    )
    published_fem_displacement_mm: Series[float] = pa.Field(
        nullable=True, description="Load over table 11's FE stiffness"
    )
    published_lca_displacement_mm: Series[float] = pa.Field(nullable=True)
    published_largest_error_percent: Series[float] = pa.Field(
        nullable=True, description="Largest error of the paper's model against FE at this load"
    )

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
        unique = ["solver", "spoke_c10_mpa", "load_n"]
