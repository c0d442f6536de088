"""Spokes with one stiffness in tension and one in compression."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from nptcs.errors import InputError
from nptcs.lca.checks import require_positive


@dataclass(frozen=True)
class LinearSpokes:
    """Stiffness of one spoke, and how many there are.

    Parameters
    ----------
    tension_n_per_mm, compression_n_per_mm : float
        k_t and k_c of a single spoke (N/mm), as table 10 of the paper gives them.
    count : int
        Number N of spokes.

    Raises
    ------
    InputError
        A stiffness is not a positive finite number, or there are fewer than three spokes.

    Examples
    --------
    Table 10 of the paper, C10 1: k and j per unit of arc length at R = 303.875 mm, N/mm²:

    >>> k, j = LinearSpokes(30.2, 13.26, count=60).foundation(radius_mm=303.875)
    >>> round(k, 3), round(j, 3)
    (0.949, 0.417)
    """

    tension_n_per_mm: float
    compression_n_per_mm: float
    count: int = 60

    def __post_init__(self) -> None:
        require_positive("tension_n_per_mm", self.tension_n_per_mm)
        require_positive("compression_n_per_mm", self.compression_n_per_mm)
        if self.count < 3:
            raise InputError(
                "a wheel needs at least three spokes",
                remedy="give the number of spokes",
                column="spoke_count",
                value=self.count,
            )

    @classmethod
    def from_foundation(
        cls, k_n_per_mm2: float, j_n_per_mm2: float, radius_mm: float, count: int = 60
    ) -> LinearSpokes:
        """Return the spokes of a smeared stiffness per unit of arc length (N/mm²)."""
        arc = 2 * pi * radius_mm / count
        return cls(k_n_per_mm2 * arc, j_n_per_mm2 * arc, count)

    def foundation(self, radius_mm: float) -> tuple[float, float]:
        """Return k and j of equation 4, k = k_t N/(2πR), per unit of arc length (N/mm²)."""
        density = self.count / (2 * pi * radius_mm)
        return self.tension_n_per_mm * density, self.compression_n_per_mm * density
