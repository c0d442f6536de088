"""The responses of a study besides its stiffness: ``studies[].responses``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Self

from pydantic import Field, model_validator

from nptcs.config.base import Strict


class Taken(StrEnum):
    """Where on its load–displacement curve a tyre has a response."""

    ANYWHERE = "at any load or displacement"
    STUDY_LOAD = "at the load of the study"
    UNLOADED = "without a load"


@dataclass(frozen=True)
class ResponseKind:
    """Unit of a response, and where on the curve it is taken."""

    unit: str
    taken: Taken


def _at_load(unit: str) -> ResponseKind:
    return ResponseKind(unit, Taken.STUDY_LOAD)


RESPONSE_KINDS: Mapping[str, ResponseKind] = {
    "secant_stiffness": ResponseKind("N/mm", Taken.ANYWHERE),
    "tangent_stiffness": ResponseKind("N/mm", Taken.ANYWHERE),
    "contact_length": _at_load("mm"),
    "largest_pressure": _at_load("MPa"),
    "mean_pressure": _at_load("MPa"),
    "largest_spoke_force": _at_load("N"),
    "smallest_spoke_force": _at_load("N"),
    "plate_largest_mises": _at_load("MPa"),
    "plate_largest_mean_mises": _at_load("MPa"),
    "plate_largest_along_fibres": _at_load("MPa"),
    "plate_smallest_along_fibres": _at_load("MPa"),
    "plate_largest_across_fibres": _at_load("MPa"),
    "plate_smallest_across_fibres": _at_load("MPa"),
    "plate_largest_shear": _at_load("MPa"),
    "plate_factor_maximum_stress": _at_load("1"),
    "plate_factor_tsai_wu": _at_load("1"),
    "rubber_largest_principal_strain": _at_load("1"),
    "rubber_largest_energy_density": _at_load("N/mm²"),
    "plate_mass": ResponseKind("kg", Taken.UNLOADED),
    "plate_cost": ResponseKind("currency", Taken.UNLOADED),
}
"""Responses of ``tyre_responses.csv``."""


class ResponseChoice(Strict):
    """A response to which the surfaces of a study are fitted; its name alone, or with a place.

    `plate_mass` is short for ``{name: plate_mass}``.
    """

    name: str = Field(description="As in the column `response` of tyre_responses.csv")
    load_n: float | None = Field(
        None, gt=0, description="Load of a stiffness; none: that of the study"
    )
    displacement_mm: float | None = Field(
        None, gt=0, description="Displacement of a stiffness, instead of a load"
    )

    @model_validator(mode="before")
    @classmethod
    def _name_alone(cls, value: Any) -> Any:
        return {"name": value} if isinstance(value, str) else value

    @model_validator(mode="after")
    def _can_be_taken_there(self) -> Self:
        if self.name not in RESPONSE_KINDS:
            known = ", ".join(RESPONSE_KINDS)
            raise ValueError(f"unknown response {self.name!r}: use one of {known}")
        placed = self.load_n is not None or self.displacement_mm is not None
        taken = RESPONSE_KINDS[self.name].taken
        if placed and taken is not Taken.ANYWHERE:
            raise ValueError(f"{self.name} is taken {taken}: leave load_n and displacement_mm out")
        if self.load_n is not None and self.displacement_mm is not None:
            raise ValueError(f"{self.name}: give load_n or displacement_mm, not both")
        return self

    def at(self, study_load_n: float) -> str:
        """Return where the response is taken, with its unit, as in ``tyre_responses.csv``."""
        if RESPONSE_KINDS[self.name].taken is Taken.UNLOADED:
            return ""
        if self.displacement_mm is not None:
            return f"{self.displacement_mm:g} mm"
        return f"{study_load_n if self.load_n is None else self.load_n:g} N"
