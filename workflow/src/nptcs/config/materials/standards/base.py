"""What the rules of all standards have in common: sizes, numbers of specimens, chords."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import AfterValidator, Field

from nptcs.config.base import Strict

ChordMethod = Literal["nearest_points", "interpolated", "least_squares"]


def _in_order(interval: tuple[float, float]) -> tuple[float, float]:
    low, high = interval
    if not low < high:
        raise ValueError(f"must run from low to high, got {low:g} to {high:g}")
    return interval


Interval = Annotated[tuple[float, float], AfterValidator(_in_order)]
Statistic = Literal["mean", "median"]
"""What a standard reports for a group: a column of the table of statistics."""

CHORD_METHODS = (
    "nearest_points: the recorded points nearest to both ends of the range; "
    "interpolated: linear interpolation at both ends; "
    "least_squares: regression line over the points inside the range"
)


class Rules(Strict):
    """What the sections of all standards have in common."""

    title: ClassVar[str]
    minimum_specimens: int = Field(
        5, ge=1, description="Number of specimens that the standard requires"
    )
    reported_statistic: Statistic = Field(
        "mean", description="Statistic that the standard reports for a group"
    )
    expected_width_mm: dict[int, Interval] = Field(
        default_factory=dict,
        description="Orientation in degrees (0 for rubber): recommended width, from and to, mm",
    )
    expected_thickness_mm: dict[int, Interval] = Field(
        default_factory=dict,
        description="Orientation in degrees (0 for rubber): recommended thickness, from and to, mm",
    )
    stations: int = Field(1, ge=1, description="Places at which width and thickness are measured")


class ChordRules(Rules):
    """Rules of a test with a chord modulus."""

    chord_range: Interval = Field((0.001, 0.003), description="Strain range of the chord")
    chord_method: ChordMethod = Field("nearest_points", description=CHORD_METHODS)
    end_tolerance: float = Field(
        0.1,
        gt=0,
        le=0.5,
        description="Largest distance of a recorded point from its end of the chord, "
        "as a fraction of the chord's width; beyond it the value is flagged",
    )
    time_to_failure_min: Interval | None = Field(
        (1.0, 10.0), description="Time to failure that the standard requires, minutes; null: none"
    )
