"""The tyre of the study: tables 3 and 4 of the paper, and its shear-band section."""

from __future__ import annotations

from math import floor
from typing import Self

from pydantic import Field, model_validator

from nptcs.config.base import Strict


class TyreGeometry(Strict):
    """Dimensions of the tyre; the defaults are those of the published study."""

    outer_diameter_mm: float = Field(646.8, gt=0, description="Outer diameter, table 3")
    tread_width_mm: float = Field(215.0, gt=0, description="Width of tread and band, table 3")
    rim_diameter_mm: float = Field(431.8, gt=0, description="Outer diameter of the rim, table 3")
    shear_band_thickness_mm: float = Field(14.0, gt=0, description="Radial thickness, table 3")
    inner_wire_diameter_mm: float = Field(
        601.5, gt=0, description="Diameter of the inner steel wire layers, table 3"
    )
    outer_wire_diameter_mm: float = Field(
        626.5, gt=0, description="Diameter of the outer steel wire layers, table 3"
    )
    band_radius_mm: float = Field(
        303.875, gt=0, description="Mean radius R of the ring in the LCA model, section 3.3.3"
    )
    spoke_count: int = Field(60, ge=3, description="Number N of spokes, table 4")
    plate_width_mm: float = Field(
        5.0, gt=0, description="Axial width of a reinforcement plate, section 3.2"
    )
    wire_layers: int = Field(4, ge=2, description="Steel wire layers, half inside, half outside")
    wire_diameter_mm: float = Field(1.0, gt=0, description="Wire diameter, section 3.2")
    wire_pitch_mm: float = Field(2.0, gt=0, description="Spacing of the wires, section 3.2")
    wire_modulus_mpa: float = Field(80000.0, gt=0, description="Young's modulus of the wire")
    wire_poisson_ratio: float = Field(0.3, gt=-1, lt=0.5, description="Poisson's ratio of the wire")

    def plates_across(self, spacing_mm: float) -> int:
        """Return how many plates of a leg fit into the width at this spacing (table 4: 15).

        Examples
        --------
        >>> [TyreGeometry().plates_across(spacing) for spacing in (10, 15, 20)]
        [22, 15, 11]
        """
        return floor((self.tread_width_mm - self.plate_width_mm) / spacing_mm + 1e-9) + 1

    @model_validator(mode="after")
    def _radii_in_order(self) -> Self:
        radii = {
            "rim_diameter_mm / 2": self.rim_diameter_mm / 2,
            "inner_wire_diameter_mm / 2": self.inner_wire_diameter_mm / 2,
            "band_radius_mm": self.band_radius_mm,
            "outer_wire_diameter_mm / 2": self.outer_wire_diameter_mm / 2,
            "outer_diameter_mm / 2": self.outer_diameter_mm / 2,
        }
        if sorted(radii.values()) != list(radii.values()):
            raise ValueError(f"radii must increase from rim to tread, got {radii}")
        return self

    @model_validator(mode="after")
    def _plates_fit(self) -> Self:
        if self.plate_width_mm > self.tread_width_mm:
            raise ValueError(
                f"plate_width_mm must not exceed tread_width_mm ({self.tread_width_mm:g}), got "
                f"{self.plate_width_mm:g}"
            )
        return self
