"""Contract of the outlines of a loaded tyre, figure 10 a of the paper."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

PARTS = ["spoke", "plate", "band", "rim"]


class DeformedTyre(pa.DataFrameModel):
    """``deformed_tyre.csv``: outlines of spokes, plates, band and rim of one loaded tyre.

    The section through the middle of a plate, hub at the origin, y up. Rows of one outline are in
    their order along it; the last point is followed by the first one.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    load_n: Series[float] = pa.Field(gt=0)
    part: Series[str] = pa.Field(isin=PARTS)
    outline: Series[int] = pa.Field(ge=0, description="Number of the outline, over all parts")
    x_mm: Series[float] = pa.Field(description="Under the load, relative to the rim")
    y_mm: Series[float]
    x_undeformed_mm: Series[float]
    y_undeformed_mm: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
