"""Options of the Abaqus model: the paper's tyre, its mesh and its load step."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from nptcs.config.base import Strict
from nptcs.config.solvers.fe import LayerlessGeometry, SpokeGeometry


class AbaqusMesh(Strict):
    """Numbers of linear elements; the defaults give the counts of table 4.

    Of the spoke meshes with 3612 bricks, those with two across a leg and many along it are the best
    in bending.
    """

    rows: tuple[int, int, int, int, int, int] = Field(
        (1, 3, 12, 3, 1, 1),
        description="Along a leg: foot to plate, taper, leg, ramp, block with plate, block",
    )
    columns: int = Field(2, ge=1, description="Across a leg")
    spoke_axial: int = Field(43, ge=1, description="Across the width of a spoke; 43 makes 5 mm")
    plate: tuple[int, int] = Field((11, 2), description="Along and across a reinforcement plate")
    around: int = Field(360, ge=12, description="Around the shear band and tread")
    band_axial: int = Field(31, ge=1, description="Across the width of the shear band and tread")
    band_rows: int = Field(
        2, ge=2, multiple_of=2, description="Through the shear band; even, for a neutral line"
    )
    tread_rows: int = Field(1, ge=1, description="Through the tread outside the shear band")

    @model_validator(mode="after")
    def _positive(self) -> Self:
        if min(*self.rows, *self.plate) < 1:
            raise ValueError(f"rows and plate must all be 1 or more, got {self.rows}, {self.plate}")
        return self


class AbaqusModel(Strict):
    """Options of the Abaqus model that are the same for all cases."""

    geometry: LayerlessGeometry = Field(default_factory=SpokeGeometry, description="The spoke")
    mesh: AbaqusMesh = Field(default_factory=AbaqusMesh, description="Mesh of the whole tyre")
    first_spoke_deg: float = Field(
        0.0, description="Angle of a spoke's feet from the middle of the contact"
    )
    friction: float = Field(0.3, ge=0, lt=2, description="Coefficient of friction, section 3.2")
    increments: tuple[float, float, float] = Field(
        (0.02, 1e-7, 0.05),
        description="First, smallest and largest increment of the load step, as parts of the load",
    )

    @model_validator(mode="after")
    def _increments_in_order(self) -> Self:
        first, smallest, largest = self.increments
        if not 0.0 < smallest <= first <= largest <= 1.0:
            raise ValueError(
                "increments must satisfy 0 < smallest <= first <= largest <= 1, "
                f"got first, smallest, largest = {self.increments}"
            )
        return self
