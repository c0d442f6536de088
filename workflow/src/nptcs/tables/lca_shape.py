"""Contract of the deformed rings of figure 14."""

import pandera.pandas as pa
from pandera.typing.pandas import Series


class LcaShape(pa.DataFrameModel):
    """``lca_shape.csv``: middle line of the band at 5000 N, hub at the origin, y upwards."""

    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    theta_deg: Series[float] = pa.Field(ge=-180, le=180, description="From the ground contact")
    region: Series[str]
    x_mm: Series[float]
    y_mm: Series[float]
    x_undeformed_mm: Series[float]
    y_undeformed_mm: Series[float]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
