"""Contract of the flags of the specimens, collected."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

FLAG_KINDS = ("deviation", "not assessed", "remark")


class FlagsTable(pa.DataFrameModel):
    """``flags.csv``: what was flagged, one row per standard and kind of flag.

    Flags that differ only in their numbers are one row, which gives the lowest and the highest
    number. The flags of each value are in ``specimens.csv``.
    """

    standard: Series[str] = pa.Field(description="Standard in force for the test")
    kind: Series[str] = pa.Field(
        isin=FLAG_KINDS,
        description="deviation: from the standard; not assessed: a value is missing; remark: "
        "something else that a reader should know",
    )
    flag: Series[str]
    specimens: Series[int] = pa.Field(gt=0, description="Number of specimens with this flag")
    names: Series[str] = pa.Field(description="These specimens")
    properties: Series[str] = pa.Field(description="Properties whose rows have the flag")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
        unique = ["standard", "flag"]
