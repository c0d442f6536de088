"""Contract of the property table: one row per specimen and property."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class PropertiesTable(pa.DataFrameModel):
    """Properties of specimens (``results/tables/specimens.csv``).

    A property that the data cannot give is a row with an empty value and a flag that begins
    with "not assessed". Compression properties are magnitudes (positive).
    """

    specimen: Series[str] = pa.Field(str_length={"min_value": 1})
    test: Series[str]
    material: Series[str]
    property: Series[str]
    value: Series[float] = pa.Field(nullable=True)
    unit: Series[str]
    rule: Series[str]
    range: Series[str] = pa.Field(description="Nominal range of the rule; empty where it has none")
    points: Series[int] = pa.Field(ge=0, description="Recorded points that the value is based on")
    flags: Series[str] = pa.Field(description="Deviations and remarks, separated by '; '")
    orientation_deg: Series[float] = pa.Field(nullable=True)
    r_squared: Series[float] = pa.Field(
        nullable=True, le=1.0, description="Of the least-squares line over the range"
    )
    standard_error: Series[float] = pa.Field(
        nullable=True,
        ge=0.0,
        description="From the scatter of the points about that line and the error of the "
        "strain origin",
    )
    origin: Series[str] = pa.Field(isin=["measured", "synthetic"])
    range_low: Series[float] = pa.Field(nullable=True, description="Abscissa that was used, from")
    range_high: Series[float] = pa.Field(nullable=True, description="Abscissa that was used, to")
    origin_effect_percent: Series[float] = pa.Field(
        nullable=True, description="What the correction of the strain origin did to the value"
    )

    class Config:
        """Refuse unknown columns, coerce types, keep the order."""

        strict = True
        coerce = True
        ordered = True
