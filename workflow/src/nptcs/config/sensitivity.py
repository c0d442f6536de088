"""The section ``sensitivity:`` of the configuration."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from nptcs.config.base import Strict

AveragingRule = Literal["domain_mean_absolute", "design_mean_absolute", "domain_mean_signed"]


class Sensitivity(Strict):
    """How gradients of the response surfaces are averaged."""

    rules: tuple[AveragingRule, ...] = Field(
        ("domain_mean_absolute", "design_mean_absolute", "domain_mean_signed"),
        min_length=1,
        description="Averaging rules; the first is the one that the ranking and the figures show",
    )
    published_impact: str | None = Field(
        None, description="CSV with the paper's table 9 (study, factor, gradient, range, impact)"
    )
