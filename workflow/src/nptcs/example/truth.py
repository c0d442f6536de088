"""The truth behind the example data: table 2, the C10 values and the specimen sizes."""

from __future__ import annotations

from dataclasses import dataclass

from nptcs.mechanical_tests import TestType

E1_MPA = 128_000.0
E2_MPA = 8_800.0
NU12 = 0.357
G12_MPA = 3_147.0
NU21 = NU12 * E2_MPA / E1_MPA
"""Reciprocity: ν21 / E2 = ν12 / E1."""
C10_MPA = {"rubber_75A": 1.18, "rubber_88A": 2.91, "rubber_92A": 4.77}
"""Neo-Hookean C10 fitted over nominal strain 0–0.15, section 3.1 of the paper."""


@dataclass(frozen=True)
class Series:
    """A group of nominally equal specimens and how they are tested.

    Parameters
    ----------
    prefix : str
        Of the specimen ids.
    width_mm, thickness_mm : float
        Nominal, table 1 and section 2.2 of the paper.
    gauge_length_mm : float
        Of the extensometer or the camera's field.
    strength_mpa : float
        Stress at which the specimen breaks (shear: axial stress, 2 τ).
    modulus_cv, strength_cv : float
        Scatter between specimens, standard deviation / mean.
    duration_s : float
        Time to break.
    """

    prefix: str
    test: TestType
    material: str
    orientation_deg: float | None
    count: int
    width_mm: float
    thickness_mm: float
    gauge_length_mm: float
    strength_mpa: float
    modulus_cv: float = 0.03
    strength_cv: float = 0.05
    duration_s: float = 90.0


SERIES = (
    Series("T0", TestType.TENSION, "cfrp", 0, 5, 15, 0.9, 50, 1950, duration_s=110),
    Series("T90", TestType.TENSION, "cfrp", 90, 6, 25, 2.1, 50, 47, duration_s=60),
    Series("C0", TestType.COMPRESSION, "cfrp", 0, 5, 12, 2.4, 6, 980, duration_s=75),
    Series("C90", TestType.COMPRESSION, "cfrp", 90, 5, 12, 2.4, 6, 165, duration_s=80),
    Series("S45", TestType.SHEAR, "cfrp", 45, 5, 25, 2.4, 50, 112, duration_s=150),
    Series("R75", TestType.RUBBER_TENSION, "rubber_75A", None, 3, 6, 2, 25, 6.5, 0.025),
    Series("R88", TestType.RUBBER_TENSION, "rubber_88A", None, 3, 6, 2, 25, 15.0, 0.025),
    Series("R92", TestType.RUBBER_TENSION, "rubber_92A", None, 3, 6, 2, 25, 24.0, 0.025),
)
LEFT_OUT = {
    "T90-6": "broke in the grip at about a third of the strength of the others",
}
"""Specimens that the sheet leaves out, and why."""
