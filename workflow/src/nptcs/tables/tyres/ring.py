"""Contract of the table that `ring.batch.solve_table` returns."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

RING_STATUSES = ("ok", "beyond_table", "diverged", "bad_input")
"""``beyond_table``: a spoke leaves the range of its energy table below the load; the message says
which, and the numbers are empty. ``diverged``: no equilibrium was found."""


class RingResults(pa.DataFrameModel):
    """Results of designs on the sandwich ring, one row per design, next to its own columns."""

    displacement_mm: Series[float] = pa.Field(gt=0, nullable=True)
    displacement_standard_error_mm: Series[float] = pa.Field(
        ge=0, nullable=True, description="From the surrogate of the spoke; 0 for a computed table"
    )
    vertical_stiffness_n_per_mm: Series[float] = pa.Field(
        gt=0, nullable=True, description="Secant F/δ at the load"
    )
    tangent_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, description="dF/dδ")
    contact_length_mm: Series[float] = pa.Field(
        ge=0, nullable=True, description="√(12 Var p) over the pressure"
    )
    largest_pressure_mpa: Series[float] = pa.Field(ge=0, nullable=True)
    smallest_u_r_mm: Series[float] = pa.Field(nullable=True)
    largest_u_r_mm: Series[float] = pa.Field(nullable=True)
    spoke_energy_n_mm: Series[float] = pa.Field(nullable=True)
    band_energy_n_mm: Series[float] = pa.Field(nullable=True)
    status: Series[str] = pa.Field(isin=RING_STATUSES)
    message: Series[str]

    class Config:
        """Further columns, as the table of designs had them, are kept."""

        strict = False
        coerce = True
