"""A reported value must be within the same limits as the curve that it comes from."""

from __future__ import annotations

from dataclasses import replace

from nptcs.config.materials.ingest import Plausible
from nptcs.mechanical_tests import TestType
from nptcs.reduce.rows import NAN, Property

POISSON = (-1.0, 3.0)
"""Bounds of a laminate's Poisson's ratio that no layup of the project comes near."""
FREE = ("bending_percent", "bending_at_failure_percent", "strain_rate", "time_to_failure")
"""Conditions of the test: of any sign, and not properties of the material."""


def only_plausible(row: Property, test: TestType, limits: Plausible) -> Property:
    """Return the property, or one that is not assessed where its value is impossible.

    Moduli have the limits of the curve's apparent modulus (a shear modulus is a third to a half
    of them, as in E = 2 (1 + ν) G), strains those of the curve's strain; strengths, stresses and
    energies must be positive.
    """
    if row.value != row.value or row.name in FREE:
        return row
    low, high = _limits(row.name, test, limits)
    if low < row.value <= high:
        return row
    words = f"not assessed: {row.value:.4g} {row.unit} is outside {low:g} to {high:g}"
    return replace(row, value=NAN, standard_error=NAN, flags=(words, *row.flags))


def _limits(name: str, test: TestType, limits: Plausible) -> tuple[float, float]:
    low, high = limits.modulus_rubber_mpa if test.is_rubber else limits.modulus_composite_mpa
    if name == "shear_modulus":
        return low / 3, high / 2
    if "modulus" in name:
        return low, high
    if name == "poisson_ratio":
        return POISSON
    if "strain" in name and "energy" not in name:
        return 0.0, limits.strain_rubber if test.is_rubber else limits.strain_composite
    return 0.0, float("inf")
