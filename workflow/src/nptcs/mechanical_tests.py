"""The tests that a specimen sheet can name: a closed set.

Whatever depends on the test type is a ``match`` that ends in ``assert_never``, so that the type
check names every place that a new member still lacks.
"""

from __future__ import annotations

import re
from enum import StrEnum
from typing import assert_never


class TestType(StrEnum):
    """What was done to a specimen."""

    __test__ = False  # not a test class

    TENSION = "tension"
    COMPRESSION = "compression"
    SHEAR = "shear"
    FLEXURE = "flexure"
    RUBBER_TENSION = "rubber_tension"
    RUBBER_EQUIBIAXIAL = "rubber_equibiaxial"
    RUBBER_PURE_SHEAR = "rubber_pure_shear"
    RUBBER_COMPRESSION = "rubber_compression"

    @property
    def is_rubber(self) -> bool:
        """True for the tests of a rubber (large strain, stretch as the variable)."""
        match self:
            case TestType.TENSION | TestType.COMPRESSION | TestType.SHEAR | TestType.FLEXURE:
                return False
            case (
                TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
                | TestType.RUBBER_COMPRESSION
            ):
                return True
            case _:
                assert_never(self)

    @property
    def load_sign(self) -> int:
        """1 if force and axial strain of the tidy curve grow with the load, otherwise -1."""
        match self:
            case TestType.COMPRESSION | TestType.RUBBER_COMPRESSION:
                return -1
            case (
                TestType.TENSION
                | TestType.SHEAR
                | TestType.FLEXURE
                | TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
            ):
                return 1
            case _:
                assert_never(self)

    @property
    def is_bending(self) -> bool:
        """True if stress and strain are those of the outer face of a bent bar."""
        match self:
            case TestType.FLEXURE:
                return True
            case (
                TestType.TENSION
                | TestType.COMPRESSION
                | TestType.SHEAR
                | TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
                | TestType.RUBBER_COMPRESSION
            ):
                return False
            case _:
                assert_never(self)

    @property
    def strains_alike(self) -> bool:
        """True if axial and transverse strain differ in sign, but hardly in size.

        The Poisson's ratio of a ±45° laminate is near 1.
        """
        match self:
            case TestType.SHEAR:
                return True
            case (
                TestType.TENSION
                | TestType.COMPRESSION
                | TestType.FLEXURE
                | TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
                | TestType.RUBBER_COMPRESSION
            ):
                return False
            case _:
                assert_never(self)

    @property
    def has_strength_without_strain(self) -> bool:
        """True if the strength is the largest force over the area, at whatever strain."""
        match self:
            case TestType.TENSION | TestType.COMPRESSION:
                return True
            case (
                TestType.SHEAR  # the largest stress up to a shear strain of 0.05
                | TestType.FLEXURE
                | TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
                | TestType.RUBBER_COMPRESSION
            ):
                return False
            case _:
                assert_never(self)


HYPERELASTIC_FIT = "hyperelastic_fit"
"""What a rubber test contributes to the material card; not a row of the property table."""
TEST_CONDITIONS = ("strain_rate", "time_to_failure")
_STRESS_AT = "stress_at_N_percent"


def property_names(test: TestType) -> tuple[str, ...]:
    """Names of the properties that a test gives; N stands for a number."""
    found: tuple[str, ...]
    match test:
        case TestType.TENSION:
            found = ("modulus", "poisson_ratio", "strength", "ultimate_strain")
        case TestType.COMPRESSION:
            bending = ("bending_percent", "bending_at_failure_percent")
            found = ("modulus", "poisson_ratio", "ultimate_strain", "strength", *bending)
        case TestType.SHEAR:
            strengths = ("offset_shear_strength", "shear_strength", "ultimate_shear_strain")
            found = ("shear_modulus", *strengths)
        case TestType.FLEXURE:
            found = ("flexural_modulus", "flexural_strength", "flexural_strain_at_failure")
        case TestType.RUBBER_TENSION | TestType.RUBBER_EQUIBIAXIAL | TestType.RUBBER_PURE_SHEAR:
            broken = ("strength", "ultimate_strain", "strain_energy_density")
            found = (_STRESS_AT, *broken, HYPERELASTIC_FIT)
        case TestType.RUBBER_COMPRESSION:
            found = (_STRESS_AT, "compression_modulus_at_N_percent", HYPERELASTIC_FIT)
        case _:
            assert_never(test)
    return (*found, *TEST_CONDITIONS)


def is_property(test: TestType, name: str) -> bool:
    """Whether a test gives a property of this name."""
    general = re.sub(r"_\d+(\.\d+)?_percent$", "_N_percent", name)
    return general in property_names(test)


COMPOSITE_TESTS = tuple(test for test in TestType if not test.is_rubber)
RUBBER_TESTS = tuple(test for test in TestType if test.is_rubber)
