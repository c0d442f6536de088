"""The tests that a specimen sheet can name: a closed set.

Whatever depends on the test type is a ``match`` that ends in ``assert_never``, so that the type
check names every place that a new member still lacks.
"""

from __future__ import annotations

from enum import StrEnum
from typing import assert_never


class TestType(StrEnum):
    """What was done to a specimen."""

    __test__ = False  # not a test class

    TENSION = "tension"
    COMPRESSION = "compression"
    SHEAR = "shear"
    RUBBER_TENSION = "rubber_tension"
    RUBBER_EQUIBIAXIAL = "rubber_equibiaxial"
    RUBBER_PURE_SHEAR = "rubber_pure_shear"

    @property
    def is_rubber(self) -> bool:
        """True for the tests of a rubber (large strain, stretch as the variable)."""
        match self:
            case TestType.TENSION | TestType.COMPRESSION | TestType.SHEAR:
                return False
            case TestType.RUBBER_TENSION | TestType.RUBBER_EQUIBIAXIAL | TestType.RUBBER_PURE_SHEAR:
                return True
            case _:
                assert_never(self)

    @property
    def load_sign(self) -> int:
        """1 where force and axial strain of the tidy curve grow with the load, else -1."""
        match self:
            case TestType.COMPRESSION:
                return -1
            case (
                TestType.TENSION
                | TestType.SHEAR
                | TestType.RUBBER_TENSION
                | TestType.RUBBER_EQUIBIAXIAL
                | TestType.RUBBER_PURE_SHEAR
            ):
                return 1
            case _:
                assert_never(self)


COMPOSITE_TESTS = tuple(test for test in TestType if not test.is_rubber)
RUBBER_TESTS = tuple(test for test in TestType if test.is_rubber)
