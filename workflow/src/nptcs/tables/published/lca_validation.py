"""Contract of ``results/tables/lca_validation.csv``."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class LcaValidation(pa.DataFrameModel):
    """Load-bearing model against the published one, one row for each section, C10 and load.

    Published values exist only for table 11's load; elsewhere they are empty, and so are the
    differences: for figure 15 the text gives only the largest error at each load.
    """

    section: Series[str] = pa.Field(isin=["sandwich", "printed"])
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    load_n: Series[float] = pa.Field(gt=0)
    theta_c_deg: Series[float] = pa.Field(gt=0, lt=90)
    theta_t_deg: Series[float] = pa.Field(gt=0, lt=180)
    displacement_mm: Series[float] = pa.Field(gt=0)
    stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    contact_length_mm: Series[float] = pa.Field(gt=0, description="2 R θc")
    mean_pressure_mpa: Series[float] = pa.Field(gt=0, description="Load / (contact length × b)")
    balance_residual: Series[float] = pa.Field(ge=-1e-9, le=1e-9)
    published_theta_c_deg: Series[float] = pa.Field(nullable=True)
    published_theta_t_deg: Series[float] = pa.Field(nullable=True)
    published_displacement_mm: Series[float] = pa.Field(nullable=True)
    published_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True)
    published_fem_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True)
    theta_c_difference_percent: Series[float] = pa.Field(nullable=True)
    theta_t_difference_percent: Series[float] = pa.Field(nullable=True)
    displacement_difference_percent: Series[float] = pa.Field(nullable=True)
    stiffness_difference_percent: Series[float] = pa.Field(nullable=True)
    fem_difference_percent: Series[float] = pa.Field(nullable=True)
    published_largest_error_percent: Series[float] = pa.Field(
        nullable=True, description="Largest error of the paper's model against FE at this load"
    )

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class LcaAgainstFem(pa.DataFrameModel):
    """Load-bearing model against the published FE stiffness of table 7."""

    section: Series[str] = pa.Field(isin=["sandwich", "printed"])
    case: Series[int] = pa.Field(ge=1)
    shear_band_c10_mpa: Series[float] = pa.Field(gt=0)
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    load_n: Series[float] = pa.Field(gt=0)
    stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    published_fem_stiffness_n_per_mm: Series[float] = pa.Field(gt=0)
    fem_difference_percent: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class LcaNeutralLine(pa.DataFrameModel):
    """Deformed middle line of the band, the hub at the origin and y up (figure 14)."""

    section: Series[str] = pa.Field(isin=["sandwich", "printed"])
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    load_n: Series[float] = pa.Field(gt=0)
    theta_deg: Series[float] = pa.Field(ge=-180, le=180)
    region: Series[str] = pa.Field(isin=["contact", "compression", "tension"])
    x_mm: Series[float]
    y_mm: Series[float]
    x_undeformed_mm: Series[float]
    y_undeformed_mm: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
