"""Rules of the tests of rubbers: tension, and compression of discs."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from nptcs.config.materials.standards.base import Interval, Rules, Statistic


class RubberRules(Rules):
    """Rules of a tension test of rubber."""

    minimum_specimens: int = Field(
        3, ge=1, description="Number of specimens that the standard requires"
    )
    reported_statistic: Statistic = Field(
        "median", description="Statistic that the standard reports for a group"
    )
    elongations_percent: tuple[float, ...] = Field(
        (100.0, 300.0), description="Elongations at which the stress is given, percent"
    )
    gauge_speed_mm_per_min: Interval | None = Field(
        (50.0, 550.0),
        description="Speed at which the gauge length grows that is compatible with 500 mm/min "
        "of grip separation (the shoulders take their share); null: not checked",
    )


class AstmD412(RubberRules):
    """ASTM D412: tension of vulcanised rubber."""

    title: ClassVar[str] = "ASTM D412"
    expected_width_mm: dict[int, Interval] = Field(
        {0: (5.7, 6.3)}, description="Width of die C, mm (6 within 5 %)"
    )
    expected_thickness_mm: dict[int, Interval] = Field({0: (1.3, 3.3)}, description="Thickness, mm")


class Iso37(RubberRules):
    """ISO 37: tension of vulcanised rubber."""

    title: ClassVar[str] = "ISO 37"
    expected_width_mm: dict[int, Interval] = Field(
        {0: (5.6, 6.4)}, description="Width of the type 1 dumb-bell, mm"
    )
    expected_thickness_mm: dict[int, Interval] = Field(
        {0: (1.8, 2.2)}, description="Thickness of the type 1 dumb-bell, mm"
    )


class RubberCompressionRules(Rules):
    """Rules of the compression of a rubber disc."""

    minimum_specimens: int = Field(
        3, ge=1, description="Number of specimens that the standard requires"
    )
    reported_statistic: Statistic = Field(
        "median", description="Statistic that the standard reports for a group"
    )
    compressions_percent: tuple[float, ...] = Field(
        (10.0, 20.0), description="Compressions at which stress and modulus are given, percent"
    )
    loadings: int = Field(
        1, ge=1, description="Loadings of which the last is measured, after conditioning"
    )
    disc_mm: tuple[Interval, Interval] = Field(
        ((1.0, 1000.0), (1.0, 1000.0)), description="Recommended diameter and height, mm"
    )


class Iso7743(RubberCompressionRules):
    """ISO 7743: compression of vulcanised rubber."""

    title: ClassVar[str] = "ISO 7743"
    loadings: int = Field(4, ge=1, description="Three for conditioning, the fourth is measured")
    disc_mm: tuple[Interval, Interval] = Field(
        ((28.5, 29.5), (12.0, 13.0)), description="Diameter and height of test piece A, mm"
    )


class AstmD575(RubberCompressionRules):
    """ASTM D575: compression of rubber."""

    title: ClassVar[str] = "ASTM D575"
    loadings: int = Field(3, ge=1, description="Two for conditioning, the third is measured")
    disc_mm: tuple[Interval, Interval] = Field(
        ((28.5, 28.7), (12.0, 13.0)), description="Diameter and height, mm"
    )
