"""Rules by which curves become properties: every range with the standard's value as default.

A section a standard, because each has its own ranges; ``tension_standard`` and its siblings
say which one is in force. Ranges that the standards leave to the laboratory, or whose numbers
were not read in a public source, are marked "check against your copy of the standard" in
``docs/methods/reduction.md``.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, assert_never

from pydantic import AfterValidator, Field

from nptcs.config.base import Strict
from nptcs.mechanical_tests import TestType

ChordMethod = Literal["nearest_points", "interpolated", "least_squares"]


def _in_order(interval: tuple[float, float]) -> tuple[float, float]:
    low, high = interval
    if not low < high:
        raise ValueError(f"runs from low to high, got {low:g} to {high:g}")
    return interval


Interval = Annotated[tuple[float, float], AfterValidator(_in_order)]

CHORD_METHODS = (
    "nearest_points: the recorded points nearest to both ends of the range; "
    "interpolated: linear interpolation at both ends; "
    "least_squares: regression line over the points inside the range"
)


class Rules(Strict):
    """What the sections of all standards have in common."""

    title: ClassVar[str]
    minimum_specimens: int = Field(5, ge=1, description="Number of specimens asked for")
    reported_statistic: Literal["mean", "median"] = Field(
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
        (1.0, 10.0), description="Time to failure that the standard asks for, minutes; null: none"
    )


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
        None, description="Time to failure that the standard asks for, minutes; null: none"
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
        None, description="Time to failure that the standard asks for, minutes; null: none"
    )


class RubberRules(Rules):
    """Rules of a tension test of rubber."""

    minimum_specimens: int = Field(3, ge=1, description="Number of specimens asked for")
    reported_statistic: Literal["mean", "median"] = Field(
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


class FlexureRules(ChordRules):
    """Rules of a bending test at three or four points."""

    span_to_thickness: Interval | None = Field(
        None, description="Span over thickness that the standard lets expect; null: any"
    )
    loading_spans: tuple[float, ...] = Field(
        (0.0,), description="Loading span over span that the standard has; 0: three points"
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
        (28.0, 36.0), description="Span over thickness (32 within some 12 %)"
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
        None, description="Time to failure that the standard asks for, minutes; null: none"
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


class RubberCompressionRules(Rules):
    """Rules of the compression of a rubber disc."""

    minimum_specimens: int = Field(3, ge=1, description="Number of specimens asked for")
    reported_statistic: Literal["mean", "median"] = Field(
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


class StatisticsSettings(Strict):
    """Statistics of a group of specimens."""

    outlier_significance: float = Field(
        0.05, gt=0, lt=1, description="Significance α of the maximum normed residual test"
    )
    b_basis_minimum_specimens: int = Field(
        5, ge=3, description="Smallest group for which a normal B-basis value is given"
    )
    b_basis_full_specimens: int = Field(
        18, ge=3, description="Group size below which the B-basis value is noted as provisional"
    )
    pool_properties: tuple[str, ...] = Field(
        ("modulus", "poisson_ratio"),
        description="Properties that are pooled; strengths in tension and compression are not "
        "the same quantity",
    )
    pool_tests: tuple[tuple[str, ...], ...] = Field(
        (("tension", "compression"),),
        description="Tests whose groups of equal material, orientation and property are also "
        "shown pooled (standard deviation within the groups)",
    )


class ReductionSettings(Strict):
    """How curves become properties and properties become group statistics."""

    tension_standard: Literal["astm_d3039", "iso_527_4"] = Field(
        "astm_d3039", description="Standard of the tension tests"
    )
    shear_standard: Literal["astm_d3518", "iso_14129"] = Field(
        "astm_d3518", description="Standard of the ±45° tension tests"
    )
    rubber_standard: Literal["astm_d412", "iso_37"] = Field(
        "astm_d412", description="Standard of the rubber tests"
    )
    flexure_standard: Literal["astm_d7264", "astm_d790", "iso_14125"] = Field(
        "astm_d7264", description="Standard of the bending tests"
    )
    rubber_compression_standard: Literal["iso_7743", "astm_d575"] = Field(
        "iso_7743", description="Standard of the compression of rubber discs"
    )
    astm_d3039: AstmD3039 = Field(AstmD3039(), description="Tension, ASTM")
    iso_527_4: Iso527 = Field(Iso527(), description="Tension, ISO")
    astm_d6641: AstmD6641 = Field(AstmD6641(), description="Compression")
    astm_d3518: AstmD3518 = Field(AstmD3518(), description="In-plane shear, ASTM")
    iso_14129: Iso14129 = Field(Iso14129(), description="In-plane shear, ISO")
    astm_d412: AstmD412 = Field(AstmD412(), description="Rubber, ASTM")
    iso_37: Iso37 = Field(Iso37(), description="Rubber, ISO")
    astm_d7264: AstmD7264 = Field(AstmD7264(), description="Flexure, ASTM, composites")
    astm_d790: AstmD790 = Field(AstmD790(), description="Flexure, ASTM, plastics")
    iso_14125: Iso14125 = Field(Iso14125(), description="Flexure, ISO")
    iso_7743: Iso7743 = Field(Iso7743(), description="Compression of rubber, ISO")
    astm_d575: AstmD575 = Field(AstmD575(), description="Compression of rubber, ASTM")
    statistics: StatisticsSettings = Field(
        StatisticsSettings(), description="Statistics of the groups"
    )

    def tension(self) -> TensionRules:
        """Rules in force for tension tests."""
        match self.tension_standard:
            case "astm_d3039":
                return self.astm_d3039
            case "iso_527_4":
                return self.iso_527_4
            case _:
                assert_never(self.tension_standard)

    def shear(self) -> ShearRules:
        """Rules in force for ±45° tension tests."""
        match self.shear_standard:
            case "astm_d3518":
                return self.astm_d3518
            case "iso_14129":
                return self.iso_14129
            case _:
                assert_never(self.shear_standard)

    def rubber(self) -> RubberRules:
        """Rules in force for rubber tests."""
        match self.rubber_standard:
            case "astm_d412":
                return self.astm_d412
            case "iso_37":
                return self.iso_37
            case _:
                assert_never(self.rubber_standard)

    def flexure(self) -> FlexureRules:
        """Rules in force for bending tests."""
        match self.flexure_standard:
            case "astm_d7264":
                return self.astm_d7264
            case "astm_d790":
                return self.astm_d790
            case "iso_14125":
                return self.iso_14125
            case _:
                assert_never(self.flexure_standard)

    def rubber_compression(self) -> RubberCompressionRules:
        """Rules in force for the compression of rubber discs."""
        match self.rubber_compression_standard:
            case "iso_7743":
                return self.iso_7743
            case "astm_d575":
                return self.astm_d575
            case _:
                assert_never(self.rubber_compression_standard)

    def rules(self, test: TestType) -> Rules:
        """Rules in force for a test type of the specimen sheet."""
        match test:
            case TestType.TENSION:
                return self.tension()
            case TestType.COMPRESSION:
                return self.astm_d6641
            case TestType.SHEAR:
                return self.shear()
            case TestType.FLEXURE:
                return self.flexure()
            case TestType.RUBBER_COMPRESSION:
                return self.rubber_compression()
            case TestType.RUBBER_TENSION | TestType.RUBBER_EQUIBIAXIAL | TestType.RUBBER_PURE_SHEAR:
                return self.rubber()
            case _:
                assert_never(test)
