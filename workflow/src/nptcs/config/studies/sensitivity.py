"""The section ``sensitivity:`` of the configuration."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from nptcs.config.base import Strict

AveragingRule = Literal["domain_mean_absolute", "design_mean_absolute", "domain_mean_signed"]


class UniformFactor(Strict):
    """A factor whose values are equally likely over a range."""

    kind: Literal["uniform"]
    low: float = Field(description="Lower bound, in the unit of the factor")
    high: float = Field(description="Upper bound, in the unit of the factor")

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.low >= self.high:
            raise ValueError(f"low must be below high, got {self.low:g} and {self.high:g}")
        return self


class NormalFactor(Strict):
    """A factor that scatters normally, as a manufactured dimension or a tested rubber does."""

    kind: Literal["normal"]
    mean: float = Field(description="Mean, in the unit of the factor")
    sd: float = Field(gt=0, description="Standard deviation, in the unit of the factor")


Distribution = Annotated[UniformFactor | NormalFactor, Field(discriminator="kind")]


class Sobol(Strict):
    """How Sobol indices are estimated."""

    points: int = Field(
        2048,
        ge=64,
        description="Base points, a power of two; n factors need points × (2n + 2) evaluations",
    )
    confidence: float = Field(
        0.95, gt=0, lt=1, description="Confidence level of the bootstrap intervals"
    )
    seed: int = Field(
        1, ge=0, description="Seed of the scrambled Sobol sequence and of the bootstrap"
    )

    @field_validator("points")
    @classmethod
    def _power_of_two(cls, points: int) -> int:
        if points & (points - 1):
            raise ValueError(f"must be a power of two, got {points}")
        return points


class Sensitivity(Strict):
    """How gradients of the response surfaces are averaged, and how variance is apportioned."""

    rules: tuple[AveragingRule, ...] = Field(
        ("domain_mean_absolute", "design_mean_absolute", "domain_mean_signed"),
        min_length=1,
        description="Averaging rules; the first is the one that the ranking and the figures show",
    )
    published_impact: str | None = Field(
        None, description="CSV with the paper's table 9 (study, factor, gradient, range, impact)"
    )
    sobol: Sobol = Sobol()
    distributions: dict[str, Distribution] = Field(
        default_factory=dict,
        description="Distribution of each factor that is named, cut to the range of the cases. "
        "Indices are then given twice: for uniform factors, and for these distributions, where a "
        "factor that is not named stays uniform over its range",
    )
    near_tie_ratio: float = Field(
        0.8,
        gt=0,
        lt=1,
        description="Two factors are a near tie where the smaller effect is at least this share "
        "of the larger one, or where solvers, surfaces or rules disagree on their order",
    )
