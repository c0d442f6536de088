"""How properties and curves become material cards: sources, assumptions, ranges, models."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from nptcs.config.base import Strict
from nptcs.config.materials.reduction import Interval
from nptcs.mechanical_tests import COMPOSITE_TESTS, TestType

ModelName = Literal["neo_hookean", "mooney_rivlin", "yeoh", "ogden"]


def _from_zero(interval: tuple[float, float]) -> tuple[float, float]:
    if interval[0] < 0:
        raise ValueError(f"must begin at zero strain or above, got {interval[0]:g}")
    return interval


def _of_composites(test: TestType) -> TestType:
    if test.is_rubber:
        raise ValueError(f"use a test of composites: {', '.join(COMPOSITE_TESTS)}")
    return test


StrainRange = Annotated[Interval, AfterValidator(_from_zero)]


class ConstantSource(Strict):
    """The specimens and the property that a measured constant comes from."""

    tests: tuple[Annotated[TestType, AfterValidator(_of_composites)], ...] = Field(
        min_length=1,
        description="Tests whose specimens are taken together: " + ", ".join(COMPOSITE_TESTS),
    )
    orientation_deg: float = Field(description="Fibre angle of those specimens")
    property: str = Field(description="Property in the property table")


class PlyAssumptions(Strict):
    """Constants that no test gives: a number, or the name of the constant they equal."""

    e3_mpa: float | Literal["e2_mpa"] = Field("e2_mpa", description="Modulus through thickness")
    nu13: float | Literal["nu12"] = Field("nu12", description="Poisson's ratio 13")
    nu23: float = Field(0.35, description="Poisson's ratio 23")
    g13_mpa: float | Literal["g12_mpa"] = Field("g12_mpa", description="Shear modulus 13")
    g23_mpa: float = Field(2300.0, gt=0, description="Shear modulus 23")


class PlySettings(Strict):
    """Sources and assumptions of the ply's nine constants."""

    e1_mpa: ConstantSource = Field(
        ConstantSource(tests=(TestType.TENSION,), orientation_deg=0, property="modulus"),
        description="E1",
    )
    e2_mpa: ConstantSource = Field(
        ConstantSource(tests=(TestType.TENSION,), orientation_deg=90, property="modulus"),
        description="E2",
    )
    nu12: ConstantSource = Field(
        ConstantSource(tests=(TestType.TENSION,), orientation_deg=0, property="poisson_ratio"),
        description="ν12",
    )
    g12_mpa: ConstantSource = Field(
        ConstantSource(tests=(TestType.SHEAR,), orientation_deg=45, property="shear_modulus"),
        description="G12",
    )
    assumptions: PlyAssumptions = Field(
        PlyAssumptions(), description="Constants that no test gives"
    )
    isotropy_tolerance_percent: float = Field(
        5.0,
        gt=0,
        description="Difference between G23 and E2/(2(1+ν23)) beyond which the card says that "
        "the ply is not transversely isotropic",
    )


class RubberSettings(Strict):
    """Fit of the hyperelastic models."""

    model: ModelName = Field("neo_hookean", description="Model of the card (the study's)")
    compare: tuple[ModelName, ...] = Field(
        ("neo_hookean", "mooney_rivlin", "yeoh", "ogden"),
        description="Models of the comparison table",
    )
    strain_range: StrainRange = Field((0.0, 0.15), description="Nominal strain range of the fit")
    comparison_range: StrainRange | None = Field(
        None, description="Strain range of the comparison table; null: strain_range"
    )
    weights: Literal["specimens", "points", "relative"] = Field(
        "specimens",
        description="specimens: each specimen counts once, however many points it has; "
        "points: each recorded point counts once; "
        "relative: as specimens, residuals divided by the measured stress",
    )
    only_specimen: str | None = Field(
        None, description="Fit this specimen alone; null: all included specimens of the rubber"
    )
    ogden_terms: int = Field(2, ge=1, le=3, description="Number of Ogden terms")
    relative_error_floor: float = Field(
        0.1,
        gt=0,
        lt=1,
        description="Relative errors are evaluated where the measured stress is at least this "
        "fraction of its largest value in the range",
    )
    range_highs: tuple[float, ...] = Field(
        (0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1.0),
        description="Upper ends of the strain range in the table of C10 against range",
    )


class CalibrationSettings(Strict):
    """How the material card is made."""

    ply: PlySettings = Field(PlySettings(), description="Ply constants")
    rubber: RubberSettings = Field(RubberSettings(), description="Rubber constants")
