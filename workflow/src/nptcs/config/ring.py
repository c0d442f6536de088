"""Options of the sandwich ring on the spokes' energies."""

from __future__ import annotations

from math import inf

from pydantic import Field

from nptcs.config.base import Strict
from nptcs.config.fe import EnergyTableOptions, FeSpokeModel, GroundContact


class RingMesh(Strict):
    """Elements of the ring, two-node."""

    elements_per_pitch: int = Field(2, ge=1, description="Elements between two spokes' feet")
    refinement: int = Field(
        3, ge=1, description="How many times as many there are near the contact"
    )
    refined_deg: float = Field(
        12.0, ge=0, le=180, description="Up to this angle from the middle of the contact"
    )
    first_spoke_deg: float = Field(
        0.0, description="Angle of a spoke's foot from the middle of the contact"
    )


class RingOptions(Strict):
    """What the ring is besides the tyre's dimensions, its rubbers and its spokes."""

    mesh: RingMesh = Field(default_factory=RingMesh, description="Elements of the ring")
    contact: GroundContact = Field(default_factory=GroundContact, description="The ground")
    wire_row_depth_mm: float = Field(
        0.05,
        ge=0,
        description="Depth of rubber around each layer of wires that turns with them and does not "
        "shear",
    )
    bulk_to_shear_ratio: float = Field(
        inf,
        ge=3,
        description="κ/2C10 of band and tread in plane strain; .inf is incompressible. 10 does "
        "what the free edges of a band 215 mm wide do",
    )


class RingModel(FeSpokeModel, RingOptions):
    """Everything of the ring and of the finite element spokes under it that no case varies."""

    table: EnergyTableOptions = Field(
        default_factory=EnergyTableOptions, description="Energy table of the spoke"
    )
    load_steps: int = Field(10, ge=2, description="Load steps to the load of the case")

    @classmethod
    def spoke_parts(cls) -> tuple[str, ...]:
        """Name the options on which the spokes' tables depend, as in the solver `fe_tyre`."""
        return (*FeSpokeModel.model_fields, "table")
