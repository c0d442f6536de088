"""Rules by which curves become properties: every range with the standard's value as default.

One section for each standard, because each has its own ranges; ``tension_standard`` and its
siblings say which one is in force. Ranges that the standards leave to the laboratory, or whose
numbers were not read in a public source, are marked "check against your copy of the standard" in
``docs/methods/reduction.md``.
"""

from __future__ import annotations

from typing import Literal, assert_never

from pydantic import Field

from nptcs.config.base import Strict
from nptcs.config.materials.standards.base import (
    CHORD_METHODS,
    ChordMethod,
    ChordRules,
    Interval,
    Rules,
)
from nptcs.config.materials.standards.composites import (
    AstmD790,
    AstmD3039,
    AstmD3518,
    AstmD6641,
    AstmD7264,
    FlexureRules,
    Iso527,
    Iso14125,
    Iso14129,
    ShearRules,
    TensionRules,
)
from nptcs.config.materials.standards.rubbers import (
    AstmD412,
    AstmD575,
    Iso37,
    Iso7743,
    RubberCompressionRules,
    RubberRules,
)
from nptcs.mechanical_tests import TestType

__all__ = [
    "AstmD3039",
    "AstmD3518",
    "AstmD412",
    "AstmD575",
    "AstmD6641",
    "AstmD7264",
    "AstmD790",
    "CHORD_METHODS",
    "ChordMethod",
    "ChordRules",
    "FlexureRules",
    "Interval",
    "Iso14125",
    "Iso14129",
    "Iso37",
    "Iso527",
    "Iso7743",
    "ReductionSettings",
    "RubberCompressionRules",
    "RubberRules",
    "Rules",
    "ShearRules",
    "StatisticsSettings",
    "TensionRules",
]


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
