"""The tidy curve of one specimen, and the record of how it was made."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Literal, assert_never

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series
from pydantic import Field

from nptcs.config.base import Strict
from nptcs.errors import InputError
from nptcs.tables.io import read_alike

CURVE_COLUMNS = (
    "time_s",
    "force_n",
    "stress_mpa",
    "strain_axial",
    "strain_transverse",
    "strain_axial_back",
)


class Curve(pa.DataFrameModel):
    """One specimen's test, one row per reading, in the order of the test.

    Tension is positive: a compression curve has negative force, stress and axial strain.
    Strain is dimensionless, nominal (ΔL/L0); for a rubber the stretch is λ = 1 + strain_axial.

    ``strain_axial`` is empty where no strain was measured (extensometer taken off, camera
    stopped): such rows carry the strength and nothing else. ``time_s`` is empty throughout if
    the raw file has no time. ``strain_transverse`` and ``strain_axial_back`` (the other face of
    a compression specimen) are empty if they were not measured.
    """

    time_s: Series[float] = pa.Field(nullable=True)
    force_n: Series[float]
    stress_mpa: Series[float]
    strain_axial: Series[float] = pa.Field(nullable=True)
    strain_transverse: Series[float] = pa.Field(nullable=True)
    strain_axial_back: Series[float] = pa.Field(nullable=True)

    class Config:
        """Exactly these columns, as floats."""

        strict = True
        coerce = True
        ordered = True


def read_curves(paths: Iterable[str | Path]) -> dict[str, pd.DataFrame]:
    """Read the curves of specimens; each file has the name of its specimen.

    Raises
    ------
    InputError
        As `nptcs.tables.io.read_table`.
    """
    files = [Path(path) for path in paths]
    curves = read_alike(files, Curve)
    return {
        file.name.removesuffix(".csv"): curve for file, curve in zip(files, curves, strict=True)
    }


Role = Literal["force", "strain", "force and strain"]
"""What a file provides for its specimen."""


class FileRecord(Strict):
    """One raw file as it was read."""

    path: str = Field(description="Relative to the sheet's folder")
    sha256: str
    role: Role
    format: str = Field(description="Name of the profile")
    detected: bool = Field(description="False if the sheet named the profile")
    encoding: str = ""
    delimiter: str = ""
    decimal: str = ""
    header_line: int | None = Field(None, description="Line of the column names, from 1")
    first_line: int | None = Field(None, description="Line of the first row of numbers")
    rows: int
    units: dict[str, str] = Field(description="Quantity → unit as found")
    columns: dict[str, str] = Field(description="Quantity → column name as found")
    notes: tuple[str, ...] = Field((), description="What detection found and why")


class Geometry(Strict):
    """The section that turned force into stress."""

    mean_width_mm: float | None
    mean_thickness_mm: float | None
    area_mm2: float
    area_rule: str = Field("", description="How the area was determined")
    width_stations: int
    thickness_stations: int


class ConditioningStep(Strict):
    """One step of signal conditioning."""

    name: str
    on: bool
    changed: str = Field("", description="What it did, in words and numbers")
    numbers: dict[str, float] = Field(default_factory=dict, description="Unit in each key")


class IngestRecord(Strict):
    """How one specimen's curve was made, or with ``status`` error the message why it was not."""

    specimen: str
    status: Literal["ok", "error"]
    message: str = ""
    files: tuple[FileRecord, ...] = ()
    geometry: Geometry | None = None
    strain_source: str = Field(
        "",
        description="extensometer, dic, strain_gauge, crosshead, unspecified, or none (strength "
        "only)",
    )
    data_sha256: str = Field(
        "", description="Hash of load and strain as read: equal for equal data"
    )
    data_sketch: tuple[int, ...] = Field(
        (), description="Sample of pairs of load and strain: shared by copies that were changed"
    )
    failure_seen: bool = Field(
        False, description="A break was recorded: force lost, and no unloading"
    )
    steps: tuple[ConditioningStep, ...] = ()
    flags: tuple[str, ...] = Field((), description="What a reader of any result must know")
    made_from: str = Field(
        "", description="Hash of row, content of the files, profiles, settings and code"
    )
    curve_sha256: str = Field("", description="Hash of the curve's file")

    @property
    def understood(self) -> bool:
        """Tell whether the specimen has a curve; otherwise the message says why not."""
        match self.status:
            case "ok":
                return True
            case "error":
                return False
            case _:
                assert_never(self.status)

    @classmethod
    def failed(cls, specimen: str, error: InputError) -> IngestRecord:
        """Return the record of a specimen that could not be read."""
        return cls(specimen=specimen, status="error", message=str(error))
