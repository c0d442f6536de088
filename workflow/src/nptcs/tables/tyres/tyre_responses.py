"""Contracts of what solved tyres do: their responses, load curves and plate stress."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class TyreResponses(pa.DataFrameModel):
    """``tyre_responses.csv``: one row per case, solver and response.

    A response that could not be found is a row with an empty value, a status that says so and the
    reason in `note`.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    load_n: Series[float] = pa.Field(gt=0, description="Load of the case")
    response: Series[str]
    at: Series[str] = pa.Field(description="Load or displacement of the response, with its unit")
    value: Series[float] = pa.Field(nullable=True)
    unit: Series[str]
    status: Series[str] = pa.Field(isin=["ok", "not assessed", "not reached"])
    note: Series[str] = pa.Field(description="The rule, or why there is no value")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
        unique = ["solver", "case_id", "response", "at"]


class TyreCurves(pa.DataFrameModel):
    """``tyre_curves.csv``: load against displacement of every solved tyre, figure 10 b."""

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    displacement_mm: Series[float] = pa.Field(ge=0)
    force_n: Series[float] = pa.Field(ge=0)

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class PlateStress(pa.DataFrameModel):
    """``plate_stress.csv``: stress at the faces of the most loaded spokes' plates, figure 10 a.

    One row per face of a plate element, at its centre, in axes that turn with the plate.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    load_n: Series[float] = pa.Field(gt=0)
    spoke: Series[int] = pa.Field(ge=0, description="Number from the contact's middle, along θ")
    leg: Series[int] = pa.Field(isin=[0, 1], description="0 at the rim, 1 at the band")
    face: Series[int] = pa.Field(isin=[0, 1], description="0 at the ply +A, 1 at the ply -A")
    height_mm: Series[float] = pa.Field(description="Of the element's centre above the rim")
    ply_deg: Series[float] = pa.Field(description="Fibre angle of the ply at this face")
    along_mpa: Series[float] = pa.Field(description="σ1, along the fibres")
    across_mpa: Series[float] = pa.Field(description="σ2, across the fibres")
    shear_mpa: Series[float] = pa.Field(description="τ12")
    mises_mpa: Series[float] = pa.Field(ge=0, description="In plane, at the element's centre")
    mean_mises_mpa: Series[float] = pa.Field(
        ge=0, description="In plane, of the mean stress of the element's face"
    )

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
