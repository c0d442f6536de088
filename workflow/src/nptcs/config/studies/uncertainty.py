"""The section ``uncertainty:`` of the configuration: what scatters, and by how much."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from nptcs.config.base import Strict

CardUncertainty = Literal["standard_error", "scatter"]


class Tolerance(Strict):
    """How a dimension scatters in manufacture; give one of the two keys."""

    sd: float | None = Field(
        None, gt=0, description="Standard deviation (normal), in the unit of the factor"
    )
    plus_minus: float | None = Field(
        None, gt=0, description="Limits of a drawing: all values within ± this are equally likely"
    )

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.sd is None) == (self.plus_minus is None):
            raise ValueError("give either sd or plus_minus")
        return self


class RubberUncertainty(Strict):
    """How well the C10 of a rubber is known; give one of the two keys."""

    rubber: str | None = Field(
        None,
        description="Tested rubber of the specimen sheet: the relative uncertainty of its card is "
        "applied to the C10 of the study",
    )
    sd_percent: float | None = Field(
        None, gt=0, lt=100, description="Stated standard deviation where no card exists"
    )

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.rubber is None) == (self.sd_percent is None):
            raise ValueError("give either rubber or sd_percent")
        return self


class Uncertainty(Strict):
    """What makes the responses of a design uncertain, apart from the solver's own bias."""

    card: CardUncertainty = Field(
        "standard_error",
        description="standard_error: how well the tests determine the mean of each constant; "
        "scatter: how one specimen, and so one tyre, differs from another",
    )
    tolerances: dict[str, Tolerance] = Field(
        default_factory=dict,
        description="Tolerances of manufacture by factor; a factor without one is exact",
    )
    rubbers: dict[str, RubberUncertainty] = Field(
        default_factory=dict,
        description="Uncertainty of shear_band_c10_mpa and spoke_c10_mpa; without an entry a "
        "rubber is listed as not assessed",
    )
    rubber_study: str | None = Field(
        None,
        description="Study whose surface gives the effect of the rubbers in studies that hold them "
        "fixed; the relative change of the response is carried over to other plates",
    )
    surface: str | None = Field(
        None,
        description="Surface used for reference designs, and for decisions that do not name "
        "another; if empty, or if a study has no such surface: the study's surface with the "
        "smallest rms error at left-out cases of its stiffness",
    )
    confidence: float = Field(0.95, gt=0, lt=1, description="Confidence level of the intervals")
    samples: int = Field(
        4096, ge=256, description="Samples of the distribution of a response, a power of two"
    )
    seed: int = Field(1, ge=0, description="Seed of the scrambled Sobol sequence of the samples")

    @model_validator(mode="after")
    def _power_of_two(self) -> Self:
        if self.samples & (self.samples - 1):
            raise ValueError(f"samples must be a power of two, got {self.samples}")
        return self
