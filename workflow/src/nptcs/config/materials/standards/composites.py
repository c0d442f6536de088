"""Rules of the tests of laminates: tension, compression, ±45° shear, flexure."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from nptcs.config.materials.standards.base import ChordRules, Interval


class TensionRules(ChordRules):
    """Rules of a tension test."""

    low_ultimate_strain: float | None = Field(
        None,
        gt=0,
        description="Ultimate strain below which the chord is taken over fractions of the "
        "ultimate strain instead of chord_range; null: never",
    )
    low_ultimate_fractions: Interval = Field(
        (0.25, 0.5), description="Those fractions of the ultimate strain"
    )
    short_run_range: Interval | None = Field(
        None,
        description="Strain range of the chord, flagged, where the strain ends before chord_range "
        "does and the ultimate strain is not known; null: not assessed then",
    )


class AstmD3039(TensionRules):
    """ASTM D3039: tensile properties of polymer matrix composites."""

    title: ClassVar[str] = "ASTM D3039"
    short_run_range: Interval | None = Field(
        (0.0005, 0.0025), description="Chord of a modulus run that ends before chord_range does"
    )
    low_ultimate_strain: float | None = Field(
        0.006, gt=0, description="Ultimate strain below which fractions of it bound the chord"
    )
    expected_width_mm: dict[int, Interval] = Field(
        {0: (14.25, 15.75), 90: (23.75, 26.25), 45: (23.75, 26.25)},
        description="Recommended width by orientation, mm (15 and 25 within 5 %)",
    )
    expected_thickness_mm: dict[int, Interval] = Field(
        {0: (0.8, 1.2), 90: (1.6, 2.4), 45: (2.0, 3.0)},
        description="Recommended thickness by orientation, mm (1.0, 2.0, 2.5 within 20 %)",
    )
    stations: int = Field(3, ge=1, description="Places at which width and thickness are measured")


class Iso527(TensionRules):
    """ISO 527-4/-5: tensile properties of fibre-reinforced plastics."""

    title: ClassVar[str] = "ISO 527-4"
    chord_range: Interval = Field((0.0005, 0.0025), description="Strain range of the chord")
    time_to_failure_min: Interval | None = Field(
        None, description="Time to failure that the standard requires, minutes; null: none"
    )


class AstmD6641(ChordRules):
    """ASTM D6641: compression of polymer matrix composites, combined loading fixture."""

    title: ClassVar[str] = "ASTM D6641"
    bending_limit_percent: float = Field(
        10.0, gt=0, description="Largest |B_y| in the middle of the chord and at failure, percent"
    )
    expected_width_mm: dict[int, Interval] = Field(
        {0: (11.4, 13.7), 90: (11.4, 13.7)},
        description="Recommended width by orientation, mm (12 to 13 within 5 %)",
    )


class ShearRules(ChordRules):
    """Rules of the tension test of a ±45° laminate."""

    chord_range: Interval = Field((0.002, 0.006), description="Shear strain range of the chord")
    chord_width: Interval | None = Field(
        None, description="Width of the recorded chord that the standard allows; null: any"
    )
    chord_start: Interval | None = Field(
        None, description="Lower end of the recorded chord that the standard allows; null: any"
    )
    offset_strain: float | None = Field(
        None, gt=0, description="Offset of the offset strength; null: the standard has none"
    )
    largest_shear_strain: float = Field(
        0.05, gt=0, description="Shear strain at which the curve is cut"
    )


class AstmD3518(ShearRules):
    """ASTM D3518: in-plane shear by tension of a ±45° laminate."""

    title: ClassVar[str] = "ASTM D3518"
    chord_width: Interval | None = Field(
        (0.0038, 0.0042), description="Width of the recorded chord that the standard allows"
    )
    chord_start: Interval | None = Field(
        (0.0015, 0.0025), description="Lower end of the recorded chord that the standard allows"
    )
    offset_strain: float | None = Field(0.002, gt=0, description="Offset of the offset strength")
    expected_width_mm: dict[int, Interval] = Field(
        {45: (23.75, 26.25)}, description="Recommended width, mm (25 within 5 %)"
    )
    stations: int = Field(3, ge=1, description="Places at which width and thickness are measured")


class Iso14129(ShearRules):
    """ISO 14129: in-plane shear by tension of a ±45° laminate."""

    title: ClassVar[str] = "ISO 14129"
    chord_range: Interval = Field((0.001, 0.005), description="Shear strain range of the chord")
    time_to_failure_min: Interval | None = Field(
        None, description="Time to failure that the standard requires, minutes; null: none"
    )


class FlexureRules(ChordRules):
    """Rules of a bending test at three or four points."""

    span_to_thickness: Interval | None = Field(
        None, description="Span over thickness that the standard expects; null: any"
    )
    loading_spans: tuple[float, ...] = Field(
        (0.0,), description="Loading span over span that the standard prescribes; 0: three points"
    )
    large_deflection: tuple[float, float] | None = Field(
        None,
        description="a and b of the factor 1 + a (D/L)² + b (h/L)(D/L) on the stress at three "
        "points where the deflection D is above a tenth of the span; null: no correction",
    )


class AstmD7264(FlexureRules):
    """ASTM D7264: flexure of polymer matrix composites."""

    title: ClassVar[str] = "ASTM D7264"
    span_to_thickness: Interval | None = Field(
        (28.0, 36.0), description="Span over thickness (32 within about 12 %)"
    )
    loading_spans: tuple[float, ...] = Field(
        (0.0, 0.5), description="Procedure A: three points; B: rollers half the span apart"
    )


class AstmD790(FlexureRules):
    """ASTM D790: flexure of plastics at three points."""

    title: ClassVar[str] = "ASTM D790"
    span_to_thickness: Interval | None = Field(
        (15.0, 60.0), description="Span over thickness (16, or more for laminates)"
    )
    large_deflection: tuple[float, float] | None = Field(
        (6.0, -4.0), description="Factors of equation 4; null: no correction"
    )


class Iso14125(FlexureRules):
    """ISO 14125: flexure of fibre-reinforced plastics."""

    title: ClassVar[str] = "ISO 14125"
    chord_range: Interval = Field((0.0005, 0.0025), description="Strain range of the chord")
    time_to_failure_min: Interval | None = Field(
        None, description="Time to failure that the standard requires, minutes; null: none"
    )
    span_to_thickness: Interval | None = Field(
        (16.0, 45.0), description="Span over thickness (16 to 40 by class of material)"
    )
    loading_spans: tuple[float, ...] = Field(
        (0.0, 1 / 3), description="Method A: three points; B: rollers a third of the span apart"
    )
    large_deflection: tuple[float, float] | None = Field(
        (6.0, -3.0), description="Factors for large deflections; null: no correction"
    )
