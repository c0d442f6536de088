"""Contract of the deformed neutral line of the band, figure 14 of the paper."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class NeutralLine(pa.DataFrameModel):
    """Displacement of the band's neutral line, for the cases that ``neutral_line_cases`` names.

    With finite elements it is the middle between the wire layers, in the load-bearing model the
    ring of radius R. A case that failed has no rows.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    load_n: Series[float] = pa.Field(gt=0)
    theta_deg: Series[float] = pa.Field(
        ge=-180, le=180, description="Before loading; 0 in the middle of the contact"
    )
    radial_mm: Series[float] = pa.Field(description="Relative to the rim, outward positive")
    tangential_mm: Series[float] = pa.Field(description="Towards larger angles")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
