"""Every file of a laboratory's folder, and what became of it."""

from __future__ import annotations

from enum import StrEnum

import pandera.pandas as pa
from pandera.typing.pandas import Series


class FileStatus(StrEnum):
    """What became of a file."""

    USED = "used"
    LEFT_OUT = "left out"
    REPEATED = "repeated"
    NOT_UNDERSTOOD = "not understood"
    NOT_NAMED = "not named"
    NOTE = "note"
    MISSING = "missing"
    SHEET = "sheet"


class Files(pa.DataFrameModel):
    """One row per file that is in the folder or that the sheet names.

    ``used``: read for an included specimen; ``left out``: read, its specimen is left out with
    the reason given; ``repeated``: its data are those of another specimen and are not counted
    again; ``not understood``: named, but its specimen failed with the reason given;
    ``not named``: no row of the sheet names it; ``note``: a README, which no row has to name;
    ``missing``: named, but not in the folder; ``sheet``: the specimen sheet itself.
    """

    file: Series[str] = pa.Field(unique=True)
    status: Series[str] = pa.Field(isin=list(FileStatus))
    specimens: Series[str]
    format: Series[str]
    reason: Series[str]
    size_bytes: Series[pa.Int64] = pa.Field(ge=0)
    sha256: Series[str] = pa.Field(str_matches=r"^([0-9a-f]{64})?$")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
