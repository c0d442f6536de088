"""Options of the sandwich ring on the spokes' energies."""

from __future__ import annotations

from math import inf
from typing import Literal, assert_never

from pydantic import Field

from nptcs.config.base import Strict
from nptcs.config.solvers.fe import (
    AXIAL_BULK_TO_SHEAR,
    SECTIONS,
    AxialFreedom,
    EnergyTableOptions,
    FeSpokeModel,
    GroundContact,
)


class RingElements(Strict):
    """Two-node elements of the ring."""

    elements_per_pitch: int = Field(2, ge=1, description="Elements between two spokes' feet")
    refinement: int = Field(
        5, ge=1, description="How many times as many elements there are near the contact"
    )
    refined_deg: float = Field(
        12.0, ge=0, le=180, description="Up to this angle from the middle of the contact"
    )
    first_spoke_deg: float = Field(
        0.0, description="Angle of a spoke's foot from the middle of the contact"
    )


class RingOptions(Strict):
    """Options of the ring beyond the tyre's dimensions, its rubbers and its spokes."""

    mesh: RingElements = Field(default_factory=RingElements, description="Elements of the ring")
    contact: GroundContact = Field(default_factory=GroundContact, description="The ground")
    axial: AxialFreedom = Field(
        "free_edges",
        description="Freedom of band and tread along the axis, as in `fe_tyre`. free_edges: as in "
        "a tyre of the paper's width; plane_strain: none, incompressible",
    )
    wire_row_mm: float = Field(
        0.05,
        ge=0,
        description="Depth of rubber around each layer of wires that turns with them and does not "
        "shear, as in the mesh of `fe_tyre`",
    )

    def foot_width_mm(self) -> float:
        """Return the width of a spoke's foot along the circumference."""
        return SECTIONS["converged"].foot_width_mm()

    def band_bulk_to_shear(self) -> float:
        """Return κ/2C10 of band and tread."""
        match self.axial:
            case "free_edges":
                return AXIAL_BULK_TO_SHEAR
            case "plane_strain":
                return inf
            case _:
                assert_never(self.axial)


class RingModel(FeSpokeModel, RingOptions):
    """Options of the ring and of its finite element spokes that are the same for all cases."""

    ring: Literal["converged"] = Field(
        "converged", description="Section of the spoke: the one calibrated with the converged ring"
    )
    table: EnergyTableOptions = Field(
        default_factory=EnergyTableOptions, description="Energy table of the spoke"
    )
    load_steps: int = Field(10, ge=2, description="Load steps to the load of the case")

    def foot_width_mm(self) -> float:
        """Return the width of a spoke's foot along the circumference, that of the section."""
        return self.geometry.foot_width_mm()

    @classmethod
    def spoke_parts(cls) -> tuple[str, ...]:
        """Name the options on which the spokes' tables depend, as in the solver `fe_tyre`."""
        return (*FeSpokeModel.model_fields, "table")
