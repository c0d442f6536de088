"""A rubber of the ring in plane strain, small strains."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Rubber:
    """A rubber in plane strain, small strains: shear modulus and κ/G.

    Parameters
    ----------
    c10_mpa : float
        Neo-Hookean constant; the shear modulus is 2 C10.
    bulk_to_shear_ratio : float
        κ/2C10; infinite is incompressible.
    """

    c10_mpa: float
    bulk_to_shear_ratio: float

    @property
    def shear_mpa(self) -> float:
        """Shear modulus G."""
        return 2.0 * self.c10_mpa

    @property
    def along_mpa(self) -> float:
        """Modulus along the ring: 4 G (κ + G/3)/(κ + 4G/3), which is 8 C10 if incompressible."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return 4.0 * self.shear_mpa * (1.0 + inverse / 3.0) / (1.0 + 4.0 * inverse / 3.0)

    @property
    def contraction(self) -> float:
        """Thinning per stretch along the ring: (κ - 2G/3)/(κ + 4G/3)."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return (1.0 - 2.0 * inverse / 3.0) / (1.0 + 4.0 * inverse / 3.0)

    @property
    def through_compliance_per_mpa(self) -> float:
        """Strain through the thickness per pressure, held along the ring: 1/(κ + 4G/3)."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return inverse / (self.shear_mpa * (1.0 + 4.0 * inverse / 3.0))
