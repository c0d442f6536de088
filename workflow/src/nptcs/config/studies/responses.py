"""What is reported for every solved tyre, beyond the stiffness at the load of its case."""

from __future__ import annotations

from pydantic import Field, field_validator

from nptcs.config.base import Strict


class TyreResponseSettings(Strict):
    """Loads and displacements at which tyres are compared, and the plates' density."""

    loads_n: tuple[float, ...] = Field(
        (1500.0, 3000.0, 5000.0),
        description="Loads of the secant and tangent stiffness; the load of the case is always "
        "one of them",
    )
    displacements_mm: tuple[float, ...] = Field(
        (25.0,),
        description="Displacements of the secant and tangent stiffness (section 4.3.1 names 25 "
        "mm); a curve that ends before one is reported as not reached, see `curve_to_mm` of "
        "fe_tyre",
    )
    plate_density_kg_per_m3: float | None = Field(
        None,
        gt=0,
        description="Density of the plates; without it their mass is not assessed. Carbon fibre "
        "with epoxy has about 1550",
    )

    plate_price_per_kg: float | None = Field(
        None,
        gt=0,
        description="Price of the plates by mass, in any currency; without it their cost is not "
        "assessed",
    )

    @field_validator("loads_n", "displacements_mm")
    @classmethod
    def _positive(cls, values: tuple[float, ...]) -> tuple[float, ...]:
        if any(not value > 0.0 for value in values):
            raise ValueError(f"must all be above zero, got {values}")
        return values
